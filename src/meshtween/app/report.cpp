#include "meshtween/app/report.h"

#include "meshtween/fit/counterpart.h"
#include "meshtween/geometry/measure.h"

#include <sys/resource.h>

#include <algorithm>
#include <array>
#include <span>

namespace meshtween {
namespace {

std::string_view name_of(FitEnd end) {
    switch (end) {
    case FitEnd::converged:
        return "converged";
    case FitEnd::out_of_rounds:
        return "out of rounds";
    case FitEnd::cancelled:
        return "cancelled";
    }
    return "";
}

Json told(const Point& p) {
    return {p[0], p[1], p[2]};
}

template <class T>
std::span<const T> first_of(const std::vector<T>& list, std::size_t most) {
    return std::span(list).first(std::min(most, list.size()));
}

Point centre(const Mesh& mesh, int triangle) {
    return position(mesh.positions, mesh.triangles, {triangle, Point::Constant(1.0 / 3)});
}

Json told_vertices(const Mesh& mesh, std::span<const int> vertices) {
    Json list = Json::array();
    for (const int v : vertices) list.push_back({{"vertex", v}, {"at", told(mesh.positions.row(v))}});
    return list;
}

Json told_triangles(const Mesh& mesh, std::span<const int> triangles) {
    Json list = Json::array();
    for (const int t : triangles) list.push_back({{"triangle", t}, {"at", told(centre(mesh, t))}});
    return list;
}

Json told_pairs(const Mesh& mesh, std::span<const std::array<int, 2>> pairs) {
    Json list = Json::array();
    for (const auto& [a, b] : pairs)
        list.push_back({{"triangles", {a, b}}, {"at", told((centre(mesh, a) + centre(mesh, b)) / 2)}});
    return list;
}

// Lengths in percent, as elsewhere in a report.
double told_value(const WorstPlace& place) {
    const bool length = place.fault == PlaceFault::off_target || place.fault == PlaceFault::uncovered ||
                        place.fault == PlaceFault::beyond;
    return length ? 100 * place.value : place.value;
}

} // namespace

std::string_view name_of(Severity severity) {
    switch (severity) {
    case Severity::note:
        return "note";
    case Severity::warning:
        return "warning";
    case Severity::error:
        return "error";
    }
    return "";
}

Json to_json(const Statistics& s) {
    return {{"mean", s.mean}, {"rms", s.rms}, {"median", s.median}, {"p95", s.p95}, {"p99", s.p99}, {"max", s.max}};
}

Json to_json(const Quality& q) {
    Json json{{"vertices", q.vertices},
              {"triangles", q.triangles},
              {"eq7", q.eq7},
              {"vertex_to_target", to_json(q.vertex_to_target)},
              {"fitted_to_target", to_json(q.fitted_to_target)},
              {"target_to_fitted", to_json(q.target_to_fitted)},
              {"flipped_faces", q.flipped.size()},
              {"flipped_area_percent", q.flipped_area_percent},
              {"degenerate_faces", q.degenerate},
              {"self_intersections", q.cuts.size()},
              {"self_intersections_source", q.cuts_source},
              {"self_intersections_target", q.cuts_target},
              {"symmetric_dirichlet", to_json(q.symmetric_dirichlet)}};
    if (q.copies > 0) json["copies_of_vertices"] = q.copies;
    if (q.truth_error) json["truth_error"] = to_json(*q.truth_error);
    if (q.marker_error) json["marker_error"] = to_json(*q.marker_error);
    return json;
}

Json to_json(const AnsweredQuality& quality) {
    return {{"faces", quality.faces},
            {"fitted_to_target", to_json(quality.fitted_to_target)},
            {"target_to_fitted", to_json(quality.target_to_fitted)},
            {"flipped_faces", quality.flipped.size()},
            {"self_intersections", quality.cuts}};
}

Json to_json(const FitResult& result) {
    return {{"end", name_of(result.end)},
            {"rounds", result.rounds},
            {"eq7", result.error},
            {"history", result.history},
            {"refused_steps", result.refused_steps},
            {"mirror_twins", result.twins},
            {"carried_vertices", result.carried.size()},
            {"target_faces_left_out", result.left_out.size()},
            {"notes", result.notes}};
}

Json to_json(const std::vector<Finding>& findings) {
    Json json = Json::array();
    for (const Finding& finding : findings)
        json.push_back({{"severity", name_of(finding.severity)}, {"what", finding.what}, {"count", finding.count}});
    return json;
}

Json describe(const Mesh& mesh, const std::vector<Finding>& findings) {
    return {{"vertices", mesh.positions.rows()},
            {"triangles", mesh.triangles.rows()},
            {"diagonal", diagonal(mesh)},
            {"area", surface_area(mesh.positions, mesh.triangles)},
            {"volume", volume(mesh.positions, mesh.triangles)},
            {"findings", to_json(findings)}};
}

Json fit_places(const Mesh& source, const Mesh& fitted, const Mesh& target, const FitResult& result,
                const Correspondence& map, const Quality& quality, std::span<const Marker> markers, std::size_t most) {
    const std::vector<WorstPlace> faults = place_faults(source, fitted, map);
    const std::vector<int> flips = without_beyond(fitted.triangles, map.border, quality.flipped);
    Json worst = Json::array(), next = Json::array();
    for (const WorstPlace& place : worst_places(fitted, faults))
        worst.push_back({{"vertex", place.vertex},
                         {"fault", name_of(place.fault)},
                         {"value", told_value(place)},
                         {"badness", place.badness},
                         {"source", told(source.positions.row(place.vertex))},
                         {"fitted", told(fitted.positions.row(place.vertex))}});
    for (const MarkerSuggestion& s : suggest_markers(source, target, map, faults, markers))
        next.push_back({{"source", told(source.positions.row(s.place.vertex))},
                        {"target", told(s.target)},
                        {"vertex", s.place.vertex},
                        {"why", s.place.badness < 0.2 ? "no marker is near" : name_of(s.place.fault)},
                        {"badness", s.place.badness}});
    return {
        {"guards",
         {{"refused_steps", result.refused_steps},
          {"refused", told_vertices(fitted, first_of(result.refused, most))},
          {"flips_mended", result.mended.size()},
          {"mended", told_triangles(fitted, first_of(result.mended, most))},
          {"flips_left", flips.size()},
          {"flipped", told_triangles(fitted, first_of(flips, most))},
          {"patches_unfolded", result.patches},
          {"cuts_left", quality.cuts.size()},
          {"cuts", told_pairs(fitted, first_of(quality.cuts, most))}}},
        {"beyond",
         {{"vertices", std::ranges::count(map.border, 1)}, {"flipped_faces", quality.flipped.size() - flips.size()}}},
        {"worst", worst},
        {"next_markers", next}};
}

Json to_json(const PathQuality& quality, const Triangles& triangles, const std::function<Points(double u)>& at) {
    const auto some = [](const auto& list) { return first_of(list, 20); };
    Json rows = Json::array();
    for (const FrameQuality& frame : quality.frames) {
        Json row{{"u", frame.u},
                 {"volume", frame.volume},
                 {"volume_ratio", frame.volume_ratio},
                 {"area", frame.area},
                 {"area_ratio", frame.area_ratio},
                 {"edge_strain_percent", 100 * frame.edge_strain_mean},
                 {"edge_strain_max_percent", 100 * frame.edge_strain_max},
                 {"flipped_faces", frame.flipped.size()},
                 {"self_intersections", frame.self_intersections.size()}};
        if (!frame.flipped.empty()) row["flipped"] = some(frame.flipped);
        if (!frame.self_intersections.empty()) {
            const Points shape = at(frame.u);
            for (const std::array<int, 2>& pair : some(frame.self_intersections)) {
                Point centre = Point::Zero();
                for (const int t : pair)
                    for (int k = 0; k < 3; ++k) centre += shape.row(triangles(t, k)) / 6;
                row["cuts"].push_back({{"triangles", pair}, {"at", {centre[0], centre[1], centre[2]}}});
            }
        }
        rows.push_back(std::move(row));
    }
    return rows;
}

double peak_memory_mib() {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return double(usage.ru_maxrss) / 1024;
}

} // namespace meshtween
