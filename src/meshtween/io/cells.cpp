#include "meshtween/io/cells.h"

#include "meshtween/io/marker_files.h"
#include "meshtween/io/text.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <optional>

namespace meshtween {
namespace {

// A number with a comma where others have a point: 1,5 or -0,25e3.
bool has_decimal_comma(std::string_view cell) {
    const std::size_t comma = cell.find(',');
    if (comma == std::string_view::npos || comma + 1 >= cell.size()) return false;
    if (std::isdigit(static_cast<unsigned char>(cell[comma + 1])) == 0) return false;
    std::string with_point(cell);
    with_point[comma] = '.';
    return is_number(with_point) && cell.find('.') == std::string_view::npos;
}

struct Line {
    std::string_view text;
    long number = 0;
    bool hash = false; // begins with #
};

// Excel's first line: sep=; in any case, in quotes or not.
std::optional<char> said_separator(std::string_view line) {
    if (line.size() == 7 && line.front() == '"' && line.back() == '"') line = line.substr(1, 5);
    constexpr std::string_view keyword = "sep=";
    const bool said = line.size() == 5 && std::equal(keyword.begin(), keyword.end(), line.begin(), [](char a, char b) {
                          return a == std::tolower(static_cast<unsigned char>(b));
                      });
    return said ? std::optional(line[4]) : std::nullopt;
}

std::vector<Line> lines_of(std::string_view bytes, const std::filesystem::path& path, std::optional<char>& separator) {
    std::vector<Line> lines;
    Text text(bytes, path);
    while (text.next_line()) {
        std::string_view line = text.line();
        if (!line.empty() && line.back() == '\r') line.remove_suffix(1);
        const std::size_t first = line.find_first_not_of(" \t");
        if (first == std::string_view::npos) continue;
        if (lines.empty() && !separator && (separator = said_separator(line))) continue;
        lines.push_back({line, text.line_number(), line[first] == '#'});
    }
    return lines;
}

// The separator that cuts the most numbers out of the first lines; of equal ones the rarest in names.
char separator_of(const std::vector<Line>& lines) {
    constexpr std::size_t most_lines = 20;
    char best = ' ';
    std::size_t most_numbers = 0, most_cells = 0;
    for (const char candidate : {'\t', ';', ',', ' '}) {
        std::size_t numbers = 0, cells = 0, seen = 0;
        for (const Line& line : lines) {
            if (line.hash) continue;
            if (++seen > most_lines) break;
            const std::vector<std::string> found = cells_of(line.text, candidate);
            cells += found.size();
            for (const std::string& cell : found)
                numbers += is_number(cell) || (candidate != ',' && has_decimal_comma(cell)) ? 1 : 0;
        }
        const bool more = numbers == most_numbers && candidate != ' ' && cells > most_cells;
        if (numbers > most_numbers || more) best = candidate, most_numbers = numbers, most_cells = cells;
    }
    return best;
}

bool is_axis(std::string_view cell) {
    return cell.size() == 1 && std::string_view("xyzXYZ").find(cell[0]) != std::string_view::npos;
}

// Words alone; cells may be empty before the first and after the last, and anywhere where the axes are named.
bool is_header(const std::vector<std::string>& cells) {
    std::size_t words = 0;
    bool holes = false, axes = false;
    for (std::size_t i = 0; i < cells.size(); ++i) {
        if (is_number(cells[i]) || has_decimal_comma(cells[i])) return false;
        if (cells[i].empty())
            holes |= i > 0 && std::any_of(cells.begin() + static_cast<std::ptrdiff_t>(i), cells.end(),
                                          [](const std::string& cell) { return !cell.empty(); });
        else if (is_missing(cells[i]))
            return false;
        else
            ++words;
        axes |= is_axis(cells[i]);
    }
    return axes ? words >= 2 : words >= 2 && !holes && words + 2 >= cells.size();
}

// 0, 1, 2 ... over the columns, as pandas numbers those that have no names.
bool counts_columns(const std::vector<std::string>& cells, bool after_empty) {
    const std::size_t first = after_empty ? 1 : 0;
    if (cells.size() < first + 3 || (after_empty && !cells[0].empty())) return false;
    for (std::size_t i = first; i < cells.size(); ++i)
        if (cells[i] != std::to_string(i - first)) return false;
    return true;
}

bool has_fractions(const std::vector<CellRow>& rows, std::size_t from) {
    for (std::size_t i = from; i < rows.size(); ++i)
        for (const std::string& cell : rows[i].cells)
            if (is_number(cell) && cell.find_first_of(".,eE") != std::string::npos) return true;
    return false;
}

void convert_decimal_commas(std::vector<CellRow>& rows) {
    const auto any = [&](const auto& holds) {
        return std::any_of(rows.begin(), rows.end(),
                           [&](const CellRow& row) { return std::any_of(row.cells.begin(), row.cells.end(), holds); });
    };
    if (any([](const std::string& cell) { return is_number(cell) && cell.find('.') != std::string::npos; })) return;
    for (CellRow& row : rows)
        for (std::string& cell : row.cells)
            if (has_decimal_comma(cell)) cell[cell.find(',')] = '.';
}

std::vector<std::string> without_hash(std::string_view text, char separator) {
    text.remove_prefix(text.find('#') + 1);
    return cells_of(text, separator);
}

std::size_t numbers_in(const std::vector<std::string>& cells) {
    return static_cast<std::size_t>(std::count_if(cells.begin(), cells.end(), [](const std::string& cell) {
        return is_number(cell) || has_decimal_comma(cell);
    }));
}

// Takes the header off the rows, or finds it in the comment before them.
void find_header(CellTable& sheet, const std::optional<std::vector<std::string>>& comment) {
    if (sheet.rows.empty()) return;
    const std::vector<std::string>& first = sheet.rows[0].cells;
    const bool counted = counts_columns(first, true);
    const bool lone = first.size() == 1 && !is_number(first[0]) && !is_missing(first[0]) && sheet.rows.size() > 1 &&
                      (is_number(sheet.rows[1].cells[0]) || is_missing(sheet.rows[1].cells[0]));
    if (is_header(first) || lone || counted || (counts_columns(first, false) && has_fractions(sheet.rows, 1))) {
        sheet.header = first;
        if (!counted && is_number(first[0]))
            sheet.notes.push_back("its first row, 0, 1, 2, counts the columns and is taken as a header");
        sheet.rows.erase(sheet.rows.begin());
    } else if (comment && comment->size() == first.size() && std::any_of(comment->begin(), comment->end(), is_axis)) {
        sheet.header = *comment;
    }
    // R leaves the cell over the rows' names out.
    if (!sheet.header.empty() && !sheet.rows.empty() && sheet.rows[0].cells.size() == sheet.header.size() + 1 &&
        !sheet.rows[0].cells.back().empty())
        sheet.header.insert(sheet.header.begin(), "");
}

} // namespace

bool is_number(std::string_view cell) {
    double ignored = 0;
    return parse(cell, ignored) && !std::isnan(ignored);
}

bool is_missing(std::string_view cell) {
    std::string lower(cell);
    std::transform(lower.begin(), lower.end(), lower.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    constexpr std::array words{"", "na", "n/a", "#n/a", "#nv", "nan", "-nan", "null", "none", "missing", "-", "?", "."};
    return std::find(words.begin(), words.end(), lower) != words.end();
}

std::vector<std::string> cells_of(std::string_view line, char separator) {
    std::vector<std::string> cells;
    std::size_t i = 0;
    const auto skip_blanks = [&] {
        while (i < line.size() && (line[i] == ' ' || line[i] == '\t' || line[i] == '\r') &&
               (line[i] != separator || separator == ' '))
            ++i;
    };
    const auto ends_cell = [&](char c) { return c == separator || (separator == ' ' && (c == '\t' || c == '\r')); };
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
        for (; i < line.size() && !ends_cell(line[i]); ++i) cell += line[i];
        cell.erase(cell.find_last_not_of(" \t\r") + 1);
        if (i >= line.size()) break;
        ++i;
        skip_blanks();
        if (i >= line.size() && separator != ' ') cells.emplace_back(); // the line ends in a separator
    }
    return cells;
}

CellTable read_cells(std::string_view bytes, const std::filesystem::path& path) {
    std::optional<char> said;
    const std::vector<Line> lines = lines_of(bytes, path, said);
    const char separator = said.value_or(separator_of(lines));
    CellTable sheet;
    std::optional<std::vector<std::string>> comment; // the last before the first row
    std::size_t width = 0;
    bool headed = false;
    std::size_t hashes = 0;
    for (const Line& line : lines) {
        std::vector<std::string> cells = cells_of(line.text, separator);
        if (cells.size() == 1 && width > 1) cells = cells_of(line.text); // cut otherwise than the rest
        if (line.hash && !headed) {
            if (sheet.rows.empty()) comment = without_hash(line.text, separator);
            continue;
        }
        if (line.hash && (cells.size() < width || numbers_in(cells) == 0 || is_axis(sheet.rows[0].cells[0]))) continue;
        if (sheet.rows.empty()) {
            width = cells.size();
            headed = is_header(cells);
        }
        hashes += line.hash ? 1 : 0;
        sheet.rows.push_back({std::move(cells), line.number});
    }
    find_header(sheet, comment);
    convert_decimal_commas(sheet.rows);
    if (hashes > 0 && hashes < sheet.rows.size())
        sheet.notes.push_back(fmt::format("{} of its rows begin with # and are taken as rows whose names do", hashes));
    return sheet;
}

} // namespace meshtween
