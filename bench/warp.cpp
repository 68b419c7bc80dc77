// The marker warp of a million points by 40 markers, one thread: ours beside the loop that one would write first, which
// calls the standard library's logarithm and root.
#include "compare.h"

#include "meshtween/core/parallel.h"
#include "meshtween/fit/rbf.h"

#include <benchmark/benchmark.h>

#include <cmath>
#include <random>

namespace meshtween {
namespace {

Points scattered(Eigen::Index count, unsigned seed) {
    std::mt19937_64 generator(seed);
    std::uniform_real_distribution<double> within(-1, 1);
    Points points(count, 3);
    for (double& c : points.reshaped()) c = within(generator);
    return points;
}

RbfWarp forty_markers(Kernel kernel) {
    const Points from = scattered(40, 1);
    return warp(from, from + 0.1 * scattered(40, 2), {kernel, 0});
}

const Points& million() {
    static const Points points = scattered(1000000, 3);
    return points;
}

Points plain_loop(const RbfWarp& w, const Points& points) { // Eq. 1
    Points result(points.rows(), 3);
    for (Eigen::Index i = 0; i < points.rows(); ++i) {
        const Point x = (points.row(i) - w.origin) * w.scale;
        Point f = w.polynomial.row(0) + x * w.polynomial.bottomRows<3>();
        for (Eigen::Index j = 0; j < w.centres.rows(); ++j) {
            const double r = (x - w.centres.row(j)).norm();
            f += (w.kernel == Kernel::linear ? r : r > 0 ? r * r * std::log(r) : 0) * w.lambda.row(j);
        }
        result.row(i) = points.row(i) + f / w.scale;
    }
    return result;
}

void ours(benchmark::State& state, Kernel kernel) {
    set_threads(1);
    const RbfWarp w = forty_markers(kernel);
    for (auto _ : state) benchmark::DoNotOptimize(w(million()).data());
    state.counters["points/s"] =
        benchmark::Counter(static_cast<double>(million().rows()), benchmark::Counter::kIsIterationInvariantRate);
    set_threads(0);
}

void plain(benchmark::State& state, Kernel kernel) {
    const RbfWarp w = forty_markers(kernel);
    for (auto _ : state) benchmark::DoNotOptimize(plain_loop(w, million()).data());
}

// N markers: the dense solve of Eq. 5.
void solve(benchmark::State& state) {
    const Points from = scattered(state.range(0), 4), to = from + 0.1 * scattered(state.range(0), 5);
    for (auto _ : state) benchmark::DoNotOptimize(warp(from, to).lambda.data());
}

BENCHMARK_CAPTURE(ours, r2_log_r, Kernel::thin_plate)->Name("warp/r2 log r/ours")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(plain, r2_log_r, Kernel::thin_plate)->Name("warp/r2 log r/plain")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(ours, r, Kernel::linear)->Name("warp/r/ours")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(plain, r, Kernel::linear)->Name("warp/r/plain")->Unit(benchmark::kMillisecond);
BENCHMARK(solve)->Name("warp/solve")->Arg(40)->Arg(2000)->Unit(benchmark::kMillisecond);

const bool rows[] = {
    compare("warp of 1M points, 40 markers, r2 log r: a plain loop", "warp/r2 log r/plain", "warp/r2 log r/ours", 5),
    compare("warp of 1M points, 40 markers, r: a plain loop", "warp/r/plain", "warp/r/ours", 2),
};

} // namespace
} // namespace meshtween
