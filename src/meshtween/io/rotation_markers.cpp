#include "meshtween/io/rotation_markers.h"

#include "meshtween/io/cells.h"
#include "meshtween/io/marker_columns.h"
#include "meshtween/io/marker_distance.h"
#include "meshtween/io/marker_sides.h"
#include "meshtween/io/output.h"
#include "meshtween/io/text.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

namespace meshtween {
namespace {

Points as_rows(const std::vector<Point>& points) {
    Points rows(std::ssize(points), 3);
    for (Eigen::Index i = 0; i < rows.rows(); ++i) rows.row(i) = points[static_cast<std::size_t>(i)];
    return rows;
}

// Which columns hold x, y, z and the role.
struct Columns {
    std::array<std::size_t, 3> axes{1, 2, 3};
    std::size_t role = 4, width = 5;
    Space space = Space::unknown;
};

Columns columns_of(const CellTable& sheet) {
    Columns columns;
    const auto role = std::find(sheet.header.begin(), sheet.header.end(), "role");
    if (role == sheet.header.end()) return columns;
    const auto named = columns_by_name(sheet.header);
    if (!named || named->places.size() != 1) return columns;
    columns.axes = named->places[0].axes;
    columns.space = named->space;
    columns.role = static_cast<std::size_t>(role - sheet.header.begin());
    columns.width = std::max(named->width, columns.role + 1);
    return columns;
}

} // namespace

RotationMarkers read_rotation_markers(const std::filesystem::path& path, const Mesh& mesh,
                                      const MarkerReading& reading) {
    const CellTable sheet = read_cells(plain_text(read_whole(path)), path);
    const Columns columns = columns_of(sheet);
    std::array<MarkerSide, 1> sides{MarkerSide{path, {}, columns.space, &mesh}};
    std::vector<bool> turns;
    for (const CellRow& row : sheet.rows) {
        const Text text({}, path, row.line + 1); // messages name the row's line
        if (row.cells.size() < columns.width || (sheet.header.empty() && row.cells.size() != columns.width))
            text.fail(fmt::format("a row of {} cells; name,x,y,z,role has five", row.cells.size()));
        const std::string& role = row.cells[columns.role];
        if (role != "turn" && role != "hold")
            text.fail(fmt::format("the role is '{}'; it can be turn or hold", shown(role)));
        Point point;
        for (std::size_t k = 0; k < 3; ++k)
            point[static_cast<Eigen::Index>(k)] =
                text.finite_from(row.cells[columns.axes[k]], std::string(1, "xyz"[k]));
        sides[0].rows.push_back({row.cells[0], fmt::format("line {}", row.line), {point}});
        turns.push_back(role == "turn");
    }
    RotationMarkers markers;
    settle_systems(sides, reading, markers.notes);
    std::vector<Point> turn, hold, all;
    std::vector<std::string> names;
    for (std::size_t i = 0; i < turns.size(); ++i) {
        all.push_back(std::get<Point>(sides[0].rows[i].places[0]));
        (turns[i] ? turn : hold).push_back(all.back());
        names.push_back(sides[0].rows[i].name);
    }
    if (turn.empty()) bad_file(path, "no row has the role turn, so nothing would turn");
    const MarkerDistances far = marker_distances(as_rows(all), names, {&mesh, "mesh"}, {}, systems_to_say(sides));
    if (!far.note.empty()) markers.notes.push_back(fmt::format("{}: {}", path.string(), far.note));
    markers.turn = as_rows(turn);
    markers.hold = as_rows(hold);
    return markers;
}

} // namespace meshtween
