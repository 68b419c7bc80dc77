#include "meshtween/core/parallel.h"

#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/info.h>
#include <oneapi/tbb/parallel_for.h>

#include <memory>

namespace meshtween {
namespace {
std::unique_ptr<tbb::global_control> limit; // alive while a count is set
int wanted = 0;
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

void parallel_ranges(std::ptrdiff_t count, std::ptrdiff_t grain,
                     const std::function<void(std::ptrdiff_t, std::ptrdiff_t)>& body) {
    if (count <= 0) return;
    if (count <= grain || threads() == 1) {
        body(0, count);
        return;
    }
    tbb::parallel_for(
        tbb::blocked_range<std::ptrdiff_t>(0, count, static_cast<std::size_t>(std::max<std::ptrdiff_t>(1, grain))),
        [&](const tbb::blocked_range<std::ptrdiff_t>& range) { body(range.begin(), range.end()); });
}

} // namespace meshtween
