#include "meshtween/app/export.h"

#include "meshtween/core/error.h"
#include "meshtween/geometry/measure.h"
#include "meshtween/morph/keys.h"
#include "support/errors.h"
#include "support/glb.h"
#include "support/twist.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <set>

namespace meshtween {
namespace {

using Floats = Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

// What a viewer reads from the file.
struct Played {
    ParsedGlb glb;
    Floats base, base_normals;
    std::vector<Floats> targets, target_normals;
    Eigen::VectorXf times;
    Floats weights; // a row a time

    explicit Played(const std::string& bytes) : glb(parse_glb(bytes)) {
        const auto& primitive = glb.root["meshes"][0]["primitives"][0];
        base = accessor<float>(glb, primitive["attributes"]["POSITION"]);
        base_normals = accessor<float>(glb, primitive["attributes"]["NORMAL"]);
        for (const auto& target : primitive["targets"]) {
            targets.push_back(accessor<float>(glb, target["POSITION"]));
            target_normals.push_back(accessor<float>(glb, target["NORMAL"]));
        }
        const auto& sampler = glb.root["animations"][0]["samplers"][0];
        times = accessor<float>(glb, sampler["input"]);
        weights = accessor<float>(glb, sampler["output"]).reshaped<Eigen::RowMajor>(times.size(), targets.size());
    }

