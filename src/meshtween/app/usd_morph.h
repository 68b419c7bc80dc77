// A morph as a USD file that UsdSkel plays.
#pragma once

#include "meshtween/app/playing.h"
#include "meshtween/io/mesh_io.h"

#include <filesystem>
#include <string>
#include <vector>

namespace meshtween {

// The curve's nodes as blend shapes with normals, and a SkelAnimation of the weights that the GLB has. A path of
// straight lines between shapes becomes one blend shape with in-betweens. Returns sentences for people. Throws
// Error(argument) where the curve is of another mesh, Error(file) where writing fails.
std::vector<std::string> write_morph_usd(const Mesh& mesh, const Curve& curve, const WeightKeys& keys,
                                         const std::filesystem::path& path, const WriteOptions& options = {});

} // namespace meshtween
