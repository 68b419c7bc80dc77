// Lists made by counting.
#pragma once

#include "meshtween/geometry/topology.h"

#include <cstddef>

namespace meshtween {

// Items by their owners, each owner's in the order in which they come. for_each_pair calls put(owner, item) for all of
// them; it is called twice.
template <typename ForEachPair>
Lists gather(std::ptrdiff_t owners, const ForEachPair& for_each_pair) {
    Lists lists;
    lists.first.assign(static_cast<std::size_t>(owners) + 1, 0);
    for_each_pair([&](int owner, int) { ++lists.first[static_cast<std::size_t>(owner) + 1]; });
    for (std::size_t i = 1; i < lists.first.size(); ++i) lists.first[i] += lists.first[i - 1];
    lists.items.resize(static_cast<std::size_t>(lists.first.back()));
    std::vector<int> next(lists.first.begin(), lists.first.end() - 1);
    for_each_pair([&](int owner, int item) {
        lists.items[static_cast<std::size_t>(next[static_cast<std::size_t>(owner)]++)] = item;
    });
    return lists;
}

} // namespace meshtween
