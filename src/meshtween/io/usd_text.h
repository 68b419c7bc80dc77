// Lists and names as USD's text format has them.
#pragma once

#include "meshtween/io/text_out.h"

#include <Eigen/Core>

#include <set>
#include <string>

namespace meshtween {

std::string usd_quoted(const std::string& text);

// A name that USD takes: letters, digits and underscores; `otherwise` where nothing is left of it.
std::string usd_name(const std::string& name, const std::string& otherwise);

// The name with a number behind it where it is taken; it is taken then.
std::string usd_unique(const std::string& name, std::set<std::string>& taken);

// What is said about an attribute, behind its value.
inline void put_about(TextOut& out, const std::string& about) {
    if (about.empty())
        out.put("\n");
    else
        out.put(" (\n            {}\n        )\n", about);
}

// [(x, y, z), ...] or pairs.
template <typename Rows>
void put_rows(TextOut& out, const Rows& rows, const std::string& about = {}) {
    out.put("[");
    for (Eigen::Index i = 0; i < rows.rows(); ++i) {
        const char* lead = i > 0 ? ", " : "";
        if (rows.cols() == 2)
            out.put("{}({}, {})", lead, rows(i, 0), rows(i, 1));
        else
            out.put("{}({}, {}, {})", lead, rows(i, 0), rows(i, 1), rows(i, rows.cols() - 1));
    }
    out.put("]");
    put_about(out, about);
}

template <typename List>
void put_list(TextOut& out, const List& list, const std::string& about = {}, const char* after = "") {
    out.put("[");
    const char* lead = "";
    for (const auto& item : list) {
        out.put("{}{}", lead, item);
        lead = ", ";
    }
    out.put("]{}", after);
    put_about(out, about);
}

} // namespace meshtween
