// Boxes that overlap come from the tree, met with itself; exact orientations decide, so that the answer does not
// depend on the order of evaluation. Triangles and segments are closed: touching is meeting.
#include "meshtween/search/self_intersections.h"

#include "meshtween/core/parallel.h"
#include "meshtween/geometry/predicates.h"
#include "meshtween/search/box_tree.h"

#include <Eigen/Geometry>

#include <algorithm>

namespace meshtween {
namespace {

using Corners = std::array<Point, 3>;

// The plane coordinates, by leaving one axis out, in which a triangle keeps most of its area, and its turn there.
struct Projection {
    int x = 0, y = 1, turn = 0;

    explicit Projection(const Corners& t) {
        Eigen::Index steepest = 0;
        (t[1] - t[0]).cross(t[2] - t[0]).cwiseAbs().maxCoeff(&steepest);
        for (int k = 1; k <= 3 && turn == 0; ++k) {
            x = (static_cast<int>(steepest) + k) % 3;
            y = (x + 1) % 3;
            turn = orient2d(flat(t[0]), flat(t[1]), flat(t[2]));
        }
    }
    PlanePoint flat(const Point& p) const { return {p[x], p[y]}; }
    int side(const Point& a, const Point& b, const Point& p) const { return orient2d(flat(a), flat(b), flat(p)); }
};

bool between(const PlanePoint& a, const PlanePoint& b, const PlanePoint& p) { // for a, b, p on one line
    return p.cwiseMin(a.cwiseMin(b)) == a.cwiseMin(b) && p.cwiseMax(a.cwiseMax(b)) == a.cwiseMax(b);
}

bool segments_meet(const Projection& in, const Point& a, const Point& b, const Point& p, const Point& q) {
    const int sp = in.side(a, b, p), sq = in.side(a, b, q), sa = in.side(p, q, a), sb = in.side(p, q, b);
    if (sp * sq < 0 && sa * sb < 0) return true;
    return (sp == 0 && between(in.flat(a), in.flat(b), in.flat(p))) ||
           (sq == 0 && between(in.flat(a), in.flat(b), in.flat(q))) ||
           (sa == 0 && between(in.flat(p), in.flat(q), in.flat(a))) ||
           (sb == 0 && between(in.flat(p), in.flat(q), in.flat(b)));
}

bool lies_in(const Projection& in, const Corners& t, const Point& p) { // for p in the triangle's plane
    bool inside = true;
    for (std::size_t k = 0; k < 3; ++k) inside = inside && in.side(t[k], t[(k + 1) % 3], p) * in.turn >= 0;
    return inside;
}

bool segment_meets_in_plane(const Point& p, const Point& q, const Corners& t) {
    const Projection in(t);
    for (std::size_t k = 0; k < 3; ++k)
        if (segments_meet(in, p, q, t[k], t[(k + 1) % 3])) return true;
    return lies_in(in, t, p);
}

// A triangle's plane, whose sides are told exactly.
class Plane {
public:
    Plane(const Corners& t, double gap) : t_(t) {
        const Point u = t[1] - t[0], v = t[2] - t[0];
        normal_ = u.cross(v);
        gap_ = gap * gap * normal_.squaredNorm();
        doubt_ = rounding * rounding * u.squaredNorm() * v.squaredNorm();
    }
    // 1, -1, or 0 in it or as near to it as the gap.
    int side(const Point& p) const {
        const Point way = p - t_[0];
        const double along = normal_.dot(way);
        if (gap_ > 0 && along * along <= gap_) return 0;
        if (along * along > doubt_ * way.squaredNorm()) return along > 0 ? 1 : -1;
        return orient3d(t_[0], t_[1], t_[2], p);
    }

private:
    static constexpr double rounding = 1e-14; // several times the bound of what `along` can be off by, in lengths

    const Corners& t_;
    Point normal_;
    double gap_ = 0, doubt_ = 0; // squared, of `along`; of it by the length of the way
};

bool segment_meets(const Point& p, const Point& q, const Corners& t, const Plane& plane) {
    const int sp = plane.side(p), sq = plane.side(q);
    if (sp * sq > 0) return false;
    if (sp == 0 && sq == 0) return segment_meets_in_plane(p, q, t);
    if (sp == 0 || sq == 0) return lies_in(Projection(t), t, sp == 0 ? p : q);
    const int first = orient3d(p, q, t[0], t[1]), second = orient3d(p, q, t[1], t[2]);
    if (first * second < 0) return false;
    const int third = orient3d(p, q, t[2], t[0]);
    return first * third >= 0 && second * third >= 0;
}

bool on_one_side(const Plane& plane, const Point& p, const Point& q) {
    const int first = plane.side(p);
    return first != 0 && plane.side(q) == first;
}

bool triangles_meet(const Corners& s, const Corners& t, const Plane& of_s, double gap) {
    if (on_one_side(of_s, t[0], t[1]) && on_one_side(of_s, t[1], t[2])) return false;
    const Plane of_t(t, gap);
    if (on_one_side(of_t, s[0], s[1]) && on_one_side(of_t, s[1], s[2])) return false;
    for (std::size_t k = 0; k < 3; ++k)
        if (segment_meets(s[k], s[(k + 1) % 3], t, of_t) || segment_meets(t[k], t[(k + 1) % 3], s, of_s)) return true;
    return false;
}

struct Surface {
    const Points& positions;
    const Triangles& triangles;
    double gap = 0;

