// A frame of a bent bar of 100,000 vertices, one thread: a weighted sum of nine float meshes against reading as many
// and writing one, a prefactored back-substitution, the paper's Gauss-Seidel sweeps and dual-mesh coordinates.
#include "compare.h"

#include "meshtween/core/parallel.h"
#include "meshtween/geometry/shapes.h"
#include "meshtween/geometry/topology.h"
#include "meshtween/morph/frames.h"
#include "meshtween/solve/cholesky.h"
#include "meshtween/solve/laplacian.h"

#include <benchmark/benchmark.h>

#include <cstring>
#include <numbers>

namespace meshtween {
namespace {

constexpr int nodes = 9;
// Meshes of 62 and 196 squares across a bar have 100,000 and 1,000,000 vertices, about.

// A bar of about 26 size^2 vertices and its bend by a half turn.
struct Bent {
    Mesh from;
    Points to;
    explicit Bent(int size)
        : from(bar({6, 1, 1}, {6 * size, size, size})), to(bend(from.positions, 6, std::numbers::pi)) {}
};

const Bent& hundred_thousand() {
    static const Bent scene(62);
    return scene;
}

// Which path the nodes lie on does not matter to the time of a frame.
FloatCurve curve_of(const Bent& scene) {
    const Morph path = morph(scene.from, scene.to, {.method = MorphMethod::linear});
    Curve c;
    c.basis = even_basis(nodes - 1, 1); // all nodes have weight
    for (int k = 0; k < nodes; ++k) c.nodes.push_back(path.at(static_cast<double>(k) / (nodes - 1)));
    return to_float(c);
}

void show(benchmark::State& state, const FloatCurve& curve) {
    set_threads(1);
    std::vector<float> out(static_cast<std::size_t>(curve.nodes.front().size()));
    double u = 0;
    for (auto _ : state) {
        u = u < 0.9 ? u + 0.0371 : 0.0123;
        frame_into(curve, u, out);
        benchmark::DoNotOptimize(out.data());
    }
}

void read_and_write(benchmark::State& state, const FloatCurve& curve) {
    std::vector<float> out(static_cast<std::size_t>(curve.nodes.front().size()));
    for (auto _ : state) {
        for (std::size_t k = 1; k < curve.nodes.size(); ++k) {
            const auto bits = Eigen::Map<const Eigen::ArrayXf>(curve.nodes[k].data(), curve.nodes[k].size());
            benchmark::DoNotOptimize(bits.maxCoeff());
        }
        std::memcpy(out.data(), curve.nodes[0].data(), out.size() * sizeof(float));
        benchmark::DoNotOptimize(out.data());
    }
}

const FloatCurve& small() {
    static const FloatCurve curve = curve_of(hundred_thousand());
    return curve;
}

const FloatCurve& large() {
    static const FloatCurve curve = curve_of(Bent(196));
    return curve;
}

void frame_100k(benchmark::State& state) {
    show(state, small());
}
void memory_100k(benchmark::State& state) {
    read_and_write(state, small());
}
void frame_1m(benchmark::State& state) {
    show(state, large());
}
void memory_1m(benchmark::State& state) {
    read_and_write(state, large());
}

void back_substitution(benchmark::State& state) {
    set_threads(1);
    const Mesh& mesh = hundred_thousand().from;
    const Topology top = topology(mesh.positions.rows(), mesh.triangles);
    const SparseCholesky factor(held(graph_laplacian(top.neighbours), components(top)));
    for (auto _ : state) benchmark::DoNotOptimize(factor.solve(mesh.positions));
}

void method_at_half(benchmark::State& state, const MorphOptions& options) {
    set_threads(1);
    const Morph path = morph(hundred_thousand().from, hundred_thousand().to, options);
    for (auto _ : state) benchmark::DoNotOptimize(path.at(0.5));
    state.counters["sweeps"] = path.report().sweeps;
}

void gauss_seidel_printed(benchmark::State& state) {
    method_at_half(state, {.method = MorphMethod::dual_as_printed, .tolerance = 1e-6});
}
void dual_mesh(benchmark::State& state) {
    method_at_half(state, {.method = MorphMethod::dual_mesh});
}

void prepare(benchmark::State& state, const Bent& scene) {
    set_threads(0);
    std::size_t count = 0;
    for (auto _ : state) count = curve(morph(scene.from, scene.to)).nodes.size();
    state.counters["meshes"] = static_cast<double>(count);
}

void prepare_100k(benchmark::State& state) {
    prepare(state, hundred_thousand());
}
void prepare_1m(benchmark::State& state) {
    prepare(state, Bent(196));
}

BENCHMARK(frame_100k)->Unit(benchmark::kMillisecond);
BENCHMARK(memory_100k)->Unit(benchmark::kMillisecond);
BENCHMARK(frame_1m)->Unit(benchmark::kMillisecond);
BENCHMARK(memory_1m)->Unit(benchmark::kMillisecond);
BENCHMARK(back_substitution)->Unit(benchmark::kMillisecond);
BENCHMARK(gauss_seidel_printed)->Unit(benchmark::kMillisecond)->Iterations(1);
BENCHMARK(dual_mesh)->Unit(benchmark::kMillisecond)->Iterations(1);
BENCHMARK(prepare_100k)->Unit(benchmark::kMillisecond)->Iterations(1)->MeasureProcessCPUTime()->UseRealTime();
BENCHMARK(prepare_1m)->Unit(benchmark::kMillisecond)->Iterations(1)->MeasureProcessCPUTime()->UseRealTime();

const bool rows[] = {
    compare("a frame, 100k vertices: reading 9 float meshes, writing one", "memory_100k", "frame_100k", 0.77),
    compare("a frame, 1M vertices: reading 9 float meshes, writing one", "memory_1m", "frame_1m", 0.77),
    compare("a frame, 100k vertices: prefactored back-substitution", "back_substitution", "frame_100k", 20),
    compare("a frame, 100k vertices: the paper's sweeps, 1.01/.99", "gauss_seidel_printed", "frame_100k", 50),
    compare("a frame, 100k vertices: dual-mesh coordinates", "dual_mesh", "frame_100k", 100),
    compare("the paper's sweeps against dual-mesh coordinates", "dual_mesh", "gauss_seidel_printed", 10),
};

} // namespace
} // namespace meshtween
