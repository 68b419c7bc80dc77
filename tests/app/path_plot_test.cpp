#include "meshtween/app/path_plot.h"

#include "meshtween/morph/morph.h"
#include "support/posed.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace meshtween {
namespace {

TEST(PathPlot, DrawsALineAPathInEachPanel) {
    const Mesh bar = test::bar(10, 3);
    const Points to = test::bent(bar.positions, 1);
    std::vector<PlottedPath> paths;
    for (const MorphMethod method : {MorphMethod::rigid, MorphMethod::linear})
        paths.push_back({std::string(name_of(method)),
                         path_quality(bar.triangles, morph(bar, to, {.method = method}).at, {.frames = 5})});
    const std::string svg = path_plot(paths);
    EXPECT_THAT(svg, testing::StartsWith("<svg"));
    EXPECT_THAT(svg, testing::EndsWith("</svg>\n"));
    EXPECT_THAT(svg, testing::HasSubstr(">linear<"));
    std::size_t lines = 0;
    for (std::size_t at = svg.find("<polyline"); at != std::string::npos; at = svg.find("<polyline", at + 1)) ++lines;
    EXPECT_EQ(lines, 8u);
}

TEST(PathPlot, NamesAreEscapedAndNumbersFinite) {
    PathQuality quality;
    quality.frames.resize(2);
    quality.frames[0].volume_ratio = std::nan("");
    const std::string svg = path_plot({{"a<b&c", quality}});
    EXPECT_THAT(svg, testing::HasSubstr("a&lt;b&amp;c"));
    EXPECT_THAT(svg, testing::Not(testing::HasSubstr("nan")));
}

} // namespace
} // namespace meshtween
