// The similarity that brings one shape over another, before anything bends.
#pragma once

#include "meshtween/core/mesh.h"

namespace meshtween {

// y = scale rotation x + translation, on column vectors; on rows of points: scale x rotation^T + translation.
struct Similarity {
    double scale = 1;
    Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
    Point translation{0, 0, 0};

    Points operator()(const Points& points) const;
};

// The least-squares similarity of matching points, both k x 3. With fewer than 3 points, or points on one line, what
// they do not say is taken as: no turn beyond the least one; scale 1 with a single point.
Similarity align(const Points& from, const Points& to);
Similarity align(const Points& from, const Points& to, const Eigen::VectorXd& weights); // k, none negative

// A guess where nothing matches: centres and areas made equal, and no turn, or principal axes made equal where that
// brings the surfaces clearly closer (both ways, by samples), the axes' directions chosen so that they lie closest.
// Mirror images are not considered.
Similarity align_axes(const Points& from, const Triangles& from_triangles, const Points& to,
                      const Triangles& to_triangles);

} // namespace meshtween
