// The search, written once for any vector width. Included by one file a width, which defines MESHTWEEN_LANES: floats in
// a vector. Floats decide what cannot be the answer: the distances of boxes never exceed the truth, those of triangles
// come with a bound on their error. What is left is settled in doubles, so that every width gives the same bits.
#pragma once

#include "meshtween/search/nearest.h"
#include "meshtween/search/wide_tree.h"

#if defined(__SSE2__)
#include <immintrin.h>
#endif

namespace meshtween::search {
namespace {

constexpr int lanes = MESHTWEEN_LANES;
using Floats = float __attribute__((vector_size(lanes * sizeof(float))));

inline Floats load(const float* from) {
    return *reinterpret_cast<const Floats*>(from);
}
inline Floats floats(float x) {
    return x - Floats{};
}

// A bit a lane where the comparison holds.
#if defined(__AVX2__)
inline unsigned at_most(Floats a, Floats b) {
    return static_cast<unsigned>(_mm256_movemask_ps(_mm256_cmp_ps(a, b, _CMP_LE_OQ)));
}
#elif defined(__SSE2__)
inline unsigned at_most(Floats a, Floats b) {
    return static_cast<unsigned>(_mm_movemask_ps(_mm_cmple_ps(a, b)));
}
#else
inline unsigned at_most(Floats a, Floats b) {
    const auto mask = a <= b;
    unsigned result = 0;
    for (unsigned i = 0; i < lanes; ++i) result |= (mask[i] != 0 ? 1U : 0U) << i;
    return result;
}
#endif

// What waits to be searched, the nearest last: a distance's bits above a child's, which sort as the distances do.
struct Stack { // NOLINT(cppcoreguidelines-pro-type-member-init): filling it would cost more than a search
    unsigned long long waiting[640]; // seven of each level of the binary tree under this one, and some
    int count = 0;

    void insert(int from, float distance, int child) { // among those from `from` on
        const unsigned long long entry = static_cast<unsigned long long>(__builtin_bit_cast(unsigned, distance)) << 32 |
                                         __builtin_bit_cast(unsigned, child);
        int i = count++;
        for (; i > from && waiting[i - 1] < entry; --i) waiting[i] = waiting[i - 1];
        waiting[i] = entry;
    }
};

// A triangle that may be the answer: its distance is no less than this.
struct Candidate {
    double least;
    int triangle;
};

struct Search {
    static constexpr int most = 32;

    const WideView& tree;
    WideQuery& query;
    Floats point[3];     // in the frame
    double rounding = 0; // more than the query is moved by floats, in the frame
    double reach = 0;    // the answer is no further
    double radius = 0;   // the same in the frame, for rounded points and boxes
    float bound = 0;     // its square
    Stack stack;
    Candidate candidates[most];
    int count = 0;

    // NOLINTNEXTLINE(cppcoreguidelines-pro-type-member-init): nor the candidates
    Search(const WideView& the_tree, WideQuery& the_query) : tree(the_tree), query(the_query) {
        double largest = 0;
        for (int k = 0; k < 3; ++k) {
            const double x = (query.point[k] - tree.origin[k]) * tree.scale;
            point[k] = floats(static_cast<float>(x));
            largest = larger(largest, larger(x, -x));
        }
        rounding = 1.2e-7 * largest + 1e-12;
        limit(__builtin_sqrt(query.squared_distance));
    }

    void limit(double distance) {
        reach = distance * (1 + 1e-15);
        radius = (reach * tree.scale + rounding) * (1 + 5e-7);
        const double squared = radius * radius + 1e-37;
        bound = squared < 3e38 ? static_cast<float>(squared) : 3e38F;
    }

    // The squared distances of `lanes` boxes.
    Floats to_boxes(const float* low, const float* high, int children) const {
        Floats squared{};
        for (int k = 0; k < 3; ++k) {
            const Floats below = load(low + k * children) - point[k], above = point[k] - load(high + k * children);
            const auto outside = larger<Floats>(larger<Floats>(below, above), Floats{});
            squared += outside * outside;
        }
        return squared;
    }

