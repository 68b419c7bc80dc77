// The only door to oneTBB. Each index writes its own slot and sums run in fixed blocks, so that results have the same
// bits for any number of threads.
#pragma once

#include <algorithm>
#include <cstddef>
#include <functional>
#include <vector>

namespace meshtween {

// Threads used by everything below, from now on; 0 means as many as the machine has. Not to be called from inside a
// loop.
void set_threads(int count);
int threads();

// Calls body(begin, end) over pieces of 0..count, at most `grain` long, each index exactly once, in any order.
void parallel_ranges(std::ptrdiff_t count, std::ptrdiff_t grain,
                     const std::function<void(std::ptrdiff_t, std::ptrdiff_t)>& body);

// Calls body(i) for i in 0..count-1, in any order. body writes only what belongs to i.
template <typename Body>
void parallel_for(std::ptrdiff_t count, const Body& body, std::ptrdiff_t grain = 1024) {
    parallel_ranges(count, grain, [&](std::ptrdiff_t begin, std::ptrdiff_t end) {
        for (std::ptrdiff_t i = begin; i < end; ++i) body(i);
    });
}

// The sum of term(i) over 0..count-1, added up in blocks of fixed length and then in order: the same bits for any
// number of threads. Sum needs a value-initialised zero and +=.
template <typename Sum, typename Term>
Sum parallel_sum(std::ptrdiff_t count, const Sum& zero, const Term& term) {
    constexpr std::ptrdiff_t block = 4096;
    const std::ptrdiff_t blocks = (count + block - 1) / block;
    std::vector<Sum> partial(static_cast<std::size_t>(blocks), zero);
    parallel_for(
        blocks,
        [&](std::ptrdiff_t b) {
            Sum sum = zero;
            for (std::ptrdiff_t i = b * block, end = std::min(count, i + block); i < end; ++i) sum += term(i);
            partial[static_cast<std::size_t>(b)] = sum;
        },
        1);
    Sum sum = zero;
    for (const Sum& p : partial) sum += p;
    return sum;
}

} // namespace meshtween
