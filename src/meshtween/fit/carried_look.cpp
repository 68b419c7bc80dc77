#include "meshtween/fit/carried_look.h"

#include "meshtween/core/color.h"
#include "meshtween/core/error.h"
#include "meshtween/core/parallel.h"
#include "meshtween/fit/bake.h"
#include "meshtween/fit/correspondence.h"
#include "meshtween/fit/counterpart.h"
#include "meshtween/geometry/measure.h"
#include "meshtween/geometry/topology.h"
#include "meshtween/io/mesh_file.h"
#include "meshtween/solve/cholesky.h"
#include "meshtween/solve/laplacian.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace meshtween {
namespace {

constexpr double near_by = 0.01, far_off = 0.03; // of the diagonal: what lies between is shown less and less
constexpr double beside = 0.001;                 // of the diagonal: a place on the giver's border that is still shown
constexpr double further = 1.5;                  // of the distance: to a place that looks the same way

std::size_t idx(std::ptrdiff_t i) {
    return static_cast<std::size_t>(i);
}

using VertexColors = Points; // n x 3, linear RGB

Eigen::Vector3f color_at(const Appearance& look, const SurfacePoint& place) {
    return look.at(place.triangle, place.barycentric.transpose().cast<float>());
}

// A point of the surface for each vertex; triangle -1 where it is in none.
std::vector<SurfacePoint> corners_of(const Mesh& mesh) {
    std::vector<SurfacePoint> places(idx(mesh.positions.rows()));
    for (Eigen::Index t = mesh.triangles.rows() - 1; t >= 0; --t)
        for (int k = 0; k < 3; ++k) {
            SurfacePoint& place = places[idx(mesh.triangles(t, k))];
            place = {static_cast<int>(t), Eigen::RowVector3d::Unit(k)};
        }
    return places;
}

// How far each vertex is shown, 0..1. Where the two do not lie on each other, as far as the middle one does.
std::vector<double> shown(const Correspondence& map) {
    std::vector<double> sorted = map.distance;
    const auto middle = sorted.begin() + std::ssize(sorted) / 2;
    std::nth_element(sorted.begin(), middle, sorted.end());
    const double from = std::max(near_by, 2 * *middle), to = from * far_off / near_by;
    std::vector<double> share(map.distance.size());
    for (std::size_t i = 0; i < share.size(); ++i)
        share[i] = map.border[i] != 0 ? 0 : std::clamp((to - map.distance[i]) / (to - from), 0.0, 1.0);
    return share;
}

// Colours that vary as little as they can where nothing is shown. Parts of which nothing is shown become plain.
VertexColors spread(const Triangles& triangles, VertexColors colors, const std::vector<double>& share) {
    if (std::ranges::all_of(share, [](double s) { return s > 0; })) return colors;
    SparseMatrix system = graph_laplacian(topology(colors.rows(), triangles).neighbours);
    constexpr double held_hard = 1e6, held_softly = 1e-6;
    for (Eigen::Index i = 0; i < colors.rows(); ++i) {
        const bool seen = share[idx(i)] > 0;
        const double weight = seen ? held_hard : held_softly;
        system.coeffRef(i, i) += weight;
        colors.row(i) = weight * (seen ? Point(colors.row(i)) : Point(plain_color.transpose().cast<double>()));
    }
    return SparseCholesky(system).solve(colors);
}

double unseen_area(const Mesh& mesh, const std::vector<double>& share) {
    double whole = 0, unseen = 0;
    for (Eigen::Index t = 0; t < mesh.triangles.rows(); ++t) {
        const double area = triangle_area(mesh.positions, mesh.triangles, t);
        whole += area;
        for (int k = 0; k < 3; ++k) unseen += area * (1 - share[idx(mesh.triangles(t, k))]) / 3;
    }
    return whole > 0 ? unseen / whole : 0;
}

// What the pictures and the vertex colours are made of.
struct Carrying {
    const Mesh &receiver, &giver;
    const Appearance &own, &look;
    const ClosestPointIndex& surface; // the giver's
    const Weld& seams;                // the receiver's
    double diagonal;
    Points normals;            // of the receiver's vertices
    std::vector<char> border;  // of the giver's vertices
    std::vector<double> share; // of the receiver's vertices: how far they are shown
    VertexColors colors;       // of the receiver's vertices

