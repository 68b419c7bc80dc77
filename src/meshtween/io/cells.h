// A text table as spreadsheets, R, pandas, 3D Slicer and people write it: one separator, maybe a header, maybe decimal
// commas, maybe comments.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace meshtween {

struct CellRow {
    std::vector<std::string> cells;
    long line = 0; // of the file
};

struct CellTable {
    std::vector<std::string> header; // as many as the rows have cells, or empty where the file has none
    std::vector<CellRow> rows;
    std::vector<std::string> notes; // what was decided, a sentence each
};

// The separator is the one of tab ; , and blanks that cuts most numbers, or what a first line "sep=;" says. Lines that
// begin with # are comments; after a header, those with as many cells as it are rows, whose names begin with #. Empty
// lines are passed over. Where decimal commas stand they become points. A header is a first row without numbers; R's,
// which lacks the cell over the rows' names or leaves it empty; pandas's 0,1,2; or a comment that names x, y and z.
// `bytes` are those that plain_text gives.
CellTable read_cells(std::string_view bytes, const std::filesystem::path& path);

// The cells of a line, cut at the separator; at ' ', blanks and tabs in any number count as one. Quotes keep a cell
// together.
std::vector<std::string> cells_of(std::string_view line, char separator);

bool is_number(std::string_view cell);
bool is_missing(std::string_view cell); // empty, NA, NaN, null, ...

} // namespace meshtween
