// An OBJ file statement by statement.
#pragma once

#include "meshtween/io/text.h"

#include <string_view>

namespace meshtween {

// Goes to the next line and gives its keyword, empty for a blank line or a comment; false at the end of the file.
// Statements of numbers go on in the next line where theirs ends in a backslash, and end before a '#'. Names do
// neither: they may hold both.
bool next_statement(Text& text, std::string_view& keyword);

} // namespace meshtween
