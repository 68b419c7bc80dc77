// meshtween studio: serves the page on this machine until it is told to stop.
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace meshtween::studio {

struct StudioOptions {
    std::vector<std::filesystem::path> meshes;      // none, or source and target
    std::filesystem::path project;                  // empty: the one that belongs to the meshes, or the last one
    int port = 0;                                   // 0: a free one
    bool browser = true;                            // open it
    std::size_t most_upload = std::size_t(1) << 30; // bytes of one file dropped on the page
    std::function<void(const std::string& address)> ready;
    std::function<bool()> stop_wanted; // asked a few times a second
};

// Throws Error for files, a project or a port that cannot be used.
void run_studio(const StudioOptions& options);

} // namespace meshtween::studio
