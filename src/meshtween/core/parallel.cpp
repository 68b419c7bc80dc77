#include "meshtween/core/parallel.h"

#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/info.h>
#include <oneapi/tbb/parallel_for.h>

#include <memory>

#if defined(__SANITIZE_THREAD__)
#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>
#endif

namespace meshtween {
namespace {
std::unique_ptr<tbb::global_control> limit; // alive while a count is set
int wanted = 0;

using Body = std::function<void(std::ptrdiff_t, std::ptrdiff_t)>;

#if defined(__SANITIZE_THREAD__)
// The sanitizer does not see how oneTBB's binary synchronises and reports it as races: under it, plain threads.
void run_ranges(std::ptrdiff_t count, std::ptrdiff_t grain, const Body& body) {
    std::atomic<std::ptrdiff_t> next{0};
    std::exception_ptr failure;
    std::mutex failing;
    const auto work = [&] {
        try {
            for (std::ptrdiff_t from = next.fetch_add(grain); from < count; from = next.fetch_add(grain))
                body(from, std::min(count, from + grain));
        } catch (...) {
            const std::lock_guard lock(failing);
            failure = std::current_exception();
        }
    };
    {
        std::vector<std::jthread> helpers;
        for (int i = 1; i < threads(); ++i) helpers.emplace_back(work);
        work();
    }
    if (failure) std::rethrow_exception(failure);
}
#else
void run_ranges(std::ptrdiff_t count, std::ptrdiff_t grain, const Body& body) {
    tbb::parallel_for(tbb::blocked_range<std::ptrdiff_t>(0, count, static_cast<std::size_t>(grain)),
                      [&](const tbb::blocked_range<std::ptrdiff_t>& range) { body(range.begin(), range.end()); });
}
#endif
} // namespace

void set_threads(int count) {
    wanted = std::max(0, count);
    limit.reset();
    if (wanted > 0)
        limit = std::make_unique<tbb::global_control>(tbb::global_control::max_allowed_parallelism,
                                                      static_cast<std::size_t>(wanted));
}

int threads() {
    return wanted > 0 ? wanted : tbb::info::default_concurrency();
}

void parallel_ranges(std::ptrdiff_t count, std::ptrdiff_t grain, const Body& body) {
    if (count <= 0) return;
    if (count <= grain || threads() == 1) {
        body(0, count);
        return;
    }
    run_ranges(count, std::max<std::ptrdiff_t>(1, grain), body);
}

} // namespace meshtween
