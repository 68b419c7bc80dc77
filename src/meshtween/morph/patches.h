// A surface cut into a few hundred patches of like rotation, and who borders on whom.
#pragma once

#include "meshtween/core/mesh.h"
#include "meshtween/geometry/topology.h"

#include <Eigen/Geometry>

#include <vector>

namespace meshtween {

using Quaternions = std::vector<Eigen::Quaterniond>;

// What patches are made from: a row a triangle of two shapes of one mesh.
struct FaceField {
    Points centre_from, centre_to; // m x 3
    Eigen::VectorXd area;          // the mean of both shapes' areas; 0 where either is degenerate
    Quaternions rotation;          // takes the first shape's triangle to the second's (polar part); 1 where area is 0
};

FaceField face_field(const Points& from, const Points& to, const Triangles& triangles);

struct PatchLink {
    int first = 0, second = 0; // patches, first < second
    double length = 0;         // how much border they share, weighted by area; only ratios matter
};

struct Patches {
    std::vector<int> of_triangle;  // a patch a triangle
    Points centre_from, centre_to; // N x 3
    Quaternions rotation;          // N, the mean rotation of a patch's triangles
    std::vector<PatchLink> links;  // neighbours, ascending
    std::vector<int> component;    // N, the component of `topology` that the patch lies in
};

// About `count` patches (at least one a component), by farthest points in a distance that adds up the way over the
// surface and the change of rotation on it: patches are small where the shapes turn against each other. It does not
// matter which shape is first.
Patches patches(const FaceField& faces, const Triangles& triangles, const Topology& topology, int count);

// The mean rotation of each group of triangles, weighted by area. `group` names one a triangle, of 0..count-1.
Quaternions mean_rotations(const FaceField& faces, const std::vector<int>& group, int count);

// A component that goes along with a patch of another.
struct Attachment {
    int host = 0; // a patch of a component that is already held
    int own = 0;  // the nearest patch of the component that is attached to it
};

// Every component but the root, which has the most patches, attached to the nearest patch (of both shapes together) of
// those before it; with very many components, of the root only.
std::vector<Attachment> attachments(const Patches& patches);
int root_component(const Patches& patches);

} // namespace meshtween