    Corners corners(int t) const {
        return {positions.row(triangles(t, 0)), positions.row(triangles(t, 1)), positions.row(triangles(t, 2))};
    }
    bool cut(int s, int t) const;
};

// Corners of both triangles, the shared ones first, in the same order in both.
struct Arranged {
    Corners s, t;
    int shared = 0;
};

Arranged arrange(const Surface& surface, int s, int t) {
    Arranged result{surface.corners(s), surface.corners(t)};
    std::array<int, 3> in_s{}, in_t{};
    for (int k = 0; k < 3; ++k) {
        in_s[static_cast<std::size_t>(k)] = surface.triangles(s, k);
        in_t[static_cast<std::size_t>(k)] = surface.triangles(t, k);
    }
    for (std::size_t i = 0; i < 3; ++i)
        for (auto j = static_cast<std::size_t>(result.shared); j < 3; ++j)
            if (in_s[i] == in_t[j]) {
                const auto k = static_cast<std::size_t>(result.shared++);
                std::swap(in_s[i], in_s[k]);
                std::swap(in_t[j], in_t[k]);
                std::swap(result.s[i], result.s[k]);
                std::swap(result.t[j], result.t[k]);
                break;
            }
    return result;
}

bool Surface::cut(int s, int t) const {
    const Arranged pair = arrange(*this, s, t);
    if (pair.shared == 3) return true;
    const Plane of_s(pair.s, gap);
    if (pair.shared == 0) return triangles_meet(pair.s, pair.t, of_s, gap);
    if (pair.shared == 1) {
        if (on_one_side(of_s, pair.t[1], pair.t[2])) return false; // they meet in the corner alone
        return segment_meets(pair.s[1], pair.s[2], pair.t, Plane(pair.t, gap)) ||
               segment_meets(pair.t[1], pair.t[2], pair.s, of_s);
    }
    // Folded flat along the shared edge: in one plane, and the third corners on one side of it.
    if (of_s.side(pair.t[2]) != 0) return false;
    const Projection in(pair.s);
    return in.side(pair.s[0], pair.s[1], pair.t[2]) == in.turn;
}

using Pairs = std::vector<std::array<int, 2>>;

struct Leaves {
    search::BoxTree tree;                // over the triangles that have area, by their own numbers
    std::vector<search::FloatBox> boxes; // of the triangles in the tree's order
    std::vector<int> leaves;
};

// Calls visit(node) for the leaves whose boxes overlap this one.
template <typename Visit>
void each_leaf(const search::BoxTree& tree, const search::FloatBox& box, const Visit& visit) {
    std::array<int, search::BoxTree::deepest + 1> stack{};
    std::size_t top = 0;
    stack[top++] = 0;
    while (top > 0) {
        const search::BoxTree::Node& node = tree.nodes[static_cast<std::size_t>(stack[--top])];
        if (!overlap(node.box, box)) continue;
        if (node.count == 0) {
            stack[top++] = node.first;
            stack[top++] = node.first + 1;
        } else {
            visit(node);
        }
    }
}

// All cutting pairs of a leaf with itself and with the leaves after it.
void meet(const Surface& surface, const Leaves& all, int leaf, Pairs& found) {
    const auto& own = all.tree.nodes[static_cast<std::size_t>(leaf)];
    const auto item = [&](int i) { return all.tree.order[static_cast<std::size_t>(i)]; };
    const auto box = [&](int i) -> const search::FloatBox& { return all.boxes[static_cast<std::size_t>(i)]; };
    each_leaf(all.tree, own.box, [&](const search::BoxTree::Node& node) {
        for (int i = own.first; i < own.first + own.count; ++i)
            for (int j = std::max(node.first, i + 1); j < node.first + node.count; ++j)
                if (overlap(box(i), box(j)) && surface.cut(item(i), item(j)))
                    found.push_back({std::min(item(i), item(j)), std::max(item(i), item(j))});
    });
}

bool has_area(const Surface& surface, int t) {
    const Corners c = surface.corners(t);
    return !collinear(c[0], c[1], c[2]);
}

// Over the triangles with area of those that are chosen, by their numbers; `boxes` is one a triangle.
Leaves leaves_over(const Surface& surface, const std::vector<search::FloatBox>& boxes, std::vector<char> chosen) {
    parallel_for(surface.triangles.rows(), [&](Eigen::Index t) {
        char& flag = chosen[static_cast<std::size_t>(t)];
        flag = flag && has_area(surface, static_cast<int>(t));
    });
    std::vector<int> number;
    std::vector<search::FloatBox> own;
    for (std::size_t t = 0; t < chosen.size(); ++t)
        if (chosen[t]) {
            number.push_back(static_cast<int>(t));
            own.push_back(boxes[t]);
        }
    Leaves result{search::box_tree(own, 4), {}, {}};
    for (int& item : result.tree.order) {
        result.boxes.push_back(own[static_cast<std::size_t>(item)]);
        item = number[static_cast<std::size_t>(item)];
    }
    for (std::size_t n = 0; n < result.tree.nodes.size(); ++n)
        if (result.tree.nodes[n].count > 0) result.leaves.push_back(static_cast<int>(n));
    return result;
}

// A coarse grid over the frame of `boxes`, -1..1 and a rounding, that knows which cells boxes lie in.
class Cells {
public:
    Cells() : marked_(side * side * side, 0) {}
    void mark(const search::FloatBox& box) {
        each(box, [&](char& cell) { cell = 1; });
    }
    bool near(const search::FloatBox& box) {
        char any = 0;
        each(box, [&](char& cell) { any |= cell; });
        return any != 0;
    }

private:
    static constexpr int side = 64;

