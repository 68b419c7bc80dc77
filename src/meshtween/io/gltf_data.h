// A glTF file's JSON, its buffers, and the numbers in them; every offset is checked.
#pragma once

#include <nlohmann/json.hpp>

#include <cstddef>
#include <filesystem>
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

class GltfData {
public:
    // `bytes` (GLB or JSON) must outlive this. Throws Error(file).
    GltfData(std::string_view bytes, std::filesystem::path path);

    const nlohmann::json& root() const { return root_; }

    // Item `index` of one of the file's lists ("nodes"). Throws where there is none.
    const nlohmann::json& item(const char* list, std::size_t index) const;

    // A whole number >= 0 of a JSON object; `otherwise` where the key is missing.
    std::size_t number(const nlohmann::json& object, const char* key, std::size_t otherwise) const;
    std::size_t number(const nlohmann::json& object, const char* key) const; // throws where it is missing

    GltfRows rows(std::size_t accessor) const;

    [[noreturn]] void fail(std::string_view what) const;

private:
    struct View {
        std::string_view bytes;
        std::size_t stride = 0; // 0: without gaps
    };

    void split_container(std::string_view bytes);
    void refuse_extensions() const;
    void load_buffers();
    std::string load_uri(const std::string& uri) const;
    View view(std::size_t index) const;
    void read_numbers(std::string_view bytes, std::size_t stride, std::size_t component_type, bool normalized,
                      GltfRows& rows, std::size_t count) const;
    void read_sparse(const nlohmann::json& accessor, GltfRows& rows) const;

    std::filesystem::path path_;
    nlohmann::json root_;
    std::string_view binary_; // the GLB's own buffer
    std::vector<std::string> loaded_;
    std::vector<std::string_view> buffers_;
    std::size_t total_ = 0; // bytes of file and buffers
};

} // namespace meshtween