    // The frame at a time, its weights on straight lines between the keys.
    Points at(double time) const {
        Eigen::Index key = 1;
        while (key + 1 < times.size() && times[key] < time) ++key;
        const double t = (time - times[key - 1]) / static_cast<double>(times[key] - times[key - 1]);
        const Eigen::RowVectorXd w =
            (1 - t) * weights.row(key - 1).cast<double>() + t * weights.row(key).cast<double>();
        Points result = base.cast<double>();
        for (std::size_t k = 0; k < targets.size(); ++k)
            result += w[static_cast<Eigen::Index>(k)] * targets[k].cast<double>();
        return result;
    }
};

double largest(const Points& difference) {
    return difference.rowwise().norm().maxCoeff();
}

TEST(Export, TargetsReachTheNodes) {
    const Mesh mesh = straight_bar();
    const Curve curve = twist_curve(mesh);
    const Played played(morph_glb(mesh, curve));
    ASSERT_EQ(played.targets.size(), curve.nodes.size() - 1);
    for (std::size_t k = 1; k < curve.nodes.size(); ++k) {
        const Floats reached = played.base + played.targets[k - 1];
        EXPECT_LT(largest(reached.cast<double>() - curve.nodes[k]), 1e-6 * diagonal(mesh));
    }
}

TEST(Export, BlendedNormalsAreThoseOfTheShape) {
    const Mesh mesh = straight_bar();
    const Curve curve = twist_curve(mesh);
    const Played played(morph_glb(mesh, curve));
    for (const double u : {0.0, 0.1, 0.35, 0.5, 0.9, 1.0}) {
        const std::vector<float> weights = float_weights(curve, u);
        Floats normals = played.base_normals;
        for (std::size_t k = 0; k < weights.size(); ++k) normals += weights[k] * played.target_normals[k];
        const Points blended = normals.cast<double>().rowwise().normalized();
        EXPECT_LT(largest(blended - vertex_normals(curve.at(u), mesh.triangles)), u == 0 || u == 1 ? 1e-6 : 0.01) << u;
    }
}

// What Blender and game engines keep weights to.
TEST(Export, WeightsLieInZeroToOneAndLeaveTheBaseTheRest) {
    const Mesh mesh = straight_bar();
    const Curve keys = key_path(mesh, {mesh.positions, twist(mesh.positions, 3, 2), twist(mesh.positions, 3, 3)}).curve;
    for (const Ease kind : {Ease::linear, Ease::in, Ease::out, Ease::in_out})
        for (const Curve& curve : {twist_curve(mesh), keys}) {
            const Played played(morph_glb(mesh, curve, {.ease = kind, .title = ""}));
            EXPECT_GE(played.weights.minCoeff(), 0);
            EXPECT_LE(played.weights.maxCoeff(), 1);
            EXPECT_LE(played.weights.cast<double>().rowwise().sum().maxCoeff(), 1);
            EXPECT_EQ(played.weights.row(0).maxCoeff(), 0);
            const Eigen::Index half = played.times.size() / 2;
            EXPECT_EQ(played.weights(half, played.weights.cols() - 1), 1);
        }
}

TEST(Export, TheKeysSayHowFarTheyLieOff) {
    const Mesh mesh = straight_bar();
    const Curve curve = twist_curve(mesh, 4);
    const double size = diagonal(mesh);
    for (const Ease kind : {Ease::linear, Ease::in_out})
        for (const double tolerance : {1e-3, 1e-5}) {
            const PlayOptions options{
                .seconds = 2, .ping_pong = false, .ease = kind, .title = "", .tolerance = tolerance};
            const WeightKeys keys = weight_keys(curve, options);
            EXPECT_LE(keys.chords, tolerance);
            EXPECT_GT(keys.chords, 0.4 * tolerance); // not for the price of far too many keys
            EXPECT_LT(keys.floats, 1e-6);
            const Played played(morph_glb(mesh, curve, options));
            double worst = 0;
            for (int i = 0; i <= 1000; ++i) {
                const double t = i / 1000.0;
                worst = std::max(worst, largest(played.at(2 * t) - curve.at(ease(kind, t))));
            }
            EXPECT_LE(worst, (keys.chords + keys.floats) * size);
        }
}

TEST(Export, StraightWeightsPlayTheCurve) {
    const Mesh mesh = straight_bar();
    const Curve curve = twist_curve(mesh);
    const Played played(morph_glb(mesh, curve, {.seconds = 3, .ping_pong = false, .title = ""}));
    EXPECT_EQ(played.times[played.times.size() - 1], 3);
    double worst = 0;
    for (int i = 0; i <= 500; ++i) worst = std::max(worst, largest(played.at(3.0 * i / 500) - curve.at(i / 500.0)));
    EXPECT_LT(worst / diagonal(mesh), 1e-5); // the keys' 8e-6 and float's rounding
    EXPECT_GT(worst / diagonal(mesh), 2e-6); // not for the price of far too many keys
}

TEST(Export, EaseAndKeysPlayAlike) {
    const Mesh mesh = straight_bar();
    const Curve curve =
        key_path(mesh, {mesh.positions, twist(mesh.positions, 3, 2), twist(mesh.positions, 3, 3)}).curve;
    const Played played(morph_glb(mesh, curve, {.seconds = 2, .ping_pong = false, .ease = Ease::in_out, .title = ""}));
    double worst = 0;
    for (int i = 0; i <= 300; ++i) {
        const double t = i / 300.0;
        worst = std::max(worst, largest(played.at(2 * t) - curve.at(ease(Ease::in_out, t))));
    }
    EXPECT_LT(worst / diagonal(mesh), 2e-5);
    EXPECT_EQ(played.glb.root["meshes"][0]["extras"]["knots"].get<std::vector<double>>(), curve.basis.knots);
}

TEST(Export, EndsAreExactToRounding) {
    const Mesh mesh = straight_bar();
    const Curve curve = twist_curve(mesh);
    const Played played(morph_glb(mesh, curve, {.seconds = 1, .ping_pong = true, .title = ""}));
    EXPECT_LT(largest(played.at(0) - curve.nodes.front()), 1e-6);
    EXPECT_LT(largest(played.at(1) - curve.nodes.back()), 1e-6);
    EXPECT_LT(largest(played.at(2) - curve.nodes.front()), 1e-6);
}

TEST(Export, PingPongIsItsOwnMirror) {
    const Mesh mesh = straight_bar();
    const Played played(morph_glb(mesh, twist_curve(mesh), {.seconds = 2, .ping_pong = true, .title = ""}));
    const Eigen::Index last = played.times.size() - 1;
    EXPECT_EQ(played.times[last], 4);
    for (Eigen::Index i = 0; i <= last; ++i)
        EXPECT_LT((played.weights.row(i) - played.weights.row(last - i)).cwiseAbs().maxCoeff(), 1e-6F);
    for (Eigen::Index i = 1; i <= last; ++i) EXPECT_GT(played.times[i], played.times[i - 1]);
}

TEST(Export, TwoNodesAreALineWithTwoKeys) {
    const Mesh mesh = straight_bar();
    const Played played(morph_glb(mesh, twist_curve(mesh, 0.3, 2), {.seconds = 2, .ping_pong = false, .title = ""}));
    EXPECT_EQ(played.times.size(), 2);
}

TEST(Export, NamesAndKnotsStandInTheExtras) {
    const Mesh mesh = straight_bar();
    const Curve curve = twist_curve(mesh);
    const Played played(morph_glb(mesh, curve, {.seconds = 2, .ping_pong = true, .title = "A \"bar\""}));
    const auto& part = played.glb.root["meshes"][0];
    EXPECT_EQ(part["extras"]["degree"], 8);
    EXPECT_EQ(part["extras"]["knots"].get<std::vector<double>>(), curve.basis.knots);
    const auto names = part["extras"]["targetNames"].get<std::vector<std::string>>();
    EXPECT_EQ(std::set<std::string>(names.begin(), names.end()).size(), curve.nodes.size() - 1);
    EXPECT_EQ(names.front(), "control 1"); // which lies beside the path
    EXPECT_EQ(names.back(), "key 2");
    EXPECT_EQ(played.glb.root["nodes"][0]["name"], "A \"bar\"");
}

TEST(Export, RefusesWhatCannotBePlayed) {
    const Mesh mesh = straight_bar();
    Curve curve = twist_curve(mesh);
    const auto refused = [&](const PlayOptions& options = {}) {
        return message_of(ErrorKind::argument, [&] { morph_glb(mesh, curve, options); });
    };
    EXPECT_EQ(refused({.seconds = 0, .ping_pong = true, .title = ""}), "a morph of 0 seconds cannot be played");
    refused({.seconds = std::numeric_limits<double>::quiet_NaN(), .ping_pong = true, .title = ""});
    curve.nodes[3].conservativeResize(5, 3);
    EXPECT_NE(refused().find("has 5 vertices"), std::string::npos);
    curve.nodes.resize(1);
    refused();
}

std::string decoded(std::string_view base64) {
    const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string bytes;
    std::uint32_t word = 0;
    int bits = 0;
    for (const char c : base64) {
        if (c == '=') break;
        word = word << 6 | static_cast<std::uint32_t>(digits.find(c));
        if ((bits += 6) >= 8) bytes += static_cast<char>(word >> (bits -= 8) & 0xFF);
    }
    return bytes;
}

std::string_view model_in(const std::string& page) {
    const std::string open = "<script id=\"model\" type=\"text/plain\">";
    const std::size_t from = page.find(open) + open.size();
    return std::string_view(page).substr(from, page.find("</script>", from) - from);
}

TEST(Export, ThePageHoldsTheModelWhole) {
    for (std::size_t size = 0; size < 70; ++size) {
        std::string bytes(size, '\0');
        for (std::size_t i = 0; i < size; ++i) bytes[i] = static_cast<char>(37 * i + size);
        const std::string page = morph_html(bytes);
        EXPECT_EQ(model_in(page).size(), (size + 2) / 3 * 4);
        EXPECT_EQ(decoded(model_in(page)), bytes);
    }
}

TEST(Export, ThePageLoadsNothing) {
    std::string page = morph_html("");
    std::transform(page.begin(), page.end(), page.begin(), [](unsigned char c) { return std::tolower(c); });
    for (const char* load :
         {"src=\"http", "href=\"http", "url(http", "@import", "src=\"//", "href=\"//", "src=\"./", "src=\"/"})
        EXPECT_EQ(page.find(load), std::string::npos) << load;
    EXPECT_NE(page.find("default-src 'none'"), std::string::npos);
}

TEST(Export, TitlesCannotBreakThePage) {
    const std::string page =
        morph_html("", {.seconds = 2, .ping_pong = true, .title = "</title><script>@@MODEL@@'\"&"});
    EXPECT_NE(page.find("<title>&lt;/title&gt;&lt;script&gt;@@MODEL@@&#39;&quot;&amp;</title>"), std::string::npos);
    EXPECT_EQ(page.find("@@TITLE@@"), std::string::npos);
    EXPECT_EQ(page.find("@@OPTIONS@@"), std::string::npos);
}

} // namespace
} // namespace meshtween
