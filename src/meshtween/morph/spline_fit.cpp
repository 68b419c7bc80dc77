// de Boor, A Practical Guide to Splines, 1978, chapter XIV (least squares). The sites are Lobatto's: least squares
// there come near the smallest largest error (Trefethen, Approximation Theory and Approximation Practice, 2013, chapter
// 16).
#include "meshtween/morph/spline_fit.h"

#include "meshtween/core/parallel.h"

#include <Eigen/QR>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace meshtween {
namespace {

constexpr int highest_degree = 8; // of Bernstein's and B-splines alike: at most nine meshes have weight in a frame

using Eigen::Index;
using Eigen::MatrixXd;

MatrixXd spline_rows(const SplineBasis& basis, const std::vector<double>& sites) {
    MatrixXd rows(std::ssize(sites), static_cast<Index>(basis.size()));
    for (Index i = 0; i < rows.rows(); ++i) {
        const std::vector<double> w = basis.weights(sites[static_cast<std::size_t>(i)]);
        rows.row(i) = Eigen::Map<const Eigen::RowVectorXd>(w.data(), rows.cols());
    }
    return rows;
}

MatrixXd lagrange_rows(const std::vector<double>& parameters, const std::vector<double>& sites) {
    MatrixXd rows(std::ssize(sites), std::ssize(parameters));
    for (Index i = 0; i < rows.rows(); ++i) {
        const std::vector<double> w = lagrange_weights(parameters, sites[static_cast<std::size_t>(i)]);
        rows.row(i) = Eigen::Map<const Eigen::RowVectorXd>(w.data(), rows.cols());
    }
    return rows;
}

// Enough sites for every span and for every wave of the polynomial.
std::vector<double> sites_for(const SplineBasis& basis, const std::vector<double>& parameters, int dense) {
    return lobatto_nodes(dense * static_cast<int>(std::max(2 * basis.size(), parameters.size())) + 1);
}

// The spline less the polynomial at sites, from the polynomial's values at its nodes: sites x M.
MatrixXd error_rows(const SplineBasis& basis, const std::vector<double>& parameters, SplineEnds ends, int dense) {
    const std::vector<double> sites = sites_for(basis, parameters, dense);
    return spline_rows(basis, sites) * spline_operator(basis, parameters, ends) - lagrange_rows(parameters, sites);
}

// The nodes' positions of some vertices, a vertex three columns, relative to the first node: M x 3 n.
MatrixXd gathered(const Interpolant& path, Index count, const auto& vertex) {
    MatrixXd values(std::ssize(path.nodes), 3 * count);
    for (Index m = 0; m < values.rows(); ++m)
        for (Index i = 0; i < count; ++i)
            values.block<1, 3>(m, 3 * i) =
                path.nodes[static_cast<std::size_t>(m)].row(vertex(i)) - path.nodes.front().row(vertex(i));
    return values;
}

// A vertex' largest length of rows * values.
Eigen::VectorXd largest_lengths(const MatrixXd& rows, const MatrixXd& values) {
    const MatrixXd product = rows * values;
    Eigen::VectorXd lengths(values.cols() / 3);
    for (Index i = 0; i < lengths.size(); ++i)
        lengths[i] = std::sqrt(product.middleCols<3>(3 * i).rowwise().squaredNorm().maxCoeff());
    return lengths;
}

// The same for all vertices, in blocks of fixed length.
Eigen::VectorXd all_lengths(const MatrixXd& rows, const Interpolant& path) {
    constexpr Index block = 128;
    const Index n = path.nodes.front().rows();
    Eigen::VectorXd lengths(n);
    parallel_for((n + block - 1) / block,
                 [&](Index b) {
                     const Index begin = b * block, count = std::min(block, n - begin);
                     lengths.segment(begin, count) =
                         largest_lengths(rows, gathered(path, count, [&](Index i) { return begin + i; }));
                 },
                 1);
    return lengths;
}

// A few vertices stand for all while splines are compared: some from all over, and those furthest from a cubic.
MatrixXd sample_of(const SplineTask& task) {
    constexpr Index wanted = 256;
    const Index n = task.path.nodes.front().rows();
    std::vector<Index> chosen;
    for (Index i = 0; i < n; i += std::max<Index>(1, n / wanted)) chosen.push_back(i);
    const Eigen::VectorXd far = all_lengths(error_rows(even_basis(3, 1), task.path.parameters, {}, 1), task.path);
    std::vector<Index> order(static_cast<std::size_t>(n));
    std::iota(order.begin(), order.end(), Index{0});
    const auto end = order.begin() + std::min(n, wanted);
    std::partial_sort(order.begin(), end, order.end(),
                      [&](Index a, Index b) { return far[a] > far[b] || (far[a] == far[b] && a < b); });
    chosen.insert(chosen.end(), order.begin(), end);
    return gathered(task.path, std::ssize(chosen), [&](Index i) { return chosen[static_cast<std::size_t>(i)]; });
}

// Splines of one degree for all paths.
struct Choice {
    int degree = 0;
    std::vector<int> spans; // a path each
    std::vector<char> met;  // whether the path's tolerance is
    double worst = 0;       // the largest error, in parts of the tolerance
    int meshes() const {
        return std::accumulate(spans.begin(), spans.end(), 0) + degree * static_cast<int>(spans.size());
    }
    bool good() const {
        return std::all_of(met.begin(), met.end(), [](char m) { return m != 0; });
    }
};

struct Search {
    const std::vector<SplineTask>& tasks;
    std::vector<MatrixXd> samples; // a path each
    int most;                      // control meshes a path

