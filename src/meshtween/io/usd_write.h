// USD as text: a mesh, alone or with the shapes that an animation of blend shapes plays.
#pragma once

#include "meshtween/core/mesh.h"
#include "meshtween/io/mesh_io.h"

#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace meshtween {

// What UsdSkel blends: the mesh's own positions are the base, each shape becomes a blend shape.
struct UsdMorph {
    std::span<const Points> shapes;  // K shapes of the mesh's connectivity, n x 3 each
    std::span<const Points> normals; // K + 1, the base's first, n x 3 each; blended as shapes are
    std::vector<std::string> names;  // K
    std::vector<float> times;        // T seconds, ascending from 0
    std::vector<float> weights;      // T x K, a row a time
    // Where shapes lie on the way, ascending to 1: set where the weights are such that only two neighbours are ever
    // blended, on a straight line. Then all become one blend shape with in-betweens.
    std::vector<float> stops; // K, or none
};

// Polygons, groups and materials are those of the mesh's file. Vertex i of the file is vertex i of the mesh. Numbers
// are floats: where the mesh lies far from the origin for its size, they are relative to its centre, which the
// prim's translation brings back. Writes through write_whole; pictures go beside the file as `options` say. Returns
// sentences for people. Throws Error(argument) for shapes of another size.
std::vector<std::string> write_usd(const Mesh& mesh, const UsdMorph& morph, const std::filesystem::path& path,
                                   const WriteOptions& options);

} // namespace meshtween
