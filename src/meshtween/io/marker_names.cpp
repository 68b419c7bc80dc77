#include "meshtween/io/marker_names.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <unordered_map>

namespace meshtween {
namespace {

using Names = std::vector<std::string>;
using Places = std::unordered_map<std::string, std::size_t>;

// What counts of a name.
std::string key_of(std::string_view name) {
    std::string key;
    for (const char c : name) {
        const auto u = static_cast<unsigned char>(c);
        if (std::isalnum(u) != 0 || u >= 0x80) key += static_cast<char>(std::tolower(u));
    }
    return key;
}

// Where the keys stand; nothing where one is empty or comes twice.
std::optional<Places> places_of(const Names& names, std::size_t begin) {
    Places places;
    for (std::size_t i = 0; i < names.size(); ++i) {
        const std::string key = key_of(std::string_view(names[i]).substr(begin));
        if (key.empty() || !places.emplace(key, i).second) return std::nullopt;
    }
    return places;
}

std::size_t shared_beginning(const Names& names) {
    constexpr std::size_t most = 48;
    std::size_t length = std::min(most, names[0].size());
    for (const std::string& name : names)
        length = static_cast<std::size_t>(
            std::mismatch(names[0].begin(),
                          names[0].begin() + static_cast<std::ptrdiff_t>(std::min(length, name.size())), name.begin())
                .first -
            names[0].begin());
    return length;
}

struct Cut {
    std::size_t first = 0, second = 0, matches = 0; // letters left out at the beginning, and what that finds
};

// The least that is left out for the most matches.
Cut best_cut(const Names& first, const Names& second) {
    Cut best;
    std::vector<std::optional<Places>> of_second;
    for (std::size_t k = 0, end = shared_beginning(second); k <= end; ++k) of_second.push_back(places_of(second, k));
    for (std::size_t i = 0, end = shared_beginning(first); i <= end; ++i) {
        const std::optional<Places> keys = places_of(first, i);
        for (std::size_t k = 0; keys && k < of_second.size(); ++k) {
            if (!of_second[k]) continue;
            const auto matches = static_cast<std::size_t>(std::count_if(
                keys->begin(), keys->end(), [&](const auto& entry) { return of_second[k]->count(entry.first) != 0; }));
            if (matches > best.matches || (matches == best.matches && i + k < best.first + best.second))
                best = {i, k, matches};
        }
    }
    return best;
}

Names reversed(const Names& names) {
    Names result;
    for (const std::string& name : names) result.emplace_back(name.rbegin(), name.rend());
    return result;
}

} // namespace

NameMatch match_names(const Names& first, const Names& second) {
    NameMatch match;
    match.of.resize(first.size());
    if (first.empty() || second.empty()) return match;
    Places exact;
    for (std::size_t i = 0; i < second.size(); ++i) exact.emplace(second[i], i);
    std::size_t equal = 0;
    for (std::size_t i = 0; i < first.size(); ++i)
        if (const auto found = exact.find(first[i]); found != exact.end()) match.of[i] = found->second, ++equal;
    const std::size_t enough = (std::min(first.size(), second.size()) + 1) / 2;
    if (equal >= enough) return match;
    const Names first_back = reversed(first), second_back = reversed(second);
    const Cut front = best_cut(first, second), back = best_cut(first_back, second_back);
    const bool by_end = back.matches > front.matches;
    const Cut& cut = by_end ? back : front;
    if (cut.matches <= equal || cut.matches < enough) return match;
    const Places keys = *places_of(by_end ? second_back : second, cut.second);
    std::string example;
    for (std::size_t i = 0; i < first.size(); ++i) {
        const auto found = keys.find(key_of(std::string_view((by_end ? first_back : first)[i]).substr(cut.first)));
        match.of[i] = found == keys.end() ? std::nullopt : std::optional(found->second);
        if (match.of[i] && example.empty()) example = fmt::format("'{}' with '{}'", first[i], second[*match.of[i]]);
    }
    match.note =
        fmt::format("{} names differ in what they {} with, in case or in signs only and are paired by the rest: {}",
                    cut.matches, by_end ? "end" : "begin", example);
    return match;
}

} // namespace meshtween
