// The built page, inside the program.
#pragma once

#include <string_view>
#include <vector>

namespace meshtween::studio {

struct Asset {
    std::string_view name, type, bytes;
};
const std::vector<Asset>& page_assets();

} // namespace meshtween::studio
