#include "meshtween/io/table.h"

#include "meshtween/io/cells.h"
#include "meshtween/io/output.h"
#include "meshtween/io/text.h"
#include "meshtween/io/text_out.h"

#include <algorithm>

namespace meshtween {
Table read_table(const std::filesystem::path& path) {
    const CellTable sheet = read_cells(plain_text(read_whole(path)), path);
    if (sheet.rows.empty()) bad_file(path, "holds no rows of numbers");
    Table table;
    const std::size_t columns = sheet.rows[0].cells.size();
    const std::vector<std::string>& header = sheet.header;
    // The vertices' numbers, or the rows' names that R and pandas write under an empty cell.
    const bool numbered = columns > 1 && !header.empty() && (header[0] == "vertex" || header[0] == "index"),
               labelled = columns > 1 && !header.empty() && header[0].empty();
    const std::size_t first = numbered || labelled ? 1 : 0;
    if (!header.empty()) {
        if (header.size() != columns)
            bad_file(path, fmt::format("line {}: {} cells, where the first row has {}", sheet.rows[0].line, columns,
                                       header.size()));
        table.names.assign(header.begin() + static_cast<std::ptrdiff_t>(first), header.end());
    }
    table.values.resize(std::ssize(sheet.rows), static_cast<Eigen::Index>(columns - first));
    for (Eigen::Index i = 0; i < table.values.rows(); ++i) {
        const CellRow& row = sheet.rows[static_cast<std::size_t>(i)];
        const Text text({}, path, row.line + 1); // messages name the row's line
        if (row.cells.size() != columns)
            text.fail(fmt::format("{} cells, where the first row has {}", row.cells.size(), columns));
        if (numbered && text.integer_from(row.cells[0], "the vertex") != i)
            text.fail(fmt::format("vertex {}, where {} should stand: sort the rows and leave none out",
                                  shown(row.cells[0]), i));
        for (std::size_t k = first; k < columns; ++k)
            table.values(i, static_cast<Eigen::Index>(k - first)) =
                text.finite_from(row.cells[k], fmt::format("column {}", k + 1));
    }
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
