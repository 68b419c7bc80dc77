// What lies on one of two meshes carried to the other, where the two lie on each other: a fitted mesh and its target.
#pragma once

#include "meshtween/core/mesh.h"

#include <vector>

namespace meshtween {

// Values of the giver's vertices at places on it: one row a place. `values`: a row a vertex of the giver.
Eigen::MatrixXd carried(const Eigen::MatrixXd& values, const Triangles& giver, const std::vector<SurfacePoint>& places);

// The receiver with the giver's colours and texture coordinates, where the giver has them; `places` are those of the
// receiver's vertices on the giver (places_on). Texture coordinates become one a corner: a triangle takes the chart of
// its centre, and a corner beyond the chart's seam is continued in it linearly.
Mesh with_attributes(const Mesh& receiver, const Mesh& giver, const std::vector<SurfacePoint>& places);

// A shape before and after its fit, with the same triangles; where nothing was fitted, both are the same.
struct TwoShapes {
    Mesh rest, fitted;
};

// Points on or near the giver's rest shape, brought to the receiver's: to the giver's surface, with it to its fitted
// shape, from there to the closest place of the receiver's fitted shape, and with that to the receiver's rest shape.
// k x 3 to k x 3; `distances`, where asked for, is how far each lay from the giver's surface, in the mesh's unit.
Points carried_points(const Points& points, const TwoShapes& giver, const TwoShapes& receiver,
                      std::vector<double>* distances = nullptr);

} // namespace meshtween
