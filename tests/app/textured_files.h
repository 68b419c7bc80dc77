#pragma once

#include <filesystem>

namespace meshtween {

void write_textured(const std::filesystem::path& folder);

} // namespace meshtween
