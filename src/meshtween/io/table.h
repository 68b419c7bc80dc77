// Numbers a row each, with or without names over their columns: what a vertex carries, from and to CSV.
#pragma once

#include "meshtween/core/mesh.h"

#include <Eigen/Core>

#include <filesystem>
#include <string>
#include <vector>

namespace meshtween {

struct Table {
    std::vector<std::string> names; // one a column, or none
    Eigen::MatrixXd values;         // rows x columns
};

// Any table that read_cells reads. A first column headed "vertex" or "index" must count from 0 and is taken away, one
// without a heading holds names and is taken away too. Throws Error(file) with the line: rows of
// unequal length, a cell that is no finite number, no rows at all.
Table read_table(const std::filesystem::path& path);

// As CSV; all digits are kept. With names, a first column "vertex" counts the rows.
void write_table(const Table& table, const std::filesystem::path& path);

} // namespace meshtween
