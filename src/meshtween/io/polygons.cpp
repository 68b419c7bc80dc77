#include "meshtween/io/polygons.h"

#include "meshtween/io/text.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace meshtween {
namespace {

using Vector2 = Eigen::Vector2d;

Point corner_position(const PolygonMesh& mesh, int corner) {
    const std::size_t v = static_cast<std::size_t>(mesh.corners[static_cast<std::size_t>(corner)]);
    return {mesh.coordinates[3 * v], mesh.coordinates[3 * v + 1], mesh.coordinates[3 * v + 2]};
}

// The polygon in the plane of its area vector (Newell), counter-clockwise; `area` is twice its area.
std::vector<Vector2> flattened(const PolygonMesh& mesh, const std::vector<int>& polygon, double& area) {
    const Point origin = corner_position(mesh, polygon[0]);
    Point normal(0, 0, 0);
    for (std::size_t i = 1; i + 1 < polygon.size(); ++i)
        normal += (corner_position(mesh, polygon[i]) - origin).cross(corner_position(mesh, polygon[i + 1]) - origin);
    area = normal.norm();
    std::vector<Vector2> flat(polygon.size(), Vector2::Zero());
    if (!(area > 0)) return flat;
    normal /= area;
    const Point x = normal.unitOrthogonal(), y = normal.cross(x);
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const Point p = corner_position(mesh, polygon[i]) - origin;
        flat[i] = {p.dot(x), p.dot(y)};
    }
    return flat;
}

double cross(const Vector2& a, const Vector2& b, const Vector2& c) {
    return (b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x());
}

bool inside(const Vector2& p, const Vector2& a, const Vector2& b, const Vector2& c) {
    return cross(a, b, p) >= 0 && cross(b, c, p) >= 0 && cross(c, a, p) >= 0 && p != a && p != b && p != c;
}

bool is_ear(const std::vector<Vector2>& flat, const std::vector<int>& left, std::size_t i, double least) {
    const std::size_t n = left.size();
    const auto at = [&](std::size_t k) { return flat[static_cast<std::size_t>(left[k % n])]; };
    const Vector2 a = at(i + n - 1), b = at(i), c = at(i + 1);
    if (cross(a, b, c) <= least) return false;
    for (std::size_t k = i + 2; k < i + n - 1; ++k)
        if (inside(at(k), a, b, c)) return false;
    return true;
}

// Meisters' ears: a corner whose triangle holds no other corner is cut off until three are left. A polygon that cuts
// itself may run out of ears; the rest is then cut as a fan.
template <typename Emit>
void clip_ears(const std::vector<Vector2>& flat, double least, const Emit& emit) {
    std::vector<int> left(flat.size());
    for (std::size_t i = 0; i < left.size(); ++i) left[i] = static_cast<int>(i);
    for (std::size_t i = 0, tried = 0; left.size() > 3 && tried < left.size();) {
        const std::size_t n = left.size();
        i %= n;
        if (is_ear(flat, left, i, least)) {
            emit(left[(i + n - 1) % n], left[i], left[(i + 1) % n]);
            left.erase(left.begin() + static_cast<std::ptrdiff_t>(i));
            tried = 0;
        } else {
            ++i;
            ++tried;
        }
    }
    for (std::size_t i = 1; i + 1 < left.size(); ++i) emit(left[0], left[i], left[i + 1]);
}

template <typename Emit>
void cut_polygon(const PolygonMesh& mesh, const std::vector<int>& polygon, const Emit& emit) {
    constexpr std::size_t most_to_clip = 4096; // clipping takes quadratic time
    double area = 0;
    const std::vector<Vector2> flat = flattened(mesh, polygon, area);
    const double least = 1e-9 * area;
    bool fan = polygon.size() > most_to_clip || !(area > 0);
    if (!fan) {
        fan = true;
        for (std::size_t i = 1; i + 1 < flat.size() && fan; ++i) fan = cross(flat[0], flat[i], flat[i + 1]) > least;
    }
    const auto put = [&](int a, int b, int c) {
        emit(polygon[static_cast<std::size_t>(a)], polygon[static_cast<std::size_t>(b)],
             polygon[static_cast<std::size_t>(c)]);
    };
    if (!fan) return clip_ears(flat, least, put);
    for (int i = 1; i + 1 < static_cast<int>(polygon.size()); ++i) put(0, i, i + 1);
}

// The corners begin..end without those that repeat the vertex before them; all of them if fewer than three are left.
std::vector<int> distinct_corners(const PolygonMesh& mesh, int begin, int end) {
    const auto vertex = [&](int corner) { return mesh.corners[static_cast<std::size_t>(corner)]; };
    std::vector<int> result;
    for (int c = begin; c < end; ++c)
        if (result.empty() || vertex(result.back()) != vertex(c)) result.push_back(c);
    while (result.size() > 1 && vertex(result.front()) == vertex(result.back())) result.pop_back();
    if (result.size() < 3) {
        result.clear();
        for (int c = begin; c < end; ++c) result.push_back(c);
    }
    return result;
}

void set_texcoords(Mesh& mesh, PolygonMesh& polygons, const Triangles& cut) {
    if (polygons.texcoord_corners.empty()) return;
    // Corners without a texture coordinate share one more, at the origin.
    const int none = static_cast<int>(polygons.texcoords.size() / 2);
    if (std::find(polygons.texcoord_corners.begin(), polygons.texcoord_corners.end(), -1) !=
        polygons.texcoord_corners.end())
        polygons.texcoords.insert(polygons.texcoords.end(), {0.0F, 0.0F});
    mesh.texcoords = Eigen::Map<const Texcoords>(polygons.texcoords.data(),
                                                 static_cast<Eigen::Index>(polygons.texcoords.size() / 2), 2);
    mesh.texcoord_triangles = cut.unaryExpr([&](int corner) {
        const int index = polygons.texcoord_corners[static_cast<std::size_t>(corner)];
        return index < 0 ? none : index;
    });
}

} // namespace

