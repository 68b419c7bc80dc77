#include "meshtween/morph/frames.h"

#include "meshtween/core/error.h"
#include "meshtween/core/parallel.h"

#include <fmt/format.h>

namespace meshtween {

FloatCurve to_float(const Curve& curve) {
    FloatCurve result;
    result.basis = curve.basis;
    for (const Points& node : curve.nodes) result.nodes.emplace_back(node.cast<float>());
    return result;
}

FloatPoints frame(const FloatCurve& curve, double u) {
    FloatPoints result(curve.nodes.front().rows(), 3);
    frame_into(curve, u, {result.data(), static_cast<std::size_t>(result.size())});
    return result;
}

void frame_into(const FloatCurve& curve, double u, std::span<float> result) {
    const Eigen::Index size = curve.nodes.front().size();
    if (static_cast<Eigen::Index>(result.size()) != size)
        throw Error(ErrorKind::argument, fmt::format("a frame needs {} floats, not {}", size, result.size()));
    std::vector<float> weights;
    std::vector<const float*> values; // of the nodes that take part
    for (std::size_t k = 0; const double weight : curve.basis.weights(u)) {
        if (weight != 0) {
            weights.push_back(static_cast<float>(weight));
            values.push_back(curve.nodes[k].data());
        }
        ++k;
    }
    using Block = Eigen::Map<Eigen::ArrayXf>;
    using Input = Eigen::Map<const Eigen::ArrayXf>;
    // A block stays in the nearest cache while four nodes at a time are added to it.
    parallel_ranges(size, 1 << 16, [&](Eigen::Index first, Eigen::Index last) {
        constexpr Eigen::Index block = 512; // two kilobytes: longer ones cross pages more than they save
        for (Eigen::Index begin = first; begin < last; begin += block) {
            const Eigen::Index length = std::min(block, last - begin);
            Block out(result.data() + begin, length);
            const auto in = [&](std::size_t k) { return Input(values[k] + begin, length); };
            const auto w = [&](std::size_t k) { return weights[k]; };
            std::size_t k = 1;
            out = w(0) * in(0);
            for (; k + 4 <= weights.size(); k += 4)
                out += (w(k) * in(k) + w(k + 1) * in(k + 1)) + (w(k + 2) * in(k + 2) + w(k + 3) * in(k + 3));
            for (; k < weights.size(); ++k) out += w(k) * in(k);
        }
    });
}

} // namespace meshtween
