// Which of 0..n-1 belong together (Tarjan 1975, Efficiency of a good but not linear set union algorithm). The least of
// a set stands for it.
#pragma once

#include <cstddef>
#include <numeric>
#include <utility>
#include <vector>

namespace meshtween {

class DisjointSets {
public:
    explicit DisjointSets(std::ptrdiff_t count) : parent_(static_cast<std::size_t>(count)) {
        std::iota(parent_.begin(), parent_.end(), 0);
    }
    int find(int i) {
        while (at(i) != i) i = at(i) = at(at(i));
        return i;
    }
    void join(int i, int j) {
        std::pair<int, int> roots{find(i), find(j)};
        if (roots.first > roots.second) std::swap(roots.first, roots.second);
        at(roots.second) = roots.first;
    }

private:
    int& at(int i) { return parent_[static_cast<std::size_t>(i)]; }
    std::vector<int> parent_;
};

} // namespace meshtween
