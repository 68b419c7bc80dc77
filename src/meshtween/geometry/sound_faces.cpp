#include "meshtween/geometry/sound_faces.h"

#include "meshtween/geometry/disjoint_sets.h"
#include "meshtween/geometry/measure.h"

#include <algorithm>
#include <array>
#include <numeric>

namespace meshtween {
namespace {

constexpr double nil = 1e-9; // of the diagonal

std::size_t idx(auto i) {
    return static_cast<std::size_t>(i);
}

std::array<int, 3> sorted_corners(const Triangles& triangles, int t) {
    std::array<int, 3> corners{triangles(t, 0), triangles(t, 1), triangles(t, 2)};
    std::sort(corners.begin(), corners.end());
    return corners;
}

} // namespace

SoundFaces sound_faces(const Points& positions, const Triangles& triangles) {
    SoundFaces result;
    const double reach = nil * diagonal(positions, triangles);
    DisjointSets places(positions.rows());
    for (Eigen::Index t = 0; t < triangles.rows(); ++t)
        for (int k = 0; k < 3; ++k) {
            const int a = triangles(t, k), b = triangles(t, (k + 1) % 3);
            if ((positions.row(a) - positions.row(b)).norm() <= reach) places.join(a, b);
        }
    for (int v = 0; v < positions.rows(); ++v) result.vertex.push_back(places.find(v));
    result.triangles = triangles;
    for (int& v : result.triangles.reshaped()) v = result.vertex[idx(v)];
    std::vector<int> faces;
    for (int t = 0; t < triangles.rows(); ++t) {
        const auto corners = sorted_corners(result.triangles, t);
        if (corners[0] != corners[1] && corners[1] != corners[2])
            faces.push_back(t);
        else
            ++result.collapsed;
    }
    std::vector<int> order = faces;
    std::stable_sort(order.begin(), order.end(), [&](int s, int t) {
        return sorted_corners(result.triangles, s) < sorted_corners(result.triangles, t);
    });
    for (std::size_t i = 0; i < order.size(); ++i)
        if (i == 0 || sorted_corners(result.triangles, order[i - 1]) != sorted_corners(result.triangles, order[i]))
            result.kept.push_back(order[i]);
    result.doubled = static_cast<long>(faces.size() - result.kept.size());
    std::sort(result.kept.begin(), result.kept.end());
    return result;
}

std::vector<int> parts_of(Eigen::Index vertices, const Triangles& triangles, const std::vector<int>& chosen) {
    DisjointSets sets(vertices);
    for (const int t : chosen)
        for (int k = 1; k < 3; ++k) sets.join(triangles(t, 0), triangles(t, k));
    std::vector<int> number(idx(vertices), -1), result;
    int count = 0;
    for (const int t : chosen) {
        int& part = number[idx(sets.find(triangles(t, 0)))];
        if (part < 0) part = count++;
        result.push_back(part);
    }
    return result;
}

} // namespace meshtween
