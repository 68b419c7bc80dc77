// Stretch is Schreiner et al. 2004, Inter-Surface Mapping: sqrt((s1^2 + s2^2 + 1/s1^2 + 1/s2^2) / 4) of the singular
// values s1, s2 of each face's map, averaged over the faces around a vertex.
#include "meshes.h"

#include "meshtween/app/report.h"
#include "meshtween/core/error.h"
#include "meshtween/core/parallel.h"
#include "meshtween/fit/markers.h"
#include "meshtween/geometry/measure.h"
#include "meshtween/io/mesh_file.h"
#include "meshtween/io/mesh_io.h"
#include "meshtween/io/seams.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace meshtween::studio {
namespace {

constexpr std::size_t longest_list = 200;
constexpr double largest_stretch = 100; // of a face without area

Json point(const Point& p) {
    return {p[0], p[1], p[2]};
}

// The stretch of one face's map; a reflection cannot be seen here and is listed as a flip.
double stretch_of(const Mesh& from, const Points& to, Eigen::Index t) {
    const auto corners = from.triangles.row(t);
    const Point a = from.positions.row(corners[1]) - from.positions.row(corners[0]),
                b = from.positions.row(corners[2]) - from.positions.row(corners[0]);
    const double length = a.norm();
    if (length <= 0) return largest_stretch;
    const double x = a.dot(b) / length, y = std::sqrt(std::max(0.0, b.squaredNorm() - x * x));
    if (y <= 0) return largest_stretch;
    const Point p = to.row(corners[1]) - to.row(corners[0]), q = to.row(corners[2]) - to.row(corners[0]);
    const Point u = p / length, v = (q - u * x) / y; // columns of the 3 x 2 Jacobian
    const double sum = u.squaredNorm() + v.squaredNorm(), area2 = u.cross(v).squaredNorm(); // s1^2 + s2^2, (s1 s2)^2
    if (area2 <= 0) return largest_stretch;
    return std::min(largest_stretch, std::sqrt((sum + sum / area2) / 4));
}

Eigen::VectorXd vertex_stretch(const Mesh& from, const Points& to) {
    Eigen::VectorXd of_face(from.triangles.rows());
    parallel_for(of_face.size(), [&](Eigen::Index t) { of_face[t] = stretch_of(from, to, t); });
    Eigen::VectorXd sum = Eigen::VectorXd::Zero(to.rows()), count = Eigen::VectorXd::Zero(to.rows());
    for (Eigen::Index i = 0; i < from.triangles.size(); ++i) {
        const int vertex = from.triangles.data()[i];
        sum[vertex] += of_face[i / 3];
        count[vertex] += 1;
    }
    return (sum.array() / count.array().max(1)).matrix() +
           (count.array() == 0).cast<double>().matrix(); // vertices of no face: 1
}

// Percent of the target's diagonal from where the fit took a marker to where it should be.
Json marker_errors(const OpenMesh& source, const OpenMesh& target, const Mesh& fitted,
                   const std::vector<PlacedMarker>& markers) {
    Json errors = Json::object();
    for (const PlacedMarker& marker : markers) {
        if (!marker.source || !marker.target) continue;
        const ClosestPoint start = source.index.closest(*marker.source);
        const Point end = position(fitted.positions, fitted.triangles, start.where);
        errors[marker.id] = 100 * (end - *marker.target).norm() / target.frame.scale;
    }
    return errors;
}

} // namespace

std::shared_ptr<const OpenMesh> open_mesh(const std::filesystem::path& path) {
    Mesh mesh = read_mesh(path);
    std::vector<Finding> findings = check(mesh, seams(mesh));
    for (const Finding& finding : findings)
        if (finding.severity == Severity::error)
            throw Error(ErrorKind::file, fmt::format("{}: {}", path.filename().string(), finding.what));
    ClosestPointIndex index(mesh);
    const Frame frame = frame_of(mesh);
    return std::make_shared<const OpenMesh>(OpenMesh{path, hash_of(path), std::filesystem::last_write_time(path),
                                                     std::filesystem::file_size(path), std::move(mesh), frame,
                                                     std::move(findings), std::move(index)});
}

