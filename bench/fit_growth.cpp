// How time and memory of the fit grow: the sample `bow`, subdivided 0, 1, ... times up to the first argument (2; 3 is
// 760,000 vertices and takes minutes), and then cut to as many vertices as the second says, if it is more. From 3 on
// triangles are only quartered: the sample's own roundness takes longer than the fit.
#include "meshtween/fit/fit.h"
#include "meshtween/fit/markers.h"
#include "meshtween/geometry/samples.h"
#include "meshtween/geometry/subdivide.h"

#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>

using namespace meshtween;

namespace {

struct Cost {
    double wall, cpu, mebibytes;
    Eigen::Index vertices;
};

// Edges cut in half, evenly spread, until there are as many vertices, or all edges are cut.
Mesh cut_to(const Mesh& mesh, Eigen::Index vertices) {
    const Topology edges = topology(mesh.positions.rows(), mesh.triangles);
    const double share =
        static_cast<double>(vertices - mesh.positions.rows()) / static_cast<double>(edges.edges.size());
    std::vector<char> cut(edges.edges.size());
    double due = 0;
    for (char& flag : cut) {
        due += share;
        flag = due >= 1;
        if (flag) due -= 1;
    }
    return subdivide(mesh, edges, cut);
}

Cost cost_of_fit(int subdivisions, Eigen::Index least_vertices) {
    constexpr int round = 2;
    Sample made = sample("bow", std::min(subdivisions, round));
    made.source = subdivide(made.source, std::max(0, subdivisions - round));
    made.target = subdivide(made.target, std::max(0, subdivisions - round));
    if (made.source.positions.rows() < least_vertices) {
        made.source = cut_to(made.source, least_vertices);
        made.target = cut_to(made.target, least_vertices);
    }
    std::vector<MarkerPair> pairs;
    for (std::size_t k = 0; k < made.marker_names.size(); ++k)
        pairs.push_back({made.marker_names[k], made.marker_source.row(static_cast<Eigen::Index>(k)),
                         made.marker_target.row(static_cast<Eigen::Index>(k))});
    const std::vector<Marker> markers = place_markers(pairs, made.source);
    const auto start = std::chrono::steady_clock::now();
    const std::clock_t cpu = std::clock();
    fit(made.source, made.target, markers);
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return {seconds, static_cast<double>(std::clock() - cpu) / CLOCKS_PER_SEC,
            static_cast<double>(usage.ru_maxrss) / 1024, made.source.positions.rows()};
}

} // namespace

int main(int count, char** arguments) {
    const int most = count > 1 ? std::atoi(arguments[1]) : 2;
    const Eigen::Index vertices = count > 2 ? std::atol(arguments[2]) : 0;
    const int rows = vertices > 0 ? most + 1 : most;
    std::printf("| vertices | seconds | CPU seconds | MiB | exponent |\n|---|---|---|---|---|\n");
    Cost last{};
    for (int row = 0; row <= rows; ++row) {
        const Cost now = cost_of_fit(std::min(row, most), row > most ? vertices : 0);
        std::printf("| %ld | %.2f | %.2f | %.0f | ", static_cast<long>(now.vertices), now.wall, now.cpu, now.mebibytes);
        if (row > 0) // of the CPU time, from one row to the next
            std::printf("%.2f", std::log(now.cpu / last.cpu) /
                                    std::log(static_cast<double>(now.vertices) / static_cast<double>(last.vertices)));
        std::printf(" |\n");
        std::fflush(stdout);
        last = now;
    }
}
