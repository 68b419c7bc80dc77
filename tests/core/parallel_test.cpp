#include "meshtween/core/parallel.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

namespace meshtween {
namespace {

class Threads : public testing::Test {
protected:
    void TearDown() override { set_threads(0); }
};

TEST_F(Threads, EachIndexOnce) {
    std::vector<int> hits(10007, 0);
    parallel_for(
        std::ssize(hits), [&](std::ptrdiff_t i) { ++hits[static_cast<std::size_t>(i)]; }, 16);
    for (const int h : hits) EXPECT_EQ(h, 1);
}

TEST_F(Threads, NothingToDo) {
    parallel_for(0, [](std::ptrdiff_t) { FAIL(); });
}

TEST_F(Threads, SumHasTheSameBitsForAnyNumberOfThreads) {
    const auto sum = [] {
        return parallel_sum(100003, 0.0,
                            [](std::ptrdiff_t i) { return std::sin(double(i)) * std::pow(10.0, double(i % 30)); });
    };
    set_threads(1);
    const double one = sum();
    for (const int count : {2, 3, 8}) {
        set_threads(count);
        const double many = sum();
        EXPECT_EQ(0, std::memcmp(&one, &many, sizeof one)) << count << " threads";
    }
}

TEST_F(Threads, CountIsWhatWasSet) {
    set_threads(3);
    EXPECT_EQ(threads(), 3);
    set_threads(0);
    EXPECT_GE(threads(), 1);
}

} // namespace
} // namespace meshtween
