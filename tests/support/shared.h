// A folder of real models, where there is one: tests that use it do more there, and nothing elsewhere.
#pragma once

#include <cstdlib>
#include <filesystem>
#include <vector>

namespace meshtween {

// Named by MESHTWEEN_SHARED, else `shared` beside the source folder, which CMake names.
inline std::filesystem::path shared_folder() {
    if (const char* named = std::getenv("MESHTWEEN_SHARED"); named != nullptr) return named;
    return std::filesystem::path(MESHTWEEN_SOURCE_DIR).parent_path() / "shared";
}

// The folders of its cases, each with source.obj, target.obj and case.json.
inline std::vector<std::filesystem::path> shared_cases() {
    std::vector<std::filesystem::path> cases;
    std::error_code none;
    for (const auto& entry : std::filesystem::directory_iterator(shared_folder() / "data", none))
        if (std::filesystem::exists(entry.path() / "case.json")) cases.push_back(entry.path());
    return cases;
}

} // namespace meshtween
