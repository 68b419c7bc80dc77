#include "meshtween/io/text.h"

namespace meshtween {

std::string shown(std::string_view word) {
    constexpr std::size_t longest = 24;
    std::string result;
    for (const char c : word.substr(0, longest)) result += c >= ' ' && c <= '~' ? c : '?';
    return word.size() > longest ? result + "..." : result;
}

} // namespace meshtween
