#include "meshtween/app/fading.h"

#include "meshtween/app/export.h"
#include "support/glb.h"
#include "support/twist.h"

#include <gtest/gtest.h>

namespace meshtween {
namespace {

using Floats = Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
using Bytes = Eigen::Matrix<std::uint8_t, Eigen::Dynamic, 4, Eigen::RowMajor>;

Mesh colored(Mesh mesh, const Eigen::RowVector3f& rgb) {
    mesh.colors = Colors::Ones(mesh.positions.rows(), 4);
    mesh.colors.leftCols<3>().rowwise() = rgb;
    mesh.colors.col(1) *= 0.5F;
    return mesh;
}

// An accessor of normalised bytes, 0..1.
Floats bytes_of(const ParsedGlb& glb, const nlohmann::json& index) {
    const auto& a = glb.root["accessors"][index.get<std::size_t>()];
    EXPECT_EQ(a["componentType"], 5121);
    EXPECT_EQ(a["type"], "VEC4");
    EXPECT_EQ(a["normalized"], true);
    const auto& view = glb.root["bufferViews"][a["bufferView"].get<std::size_t>()];
    Bytes bytes(a["count"].get<int>(), 4);
    std::memcpy(bytes.data(), glb.bin.data() + view["byteOffset"].get<std::size_t>(),
                static_cast<std::size_t>(bytes.size()));
    return bytes.cast<float>() / 255;
}

TEST(Fading, TheSharesBlendToU) {
    const Curve curve = twist_curve(straight_bar());
    const std::vector<double> shares = shares_of_u(curve);
    ASSERT_EQ(shares.size(), curve.nodes.size());
    for (const double u : {0.0, 0.1, 0.37, 0.5, 0.93, 1.0}) {
        const std::vector<double> weights = curve.weights(u);
        double sum = 0;
        for (std::size_t k = 0; k < shares.size(); ++k) sum += weights[k] * shares[k];
        EXPECT_NEAR(sum, u, 1e-9);
    }
}

TEST(Fading, VertexColoursAreMorphTargets) {
    const Mesh mesh = straight_bar();
    const Curve curve = twist_curve(mesh);
    const std::string from = morph_glb(colored(mesh, {1, 0.2F, 0}), curve),
                      to = morph_glb(colored(mesh, {0, 1, 1}), curve);
    const std::vector<double> shares = shares_of_u(curve);
    const ParsedGlb glb = parse_glb(fading_glb(from, to, shares, Fading::colors)), first = parse_glb(from),
                    last = parse_glb(to);
    EXPECT_EQ(glb.root["nodes"].size(), 1U);
    const auto& primitive = glb.root["meshes"][0]["primitives"][0];
    const auto color_at = [](const ParsedGlb& file) {
        return accessor<float>(file, file.root["meshes"][0]["primitives"][0]["attributes"]["COLOR_0"]);
    };
    const Floats begin = color_at(first), end = color_at(last);
    for (const double u : {0.0, 0.3, 1.0}) {
        Floats blended = color_at(glb);
        const std::vector<double> weights = curve.weights(u);
        for (std::size_t k = 1; k < weights.size(); ++k)
            blended += static_cast<float>(weights[k]) * accessor<float>(glb, primitive["targets"][k - 1]["COLOR_0"]);
        const Floats want = begin + static_cast<float>(u) * (end - begin);
        EXPECT_LT((blended - want).cwiseAbs().maxCoeff(), 1e-5F) << u;
    }
}

TEST(Fading, ASecondLookCoversTheFirstAndSharesItsShape) {
    const Mesh mesh = straight_bar();
    const Curve curve = twist_curve(mesh);
    const std::string from = morph_glb(mesh, curve), to = morph_glb(colored(mesh, {0, 1, 1}), curve);
    const std::string both = fading_glb(from, to, shares_of_u(curve), Fading::cover);
    const ParsedGlb glb = parse_glb(both);
    ASSERT_EQ(glb.root["nodes"].size(), 2U);
    EXPECT_EQ(glb.root["scenes"][0]["nodes"].size(), 2U);
    EXPECT_EQ(glb.root["animations"][0]["channels"].size(), 2U);
    EXPECT_EQ(glb.root["animations"][0]["channels"][1]["target"]["node"], 1);
    const auto& under = glb.root["meshes"][0]["primitives"][0];
    const auto& over = glb.root["meshes"][1]["primitives"][0];
    EXPECT_EQ(under["attributes"]["POSITION"], over["attributes"]["POSITION"]);
    EXPECT_EQ(under["indices"], over["indices"]);
    EXPECT_EQ(under["targets"][0]["POSITION"], over["targets"][0]["POSITION"]);
    EXPECT_FALSE(under["attributes"].contains("COLOR_0"));
    EXPECT_EQ(glb.root["materials"][over["material"].get<std::size_t>()]["alphaMode"], "BLEND");
    EXPECT_LT(both.size(), 1.5 * static_cast<double>(from.size()));
    const Floats base = accessor<float>(glb, over["attributes"]["COLOR_0"]);
    EXPECT_EQ(base.col(3).cwiseAbs().maxCoeff(), 0);
    for (const double u : {0.0, 0.3, 1.0}) {
        const std::vector<double> weights = curve.weights(u);
        double alpha = 0;
        for (std::size_t k = 1; k < weights.size(); ++k) {
            const Floats target = bytes_of(glb, over["targets"][k - 1]["COLOR_0"]);
            EXPECT_EQ(target.leftCols<3>().maxCoeff(), 0);
            EXPECT_EQ(target.col(3).minCoeff(), target.col(3).maxCoeff());
            alpha += weights[k] * static_cast<double>(target(0, 3));
        }
        EXPECT_NEAR(alpha, u, 0.01);
    }
}

} // namespace
} // namespace meshtween
