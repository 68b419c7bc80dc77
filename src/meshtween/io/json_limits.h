// Limits for JSON that others made.
#pragma once

#include <nlohmann/json.hpp>

#include <string_view>
#include <type_traits>

namespace meshtween {

// Why this JSON should not be parsed, as a sentence; empty where it may be. Copies of what is nested deeper would use
// up the stack, and an ordered object looks through all of its keys for each new one.
std::string_view json_trouble(std::string_view text, bool ordered);

// Discarded where the text is no JSON or goes beyond the limits.
template <typename Json>
Json json_or_discarded(std::string_view text) {
    if (!json_trouble(text, std::is_same_v<Json, nlohmann::ordered_json>).empty())
        return Json(Json::value_t::discarded);
    return Json::parse(text.begin(), text.end(), nullptr, false);
}

} // namespace meshtween
