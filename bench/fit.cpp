// A fit of a woman to a man whose true correspondence is known, in CPU seconds of all threads: ours,
// and the classic that many start from. A counter tells the mean error against the truth, in percent of the
// diagonal.
#include "compare.h"
#include "nonrigid_icp.h"

#include "meshtween/fit/fit.h"
#include "meshtween/geometry/measure.h"
#include "meshtween/geometry/samples.h"
#include "meshtween/search/closest_point.h"

#include <benchmark/benchmark.h>

namespace meshtween {
namespace {

std::vector<Marker> markers_of(const Sample& sample) {
    const ClosestPointIndex index(sample.source);
    std::vector<Marker> markers;
    for (std::size_t k = 0; k < sample.marker_names.size(); ++k) {
        const auto row = static_cast<Eigen::Index>(k);
        markers.push_back({sample.marker_names[k], index.closest(Point(sample.marker_source.row(row))).where,
                           sample.marker_target.row(row)});
    }
    return markers;
}

template <class Fit>
void run(benchmark::State& state, const Fit& fit) {
    const Sample pair = sample("build");
    const std::vector<Marker> markers = markers_of(pair);
    Points result;
    for (auto _ : state) result = fit(pair, markers);
    state.counters["vertices"] = static_cast<double>(result.rows());
    state.counters["error %"] = 100 * (result - pair.truth).rowwise().norm().mean() / diagonal(pair.target);
}

const bool registered = [] {
    const auto ours = [](const Sample& pair, const auto& markers) {
        return fit(pair.source, pair.target, markers).positions;
    };
    const auto peer = [](const Sample& pair, const auto& markers) {
        return nonrigid_icp(pair.source, pair.target, markers);
    };
    for (auto* b : {benchmark::RegisterBenchmark("fit/ours", [=](auto& state) { run(state, ours); }),
                    benchmark::RegisterBenchmark("fit/nonrigid_icp", [=](auto& state) { run(state, peer); })})
        b->Iterations(1)->Unit(benchmark::kMillisecond)->MeasureProcessCPUTime();
    return compare("fit of 12k vertices: nonrigid ICP", "fit/nonrigid_icp", "fit/ours", 4);
}();

} // namespace
} // namespace meshtween
