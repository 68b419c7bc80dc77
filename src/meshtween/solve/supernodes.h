// Where the entries of a sparse factor lie: found before any number is known. Not for callers outside this folder.
#pragma once

#include <Eigen/SparseCore>

#include <cstddef>
#include <span>
#include <vector>

namespace meshtween {

// Columns of the factor with the same rows below them, kept as one dense block each.
struct Supernodes {
    std::vector<int> permutation;         // new to old
    std::vector<int> first;               // S + 1: the first column of each
    std::vector<int> parent;              // S: the one that holds its first row below; -1 for a root
    std::vector<std::size_t> row_start;   // S + 1: into rows
    std::vector<int> rows;                // of each: its own columns, then the rows below them, ascending
    std::vector<std::size_t> value_start; // S + 1: into the factor's values, a column-major block each

    int count() const { return static_cast<int>(parent.size()); }
    int columns(int s) const { return first[static_cast<std::size_t>(s) + 1] - first[static_cast<std::size_t>(s)]; }
    std::span<const int> rows_of(int s) const {
        const auto i = static_cast<std::size_t>(s);
        return {rows.data() + row_start[i], row_start[i + 1] - row_start[i]};
    }
};

// Of a symmetric matrix whose lower triangle is given. O(entries of the factor) time.
Supernodes supernodes(const Eigen::SparseMatrix<double>& lower);

} // namespace meshtween
