#include "meshtween/fit/inner_faces.h"

#include "meshtween/fit/exposure.h"

#include <fmt/format.h>

#include <algorithm>

namespace meshtween {
namespace {

constexpr double some = 0.02;   // of the area: less are folds and furrows
constexpr double hardly = 0.25; // of what the other shape has

std::size_t idx(auto i) {
    return static_cast<std::size_t>(i);
}

bool alone(double own, double other) {
    return own >= some && other < hardly * own;
}

// Whether that may come out of shares that a sample tells.
bool may_be_alone(double own, double other) {
    constexpr double doubt = 0.7;
    return alone(own / doubt, other * doubt);
}

std::vector<char> of_all(const SoundFaces& faces, const std::vector<char>& kept) {
    std::vector<char> result(idx(faces.triangles.rows()), 0);
    for (std::size_t i = 0; i < faces.kept.size(); ++i) result[idx(faces.kept[i])] = kept[i];
    return result;
}

std::vector<char> either(std::vector<char> a, const std::vector<char>& b) {
    for (std::size_t i = 0; i < a.size(); ++i) a[i] |= b[i];
    return a;
}

} // namespace

InnerFaces inner_faces(const Points& source, const SoundFaces& source_faces, const Points& target,
                       const SoundFaces& target_faces, TargetLayer layer) {
    InnerFaces result;
    if (source_faces.kept.empty() || target_faces.kept.empty()) return result;
    const Triangles from = source_faces.triangles(source_faces.kept, Eigen::all),
                    to = target_faces.triangles(target_faces.kept, Eigen::all);
    const InnerShares of_source = inner_shares(source, from), of_target = inner_shares(target, to);
    if (may_be_alone(of_source.hidden, of_target.hidden)) {
        const std::vector<char> hidden = hidden_faces(source, from, exposure(source, from));
        if (alone(share_of_area(source, from, hidden), of_target.hidden)) result.source = of_all(source_faces, hidden);
    }
    std::vector<char> left_out(target_faces.kept.size(), 0);
    const bool may_hide = may_be_alone(of_target.hidden, of_source.hidden),
               may_cover = layer != TargetLayer::both && may_be_alone(of_target.covered, of_source.covered);
    if (!may_hide && !may_cover) return result;
    const std::vector<Exposure> all = exposure(target, to);
    const std::vector<char> hidden = hidden_faces(target, to, all), covered = covered_faces(target, to, all);
    if (const double share = share_of_area(target, to, hidden); alone(share, of_source.hidden)) {
        left_out = hidden;
        result.notes.push_back(fmt::format("{:.0f} % of the target's area is hidden from outside, and the source has "
                                           "no such part: left out",
                                           100 * share));
    }
    if (const double share = share_of_area(target, to, covered); may_cover && alone(share, of_source.covered)) {
        const Triangles inside_out = to.rowwise().reverse();
        left_out = either(std::move(left_out),
                          layer == TargetLayer::outer
                              ? covered
                              : covered_faces(target, inside_out, exposure(target, inside_out, Holes::open)));
        result.notes.push_back(
            fmt::format("the target has one surface over another in {:.0f} % of its area: the {} one is fitted to "
                        "(--layer outer, inner or both)",
                        100 * share, layer == TargetLayer::inner ? "inner" : "outer"));
    }
    if (std::ranges::any_of(left_out, [](char flag) { return flag != 0; }))
        result.target = of_all(target_faces, left_out);
    return result;
}

} // namespace meshtween
