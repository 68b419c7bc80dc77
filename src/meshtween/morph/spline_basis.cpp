// de Boor, A Practical Guide to Splines, 1978, chapter X: the recursion that only takes means of what is not negative.
#include "meshtween/morph/spline_basis.h"

#include <algorithm>

namespace meshtween {

std::size_t SplineBasis::size() const {
    return knots.size() - static_cast<std::size_t>(degree) - 1;
}

std::vector<double> SplineBasis::weights(double u) const {
    const auto p = static_cast<std::size_t>(degree);
    u = std::clamp(u, knots.front(), knots.back());
    // The last span that begins at or before u and is not empty.
    std::size_t i = p;
    while (i + 1 < size() && knots[i + 1] <= u) ++i;
    std::vector<double> w(size(), 0.0);
    double* const own = &w[i - p]; // the weights of this span
    own[0] = 1;
    for (std::size_t d = 1; d <= p; ++d) {
        double given = 0; // by the weight before
        for (std::size_t k = 0; k < d; ++k) {
            const double left = knots[i + 1 - d + k], right = knots[i + 1 + k];
            const double passed = (u - left) / (right - left) * own[k];
            own[k] = given + (right - u) / (right - left) * own[k];
            given = passed;
        }
        own[d] = given;
    }
    for (std::size_t k = 0; k <= p; ++k) own[k] = std::min(own[k], 1.0); // rounding may pass it
    return w;
}

std::vector<double> SplineBasis::spans() const {
    std::vector<double> values = knots;
    values.erase(std::unique(values.begin(), values.end()), values.end());
    return values;
}

SplineBasis even_basis(int degree, int spans) {
    SplineBasis basis{degree, {}};
    basis.knots.assign(static_cast<std::size_t>(degree), 0.0);
    for (int k = 0; k <= spans; ++k) basis.knots.push_back(static_cast<double>(k) / spans);
    basis.knots.insert(basis.knots.end(), static_cast<std::size_t>(degree), 1.0);
    return basis;
}

} // namespace meshtween
