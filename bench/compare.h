// Rows of the table that closes a run.
#pragma once

#include <string>

// Adds the row "`what`: the peer takes X times as long, wanted W": both are names of benchmarks in the same run, `ours`
// with its arguments as printed. Returns true, so that it can stand at namespace scope:
//     const bool row = compare("warp of 1M points", "warp/vtk", "warp/ours", 5);
bool compare(std::string what, std::string peer, std::string ours, double wanted);
