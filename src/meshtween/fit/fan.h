// The triangles around one vertex, and what is wanting there wherever the vertex is put.
#pragma once

#include "meshtween/core/mesh.h"
#include "meshtween/fit/cut_length.h"
#include "meshtween/fit/refine.h"
#include "meshtween/fit/shell.h"

#include <span>
#include <vector>

namespace meshtween {

// What fans stand on.
struct FanGround {
    const Shell& shell;
    const FitTarget& target;
    std::vector<Pin> pins; // by their triangles, ascending
    double unit = 1;       // a typical edge: what lengths are counted in
};

// A triangle of which one corner may move.
struct Blade {
    Sheet lies; // as it is
    std::size_t corner = 0;
    Sheet with(const Point& vertex) const;
};

struct Fan {
    struct Judged {
        Blade blade;
        std::vector<Sheet> sheets;  // that it could cut and that stay
        std::vector<Blade> fellows; // the same, of the fan
        std::vector<Pin> pins;      // in it
        double wanting = 0;         // as it is
    };
    std::vector<Judged> blades; // the worst first
    double wanting = 0;         // in all
    double least_area = 0;      // doubled, of the smallest triangle
    double pins_off = 0;        // their squared distances from their places
};

// The fan around a vertex that is going to move by less than `reach`; `sheets` are the triangles that could be cut.
Fan fan_around(const FanGround& ground, const Points& positions, Eigen::Index vertex, std::span<const int> sheets,
               double reach);

// No triangle grows much thinner there than the thinnest is, and no pin comes to lie further off.
bool bearable(const Fan& fan, const Point& vertex);

// With the vertex there, `height` off the target: what triangles that look into the target cost, the lengths of cuts,
// and a little of all squared distances from the target. Where it is no less than `most`, any such number.
double wanting(const FanGround& ground, const Fan& fan, const Point& vertex, double height, double most);

constexpr double fault_costs = 0.1; // in `wanting`, at least

} // namespace meshtween
