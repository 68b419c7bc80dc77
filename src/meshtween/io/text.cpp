#include "meshtween/io/text.h"

namespace meshtween {

std::string shown(std::string_view word) {
    constexpr std::size_t longest = 24;
    std::string result;
    for (const char c : word.substr(0, longest)) result += c >= ' ' && c <= '~' ? c : '?';
    return word.size() > longest ? result + "..." : result;
}

std::string listed(const std::vector<std::string>& parts) {
    std::string result;
    for (std::size_t i = 0; i < parts.size(); ++i) {
        if (i > 0) result += i + 1 == parts.size() ? " and " : ", ";
        result += parts[i];
    }
    return result;
}

std::string counted(std::size_t count, std::string_view noun) {
    return fmt::format("{} {}{}", count, noun, count == 1 ? "" : "s");
}

} // namespace meshtween
