// A glTF file's JSON, its buffers, and the numbers in them; every offset is checked.
#pragma once

#include "meshtween/io/gltf_compressed.h"

#include <nlohmann/json.hpp>

#include <cstddef>
#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace meshtween {

class GltfData {
public:
    // `bytes` (GLB or JSON) must outlive this. Throws Error(file).
    GltfData(std::string_view bytes, std::filesystem::path path);

    const nlohmann::json& root() const { return root_; }
    const std::filesystem::path& path() const { return path_; }

    // Bytes of the file and its buffers.
    std::size_t size() const { return total_; }

    // How many vertices its parts have in all: reading them takes as many times more numbers.
    void lay_out(std::size_t vertices) const { vertices_ = vertices; }

    // How many items one of the file's lists ("nodes") has.
    std::size_t count(const char* list) const;
    // Item `index` of one of the file's lists. Throws where there is none.
    const nlohmann::json& item(const char* list, std::size_t index) const;

    // A whole number >= 0 of a JSON object; `otherwise` where the key is missing.
    std::size_t number(const nlohmann::json& object, const char* key, std::size_t otherwise) const;
    std::size_t number(const nlohmann::json& object, const char* key) const;               // throws where it is missing
    std::vector<std::size_t> numbers(const nlohmann::json& object, const char* key) const; // none where it is missing
    std::vector<double> reals(const nlohmann::json& object, const char* key) const;        // none where it is missing

    GltfRows rows(std::size_t accessor) const;

    // An attribute of a primitive, and the corners of its triangles, strips or fans; decoded where it is compressed.
    GltfRows attribute(const nlohmann::json& primitive, const std::string& name) const;
    std::vector<double> corners(const nlohmann::json& primitive, std::size_t vertices) const;

    // A bufferView's bytes, decoded where they are compressed.
    std::string_view view_bytes(std::size_t view) const;
    const std::vector<std::string_view>& buffers() const { return buffers_; }

    [[noreturn]] void fail(std::string_view what) const;

private:
    struct View {
        std::string_view bytes;
        std::size_t stride = 0; // 0: without gaps
    };

    void split_container(std::string_view bytes);
    void check_version() const;
    void load_buffers();
    std::string load_uri(const std::string& uri) const;
    View view(std::size_t index) const;
    std::string_view range(const nlohmann::json& object, const std::string& what) const;
    std::string_view decoded_view(std::size_t index, const nlohmann::json& compression) const;
    const DracoMesh* draco(const nlohmann::json& primitive) const;
    void count_read(std::size_t numbers) const;
    void count_decoded(std::size_t bytes) const;
    std::size_t columns_of(std::size_t index, const nlohmann::json& accessor) const;
    void read_numbers(std::string_view bytes, std::size_t stride, std::size_t component_type, bool normalized,
                      GltfRows& rows, std::size_t count) const;
    void read_sparse(const nlohmann::json& accessor, GltfRows& rows) const;

    std::filesystem::path path_;
    nlohmann::json root_;
    std::string_view binary_; // the GLB's own buffer
    std::vector<std::string> loaded_;
    std::vector<std::string> missing_; // why a buffer could not be had; else empty
    std::vector<std::string_view> buffers_;
    std::size_t total_ = 0; // bytes of file and buffers
    mutable std::size_t vertices_ = 0;
    mutable std::size_t read_ = 0; // numbers of accessors so far, and bytes that were decoded
    mutable std::size_t decoded_ = 0;
    mutable std::map<std::size_t, std::string> views_; // those that were compressed
    mutable std::map<std::size_t, DracoMesh> draco_;   // by bufferView
};

// Throws Error(file) through `data` where the file needs an extension that would change its shape and is not known
// here.
void require_known_extensions(const GltfData& data);

// A file that a uri of a glTF file names, relative to its folder: %20 is a space. Empty for a data: uri and for what
// lies outside the folder.
std::filesystem::path file_of_uri(const std::filesystem::path& gltf, const std::string& uri);

// The bytes of a data: uri in base64; an empty text where it is none.
std::string data_of_uri(std::string_view uri);

// 1, 2 or 4 bytes; 0 for what is no component type of glTF.
std::size_t component_size(std::size_t type);

} // namespace meshtween