std::shared_ptr<const OpenMesh> open_as(const std::filesystem::path& path, const std::string& name) {
    try {
        return open_mesh(path);
    } catch (const Error& error) {
        std::string told = error.what();
        if (const std::size_t at = told.find(path.string()); at != std::string::npos)
            told.replace(at, path.string().size(), name);
        throw Error(error.kind(), told);
    }
}

Json to_json(const OpenMesh& open) {
    Json findings = Json::array();
    for (const Finding& finding : open.findings)
        findings.push_back({{"warning", finding.severity != Severity::note}, {"what", finding.what}});
    const Json notes = open.mesh.file ? Json(open.mesh.file->notes) : Json::array();
    return {{"name", open.path.filename().string()},
            {"path", open.path.string()},
            {"hash", open.hash},
            {"vertices", open.mesh.positions.rows()},
            {"triangles", open.mesh.triangles.rows()},
            {"frame", to_json(open.frame)},
            {"colors", open.mesh.colors.rows() > 0},
            {"uvs", open.mesh.texcoords.rows() > 0},
            {"notes", notes},
            {"findings", findings}};
}

bool changed_on_disk(const OpenMesh& open) {
    std::error_code gone;
    const auto time = std::filesystem::last_write_time(open.path, gone);
    if (gone) return true;
    if (time == open.time && std::filesystem::file_size(open.path, gone) == open.size) return false;
    return hash_of(open.path) != open.hash;
}

Fitted shown(const OpenMesh& source, const OpenMesh& target, Points positions) {
    Fitted fitted;
    fitted.of = source.hash + target.hash;
    fitted.mesh = source.mesh;
    fitted.mesh.positions = std::move(positions);
    const Points& points = fitted.mesh.positions;
    fitted.distance.resize(points.rows());
    parallel_for(points.rows(), [&](Eigen::Index i) {
        fitted.distance[i] =
            100 * std::sqrt(target.index.closest(Point(points.row(i))).squared_distance) / target.frame.scale;
    });
    fitted.stretch = vertex_stretch(source.mesh, points);
    fitted.map = correspondence(fitted.mesh, target.mesh);
    return fitted;
}

Fitted examined(const OpenMesh& source, const OpenMesh& target, const FitResult& result,
                const std::vector<PlacedMarker>& markers, const Progress& progress) {
    keep_going(progress, 0, "measuring");
    Fitted fitted = shown(source, target, result.positions);
    keep_going(progress, 0.1, "measuring");
    set_aside(fitted.map, result.carried);
    fitted.summary = meshtween::to_json(result);
    fitted.summary["of"] = fitted.of;
    fitted.summary["mark"] = mark_of(markers);
    const std::vector<Marker> placed = place_markers(complete_pairs(markers), source.mesh);
    const Comparison both(fitted.mesh, target.mesh);
    const Quality quality = measure(source.mesh, both, {}, placed);
    fitted.summary["quality"] = meshtween::to_json(quality);
    fitted.summary["answered"] =
        meshtween::to_json(answered_quality(source.mesh, both, quality, fitted.map.border, result.left_out));
    keep_going(progress, 0.7, "finding places");
    fitted.summary["marker_errors"] = marker_errors(source, target, fitted.mesh, markers);
    fitted.summary.update(
        fit_places(source.mesh, fitted.mesh, target.mesh, result, fitted.map, quality, placed, longest_list));
    keep_going(progress, 1, "measuring");
    return fitted;
}

std::vector<MarkerPair> complete_pairs(const std::vector<PlacedMarker>& markers) {
    std::vector<MarkerPair> pairs;
    for (std::size_t i = 0; i < markers.size(); ++i)
        if (markers[i].source && markers[i].target)
            pairs.push_back({markers[i].name.empty() ? std::to_string(i + 1) : markers[i].name, *markers[i].source,
                             *markers[i].target});
    return pairs;
}

Points side_of_pairs(const std::vector<MarkerPair>& pairs, Side side) {
    Points points(std::ssize(pairs), 3);
    for (std::size_t i = 0; i < pairs.size(); ++i)
        points.row(Eigen::Index(i)) = side == Side::source ? pairs[i].source : pairs[i].target;
    return points;
}

std::string mark_of(const std::vector<PlacedMarker>& markers) {
    Json places = Json::array();
    for (const MarkerPair& pair : complete_pairs(markers)) places.push_back({point(pair.source), point(pair.target)});
    return hash_of_bytes(places.dump());
}

} // namespace meshtween::studio
