// What a mistyped word was probably meant to be.
#pragma once

#include <string>
#include <vector>

// The name nearest to `word` by letters inserted, left out, replaced or exchanged with their neighbour; empty where
// none is within a third of its length.
std::string nearest_name(const std::string& word, const std::vector<std::string>& names);
