#include "assets.h"

#include <cstddef>

extern "C" {
extern const char studio_index_begin[], studio_index_end[];
extern const char studio_script_begin[], studio_script_end[];
extern const char studio_style_begin[], studio_style_end[];
extern const char studio_worker_begin[], studio_worker_end[];
}

namespace meshtween::studio {

const std::vector<Asset>& page_assets() {
    const auto bytes = [](const char* begin, const char* end) {
        return std::string_view(begin, static_cast<std::size_t>(end - begin));
    };
    static const std::vector<Asset> all{
        {"index.html", "text/html; charset=utf-8", bytes(studio_index_begin, studio_index_end)},
        {"studio.js", "text/javascript; charset=utf-8", bytes(studio_script_begin, studio_script_end)},
        {"studio.css", "text/css; charset=utf-8", bytes(studio_style_begin, studio_style_end)},
        {"worker.js", "text/javascript; charset=utf-8", bytes(studio_worker_begin, studio_worker_end)},
    };
    return all;
}

} // namespace meshtween::studio