    // The giver's closest place that looks the same way as the receiver there, where it is nearly as close as any.
    ClosestPoint place_on_giver(const Point& at, const Point& normal, int hint) const {
        ClosestPoint best = surface.closest(at, hint);
        if (surface.normals().row(best.where.triangle).dot(normal) >= 0) return best;
        const double reach = further * std::sqrt(best.squared_distance) + beside * diagonal;
        const ClosestPoint alike = surface.closest(at, {normal.normalized(), 0.0}, reach, best.where.triangle);
        return alike.found() ? alike : best;
    }

    void paint(std::span<const SurfacePoint> places, std::span<Eigen::Vector3f> painted) const {
        int hint = -1;
        for (std::size_t i = 0; i < places.size(); ++i) {
            const auto corners = receiver.triangles.row(places[i].triangle);
            Point at(0, 0, 0), normal(0, 0, 0), around(0, 0, 0);
            double seen = 0;
            for (int k = 0; k < 3; ++k) {
                const double b = places[i].barycentric[k];
                at += b * receiver.positions.row(corners[k]);
                normal += b * normals.row(corners[k]);
                around += b * colors.row(corners[k]);
                seen += b * share[idx(corners[k])];
            }
            const Eigen::Vector3f rest =
                own.any() ? color_at(own, places[i]) : Eigen::Vector3f(around.transpose().cast<float>());
            if (seen <= 0) {
                painted[i] = rest;
                continue;
            }
            const ClosestPoint found = place_on_giver(at, normal, hint);
            hint = found.where.triangle;
            if (at_border(found.where, giver.triangles, border)) { // it may end between the receiver's vertices
                const double away = std::sqrt(found.squared_distance) / (beside * diagonal);
                seen *= std::clamp(3 - away, 0.0, 1.0);
            }
            const auto weight = static_cast<float>(seen);
            painted[i] = weight * color_at(look, found.where) + (1 - weight) * rest;
        }
    }
};

// The vertices' colours, and in them what is not shown.
VertexColors vertex_colors(const Carrying& c, const std::vector<SurfacePoint>& places) {
    VertexColors colors(c.receiver.positions.rows(), 3);
    parallel_for(colors.rows(), [&](std::ptrdiff_t i) {
        colors.row(i) = color_at(c.look, places[idx(i)]).transpose().cast<double>();
    });
    if (!c.own.any()) {
        if (!c.seams.any()) return spread(c.receiver.triangles, std::move(colors), c.share);
        return c.seams.expanded(c.seams.reduced(spread(c.seams.by_first(), std::move(colors), c.share)));
    }
    const std::vector<SurfacePoint> corners = corners_of(c.receiver);
    parallel_for(colors.rows(), [&](std::ptrdiff_t i) {
        if (corners[idx(i)].triangle < 0) return;
        const Point rest = color_at(c.own, corners[idx(i)]).transpose().cast<double>();
        colors.row(i) = c.share[idx(i)] * colors.row(i) + (1 - c.share[idx(i)]) * rest;
    });
    return colors;
}

Colors shown_colors(const VertexColors& linear) {
    Colors colors(linear.rows(), 4);
    for (Eigen::Index i = 0; i < linear.rows(); ++i) {
        for (int c = 0; c < 3; ++c)
            colors(i, c) = srgb_from_linear(static_cast<float>(std::clamp(linear(i, c), 0.0, 1.0)));
        colors(i, 3) = 1;
    }
    return colors;
}

// The mesh's file without its look: white materials of the same names. Triangles are polygons where it has none.
MeshFile bare_file(const Mesh& mesh) {
    MeshFile file;
    if (is_described(mesh)) {
        file = *mesh.file;
    } else {
        file.corners.assign(mesh.triangles.data(), mesh.triangles.data() + mesh.triangles.size());
        file.cut.resizeLike(mesh.triangles);
        for (Eigen::Index t = 0; t < mesh.triangles.rows(); ++t) {
            file.ends.push_back(static_cast<int>(3 * t + 3));
            file.cut.row(t) << static_cast<int>(3 * t), static_cast<int>(3 * t + 1), static_cast<int>(3 * t + 2);
        }
    }
    file.format.clear(); // it is no longer what the bytes say
    file.bytes.clear();
    file.images.clear();
    file.material_libraries.clear();
    file.notes.clear();
    file.vertices = mesh.positions.rows();
    for (Material& material : file.materials) material = {.name = material.name, .double_sided = material.double_sided};
    return file;
}

// Gives each polygon a material with the picture that it lies on.
void set_pictures(MeshFile& file, const PictureLayout& layout, const std::vector<Image>& pictures,
                  const std::string& name) {
    for (std::size_t i = 0; i < pictures.size(); ++i)
        file.images.push_back({.name = i == 0 ? name : fmt::format("{}_{}", name, i + 1),
                               .mime = "image/png",
                               .bytes = png_bytes(pictures[i]),
                               .path = {}});
    std::vector<int> on(file.ends.size(), 0); // a polygon: its picture
    const std::vector<int> polygon = polygon_of_triangles(file);
    for (std::size_t t = polygon.size(); t-- > 0;) on[idx(polygon[t])] = layout.picture[t];
    file.polygon_materials.resize(file.ends.size(), -1);
    std::map<std::pair<int, int>, int> numbers; // of a material and a picture
    std::vector<Material> materials;
    std::map<int, int> split;
    for (std::size_t p = 0; p < on.size(); ++p) {
        int& m = file.polygon_materials[p];
        const auto [entry, fresh] = numbers.try_emplace({m, on[p]}, static_cast<int>(materials.size()));
        if (fresh) {
            Material material = m >= 0 && m < std::ssize(file.materials) ? file.materials[idx(m)] : Material{};
            if (material.name.empty()) material.name = "surface";
            if (const int again = split[m]++; again > 0) material.name += fmt::format("_{}", again + 1);
            material.roughness = 0.6F;
            material.base_color_image = on[p];
            materials.push_back(std::move(material));
        }
        m = entry->second;
    }
    file.materials = std::move(materials);
}

} // namespace

