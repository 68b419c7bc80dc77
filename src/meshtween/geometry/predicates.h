// On which side a point lies, decided exactly.
#pragma once

#include "meshtween/core/mesh.h"

namespace meshtween {

using PlanePoint = Eigen::RowVector2d;

// 1 where a, b, c turn counter-clockwise, -1 where clockwise, 0 where they lie on one line. Exact for the coordinates
// as given, unless a product of two differences over- or underflows.
int orient2d(const PlanePoint& a, const PlanePoint& b, const PlanePoint& c);

// 1 where d lies on the side of the plane a, b, c to which (b - a) x (c - a) points, -1 on the other side, 0 in the
// plane. Exact for the coordinates as given, unless a product of three differences over- or underflows.
int orient3d(const Point& a, const Point& b, const Point& c, const Point& d);

// True where a, b, c lie on one line, exactly.
bool collinear(const Point& a, const Point& b, const Point& c);

} // namespace meshtween