    static std::size_t cell(float x) {
        return static_cast<std::size_t>(std::clamp(static_cast<int>((x + 1) / 2 * side), 0, side - 1));
    }
    template <typename Visit>
    void each(const search::FloatBox& box, const Visit& visit) {
        for (std::size_t x = cell(box.low[0]); x <= cell(box.high[0]); ++x)
            for (std::size_t y = cell(box.low[1]); y <= cell(box.high[1]); ++y)
                for (std::size_t z = cell(box.low[2]); z <= cell(box.high[2]); ++z)
                    visit(marked_[(x * side + y) * side + z]);
    }

    std::vector<char> marked_;
};

// The cutting pairs of a triangle with the chosen ones; of two chosen ones, from the first.
void meet_chosen(const Surface& surface, const Leaves& leaves, const search::FloatBox& box, int t,
                 const std::vector<char>& chosen, Pairs& found) {
    const bool own = chosen[static_cast<std::size_t>(t)] != 0;
    bool asked = false, area = false; // asked only where it matters
    each_leaf(leaves.tree, box, [&](const search::BoxTree::Node& node) {
        for (int i = node.first; i < node.first + node.count; ++i) {
            const int s = leaves.tree.order[static_cast<std::size_t>(i)];
            if (s == t || (own && s < t) || !overlap(leaves.boxes[static_cast<std::size_t>(i)], box)) continue;
            if (!asked) asked = true, area = has_area(surface, t);
            if (area && surface.cut(s, t)) found.push_back({std::min(s, t), std::max(s, t)});
        }
    });
}

// What visit(i, found) finds for i in 0..count-1, ascending.
template <typename Visit>
Pairs sorted_finds(std::ptrdiff_t count, std::ptrdiff_t grain, const Visit& visit) {
    std::vector<Pairs> found(static_cast<std::size_t>((count + grain - 1) / grain));
    parallel_for(
        std::ssize(found),
        [&](std::ptrdiff_t b) {
            for (std::ptrdiff_t i = b * grain; i < std::min(count, (b + 1) * grain); ++i)
                visit(i, found[static_cast<std::size_t>(b)]);
        },
        1);
    Pairs all;
    for (const Pairs& some : found) all.insert(all.end(), some.begin(), some.end());
    std::sort(all.begin(), all.end());
    return all;
}

} // namespace

Pairs self_intersections(const Points& positions, const Triangles& triangles, double gap) {
    if (triangles.rows() == 0) return {};
    const Surface surface{positions, triangles, gap};
    const auto boxes = search::triangle_boxes(positions, triangles, search::frame(positions, triangles));
    const Leaves leaves = leaves_over(surface, boxes, std::vector<char>(boxes.size(), 1));
    return sorted_finds(std::ssize(leaves.leaves), 32, [&](std::ptrdiff_t i, Pairs& found) {
        meet(surface, leaves, leaves.leaves[static_cast<std::size_t>(i)], found);
    });
}

Pairs self_intersections(const Points& positions, const Triangles& triangles, const std::vector<char>& chosen,
                         double gap) {
    if (std::find(chosen.begin(), chosen.end(), 1) == chosen.end()) return {};
    const Surface surface{positions, triangles, gap};
    const auto boxes = search::triangle_boxes(positions, triangles, search::frame(positions, triangles));
    const Leaves leaves = leaves_over(surface, boxes, chosen);
    if (leaves.leaves.empty()) return {};
    Cells cells;
    for (const search::FloatBox& box : leaves.boxes) cells.mark(box);
    return sorted_finds(triangles.rows(), 1024, [&](std::ptrdiff_t t, Pairs& found) {
        const search::FloatBox& box = boxes[static_cast<std::size_t>(t)];
        if (cells.near(box)) meet_chosen(surface, leaves, box, static_cast<int>(t), chosen, found);
    });
}

} // namespace meshtween
