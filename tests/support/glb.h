// Reads back what the glTF writer made, with nothing of the writer.
#pragma once

#include <Eigen/Core>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cstdint>
#include <cstring>
#include <string>

namespace meshtween {

struct ParsedGlb {
    nlohmann::json root;
    std::string bin;
};

inline std::uint32_t word_at(const std::string& bytes, std::size_t offset) {
    std::uint32_t value = 0;
    std::memcpy(&value, bytes.data() + offset, sizeof value);
    return value;
}

inline ParsedGlb parse_glb(const std::string& glb) {
    EXPECT_EQ(glb.substr(0, 4), "glTF");
    EXPECT_EQ(word_at(glb, 8), glb.size());
    const std::uint32_t text = word_at(glb, 12), bin = word_at(glb, 20 + text);
    EXPECT_EQ(28 + text + bin, glb.size());
    EXPECT_EQ(text % 4, 0U);
    EXPECT_EQ(bin % 4, 0U);
    return {nlohmann::json::parse(glb.substr(20, text)), glb.substr(28 + text, bin)};
}

// An accessor's rows; its component type must be Number's.
template <typename Number>
Eigen::Matrix<Number, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> accessor(const ParsedGlb& glb, int index) {
    const auto& a = glb.root["accessors"][static_cast<std::size_t>(index)];
    const auto& view = glb.root["bufferViews"][a["bufferView"].get<std::size_t>()];
    const std::string type = a["type"];
    const int columns = type == "SCALAR" ? 1 : type.back() - '0';
    const int code = std::is_same_v<Number, float> ? 5126 : sizeof(Number) == 2 ? 5123 : 5125;
    EXPECT_EQ(a["componentType"], code);
    Eigen::Matrix<Number, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> rows(a["count"].get<int>(), columns);
    const auto bytes = static_cast<std::size_t>(rows.size()) * sizeof(Number);
    EXPECT_EQ(view["byteLength"].get<std::size_t>(), bytes);
    std::memcpy(rows.data(), glb.bin.data() + view["byteOffset"].get<std::size_t>(), bytes);
    return rows;
}

} // namespace meshtween
