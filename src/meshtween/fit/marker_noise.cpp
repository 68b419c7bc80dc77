#include "meshtween/fit/marker_noise.h"

#include <Eigen/Cholesky>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

namespace meshtween {
namespace {

constexpr double slip = 0.05;         // diagonals: further off, a marker is meant to be there
constexpr double least_noise = 0.003; // less than that costs next to nothing
constexpr std::size_t few = 8;        // markers: their scatter tells nothing

double median(std::vector<double>& values) {
    const auto middle = values.begin() + std::ssize(values) / 2;
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

// Correlations of places at these distances, squared.
Eigen::MatrixXd correlations(const Eigen::MatrixXd& squared, double length) {
    const Eigen::ArrayXXd away = (3 * squared.array()).sqrt() / length;
    return (1 + away) * (-away).exp();
}

} // namespace

MarkerGoals marker_goals(const Points& given, const FitTarget& target) {
    MarkerGoals goals{given};
    std::vector<double> heights;
    for (Eigen::Index k = 0; k < given.rows(); ++k) {
        const ClosestPoint closest = target.index.closest(Point(given.row(k)));
        if (closest.squared_distance > slip * slip || on_border(target, closest.where)) continue;
        goals.places.row(k) = closest.position;
        heights.push_back(std::copysign(std::sqrt(closest.squared_distance),
                                        (given.row(k) - closest.position).dot(normal_at(target, closest.where))));
    }
    if (heights.size() < few) return goals;
    const double middle = median(heights);
    for (double& height : heights) height = std::abs(height - middle);
    const double noise = 1.4826 * median(heights); // what the median of a normal distribution's deviations tells
    if (noise >= least_noise) goals.noise = noise;
    return goals;
}

Points smooth_misfits(const Points& places, const Points& misfits, double noise) {
    constexpr std::array lengths{0.05, 0.1, 0.2, 0.4, 0.8};     // of the correlation, in diagonals
    constexpr std::array spreads{0.1, 0.2, 0.4, 0.8, 1.6, 3.2}; // of the smooth part, beside the noise
    const Eigen::Index count = places.rows();
    const Eigen::VectorXd squares = places.rowwise().squaredNorm();
    const Eigen::MatrixXd squared =
        ((-2 * places * places.transpose()).colwise() + squares).rowwise() + squares.transpose();
    Points best = Points::Zero(count, 3);
    double likeliest = -std::numeric_limits<double>::infinity();
    const auto weigh = [&](double spread, const Eigen::MatrixXd& correlation) {
        Eigen::MatrixXd covariance = spread * spread * correlation;
        covariance.diagonal().array() += 1;
        const Eigen::LLT<Eigen::MatrixXd> factor(covariance);
        const Points solved = factor.solve(misfits / noise);
        const double determinant = 2 * factor.matrixLLT().diagonal().array().log().sum();
        const double likelihood =
            -0.5 * (misfits / noise).cwiseProduct(solved).sum() - 1.5 * determinant; // of three coordinates
        if (likelihood <= likeliest) return;
        likeliest = likelihood;
        best = noise * spread * spread * (correlation * solved);
    };
    weigh(0, Eigen::MatrixXd::Zero(count, count));
    for (const double length : lengths) {
        const Eigen::MatrixXd correlation = correlations(squared.cwiseMax(0), length);
        for (const double spread : spreads) weigh(spread, correlation);
    }
    return best;
}

} // namespace meshtween
