// Gortler, Grzeszczuk, Szeliski and Cohen 1996, The lumigraph, 4.2: what is missing is pulled from coarser means.
#include "meshtween/fit/bake.h"

#include "meshtween/core/parallel.h"

#include <algorithm>

namespace meshtween {
namespace {

std::size_t idx(std::ptrdiff_t i) {
    return static_cast<std::size_t>(i);
}

// Sums of covered pixels.
struct Mean {
    std::array<int, 3> sum{};
    int count = 0;
    void add(const std::uint8_t* rgb) {
        for (std::size_t c = 0; c < 3; ++c) sum[c] += rgb[c];
        ++count;
    }
    void put(std::uint8_t* rgb) const {
        for (std::size_t c = 0; c < 3; ++c) rgb[c] = static_cast<std::uint8_t>((sum[c] + count / 2) / count);
    }
};

// Once around; what was covered stays as it is.
void widen(Image& image, std::vector<char>& covered) {
    std::vector<char> wider = covered;
    const int width = image.width, height = image.height;
    parallel_for(
        height,
        [&](std::ptrdiff_t y) {
            for (int x = 0; x < width; ++x) {
                const std::size_t at = idx(y) * idx(width) + idx(x);
                if (covered[at] != 0) continue;
                Mean mean;
                for (std::ptrdiff_t ny = std::max<std::ptrdiff_t>(0, y - 1);
                     ny < std::min<std::ptrdiff_t>(height, y + 2); ++ny)
                    for (int nx = std::max(0, x - 1); nx < std::min(width, x + 2); ++nx)
                        if (const std::size_t n = idx(ny) * idx(width) + idx(nx); covered[n] != 0)
                            mean.add(image.rgb.data() + 3 * n);
                if (mean.count == 0) continue;
                mean.put(image.rgb.data() + 3 * at);
                wider[at] = 1;
            }
        },
        16);
    covered.swap(wider);
}

// Fills what is not covered from the picture at half the size, filled in the same way.
void pull(Image& image, const std::vector<char>& covered) {
    if (image.width * image.height == 1) return;
    Image half{(image.width + 1) / 2, (image.height + 1) / 2, {}};
    half.rgb.resize(3 * idx(half.width) * idx(half.height), 128);
    std::vector<char> half_covered(idx(half.width) * idx(half.height), 0);
    parallel_for(
        half.height,
        [&](std::ptrdiff_t y) {
            for (int x = 0; x < half.width; ++x) {
                Mean mean;
                for (std::ptrdiff_t ny = 2 * y; ny < std::min<std::ptrdiff_t>(image.height, 2 * y + 2); ++ny)
                    for (int nx = 2 * x; nx < std::min(image.width, 2 * x + 2); ++nx)
                        if (const std::size_t n = idx(ny) * idx(image.width) + idx(nx); covered[n] != 0)
                            mean.add(image.rgb.data() + 3 * n);
                const std::size_t at = idx(y) * idx(half.width) + idx(x);
                if (mean.count == 0) continue;
                mean.put(half.rgb.data() + 3 * at);
                half_covered[at] = 1;
            }
        },
        16);
    pull(half, half_covered);
    parallel_for(
        image.height,
        [&](std::ptrdiff_t y) {
            for (int x = 0; x < image.width; ++x) {
                const std::size_t at = idx(y) * idx(image.width) + idx(x);
                const std::size_t from = idx(y / 2) * idx(half.width) + idx(x / 2);
                if (covered[at] == 0) std::copy_n(half.rgb.data() + 3 * from, 3, image.rgb.data() + 3 * at);
            }
        },
        16);
}

} // namespace

void fill_around(Image& image, std::vector<char> covered, int margin) {
    for (int i = 0; i < margin; ++i) widen(image, covered);
    pull(image, covered);
}

} // namespace meshtween
