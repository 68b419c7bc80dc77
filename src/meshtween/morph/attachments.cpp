// Prim's spanning tree over the components of a mesh.
#include "meshtween/morph/patches.h"

#include <algorithm>
#include <limits>
#include <map>

namespace meshtween {
namespace {

double distance_between(const Patches& patches, int p, int q) {
    return (patches.centre_from.row(p) - patches.centre_from.row(q)).norm() +
           (patches.centre_to.row(p) - patches.centre_to.row(q)).norm();
}

} // namespace

int root_component(const Patches& patches) {
    std::map<int, int> count;
    for (const int c : patches.component) ++count[c];
    const auto most =
        std::max_element(count.begin(), count.end(), [](const auto& a, const auto& b) { return a.second < b.second; });
    return most == count.end() ? -1 : most->first;
}

std::vector<Attachment> attachments(const Patches& patches) {
    const int n = static_cast<int>(patches.component.size());
    std::map<int, std::vector<int>> members;
    for (int p = 0; p < n; ++p) members[patches.component[static_cast<std::size_t>(p)]].push_back(p);
    struct Nearest {
        double distance = std::numeric_limits<double>::infinity();
        Attachment link;
    };
    std::map<int, Nearest> waiting; // by component
    const int root = root_component(patches);
    for (const auto& [component, own] : members)
        if (component != root) waiting[component] = {};
    const auto offer = [&](const std::vector<int>& hosts) {
        for (auto& [component, nearest] : waiting)
            for (const int own : members[component])
                for (const int host : hosts)
                    if (const double d = distance_between(patches, own, host); d < nearest.distance)
                        nearest = {d, {host, own}};
    };
    std::vector<Attachment> result;
    constexpr int many = 4000; // patches; beyond, a full tree would take too long
    if (n > 0) offer(members[root]);
    while (!waiting.empty()) {
        const auto next = n > many ? waiting.begin()
                                   : std::min_element(waiting.begin(), waiting.end(), [](const auto& a, const auto& b) {
                                         return a.second.distance < b.second.distance;
                                     });
        result.push_back(next->second.link);
        const int component = next->first;
        waiting.erase(next);
        if (n <= many) offer(members[component]);
    }
    return result;
}

} // namespace meshtween