    double error(std::size_t task, int degree, int spans) const {
        const SplineTask& t = tasks[task];
        const MatrixXd rows = error_rows(even_basis(degree, spans), t.path.parameters, t.ends, 2);
        return samples[task].cols() == 0 ? 0 : largest_lengths(rows, samples[task]).maxCoeff();
    }

    // Gives up, its tolerance not met, beyond `limit` meshes for all paths.
    Choice of_degree(int degree, int limit) const {
        Choice choice{degree, {}, {}, 0};
        const int last = degree < 3 ? 1 : std::max(1, most - degree); // below 3 a knot would show
        for (std::size_t k = 0; k < tasks.size(); ++k) {
            int spans = 1;
            double found = error(k, degree, spans);
            while (found > tasks[k].tolerance && spans < last && choice.meshes() + degree + spans < limit)
                found = error(k, degree, ++spans);
            choice.spans.push_back(spans);
            choice.met.push_back(found <= tasks[k].tolerance);
            choice.worst = std::max(choice.worst, found / std::max(tasks[k].tolerance, 1e-300));
        }
        return choice;
    }
};

// Whether the one of lower degree is to be taken.
bool as_good(const Choice& lower, const Choice& higher) {
    if (lower.good() != higher.good()) return lower.good();
    return lower.good() ? lower.meshes() <= higher.meshes() : lower.worst <= higher.worst;
}

} // namespace

MatrixXd spline_operator(const SplineBasis& basis, const std::vector<double>& parameters, SplineEnds ends) {
    const auto count = static_cast<Index>(basis.size()), nodes = std::ssize(parameters);
    MatrixXd control = MatrixXd::Zero(count, nodes);
    control(0, 0) = control(count - 1, nodes - 1) = 1;
    const auto slope = [&](bool last) -> Eigen::RowVectorXd {
        const std::vector<double> w = end_derivative_weights(parameters, last);
        return Eigen::Map<const Eigen::RowVectorXd>(w.data(), nodes);
    };
    const auto degree = static_cast<std::size_t>(basis.degree);
    Index first = 1, last = count - 1; // of those that are free
    if (ends.first_velocity)
        control.row(first++) = control.row(0) + basis.knots[degree + 1] / basis.degree * slope(false);
    if (ends.last_velocity) {
        const double width = 1 - basis.knots[basis.size() - 1];
        --last;
        control.row(last) = control.row(count - 1) - width / basis.degree * slope(true);
    }
    if (first >= last) return control;
    const std::vector<double> sites = sites_for(basis, parameters, 2);
    const MatrixXd rows = spline_rows(basis, sites);
    const MatrixXd rest = lagrange_rows(parameters, sites) - rows * control;
    control.middleRows(first, last - first) = rows.middleCols(first, last - first).householderQr().solve(rest);
    return control;
}

double spline_error(const SplineBasis& basis, const SplineTask& task) {
    const Eigen::VectorXd lengths = all_lengths(error_rows(basis, task.path.parameters, task.ends, 4), task.path);
    return lengths.size() == 0 ? 0 : lengths.maxCoeff();
}

std::vector<SplineBasis> fewest_splines(const std::vector<SplineTask>& tasks, int most) {
    Search search{tasks, {}, most};
    bool joined = false;
    for (const SplineTask& task : tasks) {
        search.samples.push_back(sample_of(task));
        joined = joined || task.ends.first_velocity || task.ends.last_velocity;
    }
    const int highest = std::min(highest_degree, most - 1);
    Choice best = search.of_degree(highest, std::numeric_limits<int>::max());
    for (int degree = highest - 1; degree >= (joined ? 3 : 1); --degree) {
        Choice choice = search.of_degree(degree, best.good() ? best.meshes() : std::numeric_limits<int>::max());
        if (as_good(choice, best)) best = std::move(choice);
    }
    std::vector<SplineBasis> bases;
    for (std::size_t k = 0; k < tasks.size(); ++k) {
        // The vertices that stood for all may have missed the worst.
        const int last = best.degree < 3 ? best.spans[k] : std::max(best.spans[k], most - best.degree);
        int spans = best.spans[k];
        while (best.met[k] && spans < last &&
               spline_error(even_basis(best.degree, spans), tasks[k]) > tasks[k].tolerance)
            ++spans;
        bases.push_back(even_basis(best.degree, spans));
    }
    return bases;
}

std::vector<Points> control_meshes(const SplineBasis& basis, const SplineTask& task) {
    const MatrixXd control = spline_operator(basis, task.path.parameters, task.ends);
    const Points& origin = task.path.nodes.front();
    std::vector<Points> meshes(basis.size());
    meshes.front() = origin;
    meshes.back() = task.path.nodes.back();
    for (std::size_t k = 1; k + 1 < meshes.size(); ++k) {
        Points& mesh = meshes[k];
        mesh = origin;
        parallel_ranges(mesh.rows(), 4096, [&](Index begin, Index end) {
            for (std::size_t m = 1; m < task.path.nodes.size(); ++m)
                mesh.middleRows(begin, end - begin) +=
                    control(static_cast<Index>(k), static_cast<Index>(m)) *
                    (task.path.nodes[m].middleRows(begin, end - begin) - origin.middleRows(begin, end - begin));
        });
    }
    return meshes;
}

} // namespace meshtween
