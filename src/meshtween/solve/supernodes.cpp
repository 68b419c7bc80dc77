// Karypis and Kumar, A Fast and High Quality Multilevel Scheme for Partitioning Irregular Graphs, 1998 (the ordering);
// Liu, The Role of Elimination Trees in Sparse Factorization, 1990; Ashcraft and Grimes, The Influence of Relaxed
// Supernode Partitions on the Multifrontal Method, 1989.
#include "meshtween/solve/supernodes.h"

#include "meshtween/core/error.h"

#include <metis.h>

#include <algorithm>
#include <mutex>
#include <numeric>

namespace meshtween {
namespace {

using Ints = std::vector<int>;

std::size_t at(int i) {
    return static_cast<std::size_t>(i);
}

struct Graph {
    std::vector<idx_t> first, neighbours; // without the diagonal
};

Graph graph_of(const Eigen::SparseMatrix<double>& lower) {
    const int n = static_cast<int>(lower.cols());
    Graph graph;
    graph.first.assign(at(n) + 1, 0);
    const auto each = [&](const auto& visit) {
        for (int j = 0; j < n; ++j)
            for (Eigen::SparseMatrix<double>::InnerIterator it(lower, j); it; ++it)
                if (it.row() > j) visit(static_cast<int>(it.row()), j);
    };
    each([&](int i, int j) { ++graph.first[at(i) + 1], ++graph.first[at(j) + 1]; });
    std::partial_sum(graph.first.begin(), graph.first.end(), graph.first.begin());
    graph.neighbours.resize(static_cast<std::size_t>(graph.first.back()));
    std::vector<idx_t> next(graph.first.begin(), graph.first.end() - 1);
    each([&](int i, int j) {
        graph.neighbours[static_cast<std::size_t>(next[at(i)]++)] = j;
        graph.neighbours[static_cast<std::size_t>(next[at(j)]++)] = i;
    });
    return graph;
}

// New to old, by nested dissection.
Ints dissection(Graph& graph) {
    idx_t n = static_cast<idx_t>(graph.first.size()) - 1;
    std::vector<idx_t> order(static_cast<std::size_t>(n)), inverse(order.size());
    std::iota(order.begin(), order.end(), 0);
    static std::mutex one; // METIS draws its random numbers from one place for all threads
    const std::lock_guard lock(one);
    if (n > 1 && !graph.neighbours.empty() &&
        METIS_NodeND(&n, graph.first.data(), graph.neighbours.data(), nullptr, nullptr, order.data(), inverse.data()) !=
            METIS_OK)
        throw Error(ErrorKind::computation, "METIS could not order the system");
    return {order.begin(), order.end()};
}

Ints inverse_of(const Ints& permutation) {
    Ints inverse(permutation.size());
    for (std::size_t k = 0; k < permutation.size(); ++k) inverse[at(permutation[k])] = static_cast<int>(k);
    return inverse;
}

// Calls visit(i) for the neighbours i < k of column k, in the new numbering.
template <typename Visit>
void earlier(const Graph& graph, const Ints& permutation, const Ints& inverse, int k, const Visit& visit) {
    const auto v = at(permutation[at(k)]);
    for (idx_t e = graph.first[v]; e < graph.first[v + 1]; ++e) {
        const int i = inverse[static_cast<std::size_t>(graph.neighbours[static_cast<std::size_t>(e)])];
        if (i < k) visit(i);
    }
}

Ints elimination_tree(const Graph& graph, const Ints& permutation) {
    const Ints inverse = inverse_of(permutation);
    const int n = static_cast<int>(permutation.size());
    Ints parent(at(n), -1), ancestor(at(n), -1);
    for (int k = 0; k < n; ++k)
        earlier(graph, permutation, inverse, k, [&](int i) {
            while (i != -1 && i != k) {
                const int next = ancestor[at(i)];
                ancestor[at(i)] = k;
                if (next == -1) parent[at(i)] = k;
                i = next;
            }
        });
    return parent;
}

// Children before parents, subtrees in one piece.
Ints postorder(const Ints& parent) {
    const int n = static_cast<int>(parent.size());
    Ints head(at(n), -1), next(at(n), -1), order, stack;
    order.reserve(at(n));
    for (int k = n - 1; k >= 0; --k)
        if (const int p = parent[at(k)]; p >= 0) {
            next[at(k)] = head[at(p)];
            head[at(p)] = k;
        }
    for (int root = 0; root < n; ++root) {
        if (parent[at(root)] >= 0) continue;
        stack.push_back(root);
        while (!stack.empty()) {
            const int k = stack.back();
            if (const int child = head[at(k)]; child >= 0) {
                head[at(k)] = next[at(child)];
                stack.push_back(child);
            } else {
                order.push_back(k);
                stack.pop_back();
            }
        }
    }
    return order;
}

// How many entries each column of the factor has, the diagonal included.
Ints column_counts(const Graph& graph, const Ints& permutation, const Ints& parent) {
    const Ints inverse = inverse_of(permutation);
    Ints count(permutation.size(), 1), flag(permutation.size(), -1);
    for (int k = 0; k < static_cast<int>(permutation.size()); ++k) {
        flag[at(k)] = k;
        earlier(graph, permutation, inverse, k, [&](int i) {
            for (; flag[at(i)] != k; i = parent[at(i)]) {
                ++count[at(i)];
                flag[at(i)] = k;
            }
        });
    }
    return count;
}

// The first columns of supernodes: columns of one structure, and small ones together with their parents where that
// stores few zeros.
Ints grouped(const Ints& parent, const Ints& count) {
    struct Group {
        int first, columns, height;
        double zeros;
    };
    std::vector<Group> groups;
    const auto merge_back = [&] {
        while (groups.size() > 1) {
            const Group &t = groups.back(), &s = groups[groups.size() - 2];
            if (parent[at(s.first + s.columns - 1)] != t.first) return;
            const int columns = s.columns + t.columns, height = s.columns + t.height;
            const double zeros = s.zeros + t.zeros + static_cast<double>(s.columns) * (height - s.height);
            const double share = zeros / (static_cast<double>(columns) * height);
            if (share > (columns <= 8 ? 0.8 : columns <= 32 ? 0.3 : 0.05)) return;
            const Group merged{s.first, columns, height, zeros};
            groups.pop_back();
            groups.back() = merged;
        }
    };
    for (int j = 0; j < static_cast<int>(parent.size()); ++j) {
        const bool joins = j > 0 && parent[at(j - 1)] == j && count[at(j)] == count[at(j - 1)] - 1;
        if (joins) {
            ++groups.back().columns;
            continue;
        }
        merge_back(); // the one before is complete now
        groups.push_back({j, 1, count[at(j)], 0});
    }
    merge_back();
    Ints first;
    for (const Group& group : groups) first.push_back(group.first);
    first.push_back(static_cast<int>(parent.size()));
    return first;
}

} // namespace

Supernodes supernodes(const Eigen::SparseMatrix<double>& lower) {
    Graph graph = graph_of(lower);
    Supernodes result;
    result.permutation = dissection(graph);
    const Ints order = postorder(elimination_tree(graph, result.permutation));
    Ints permutation;
    for (const int k : order) permutation.push_back(result.permutation[at(k)]);
    result.permutation = std::move(permutation);
    const Ints parent = elimination_tree(graph, result.permutation);
    result.first = grouped(parent, column_counts(graph, result.permutation, parent));

    const int count = static_cast<int>(result.first.size()) - 1, n = static_cast<int>(parent.size());
    const Ints inverse = inverse_of(result.permutation);
    Ints owner(at(n)), mark(at(n), -1);
    for (int s = 0; s < count; ++s)
        std::fill(owner.begin() + result.first[at(s)], owner.begin() + result.first[at(s) + 1], s);
    std::vector<Ints> children(at(count));
    result.parent.assign(at(count), -1);
    result.row_start = {0};
    result.value_start = {0};
    for (int s = 0; s < count; ++s) {
        const int begin = result.first[at(s)], end = result.first[at(s) + 1];
        for (int j = begin; j < end; ++j) result.rows.push_back(j);
        const std::size_t below = result.rows.size();
        const auto add = [&](int i) {
            if (i < end || mark[at(i)] == s) return;
            mark[at(i)] = s;
            result.rows.push_back(i);
        };
        for (int j = begin; j < end; ++j) {
            const auto v = at(result.permutation[at(j)]);
            for (idx_t e = graph.first[v]; e < graph.first[v + 1]; ++e)
                add(inverse[static_cast<std::size_t>(graph.neighbours[static_cast<std::size_t>(e)])]);
        }
        for (const int child : children[at(s)])
            for (std::size_t k = result.row_start[at(child)]; k < result.row_start[at(child) + 1]; ++k)
                add(result.rows[k]);
        std::sort(result.rows.begin() + static_cast<std::ptrdiff_t>(below), result.rows.end());
        if (below < result.rows.size()) {
            result.parent[at(s)] = owner[at(result.rows[below])];
            children[at(result.parent[at(s)])].push_back(s);
        }
        const std::size_t height = result.rows.size() - result.row_start.back();
        result.row_start.push_back(result.rows.size());
        result.value_start.push_back(result.value_start.back() + height * static_cast<std::size_t>(end - begin));
    }
    return result;
}

} // namespace meshtween
