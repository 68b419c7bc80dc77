// The fewest control meshes whose B-spline follows a path, and how they come from the path's shapes.
#pragma once

#include "meshtween/morph/interpolant.h"
#include "meshtween/morph/spline_basis.h"

namespace meshtween {

// What a spline has to keep of a path besides its ends.
struct SplineEnds {
    bool first_velocity = false, last_velocity = false;
};

// A path between two keys that a spline is to follow.
struct SplineTask {
    const Interpolant& path;
    SplineEnds ends;
    double tolerance = 0; // a length
};

// The control values of the spline nearest to a polynomial in least squares, linear in the polynomial's values at its
// nodes: K x M. The first and last are the ends' values.
Eigen::MatrixXd spline_operator(const SplineBasis& basis, const std::vector<double>& parameters, SplineEnds ends);

// The largest distance between a path's polynomial and its spline, over all vertices.
double spline_error(const SplineBasis& basis, const SplineTask& task);

// One basis for each of the paths, all of one degree, with the fewest control meshes in all that keep the tolerances;
// of equally few those of the lowest degree from 3 on. Where `most` control meshes for one path do not suffice, those
// that come nearest.
std::vector<SplineBasis> fewest_splines(const std::vector<SplineTask>& tasks, int most);

// The control meshes; the first and last are the path's own ends.
std::vector<Points> control_meshes(const SplineBasis& basis, const SplineTask& task);

} // namespace meshtween
