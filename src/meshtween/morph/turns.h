// How every triangle turns along the path: nothing at 0, its whole way at 1, however far that is.
#pragma once

#include "meshtween/morph/patches.h"

namespace meshtween {

// A triangle's rotation as seen from the nearest patches: the patch's own rotation times the exponential of u times a
// rotation vector, blended by weights that fade smoothly from patch to patch.
struct FaceTurn {
    static constexpr std::size_t most = 4;
    std::array<int, most> patch{0, 0, 0, 0};
    std::array<float, most> weight{1, 0, 0, 0}; // beginning with the triangle's own patch
    std::array<Eigen::Vector3f, most> rotation_vector;
};

struct PatchTurn {
    int first = 0, second = 0;
    Eigen::Vector3d rotation_vector; // of the second against the first, in the first shape's frame
    double weight = 0;
    Eigen::Vector3d bow{0, 0, 0}; // how far the middle of the way lies beside half of that vector
};

struct Turns {
    std::vector<FaceTurn> faces;
    std::vector<PatchTurn> links;
    int patch_count = 0;
    int root = 0;                         // the patch that turns least
    Eigen::Vector3d root_vector{0, 0, 0}; // its rotation vector
    Eigen::Vector3d root_bow{0, 0, 0};
    std::vector<std::array<Eigen::Vector3f, FaceTurn::most>>
        face_bows; // one a face, or none where all ways are straight
};

// The rotation about a vector by its length.
Eigen::Quaterniond exponential(const Eigen::Vector3d& v);

Turns turns(const FaceField& faces, const Patches& patches, const std::vector<Attachment>& attached);

// The same turns by way of a middle shape at u = 0.5, into which the triangles turn like this: rotation vectors are no
// longer scaled by u alone, but go through the middle's on parabolas.
Turns by_way_of(Turns turns, const FaceField& to_middle, const std::vector<int>& patch_of_triangle);

// The patches' rotations at their parameters u. N each.
Quaternions patch_rotations(const Turns& turns, const Eigen::VectorXd& u);

// The triangles' rotations at their parameters u, given those of the patches. m each.
Quaternions face_rotations(const Turns& turns, const Quaternions& patches, const Eigen::VectorXd& u);

} // namespace meshtween
