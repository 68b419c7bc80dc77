#include "meshtween/app/report.h"

#include "meshtween/core/parallel.h"
#include "meshtween/geometry/measure.h"
#include "meshtween/geometry/topology.h"

#include <sys/resource.h>

#include <cmath>

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
              {"flipped_faces", q.flipped},
              {"flipped_area_percent", q.flipped_area_percent},
              {"degenerate_faces", q.degenerate},
              {"self_intersections", q.cuts},
              {"self_intersections_source", q.cuts_source},
              {"self_intersections_target", q.cuts_target},
              {"symmetric_dirichlet", to_json(q.symmetric_dirichlet)}};
    if (q.truth_error) json["truth_error"] = to_json(*q.truth_error);
    if (q.marker_error) json["marker_error"] = to_json(*q.marker_error);
    return json;
}

Json to_json(const FitResult& result) {
    return {{"end", name_of(result.end)},
            {"rounds", result.rounds},
            {"eq7", result.error},
            {"history", result.history},
            {"refused_steps", result.refused_steps},
            {"notes", result.notes}};
}

Json to_json(const std::vector<Finding>& findings) {
    Json json = Json::array();
    for (const Finding& finding : findings)
        json.push_back({{"severity", name_of(finding.severity)}, {"what", finding.what}, {"count", finding.count}});
    return json;
}

Json describe(const Mesh& mesh) {
    return {{"vertices", mesh.positions.rows()},
            {"triangles", mesh.triangles.rows()},
            {"diagonal", diagonal(mesh.positions)},
            {"area", surface_area(mesh.positions, mesh.triangles)},
            {"volume", volume(mesh.positions, mesh.triangles)},
            {"findings", to_json(check(mesh))}};
}

Json path_report(const Mesh& mesh, const Morph& morph, const std::vector<double>& parameters) {
    const Points from = morph.at(0), to = morph.at(1);
    const std::vector<Edge> edges = topology(mesh.positions.rows(), mesh.triangles).edges;
    const auto length = [&](const Points& p, const Edge& e) {
        return (p.row(e.vertices[0]) - p.row(e.vertices[1])).norm();
    };
    Json rows = Json::array();
    for (const double u : parameters) {
        const Points shape = morph.at(u);
        const double strain = parallel_sum(std::ssize(edges), 0.0, [&](std::ptrdiff_t i) {
            const Edge& e = edges[static_cast<std::size_t>(i)];
            const double want = (1 - u) * length(from, e) + u * length(to, e);
            return want > 0 ? std::abs(length(shape, e) - want) / want : 0;
        });
        rows.push_back({{"u", u},
                        {"volume", volume(shape, mesh.triangles)},
                        {"area", surface_area(shape, mesh.triangles)},
                        {"edge_strain_percent", edges.empty() ? 0 : 100 * strain / double(edges.size())}});
    }
    return rows;
}

double peak_memory_mib() {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return double(usage.ru_maxrss) / 1024;
}

} // namespace meshtween