void share_texcoords(PolygonMesh& polygons, const std::vector<float>& wedges) {
    constexpr int most_compared = 64; // more than any real vertex has: a file made to take long does not
    const std::size_t vertices = polygons.coordinates.size() / 3;
    std::vector<int> last(vertices, -1), before; // a vertex's last texture coordinate, and the one before each
    for (std::size_t c = 0; c < polygons.corners.size(); ++c) {
        const auto vertex = static_cast<std::size_t>(polygons.corners[c]);
        if (vertex >= vertices) return; // require_sound will say so
        const float u = wedges[2 * c], v = wedges[2 * c + 1];
        int found = last[vertex];
        for (int tries = 0; found >= 0; ++tries) {
            const auto i = static_cast<std::size_t>(found);
            if (polygons.texcoords[2 * i] == u && polygons.texcoords[2 * i + 1] == v) break;
            found = tries < most_compared ? before[i] : -1;
        }
        if (found < 0) {
            found = static_cast<int>(before.size());
            before.push_back(std::exchange(last[vertex], found));
            polygons.texcoords.insert(polygons.texcoords.end(), {u, v});
        }
        polygons.texcoord_corners.push_back(found);
    }
}

Triangles cut_polygons(const PolygonMesh& polygons) {
    std::vector<int> cut;
    cut.reserve(polygons.corners.size());
    const auto emit = [&](int a, int b, int c) { cut.insert(cut.end(), {a, b, c}); };
    int begin = 0;
    for (const int end : polygons.ends) {
        if (end - begin == 3)
            emit(begin, begin + 1, begin + 2);
        else
            cut_polygon(polygons, distinct_corners(polygons, begin, end), emit);
        begin = end;
    }
    return Eigen::Map<const Triangles>(cut.data(), static_cast<Eigen::Index>(cut.size() / 3), 3);
}

std::optional<Triangles> cut_like(const PolygonMesh& polygons, const Triangles& triangles) {
    Triangles cut(triangles.rows(), 3);
    Eigen::Index t = 0;
    int begin = 0;
    for (const int end : polygons.ends) {
        const auto last = polygons.corners.begin() + end;
        const Eigen::Index most = t + end - begin - 2, least = t + 1;
        for (bool here = true; here && t < std::min(most, triangles.rows()); t += here)
            for (int k = 0; k < 3 && here; ++k) {
                // A triangle may name a vertex twice: then the next corner with it.
                const int from = k > 0 && triangles(t, k) == triangles(t, k - 1) ? cut(t, k - 1) + 1 : begin;
                const auto found = std::find(polygons.corners.begin() + from, last, triangles(t, k));
                here = found != last;
                if (here) cut(t, k) = static_cast<int>(found - polygons.corners.begin());
            }
        if (t < least) return {};
        begin = end;
    }
    if (t != triangles.rows()) return {};
    return cut;
}

void require_sound(const PolygonMesh& polygons, const std::filesystem::path& path) {
    constexpr std::size_t most = std::numeric_limits<int>::max() / 3;
    const std::size_t vertices = polygons.coordinates.size() / 3;
    if (vertices == 0) bad_file(path, "holds no vertices; export the model again, as a triangle mesh");
    if (polygons.ends.empty())
        bad_file(path,
                 fmt::format("holds {} vertices but no faces; a surface is needed, not a cloud of points", vertices));
    if (vertices > most || polygons.corners.size() > most)
        bad_file(path,
                 fmt::format("holds more than {} vertices or face corners, too many; reduce the model first", most));
    for (std::size_t i = 0; i < polygons.coordinates.size(); ++i)
        if (!std::isfinite(polygons.coordinates[i]))
            bad_file(path,
                     fmt::format("coordinate {} of vertex {} (counted from 0) is {}, which is not a finite number; "
                                 "mend the coordinates or export the model again",
                                 "xyz"[i % 3], i / 3, polygons.coordinates[i]));
    std::size_t corner = 0;
    for (std::size_t face = 0; face < polygons.ends.size(); ++face)
        for (; corner < static_cast<std::size_t>(polygons.ends[face]); ++corner) {
            const int v = polygons.corners[corner];
            if (v < 0 || static_cast<std::size_t>(v) >= vertices)
                bad_file(path,
                         fmt::format("face {} (counted from 0) names vertex {}, but there are {}, 0 to {}; the file "
                                     "is damaged, export the model again",
                                     face, v, vertices, vertices - 1));
        }
}

Mesh cut_mesh(PolygonMesh&& polygons, const Triangles& cut) {
    Mesh mesh;
    const auto rows = static_cast<Eigen::Index>(polygons.coordinates.size() / 3);
    mesh.positions = Eigen::Map<const Points>(polygons.coordinates.data(), rows, 3);
    mesh.triangles = cut.unaryExpr([&](int corner) { return polygons.corners[static_cast<std::size_t>(corner)]; });
    if (!polygons.colors.empty()) mesh.colors = Eigen::Map<const Colors>(polygons.colors.data(), rows, 4);
    MeshFile file = std::move(polygons.file);
    file.corners = std::move(polygons.corners);
    file.ends = std::move(polygons.ends);
    file.cut = cut;
    file.vertices = rows;
    set_texcoords(mesh, polygons, cut);
    file.attributes = attributes_key(mesh);
    file.shape = shape_key(mesh);
    mesh.file = std::make_shared<const MeshFile>(std::move(file));
    return mesh;
}

} // namespace meshtween
