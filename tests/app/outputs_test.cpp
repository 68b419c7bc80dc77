#include "meshtween/app/outputs.h"

#include "meshtween/geometry/shapes.h"

#include "support/scratch.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

using namespace meshtween;

namespace {

TEST(WriteStill, PicturesTellHowFarTheyAre) {
    const Scratch folder;
    std::vector<double> told;
    const Written written = write_still(sphere(2), "ball", {{"before", sphere(1), {}}},
                                        {output(folder.path("ball.png").string())}, [&](double fraction, auto) {
                                            told.push_back(fraction);
                                            return true;
                                        });
    EXPECT_FALSE(written.cancelled);
    EXPECT_EQ(written.files.size(), 1u);
    EXPECT_GE(told.size(), 3u); // each tile, and the writing
    EXPECT_TRUE(std::is_sorted(told.begin(), told.end()));
}

TEST(WriteStill, ACancelledPictureIsNotWritten) {
    const Scratch folder;
    for (const int calls : {0, 1, 2}) {
        int left = calls;
        const Written written =
            write_still(sphere(2), "ball", {{"before", sphere(1), {}}}, {output(folder.path("ball.png").string())},
                        [&](double, auto) { return left-- > 0; });
        EXPECT_TRUE(written.cancelled);
        EXPECT_TRUE(written.files.empty());
        EXPECT_EQ(folder.entries(), 0);
    }
}

} // namespace
