// A mesh as a thin shell: what it costs to bend it, and how each place of it has turned.
#pragma once

#include "meshtween/core/mesh.h"
#include "meshtween/fit/border.h"
#include "meshtween/geometry/topology.h"
#include "meshtween/solve/block_system.h"

#include <array>
#include <memory>
#include <vector>

namespace meshtween {

// An edge with the two triangles on it. coefficients . positions is the jump of the gradient across the edge, times
// its length: nought for any linear function of a plane.
struct Hinge {
    std::array<int, 4> vertices{}; // the edge's ends, then the corners across it
    std::array<double, 4> coefficients{};
    double weight = 0; // 3 / (area of both triangles), over the whole mesh's area; 0 only where it is none
};

// Energies are means over the surface, so that they do not depend on how finely it is cut into triangles.
struct Shell {
    Points rest; // n x 3
    Triangles triangles;
    Topology topology;
    Points normals;                         // n x 3, of the rest shape
    std::vector<double> area;               // n: share of the whole area
    std::vector<double> edge_weights;       // one an item of topology.neighbours: cotangent weights, kept positive
    std::vector<Hinge> hinges;              // one an inner edge
    Triangles border;                       // border_edges, but those where more of the shape follows
    std::vector<double> border_size;        // border_sizes of the rest shape
    Lists vertex_hinges;                    // a list a vertex: 4 h + k where it is the k-th of hinge h, ascending
    std::shared_ptr<const Pattern> pattern; // entries of both quadratic forms below
    std::vector<double> bending;            // sum over hinges of weight coefficients coefficients^T
    std::vector<double> membrane;           // the cotangent Laplacian over the whole area
};

Shell shell(const Points& rest, const Triangles& triangles);

// The border's edges between flagged vertices, a flag each, are none any more: there the mesh was cut off from the rest
// of its shape, and the target may go on.
void end_borders(Shell& shell, const std::vector<char>& cut_off);

// Whether the vertex lies on the shape's border.
inline bool has_border(const Shell& shell, Eigen::Index vertex) {
    return !shell.border_size.empty() && shell.border_size[static_cast<std::size_t>(vertex)] > 0;
}

// Each vertex's third of the triangles around it, over the whole area. n.
std::vector<double> vertex_area_shares(const Points& positions, const Triangles& triangles);

// How each vertex's neighbourhood lies after a deformation: a rotation times a scale (with_scale) or a rotation, the
// best one for the edges around it after `smoothing` rounds of averaging with its neighbours. n.
std::vector<Eigen::Matrix3d> local_frames(const Shell& shell, const Points& positions, int smoothing, bool with_scale);

// Frames that turn by less than `angle` (radians) drawn smoothly towards the identity, turn and scale alike: where
// little turns, the shell then asks for a smooth displacement rather than for its own form, turned. n.
std::vector<Eigen::Matrix3d> calmed(std::vector<Eigen::Matrix3d> frames, double angle);

// The right side that goes with  bending_weight E_b + membrane_weight E_m,  where E_b asks each hinge to keep its rest
// value turned by its frame and E_m asks each edge to. n x 3.
Points rest_force(const Shell& shell, const std::vector<Eigen::Matrix3d>& frames, double bending_weight,
                  double membrane_weight);

} // namespace meshtween
