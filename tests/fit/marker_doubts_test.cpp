#include "meshtween/fit/marker_doubts.h"

#include "meshtween/geometry/samples.h"

#include <gtest/gtest.h>

#include <algorithm>

using namespace meshtween;

namespace {

struct Pairs {
    Sample sample = meshtween::sample("head");
    Points target = sample.marker_target;

    Eigen::Index row(std::string_view name) const {
        return std::ranges::find(sample.marker_names, name) - sample.marker_names.begin();
    }
    std::vector<std::string> doubts() const { return marker_doubts(sample.marker_source, target, sample.marker_names); }
};

TEST(MarkerDoubts, RightOnesHaveNone) {
    for (const char* name : {"head", "bow", "build", "arms", "torus", "cup", "scan"}) {
        const Sample s = sample(name);
        EXPECT_TRUE(marker_doubts(s.marker_source, s.marker_target, s.marker_names).empty()) << name;
    }
}

TEST(MarkerDoubts, TwoThatAreExchangedAreNamedAndNoOthers) {
    Pairs pairs;
    pairs.target.row(pairs.row("eye_outer_L")).swap(pairs.target.row(pairs.row("mouth_corner_R")));
    const std::vector<std::string> doubts = pairs.doubts();
    ASSERT_EQ(doubts.size(), 1u);
    EXPECT_NE(doubts[0].find("'eye_outer_L'"), std::string::npos);
    EXPECT_NE(doubts[0].find("'mouth_corner_R'"), std::string::npos);
}

TEST(MarkerDoubts, LeftAndRightExchangedAndMirroredTargets) {
    Pairs names, mirrored;
    for (std::size_t k = 0; k < names.sample.marker_names.size(); ++k) {
        std::string other = names.sample.marker_names[k];
        if (!other.ends_with("_L")) continue;
        other.back() = 'R';
        names.target.row(static_cast<Eigen::Index>(k)).swap(names.target.row(names.row(other)));
    }
    mirrored.target.col(2) *= -1;
    for (const Pairs* pairs : {&names, &mirrored}) {
        const std::vector<std::string> doubts = pairs->doubts();
        ASSERT_EQ(doubts.size(), 1u);
        EXPECT_NE(doubts[0].find("mirror"), std::string::npos);
    }
}

TEST(MarkerDoubts, AnOutlierIsNamed) {
    Pairs pairs;
    pairs.target.row(pairs.row("mouth_corner_L")) += Point(0.1, 0.2, 0.1);
    const std::vector<std::string> doubts = pairs.doubts();
    ASSERT_GE(doubts.size(), 1u);
    EXPECT_NE(doubts[0].find("'mouth_corner_L'"), std::string::npos);
}

TEST(MarkerDoubts, FewPairsSayNothing) {
    Pairs pairs;
    pairs.target.row(0).swap(pairs.target.row(5));
    EXPECT_TRUE(marker_doubts(pairs.sample.marker_source.topRows(7), pairs.target.topRows(7),
                              {"a", "b", "c", "d", "e", "f", "g"})
                    .empty());
}

} // namespace
