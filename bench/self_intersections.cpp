// Pairs of faces that cut each other on two bumpy spheres that overlap, one thread: ours, and CGAL's boxes and
// do_intersect. Both must find the same pairs, and this run fails where they do not.
#include "compare.h"

#include "meshtween/core/parallel.h"
#include "meshtween/geometry/shapes.h"
#include "meshtween/search/self_intersections.h"

#include <CGAL/Box_intersection_d/Box_with_info_d.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/box_intersection_d.h>
#include <benchmark/benchmark.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace meshtween {
namespace {

using Pairs = std::vector<std::array<int, 2>>;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;

const Mesh& two_spheres() {
    static const Mesh both = [] {
        Mesh one = sphere(6), mesh;
        for (auto&& p : one.positions.rowwise()) p *= 1 + 0.1 * std::sin(7 * p[0]) * std::cos(9 * p[1]);
        const Eigen::Index n = one.positions.rows(), m = one.triangles.rows();
        mesh.positions.resize(2 * n, 3);
        mesh.positions << one.positions, one.positions.rowwise() + Point(0.31, 0.17, 0.23);
        mesh.triangles.resize(2 * m, 3);
        mesh.triangles << one.triangles, one.triangles.array() + static_cast<int>(n);
        return mesh;
    }();
    return both;
}

Pairs with_cgal(const Mesh& mesh) {
    using Box = CGAL::Box_intersection_d::Box_with_info_d<double, 3, int>;
    const auto point = [&](int v) {
        return Kernel::Point_3(mesh.positions(v, 0), mesh.positions(v, 1), mesh.positions(v, 2));
    };
    const auto face = [&](int t) {
        return Kernel::Triangle_3(point(mesh.triangles(t, 0)), point(mesh.triangles(t, 1)),
                                  point(mesh.triangles(t, 2)));
    };
    std::vector<Box> boxes;
    for (int t = 0; t < mesh.triangles.rows(); ++t) boxes.emplace_back(face(t).bbox(), t);
    Pairs found;
    CGAL::box_self_intersection_d(boxes.begin(), boxes.end(), [&](const Box& x, const Box& y) {
        const auto s = mesh.triangles.row(x.info()), t = mesh.triangles.row(y.info());
        std::vector<int> only_s, only_t;
        for (const int v : s)
            if ((t.array() != v).all()) only_s.push_back(v);
        for (const int v : t)
            if ((s.array() != v).all()) only_t.push_back(v);
        const auto opposite_meets = [&](const std::vector<int>& two, int t_face) {
            return CGAL::do_intersect(Kernel::Segment_3(point(two[0]), point(two[1])), face(t_face));
        };
        bool cut = false; // of faces with a common edge none lies flat on the other here
        if (only_s.size() == 3) cut = CGAL::do_intersect(face(x.info()), face(y.info()));
        if (only_s.size() == 2) cut = opposite_meets(only_s, y.info()) || opposite_meets(only_t, x.info());
        if (cut) found.push_back({std::min(x.info(), y.info()), std::max(x.info(), y.info())});
    });
    std::sort(found.begin(), found.end());
    return found;
}

void ours(benchmark::State& state) {
    set_threads(1);
    for (auto _ : state) benchmark::DoNotOptimize(self_intersections(two_spheres().positions, two_spheres().triangles));
    set_threads(0);
}

void cgal(benchmark::State& state) {
    Pairs found;
    for (auto _ : state) found = with_cgal(two_spheres());
    if (found != self_intersections(two_spheres().positions, two_spheres().triangles))
        state.SkipWithError("CGAL finds other pairs");
    state.counters["pairs"] = static_cast<double>(found.size());
}

BENCHMARK(ours)->Name("self_intersections/ours")->Iterations(1)->Unit(benchmark::kMillisecond);
BENCHMARK(cgal)->Name("self_intersections/cgal")->Iterations(1)->Unit(benchmark::kMillisecond);
const bool row = compare("cuts of 163,840 faces: CGAL", "self_intersections/cgal", "self_intersections/ours", 2);

} // namespace
} // namespace meshtween
