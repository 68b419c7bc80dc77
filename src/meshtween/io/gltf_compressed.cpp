// KHR_draco_mesh_compression, through Google's library; EXT_meshopt_compression, through meshoptimizer. Both are found
// when this is built or left out: then a compressed file is refused by name.
#include "meshtween/io/gltf_compressed.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <exception>

#ifdef MESHTWEEN_DRACO
#include <draco/compression/decode.h>
#include <draco/mesh/mesh.h>
#endif
#ifdef MESHTWEEN_MESHOPT
#include <meshoptimizer.h>
#endif

namespace meshtween {

#ifdef MESHTWEEN_DRACO
namespace {

GltfRows rows_of(const draco::PointAttribute& attribute, std::size_t points) {
    const int columns = attribute.num_components();
    GltfRows rows{static_cast<std::size_t>(columns), {}};
    rows.values.resize(points * rows.columns);
    std::array<double, 16> row{};
    const bool whole = attribute.data_type() != draco::DT_FLOAT32 && attribute.data_type() != draco::DT_FLOAT64;
    for (std::size_t i = 0; i < points; ++i) {
        const auto at = attribute.mapped_index(draco::PointIndex(static_cast<std::uint32_t>(i)));
        if (whole) { // ConvertValue to a floating type would divide normalised integers
            std::array<std::int64_t, 16> numbers{};
            attribute.ConvertValue<std::int64_t>(at, static_cast<std::int8_t>(columns), numbers.data());
            for (std::size_t c = 0; c < rows.columns; ++c) row[c] = static_cast<double>(numbers[c]);
        } else {
            attribute.ConvertValue<double>(at, static_cast<std::int8_t>(columns), row.data());
        }
        std::copy_n(row.begin(), rows.columns, rows.values.begin() + static_cast<std::ptrdiff_t>(i * rows.columns));
    }
    return rows;
}

DracoMesh decoded(std::string_view bytes) {
    DracoMesh result;
    draco::DecoderBuffer buffer;
    buffer.Init(bytes.data(), bytes.size());
    const auto kind = draco::Decoder::GetEncodedGeometryType(&buffer);
    if (!kind.ok() || kind.value() != draco::TRIANGULAR_MESH) {
        result.trouble = "holds no Draco mesh where it says so";
        return result;
    }
    draco::Decoder decoder;
    auto mesh = decoder.DecodeMeshFromBuffer(&buffer);
    if (!mesh.ok()) {
        result.trouble = std::string("holds a Draco mesh that cannot be decoded (") + mesh.status().error_msg() + ")";
        return result;
    }
    const draco::Mesh& found = *mesh.value();
    result.corners.reserve(3 * std::size_t{found.num_faces()});
    for (std::uint32_t f = 0; f < found.num_faces(); ++f)
        for (const auto& corner : found.face(draco::FaceIndex(f)))
            result.corners.push_back(static_cast<double>(corner.value()));
    for (std::int32_t a = 0; a < found.num_attributes(); ++a) {
        const draco::PointAttribute& attribute = *found.attribute(a);
        if (attribute.num_components() > 16) continue;
        result.of[attribute.unique_id()] = rows_of(attribute, found.num_points());
    }
    return result;
}

} // namespace

DracoMesh decode_draco(std::string_view bytes) {
    try {
        return decoded(bytes);
    } catch (const std::exception&) { // a length in damaged data that no memory holds
        DracoMesh result;
        result.trouble = "holds a Draco mesh that cannot be decoded";
        return result;
    }
}
#else
DracoMesh decode_draco(std::string_view) {
    DracoMesh result;
    result.trouble = "is compressed with Draco, which this build does not read; export it without compression";
    return result;
}
#endif

#ifdef MESHTWEEN_MESHOPT
namespace {

// 0 where it went well, as the library says it.
int decode(std::string_view bytes, const MeshoptView& view, std::string& into) {
    const auto* from = reinterpret_cast<const unsigned char*>(bytes.data());
    if (view.mode == "ATTRIBUTES")
        return meshopt_decodeVertexBuffer(into.data(), view.count, view.stride, from, bytes.size());
    if (view.mode == "TRIANGLES")
        return meshopt_decodeIndexBuffer(into.data(), view.count, view.stride, from, bytes.size());
    return meshopt_decodeIndexSequence(into.data(), view.count, view.stride, from, bytes.size());
}

bool sensible(const MeshoptView& view) {
    if (view.mode == "ATTRIBUTES")
        return view.stride > 0 && view.stride <= 256 && view.stride % 4 == 0 &&
               (view.filter.empty() || view.filter == "NONE" ||
                (view.filter == "OCTAHEDRAL" && (view.stride == 4 || view.stride == 8)) ||
                (view.filter == "QUATERNION" && view.stride == 8) || view.filter == "EXPONENTIAL");
    const bool triangles = view.mode == "TRIANGLES" && view.count % 3 == 0;
    return (triangles || view.mode == "INDICES") && (view.stride == 2 || view.stride == 4);
}

} // namespace

MeshoptBytes decode_meshopt(std::string_view bytes, const MeshoptView& view) {
    // Nothing shrinks further: two bits stand for a byte of 256 vertices. What promises more is damage or malice.
    if (!sensible(view) || view.count * view.stride > 1024 * (bytes.size() + 64))
        return {{}, "is compressed with meshopt in a way that is not known here; export it without compression"};
    MeshoptBytes result;
    result.bytes.resize(view.count * view.stride);
    if (decode(bytes, view, result.bytes) != 0)
        return {{}, "holds meshopt data that cannot be decoded: it is damaged, or of a newer version of meshopt"};
    if (view.mode == "ATTRIBUTES") {
        if (view.filter == "OCTAHEDRAL") meshopt_decodeFilterOct(result.bytes.data(), view.count, view.stride);
        if (view.filter == "QUATERNION") meshopt_decodeFilterQuat(result.bytes.data(), view.count, view.stride);
        if (view.filter == "EXPONENTIAL") meshopt_decodeFilterExp(result.bytes.data(), view.count, view.stride);
    }
    return result;
}
#else
MeshoptBytes decode_meshopt(std::string_view, const MeshoptView&) {
    return {{}, "is compressed with meshopt, which this build does not read; export it without compression"};
}
#endif

} // namespace meshtween
