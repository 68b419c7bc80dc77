#include "meshtween/io/json_limits.h"

#include <cstddef>
#include <vector>

namespace meshtween {

// The parser's own callback could count too, but then each end of an object takes a look at all objects beside it.
std::string_view json_trouble(std::string_view text, bool ordered) {
    constexpr std::size_t deepest = 256, most_keys = 20'000;
    std::vector<std::size_t> keys; // so far, of the objects and lists around this place
    bool quoted = false;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const char c = text[i];
        if (c == '"') quoted = !quoted;
        if (quoted) {
            if (c == '\\') ++i;
            continue;
        }
        if (c == '{' || c == '[') keys.push_back(0);
        if (keys.size() > deepest) return "its JSON is nested too deeply; the file is damaged";
        if ((c == '}' || c == ']') && !keys.empty()) keys.pop_back();
        if (c == ':' && ordered && !keys.empty() && ++keys.back() > most_keys)
            return "an object of its JSON has too many entries; the file is damaged";
    }
    return {};
}

} // namespace meshtween
