// Decoders of compressed glTF: Draco and meshopt, where the libraries were there when this was built.
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace meshtween {

// An accessor's numbers, a row an element; integers that stand for fractions are fractions already.
struct GltfRows {
    std::size_t columns = 0;
    std::vector<double> values;
    std::size_t size() const { return columns == 0 ? 0 : values.size() / columns; }
};

struct DracoMesh {
    std::vector<double> corners;        // three a triangle
    std::map<std::size_t, GltfRows> of; // attributes by their number; integers as they are
    std::string trouble;                // why it could not be read; else empty
};
DracoMesh decode_draco(std::string_view bytes);

struct MeshoptView {
    std::size_t count = 0, stride = 0;
    std::string mode, filter; // as EXT_meshopt_compression names them
};
struct MeshoptBytes {
    std::string bytes;
    std::string trouble; // why they could not be read; else empty
};
MeshoptBytes decode_meshopt(std::string_view bytes, const MeshoptView& view);

} // namespace meshtween
