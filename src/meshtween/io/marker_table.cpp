// Rows of cells: our own CSV and the bare lists of other programs.
#include "meshtween/io/marker_files.h"
#include "meshtween/io/markers.h"
#include "meshtween/io/output.h"
#include "meshtween/io/text.h"
#include "meshtween/io/text_out.h"

#include <fmt/format.h>

#include <algorithm>

namespace meshtween {
namespace {

bool is_number(const std::string& cell) {
    double ignored = 0;
    return parse(cell, ignored);
}

bool is_blank(const std::string& cell) {
    double value = 0;
    return cell.empty() || (parse(cell, value) && std::isnan(value));
}

// How many cells a row has: a name or none, then one place or two, each a point (3 cells) or a vertex's index (1).
struct Layout {
    std::size_t name = 0, sides = 0, cells_each = 0;
    std::size_t width() const { return name + sides * cells_each; }
};

Layout layout_of(const std::vector<std::string>& cells, const Text& text) {
    const bool named = !is_number(cells[0]);
    switch (cells.size()) {
    case 7:
        return {1, 2, 3};
    case 6:
        return {0, 2, 3};
    case 4:
        return {1, 1, 3};
    case 3:
        return named ? Layout{1, 2, 1} : Layout{0, 1, 3};
    case 2:
        return named ? Layout{1, 1, 1} : Layout{0, 2, 1};
    case 1:
        return {0, 1, 1};
    default:
        text.fail(fmt::format("a row of {} cells is none of name,sx,sy,sz,tx,ty,tz or name,x,y,z or x,y,z or two "
                              "vertex indices or one",
                              cells.size()));
    }
}

MarkerPlace place_of(const std::string* cells, const Layout& layout, const Text& text) {
    if (std::all_of(cells, cells + layout.cells_each, is_blank)) return {};
    if (layout.cells_each == 1) return text.integer_from(cells[0], "a vertex's index");
    Point point;
    for (int k = 0; k < 3; ++k) point[k] = text.finite_from(cells[k], std::string(1, "xyz"[k]));
    return point;
}

bool is_comment(std::string_view line) {
    const std::size_t first = line.find_first_not_of(" \t\r");
    return first == std::string_view::npos || line[first] == '#';
}

// A row of words alone, before any other, is a header.
bool is_header(const std::vector<std::string>& cells) {
    return cells.size() > 1 && std::none_of(cells.begin(), cells.end(),
                                            [](const std::string& cell) { return cell.empty() || is_number(cell); });
}

std::string quoted(std::string name) {
    std::replace(name.begin(), name.end(), '\n', ' ');
    if (name.find_first_of("\",;\t# ") == std::string::npos) return name;
    std::string result = "\"";
    for (const char c : name) result += c == '"' ? "\"\"" : std::string(1, c);
    return result + '"';
}

} // namespace

std::vector<std::string> cells_of(std::string_view line) {
    char separator = ' ';
    for (const char candidate : {'\t', ',', ';'}) { // the last that is there, outside quotes
        bool in_quotes = false;
        for (const char c : line) {
            if (c == '"') in_quotes = !in_quotes;
            if (c == candidate && !in_quotes) separator = candidate;
        }
    }
    std::vector<std::string> cells;
    std::size_t i = 0;
    const auto skip_blanks = [&] {
        while (i < line.size() && line[i] != separator && (line[i] == ' ' || line[i] == '\t' || line[i] == '\r')) ++i;
        while (separator == ' ' && i < line.size() && (line[i] == ' ' || line[i] == '\r')) ++i;
    };
    skip_blanks();
    while (i < line.size()) {
        std::string& cell = cells.emplace_back();
        if (line[i] == '"') {
            for (++i; i < line.size() && (line[i] != '"' || line.substr(i, 2) == "\"\""); ++i) {
                cell += line[i];
                if (line[i] == '"') ++i;
            }
            ++i;
        }
        for (; i < line.size() && line[i] != separator; ++i) cell += line[i];
        cell.erase(cell.find_last_not_of(" \t\r") + 1);
        if (i >= line.size()) break;
        ++i;
        skip_blanks();
        if (i >= line.size() && separator != ' ') cells.emplace_back(); // the line ends in a separator
    }
    return cells;
}

MarkerFile read_marker_table(std::string_view bytes, const std::filesystem::path& path) {
    MarkerFile file;
    Layout layout;
    Text text(bytes, path);
    for (bool first = true; text.next_line();) {
        if (is_comment(text.line())) continue;
        std::vector<std::string> cells = cells_of(text.line());
        const bool header = first && is_header(cells);
        first = false;
        if (header) continue;
        if (file.rows.empty()) layout = layout_of(cells, text);
        if (cells.size() == layout.width() + 1 && cells.back().empty()) cells.pop_back();
        if (cells.size() != layout.width())
            text.fail(fmt::format("this row has {} cells, those before it {}; the file is truncated or damaged",
                                  cells.size(), layout.width()));
        MarkerRow row;
        if (layout.name == 1) row.name = cells[0];
        row.where = fmt::format("line {}", text.line_number());
        for (std::size_t side = 0; side < layout.sides; ++side)
            row.places.push_back(place_of(&cells[layout.name + side * layout.cells_each], layout, text));
        file.rows.push_back(std::move(row));
        file.sides = layout.sides;
    }
    return file;
}

void write_marker_pairs(const std::vector<MarkerPair>& pairs, const std::filesystem::path& path) {
    write_whole(path, [&](std::ostream& stream) {
        TextOut out(stream);
        out.put("name,sx,sy,sz,tx,ty,tz\n");
        for (const MarkerPair& pair : pairs) {
            const Point &s = pair.source, &t = pair.target;
            out.put("{},{},{},{},{},{},{}\n", quoted(pair.name), s[0], s[1], s[2], t[0], t[1], t[2]);
        }
    });
}

Points read_points(const std::filesystem::path& path) {
    const std::string bytes = read_whole(path);
    if (bytes.empty()) bad_file(path, "the file is empty");
    std::vector<double> values;
    Text text(bytes, path);
    for (bool first = true; text.next_line();) {
        if (is_comment(text.line())) continue;
        const std::vector<std::string> cells = cells_of(text.line());
        const bool header = first && is_header(cells);
        first = false;
        if (header) continue;
        if (cells.size() != 3) text.fail(fmt::format("a row x,y,z has three cells, this has {}", cells.size()));
        for (std::size_t k = 0; k < 3; ++k) values.push_back(text.finite_from(cells[k], std::string(1, "xyz"[k])));
    }
    return Eigen::Map<const Points>(values.data(), static_cast<Eigen::Index>(values.size() / 3), 3);
}

void write_points(const Points& points, const std::filesystem::path& path) {
    write_whole(path, [&](std::ostream& stream) {
        TextOut out(stream);
        out.put("x,y,z\n");
        for (Eigen::Index i = 0; i < points.rows(); ++i)
            out.put("{},{},{}\n", points(i, 0), points(i, 1), points(i, 2));
    });
}

} // namespace meshtween
