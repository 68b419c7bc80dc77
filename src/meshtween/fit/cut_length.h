// How far triangles of a mesh reach through each other: what falls to nothing as a cut is undone.
#pragma once

#include "meshtween/core/mesh.h"
#include "meshtween/fit/shell.h"

#include <array>
#include <optional>
#include <span>
#include <vector>

namespace meshtween {

// The length of the line in which two triangles cut each other; nothing for two that do not, or that share an edge.
std::optional<double> cut_length(const Points& positions, const Triangles& triangles, int s, int t);

// Triangles within a few rings of those that cut, ascending: what these could cut instead.
std::vector<int> beside_cuts(const Shell& shell, std::span<const std::array<int, 2>> cuts);

// Of the given triangles those whose box comes within `reach` of the box around a vertex and its neighbours.
std::vector<int> near_vertex(const Shell& shell, const Points& positions, Eigen::Index vertex,
                             std::span<const int> triangles, double reach);

} // namespace meshtween
