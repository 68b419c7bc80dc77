// Which names of two lists mean the same.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace meshtween {

struct NameMatch {
    std::vector<std::optional<std::size_t>> of; // for each name of the first list, its place in the second
    std::string note;                           // what was overlooked to find them; empty where they are equal
};

// By equality; where that finds less than half, without a beginning (or an end) that all names of a list share, upper
// case, blanks and signs aside: "F-1" with "L-1", "source_nose" with "target_nose", "Skull1_nasion" with "Nasion".
// Names within a list differ.
NameMatch match_names(const std::vector<std::string>& first, const std::vector<std::string>& second);

} // namespace meshtween
