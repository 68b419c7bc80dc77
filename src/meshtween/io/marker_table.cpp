// Rows of cells: our own CSV and the tables and bare lists of other programs.
#include "meshtween/io/cells.h"
#include "meshtween/io/marker_columns.h"
#include "meshtween/io/marker_files.h"
#include "meshtween/io/marker_write.h"
#include "meshtween/io/output.h"
#include "meshtween/io/text.h"
#include "meshtween/io/text_out.h"

#include <fmt/format.h>

#include <algorithm>

namespace meshtween {
namespace {

MarkerColumns columns_of(const CellTable& sheet, const std::filesystem::path& path) {
    if (!sheet.header.empty())
        if (auto named = columns_by_name(sheet.header)) return *named;
    const CellRow& first = sheet.rows[0];
    const auto known = std::find_if(sheet.rows.begin(), sheet.rows.end(),
                                    [](const CellRow& row) { return !is_missing(row.cells[0]); });
    const bool named = known != sheet.rows.end() && !is_number(known->cells[0]);
    if (auto counted = columns_by_count(first.cells.size(), named)) return *counted;
    bad_file(path, fmt::format("line {}: a row of {} cells is none of name,sx,sy,sz,tx,ty,tz or name,x,y,z or x,y,z or "
                               "two vertex indices or one; a header that names the columns x, y and z would do",
                               first.line, first.cells.size()));
}

MarkerPlace place_of(const CellRow& row, const PlaceColumns& columns, const Text& text) {
    if (columns.indexed) {
        const std::string& cell = row.cells[columns.index];
        if (is_missing(cell)) return {};
        return text.integer_from(cell, "a vertex's index");
    }
    std::array<std::string_view, 3> cells;
    for (std::size_t k = 0; k < 3; ++k) cells[k] = row.cells[columns.axes[k]];
    if (std::all_of(cells.begin(), cells.end(), is_missing)) return {};
    Point point;
    for (std::size_t k = 0; k < 3; ++k)
        point[static_cast<Eigen::Index>(k)] = text.finite_from(cells[k], std::string(1, "xyz"[k]));
    return point;
}

std::string where(const CellRow& row) {
    return fmt::format("line {}", row.line);
}

// A row is a specimen, as in tables for statistics: the landmarks lie beside each other.
void add_specimen(MarkerFile& file, const CellRow& row, const MarkerColumns& columns, const Text& text) {
    Specimen specimen{columns.name ? row.cells[*columns.name] : "", {}};
    for (const PlaceColumns& place : columns.places)
        specimen.rows.push_back({place.name, where(row), {place_of(row, place, text)}});
    file.specimens.push_back(std::move(specimen));
}

void add_row(MarkerFile& file, const CellRow& row, const MarkerColumns& columns, const Text& text) {
    MarkerRow marker{columns.name ? row.cells[*columns.name] : "", where(row), {}};
    const bool undefined = columns.defined && *columns.defined < row.cells.size() && row.cells[*columns.defined] == "0";
    for (const PlaceColumns& place : columns.places)
        marker.places.push_back(undefined ? MarkerPlace() : place_of(row, place, text));
    file.rows.push_back(std::move(marker));
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
    const CellTable sheet = read_cells(bytes, path);
    MarkerFile file;
    if (sheet.rows.empty()) return file;
    const MarkerColumns columns = columns_of(sheet, path);
    const std::size_t most = sheet.header.size() > columns.width ? SIZE_MAX : columns.width;
    file.space = columns.space;
    file.notes = sheet.notes;
    file.notes.insert(file.notes.end(), columns.notes.begin(), columns.notes.end());
    for (CellRow row : sheet.rows) {
        const Text text({}, path, row.line + 1); // messages name the row's line
        while (row.cells.size() > columns.width && row.cells.back().empty()) row.cells.pop_back();
        if (row.cells.size() < columns.width || row.cells.size() > most)
            text.fail(fmt::format("this row has {} cells, those before it {}; the file is truncated or damaged",
                                  row.cells.size(), columns.width));
        if (columns.places.size() > 2)
            add_specimen(file, row, columns, text);
        else
            add_row(file, row, columns, text);
    }
    file.sides = std::min<std::size_t>(columns.places.size(), 2);
    if (columns.places.size() > 2) file.sides = 1;
    return file;
}

void write_marker_pairs(const std::vector<MarkerPair>& pairs, const std::filesystem::path& path) {
    std::vector<PartialPair> both;
    for (const MarkerPair& pair : pairs) both.push_back({pair.name, pair.source, pair.target});
    write_marker_csv(both, path);
}

Points read_points(const std::filesystem::path& path) {
    const std::string bytes = plain_text(read_whole(path));
    if (bytes.empty()) bad_file(path, "the file is empty");
    const CellTable sheet = read_cells(bytes, path);
    std::optional<MarkerColumns> columns;
    if (!sheet.header.empty()) columns = columns_by_name(sheet.header);
    if (!columns || columns->places.size() != 1) columns = columns_by_count(3, false);
    Points points(std::ssize(sheet.rows), 3);
    for (Eigen::Index i = 0; i < points.rows(); ++i) {
        const CellRow& row = sheet.rows[static_cast<std::size_t>(i)];
        const Text text({}, path, row.line + 1);
        if (row.cells.size() < columns->width || (row.cells.size() > 3 && sheet.header.empty()))
            text.fail(fmt::format("a row x,y,z has three cells, this has {}", row.cells.size()));
        for (std::size_t k = 0; k < 3; ++k)
            points(i, static_cast<Eigen::Index>(k)) =
                text.finite_from(row.cells[columns->places[0].axes[k]], std::string(1, "xyz"[k]));
    }
    return points;
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
