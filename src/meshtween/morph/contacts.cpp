#include "meshtween/morph/contacts.h"

#include <algorithm>
#include <map>

namespace meshtween {
namespace {

using Cells = std::array<int, 2>;

// Which cells each cell borders on, itself among them.
std::vector<std::vector<int>> borders(const Patches& cells) {
    std::vector<std::vector<int>> around(cells.rotation.size());
    for (std::size_t c = 0; c < around.size(); ++c) around[c].push_back(static_cast<int>(c));
    for (const PatchLink& link : cells.links) {
        around[static_cast<std::size_t>(link.first)].push_back(link.second);
        around[static_cast<std::size_t>(link.second)].push_back(link.first);
    }
    return around;
}

Cells cells_of(const std::array<int, 2>& pair, const Patches& cells) {
    return {cells.of_triangle[static_cast<std::size_t>(pair[0])], cells.of_triangle[static_cast<std::size_t>(pair[1])]};
}

// Ordered pairs of cells, gathered over neighbours: the side that a pair's first cell lies on goes along.
class Gathered {
public:
    void add(const Cells& cells) { group_.emplace(cells, -1); }

    int number(const std::vector<std::vector<int>>& around) {
        int count = 0;
        for (auto& [cells, group] : group_) {
            if (group >= 0) continue;
            group = count;
            std::vector<Cells> queue{cells};
            while (!queue.empty()) {
                const Cells c = queue.back();
                queue.pop_back();
                for (const int a : around[static_cast<std::size_t>(c[0])])
                    for (const int b : around[static_cast<std::size_t>(c[1])])
                        if (const auto it = group_.find({a, b}); it != group_.end() && it->second < 0) {
                            it->second = count;
                            queue.push_back({a, b});
                        }
            }
            ++count;
        }
        return count;
    }

    int of(const Cells& cells) const { return group_.at(cells); }

private:
    std::map<Cells, int> group_;
};

void finish(Contact& contact) {
    for (auto& side : contact.sides) {
        std::sort(side.begin(), side.end());
        side.erase(std::unique(side.begin(), side.end()), side.end());
    }
    const auto worst = std::max_element(contact.cuts.begin(), contact.cuts.end());
    contact.worst_frame = static_cast<int>(worst - contact.cuts.begin());
    const int count = static_cast<int>(contact.cuts.size());
    contact.first_frame = count;
    for (int f = 0; f < count; ++f)
        if (contact.cuts[static_cast<std::size_t>(f)] > 0) {
            contact.first_frame = std::min(contact.first_frame, f);
            contact.last_frame = f;
        }
}

} // namespace

std::vector<Contact> contacts(const std::vector<CutPairs>& frames, const CutPairs& ends, const Patches& cells) {
    // Each pair comes in both orders, so that every contact comes twice, its sides exchanged; a crease is both in one.
    Gathered gathered;
    const auto both = [&](const CutPairs& pairs, const auto& use) {
        for (const auto& pair : pairs) {
            const Cells c = cells_of(pair, cells);
            use(c, pair[0], pair[1]);
            use(Cells{c[1], c[0]}, pair[1], pair[0]);
        }
    };
    const auto add = [&](const Cells& c, int, int) { gathered.add(c); };
    for (const CutPairs& pairs : frames) both(pairs, add);
    both(ends, add);
    std::vector<Contact> all(static_cast<std::size_t>(gathered.number(borders(cells))));
    std::vector<int> twin(all.size(), -1);
    for (Contact& contact : all) contact.cuts.assign(frames.size(), 0);
    for (std::size_t f = 0; f < frames.size(); ++f)
        both(frames[f], [&](const Cells& c, int a, int b) {
            const int g = gathered.of(c);
            Contact& contact = all[static_cast<std::size_t>(g)];
            contact.sides[0].push_back(a);
            contact.sides[1].push_back(b);
            ++contact.cuts[f];
            twin[static_cast<std::size_t>(g)] = gathered.of({c[1], c[0]});
        });
    both(ends, [&](const Cells& c, int, int) { all[static_cast<std::size_t>(gathered.of(c))].at_an_end = true; });
    std::vector<Contact> result;
    for (std::size_t g = 0; g < all.size(); ++g) {
        if (all[g].sides[0].empty() || twin[g] < static_cast<int>(g)) continue; // the ends' alone, or seen already
        all[g].fold = twin[g] == static_cast<int>(g);
        finish(all[g]);
        result.push_back(std::move(all[g]));
    }
    return result;
}

} // namespace meshtween
