#include "meshtween/morph/frames.h"

#include "meshtween/core/error.h"
#include "meshtween/core/parallel.h"
#include "meshtween/geometry/measure.h"
#include "support/posed.h"

#include <gtest/gtest.h>

namespace meshtween {
namespace {

TEST(Frames, AreTheCurveInFloat) {
    const Mesh bar = test::bar(200, 12); // several blocks, and an odd rest
    for (const int most : {2, 3, 5, 6, 9}) {
        const Curve c = curve(morph(bar, test::bent(bar.positions, 2)), {.tolerance = 1e-12, .max_nodes = most});
        const FloatCurve f = to_float(c);
        for (const double u : {0.0, 0.2, 0.77, 1.0}) {
            const Points shape = frame(f, u).cast<double>();
            EXPECT_LT(test::distance(shape, c.at(u)), 1e-6 * diagonal(bar)) << most << " " << u;
        }
    }
}

TEST(Frames, SameBitsForAnyNumberOfThreads) {
    const Mesh bar = test::bar(600, 12);
    const FloatCurve f = to_float(curve(morph(bar, test::bent(bar.positions, 2))));
    set_threads(1);
    const FloatPoints one = frame(f, 0.3);
    set_threads(2);
    const FloatPoints two = frame(f, 0.3);
    set_threads(0);
    EXPECT_EQ(one, two);
}

TEST(Frames, WrongSizeIsAnError) {
    const Mesh bar = test::bar(5, 2);
    const FloatCurve f = to_float(curve(morph(bar, bar.positions, {.method = MorphMethod::linear})));
    std::vector<float> small(5);
    EXPECT_THROW(frame_into(f, 0.5, small), Error);
}

} // namespace
} // namespace meshtween
