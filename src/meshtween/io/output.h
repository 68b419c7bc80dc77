// Files that appear whole or not at all.
#pragma once

#include <filesystem>
#include <functional>
#include <ostream>
#include <string_view>

namespace meshtween {

// Runs `write` on a stream to a temporary file beside `path`, flushes it to the disk and renames it over `path`. On any
// failure the temporary file is removed and what was at `path` stays as it was: Error(file) says what could not be
// written and why (no such folder, no permission, a full disk); an exception from `write` passes through. A link is
// written through; a device or a pipe is written straight to.
void write_whole(const std::filesystem::path& path, const std::function<void(std::ostream&)>& write);
void write_whole(const std::filesystem::path& path, std::string_view contents);

// The file's bytes. Throws Error(file): not there, a folder, not readable.
std::string read_whole(const std::filesystem::path& path);

} // namespace meshtween
