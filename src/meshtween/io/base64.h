// Bytes as letters and back (RFC 4648, section 4).
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace meshtween {

std::string to_base64(std::string_view bytes);

// The first `most` bytes; fewer where the text ends before. Blanks are passed over, and padding may stand between
// texts that were written one behind the other. Nothing where a letter is none of the alphabet.
std::optional<std::string> from_base64(std::string_view text, std::size_t most = std::string_view::npos);

} // namespace meshtween
