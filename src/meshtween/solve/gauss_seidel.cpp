// Eq. 10-12 of Yoo, Three-dimensional Morphing of Similar Shapes Using a Template Mesh. Row i of the matrix is c1 on
// the diagonal and -c2 / N_i at its neighbours: it is strictly dominant by rows (Eq. 11) where c1 > c2, so that the
// sweeps converge, by c2 / c1 a sweep or better.
#include "meshtween/solve/gauss_seidel.h"

#include "meshtween/core/error.h"
#include "meshtween/core/parallel.h"
#include "meshtween/solve/laplacian.h"

#include <fmt/format.h>

#include <cmath>

namespace meshtween {

Points modified_laplacian(const Points& positions, const Lists& neighbours, double c1, double c2) {
    return c1 * positions - c2 * neighbour_mean(positions, neighbours); // Eq. 12
}

Lists colouring(const Lists& neighbours) {
    const auto n = static_cast<std::size_t>(neighbours.size());
    std::vector<int> colour(n, -1);
    std::vector<int> last_seen; // a colour: the last vertex that has a neighbour of it
    for (std::size_t i = 0; i < n; ++i) {
        const int vertex = static_cast<int>(i);
        for (const int j : neighbours[vertex])
            if (const int c = colour[static_cast<std::size_t>(j)]; c >= 0)
                last_seen[static_cast<std::size_t>(c)] = vertex;
        std::size_t free = 0;
        while (free < last_seen.size() && last_seen[free] == vertex) ++free;
        if (free == last_seen.size()) last_seen.push_back(-1);
        colour[i] = static_cast<int>(free);
    }
    Lists groups;
    groups.first.assign(last_seen.size() + 1, 0);
    for (const int c : colour) ++groups.first[static_cast<std::size_t>(c) + 1];
    for (std::size_t c = 0; c < last_seen.size(); ++c) groups.first[c + 1] += groups.first[c];
    groups.items.resize(n);
    std::vector<int> next = groups.first;
    for (std::size_t i = 0; i < n; ++i)
        groups.items[static_cast<std::size_t>(next[static_cast<std::size_t>(colour[i])]++)] = static_cast<int>(i);
    return groups;
}

GaussSeidelResult gauss_seidel(const Points& coordinates, const Points& start, const Lists& neighbours,
                               const Lists& colours, const GaussSeidelOptions& options, const Progress& progress) {
    const auto [c1, c2, tolerance, max_sweeps] = options;
    if (!(c1 > c2 && c2 > 0))
        throw Error(ErrorKind::argument,
                    fmt::format("C1 = {} and C2 = {}: the sweeps converge only where C1 > C2 > 0", c1, c2));
    GaussSeidelResult result{start, {}};
    Points& p = result.positions;
    std::vector<double> moved(static_cast<std::size_t>(p.rows()), 0); // squared, a vertex
    double first = 0, largest = 0, done = 0;
    result.report.converged = false;
    for (int sweep = 0; sweep < max_sweeps; ++sweep) {
        for (std::ptrdiff_t c = 0; c < colours.size(); ++c) {
            const auto group = colours[c];
            parallel_for(static_cast<std::ptrdiff_t>(group.size()), [&](std::ptrdiff_t k) {
                const int i = group[static_cast<std::size_t>(k)];
                Point sum = Point::Zero();
                for (const int j : neighbours[i]) sum += p.row(j);
                if (!neighbours[i].empty()) sum *= c2 / static_cast<double>(neighbours[i].size());
                const Point next = (coordinates.row(i) + sum) / c1; // Eq. 12, solved for p_i
                moved[static_cast<std::size_t>(i)] = (next - p.row(i)).squaredNorm();
                p.row(i) = next;
            });
        }
        largest = 0;
        for (const double m : moved) largest = std::max(largest, m);
        largest = std::sqrt(largest);
        if (sweep == 0) first = largest;
        ++result.report.sweeps;
        if (largest <= tolerance) {
            result.report.converged = true;
            break;
        }
        done = std::max(done, std::min(1.0, std::log(first / largest) / std::log(first / tolerance)));
        if (!keep_going(progress, done, "solving")) break;
    }
    const double size = coordinates.norm();
    const double rest = (modified_laplacian(p, neighbours, c1, c2) - coordinates).norm();
    result.report.residual = size > 0 ? rest / size : rest;
    return result;
}

} // namespace meshtween
