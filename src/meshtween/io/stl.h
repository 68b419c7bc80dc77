// What reading and writing STL share.
#pragma once

#include "meshtween/io/text.h"

#include <cstddef>
#include <filesystem>
#include <string_view>

namespace meshtween {

inline constexpr std::size_t stl_header_size = 80, stl_facet_size = 50; // a facet without what its attribute counts

// How the bytes of an STL file are to be read.
struct StlLayout {
    bool text = false;
    std::size_t facets = 0;   // of a binary file; its size tells where the header's count is wrong
    bool payloads = false;    // each facet is followed by as many bytes as its last two say
    std::size_t promised = 0; // the header's count
    std::size_t surplus = 0;  // bytes behind the last facet
};

// Throws Error(file) where size and count go together in no way.
StlLayout stl_layout(std::string_view bytes, const std::filesystem::path& path);

// The size of the facet that begins here, with its payload.
std::size_t stl_facet_length(const char* facet, bool payloads);

enum class StlWord { solid, facet, loop, vertex, end_loop, end_facet, end_solid, none, other };

// The line's statement, in any case, "end facet" in one word or two.
StlWord stl_word(Text& text);

} // namespace meshtween