CarriedLook carried_look(const Mesh& receiver, const Mesh& giver, const std::string& giver_name,
                         const LookOptions& options, const Progress& progress) {
    const Appearance look(giver), own(receiver);
    if (!look.problems().empty()) throw Error(ErrorKind::file, fmt::format("{}: {}", giver_name, look.problems()[0]));
    if (!look.any())
        throw Error(ErrorKind::file, fmt::format("{} has neither colours nor a texture to carry over", giver_name));
    CarriedLook result;
    result.mesh = receiver;
    keep_going(progress, 0, "finding places");
    const Comparison both(receiver, giver);
    const Correspondence map = correspondence(both);
    const Weld& giver_seams = both.target_seams; // a cut in the numbering is no border
    std::vector<char> border =
        topology(giver.positions.rows(), giver_seams.any() ? giver_seams.by_first() : giver.triangles).on_boundary;
    giver_seams.share(border);
    Carrying c{receiver,
               giver,
               own,
               look,
               both.on_target,
               both.fitted_seams,
               both.diagonal,
               vertex_normals(receiver.positions, receiver.triangles, both.fitted_seams),
               std::move(border),
               shown(map),
               {}};
    c.colors = vertex_colors(c, map.places);
    result.unseen = unseen_area(receiver, c.share);
    if (!keep_going(progress, 0.2, "carrying over")) result.cancelled = true;
    MeshFile file = bare_file(receiver);
    const bool wanted = look.has_pictures() || options.bake_colors;
    const PictureLayout layout = wanted ? picture_layout(receiver) : PictureLayout{};
    result.no_picture = layout.problem;
    if (wanted && layout.problem.empty() && !result.cancelled) {
        const Baked baked = bake(
            receiver, layout, {.size = options.texture_size, .margin = std::max(8, options.texture_size / 128)},
            [&c](std::span<const SurfacePoint> places, std::span<Eigen::Vector3f> colors) { c.paint(places, colors); },
            part_of(progress, 0.2, 0.95));
        result.cancelled = baked.cancelled;
        result.twice = baked.twice;
        if (!baked.cancelled) set_pictures(file, layout, baked.pictures, options.picture_name);
        result.mesh.colors.resize(0, 4);
    } else {
        result.mesh.colors = shown_colors(c.colors);
    }
    result.mesh.file = std::make_shared<MeshFile>(std::move(file));
    return result;
}

} // namespace meshtween
