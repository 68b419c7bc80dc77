// How far triangles of a mesh reach through each other: what falls to nothing as a cut is undone.
#pragma once

#include "meshtween/core/mesh.h"
#include "meshtween/fit/shell.h"

#include <Eigen/Geometry>

#include <array>
#include <optional>
#include <span>
#include <vector>

namespace meshtween {

// A triangle of a mesh as it lies now.
struct Sheet {
    std::array<int, 3> vertices{};
    std::array<Point, 3> corners;
    Eigen::AlignedBox3d box;
    Point normal{0, 0, 0};  // of any length
    double normal_size = 0; // that length
};

Sheet sheet(const std::array<int, 3>& vertices, const std::array<Point, 3>& corners);
Sheet sheet(const Points& positions, const Triangles& triangles, int t);

// The length of the line in which two triangles cut each other; nothing for two that do not, or that share an edge.
std::optional<double> cut_length(const Sheet& a, const Sheet& b);

// Triangles within a few rings of those that cut, ascending: what these could cut instead.
std::vector<int> beside_cuts(const Shell& shell, std::span<const std::array<int, 2>> cuts);

} // namespace meshtween
