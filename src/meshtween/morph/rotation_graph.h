// Rotations that are known only against each other.
#pragma once

#include "meshtween/morph/patches.h"

namespace meshtween {

struct RotationLink {
    int first = 0, second = 0;
    Eigen::Matrix3d rotation; // second = first * rotation
    double weight = 1;
};

struct RotationRoot { // one a connected part, at least
    int node = 0;
    Eigen::Matrix3d rotation;
    double weight = 1;
};

// Minimises the sum of weight |X_first M - X_second|^2 over 3 x 3 matrices X, M a link's rotation, with the roots' X
// given, and takes the rotations nearest to them: exact where links agree, least squares where they disagree around a
// loop (Singer, Angular Synchronization by Eigenvectors and Semidefinite Programming, 2011). Throws Error(computation)
// where a part has no root.
Quaternions synchronised(int count, const std::vector<RotationLink>& links, const std::vector<RotationRoot>& roots);

} // namespace meshtween
