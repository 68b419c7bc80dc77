// Nocedal: Updating quasi-Newton matrices with limited storage. Mathematics of Computation 1980. Steps are halved until
// they gain enough (Armijo 1966).
#include "meshtween/solve/lbfgs.h"

#include <algorithm>
#include <deque>

namespace meshtween {
namespace {

constexpr int halvings = 12;

double product(const Points& a, const Points& b) {
    return a.cwiseProduct(b).sum();
}

struct Step {
    Points moved, gradient; // the change of both
    double product = 0;
};

double furthest(const Points& x) {
    return std::max(1e-300, x.rowwise().norm().maxCoeff());
}

// Minus the direction to go: the gradient times a guess of the inverse Hessian (the two loops of Algorithm 7.4 in
// Nocedal and Wright, Numerical Optimization).
Points against(const std::deque<Step>& steps, const Points& gradient, double first_step) {
    if (steps.empty()) return gradient * (first_step / furthest(gradient));
    Points direction = gradient;
    std::vector<double> alpha(steps.size());
    for (std::size_t k = steps.size(); k-- > 0;) {
        alpha[k] = product(steps[k].moved, direction) / steps[k].product;
        direction -= alpha[k] * steps[k].gradient;
    }
    direction *= steps.back().product / steps.back().gradient.squaredNorm();
    for (std::size_t k = 0; k < steps.size(); ++k)
        direction += (alpha[k] - product(steps[k].gradient, direction) / steps[k].product) * steps[k].moved;
    return direction;
}

} // namespace

Points lbfgs(Points x, const std::function<double(const Points& x, Points& gradient)>& value,
             const LbfgsOptions& options) {
    std::deque<Step> steps;
    Points gradient(x.rows(), 3), next(x.rows(), 3), next_gradient(x.rows(), 3);
    double now = value(x, gradient);
    for (int iteration = 0; iteration < options.iterations && gradient.squaredNorm() > 0; ++iteration) {
        Points direction = against(steps, gradient, options.first_step);
        if (!(product(gradient, direction) > 0)) {
            steps.clear();
            direction = against(steps, gradient, options.first_step);
        }
        const double slope = product(gradient, direction);
        double length = std::min(1.0, options.longest_step / furthest(direction)), then = now;
        bool found = false;
        for (int k = 0; k < halvings && !found; ++k, length /= 2) {
            next = x - length * direction;
            then = value(next, next_gradient);
            found = then <= now - 1e-4 * length * slope;
        }
        if (!found) break;
        Step step{next - x, next_gradient - gradient, 0};
        step.product = product(step.moved, step.gradient);
        if (step.product > 1e-14 * step.moved.norm() * step.gradient.norm()) {
            steps.push_back(std::move(step));
            if (steps.size() > options.memory) steps.pop_front();
        }
        const double gain = now - then;
        x.swap(next), gradient.swap(next_gradient);
        now = then;
        if (gain < options.tolerance * std::abs(now)) break;
    }
    return x;
}

} // namespace meshtween
