// What a glTF file's scene shows: its meshes, where nodes, instances, skins and default weights place their vertices.
#pragma once

#include "meshtween/io/gltf_data.h"

#include <Eigen/Core>

#include <memory>
#include <string>
#include <vector>

namespace meshtween {

// One appearance of a mesh.
struct GltfPart {
    std::size_t node = 0, mesh = 0;
    int instance = -1;     // of EXT_mesh_gpu_instancing; -1: the node itself
    Eigen::Matrix4d world; // of the node, or of its instance
    Eigen::Matrix4d local; // of the instance below the node
    // In the rest pose: where each joint takes the vertices; empty without a skin. Parts share them.
    std::shared_ptr<const std::vector<Eigen::Matrix4d>> joints;
    std::shared_ptr<const std::vector<double>> weights; // of its morph targets by default; empty where all are 0
};

// The parts in the order in which nodes are visited: the default scene's, children after their parents.
std::vector<GltfPart> gltf_parts(const GltfData& data);

// Triangles, strips and fans have vertices here; points and lines have none.
bool has_triangles(const GltfData& data, const nlohmann::json& primitive);

// A primitive of a part, and which of all vertices are its own.
struct GltfPiece {
    std::size_t part = 0, primitive = 0;
    std::size_t first = 0, count = 0;
    bool again = false; // the vertices are those of an earlier piece of the same part, which shares all its attributes
};

struct GltfLayout {
    std::vector<GltfPart> parts;
    std::vector<GltfPiece> pieces;
    std::size_t vertices = 0;
    std::size_t passed_over = 0; // primitives of points or lines
    const nlohmann::json& primitive(const GltfData& data, const GltfPiece& piece) const;
};

GltfLayout gltf_layout(const GltfData& data);

// How a piece's vertices come from the file's numbers into the world: matrix * (position + offset).
struct GltfPlacement {
    std::vector<Eigen::Matrix4d> matrices; // one for all, or one a vertex
    std::vector<double> offsets;           // x y z a vertex, of the default weights; empty where there are none
    bool skinned = false;

    const Eigen::Matrix4d& matrix(std::size_t i) const { return matrices[matrices.size() == 1 ? 0 : i]; }
};

GltfPlacement gltf_placement(const GltfData& data, const GltfLayout& layout, const GltfPiece& piece);

// Writes where the piece's vertices lie in the world to their places among all, x y z each; `coordinates` grow to hold
// them.
void gltf_positions(const GltfData& data, const GltfLayout& layout, const GltfPiece& piece,
                    const GltfPlacement& placement, std::vector<double>& coordinates);

} // namespace meshtween
