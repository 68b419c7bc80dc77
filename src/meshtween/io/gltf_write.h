// Binary glTF 2.0 in memory: a mesh, alone or with the shapes that an animation plays.
#pragma once

#include "meshtween/core/mesh.h"

#include <functional>
#include <span>
#include <string>
#include <vector>

namespace meshtween {

// What a player blends: the mesh's own positions are the base, each shape is a morph target.
struct GltfMorph {
    std::span<const Points> shapes;      // K shapes of the mesh's connectivity, n x 3 each
    std::vector<std::string> names = {}; // K
    std::vector<float> times = {};       // T seconds, ascending from 0
    std::vector<float> weights = {};     // T x K, a row a time
    // The B-spline that the weights are of, with K + 1 weights, the base's first: for players, in the extras.
    int degree = 0;
    std::vector<double> knots = {};
    // Shapes that lie beside the path have no normals of their own: those of shape k (0 the base) are sum_s
    // normal_fit(k, s) of the normals of on_path(s). Empty: the shapes' own.
    Eigen::MatrixXd normal_fit = {};
    std::function<Points(std::size_t)> on_path = {};
};

// Where positions are written relative to: the origin, or the centre of a mesh that lies far from it.
Point glb_origin(const Points& positions);

// Positions, normals, colours, all sets of UVs, and the materials of the mesh's file as one GLB, a primitive a
// material. Vertex i of the file is vertex i of the mesh, and a vertex with several UVs or normals is repeated after
// all others; where there are several materials each has vertices of its own. The attribute _VERTEX tells the mesh's
// vertex where the numbering is another, so that reading gives back the mesh. Normals are split where the mesh's file
// split them. Positions are float: where the mesh lies far from the origin for its size, they are written relative to
// its centre, which the node's translation brings back. Colours are taken as sRGB and written linear, as glTF has them.
// Throws Error(argument): no faces, an index out of range, a number that is not finite, shapes of another size, or more
// than a GLB can hold (4 GiB).
std::string mesh_glb(const Mesh& mesh, const std::string& name = "mesh");
std::string mesh_glb(const Mesh& mesh, const GltfMorph& morph, const std::string& name = "mesh");

// What mesh_glb could not take along of the mesh's file: pictures that are not there or that glTF does not show.
// Sentences for people.
std::vector<std::string> mesh_glb_notes(const Mesh& mesh);

} // namespace meshtween
