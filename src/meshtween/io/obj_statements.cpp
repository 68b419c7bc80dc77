// After "Object Files (.obj)", Appendix B1 of the Advanced Visualizer manual.
#include "meshtween/io/obj_statements.h"

#include <algorithm>
#include <array>

namespace meshtween {
namespace {

bool holds_numbers(std::string_view keyword) {
    static constexpr std::array<std::string_view, 24> known{
        "v",    "vt",    "vn",   "f",    "fo",   "l",    "p",    "vp", "deg", "bmat", "step",  "cstype",
        "curv", "curv2", "surf", "parm", "trim", "hole", "scrv", "sp", "end", "con",  "ctech", "stech"};
    return std::find(known.begin(), known.end(), keyword) != known.end();
}

// A '#' ends the statement, but for that in 1.#QNAN, which is how some libraries print what is not a number.
bool cut_comment(Text& text) {
    const std::string_view rest = text.rest();
    const std::size_t at = rest.find('#');
    if (at == std::string_view::npos || (at > 0 && rest[at - 1] == '.')) return false;
    return text.cut_at('#');
}

} // namespace

bool next_statement(Text& text, std::string_view& keyword) {
    if (!text.next_line()) return false;
    keyword = text.word();
    if (keyword.empty() || keyword[0] == '#') {
        keyword = {};
    } else if (holds_numbers(keyword)) {
        if (!cut_comment(text) && text.join_lines()) cut_comment(text);
    }
    return true;
}

} // namespace meshtween