    // Puts the children within reach on the stack.
    void open(const WideNode& node) {
        const int from = stack.count;
        for (int start = 0; start < wide; start += lanes) {
            const Floats squared = to_boxes(node.low[0] + start, node.high[0] + start, wide);
            alignas(32) float distance[lanes];
            *reinterpret_cast<Floats*>(distance) = squared;
            for (unsigned hit = at_most(squared, floats(bound)); hit != 0; hit &= hit - 1) {
                const int i = __builtin_ctz(hit);
                stack.insert(from, distance[i], node.child[start + i]);
            }
        }
    }

    bool inside(const Neighbourhood& hood) const {
        bool result = true;
        for (int k = 0; k < 3; ++k)
            result &= (point[k][0] - radius >= hood.inside_low[k]) & (point[k][0] + radius <= hood.inside_high[k]);
        return result;
    }

    // With the last answer as bound there are few leaves within reach, and no order of theirs is worth its making.
    void look_around(const Neighbourhood& hood) {
        unsigned hit = 0;
        for (int start = 0; start < most_neighbours; start += lanes)
            hit |= at_most(to_boxes(hood.low[0] + start, hood.high[0] + start, most_neighbours), floats(bound))
                   << start;
        for (; hit != 0; hit &= hit - 1) look_into(tree.blocks[~hood.child[__builtin_ctz(hit)]]);
    }

    void settle_candidates() { // the last ones are the closest, and leave little to do for the others
        while (count > 0) {
            const Candidate& candidate = candidates[--count];
            if (candidate.least > reach) continue;
            settle(tree, query, candidate.triangle);
            reach = smaller(reach, __builtin_sqrt(query.squared_distance) * (1 + 1e-15));
        }
    }

    void consider(int t, double distance, double margin) {
        if (distance - margin > reach || !agrees(tree, query, t)) return;
        if (count == most) {
            settle_candidates();
            limit(reach);
        }
        candidates[count++] = {distance - margin, t};
        if (distance + margin < reach) limit(distance + margin);
    }

    void look_into(const TriangleBlock& block) {
        float local[3], away = 4;
        for (int k = 0; k < 3; ++k) {
            local[k] = static_cast<float>((query.point[k] - block.centre[k]) * block.scale);
            away += larger(local[k], -local[k]);
        }
        const Vector3<Floats> here{floats(local[0]), floats(local[1]), floats(local[2])};
        const float margin = block.slack * away, within = static_cast<float>(reach * block.scale) + margin;
        const float squared_within = within * within * (1 + 1e-6F);
        for (int start = 0; start < wide; start += lanes) {
            const auto row = [&](const float(&values)[3][wide]) {
                return Vector3<Floats>{load(values[0] + start), load(values[1] + start), load(values[2] + start)};
            };
            const Floats squared = nearest(here - row(block.a), row(block.ab), row(block.ac)).squared_distance;
            alignas(32) float distance[lanes];
            *reinterpret_cast<Floats*>(distance) = squared;
            for (unsigned hit = at_most(squared, floats(squared_within)); hit != 0; hit &= hit - 1) {
                const int i = __builtin_ctz(hit), t = block.triangle[start + i];
                if (t != query.triangle) consider(t, __builtin_sqrtf(distance[i]) * block.unit, margin * block.unit);
            }
        }
    }

    void come_down() {
        open(tree.nodes[0]);
        while (stack.count > 0) {
            const unsigned long long entry = stack.waiting[--stack.count];
            if (!(__builtin_bit_cast(float, static_cast<unsigned>(entry >> 32)) <= bound)) continue;
            const int child = __builtin_bit_cast(int, static_cast<unsigned>(entry));
            if (child >= 0)
                open(tree.nodes[child]);
            else
                look_into(tree.blocks[~child]);
        }
    }

    void run() {
        const int hint = query.triangle;
        if (hint >= 0 && inside(tree.neighbourhoods[tree.home[hint]]))
            look_around(tree.neighbourhoods[tree.home[hint]]);
        else
            come_down();
        settle_candidates();
    }
};

} // namespace
} // namespace meshtween::search
