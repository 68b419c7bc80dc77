#include "meshtween/io/table.h"

#include "meshtween/io/marker_files.h"
#include "meshtween/io/output.h"
#include "meshtween/io/text.h"
#include "meshtween/io/text_out.h"

#include <algorithm>

namespace meshtween {
namespace {

bool is_header(const std::vector<std::string>& cells) {
    return std::any_of(cells.begin(), cells.end(), [](const std::string& cell) {
        double ignored = 0;
        return !parse(cell, ignored);
    });
}

} // namespace

Table read_table(const std::filesystem::path& path) {
    const std::string bytes = read_whole(path);
    Table table;
    std::vector<double> values;
    std::size_t columns = 0;
    long rows = 0;
    bool numbered = false, first = true;
    Text text(bytes, path);
    while (text.next_line()) {
        if (text.peek().empty() || text.peek().front() == '#') continue;
        const std::vector<std::string> cells = cells_of(text.line());
        const bool header = std::exchange(first, false) && is_header(cells);
        if (columns == 0) columns = cells.size();
        if (cells.size() != columns)
            text.fail(fmt::format("{} cells, where the first row has {}", cells.size(), columns));
        if (header) {
            numbered = columns > 1 && (cells[0] == "vertex" || cells[0] == "index");
            table.names.assign(cells.begin() + (numbered ? 1 : 0), cells.end());
            continue;
        }
        if (numbered && text.integer_from(cells[0], "the vertex") != rows)
            text.fail(fmt::format("vertex {}, where {} should stand: sort the rows and leave none out", shown(cells[0]),
                                  rows));
        for (std::size_t k = numbered ? 1 : 0; k < columns; ++k)
            values.push_back(text.finite_from(cells[k], fmt::format("column {}", k + 1)));
        ++rows;
    }
    if (rows == 0) bad_file(path, "holds no rows of numbers");
    table.values = Eigen::Map<const Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>>(
        values.data(), rows, static_cast<Eigen::Index>(columns) - (numbered ? 1 : 0));
    return table;
}

void write_table(const Table& table, const std::filesystem::path& path) {
    write_whole(path, [&](std::ostream& stream) {
        TextOut out(stream);
        const bool named = !table.names.empty();
        if (named) out.put("vertex,{}\n", fmt::join(table.names, ","));
        for (Eigen::Index i = 0; i < table.values.rows(); ++i) {
            if (named) out.put("{},", i);
            for (Eigen::Index k = 0; k < table.values.cols(); ++k)
                out.put("{}{}", k == 0 ? "" : ",", table.values(i, k));
            out.put("\n");
        }
    });
}

} // namespace meshtween
