#include "meshtween/io/rotation_markers.h"

#include "meshtween/io/marker_files.h"
#include "meshtween/io/output.h"
#include "meshtween/io/text.h"

#include <vector>

namespace meshtween {
namespace {

Points as_rows(const std::vector<Point>& points) {
    Points rows(std::ssize(points), 3);
    for (Eigen::Index i = 0; i < rows.rows(); ++i) rows.row(i) = points[static_cast<std::size_t>(i)];
    return rows;
}

} // namespace

RotationMarkers read_rotation_markers(const std::filesystem::path& path) {
    const std::string bytes = read_whole(path);
    Text text(bytes, path);
    std::vector<Point> turn, hold;
    while (text.next_line()) {
        const std::string_view first = text.peek();
        if (first.empty() || first.front() == '#') continue;
        const std::vector<std::string> cells = cells_of(text.line());
        if (cells.size() != 5) text.fail(fmt::format("a row of {} cells; name,x,y,z,role has five", cells.size()));
        if (cells[4] == "role") continue; // the header
        Point point;
        for (int k = 0; k < 3; ++k)
            point[k] = text.finite_from(cells[static_cast<std::size_t>(k) + 1], std::string(1, "xyz"[k]));
        if (cells[4] == "turn")
            turn.push_back(point);
        else if (cells[4] == "hold")
            hold.push_back(point);
        else
            text.fail(fmt::format("the role is '{}'; it can be turn or hold", shown(cells[4])));
    }
    if (turn.empty()) bad_file(path, "no row has the role turn, so nothing would turn");
    return {as_rows(turn), as_rows(hold)};
}

} // namespace meshtween
