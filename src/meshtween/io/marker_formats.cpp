// The marker files of other programs: MeshLab's picked points, 3D Slicer's markups (fcsv, mrk.json), Wrap's points on
// triangles, IDAV Landmark's pts, meshes of vertices alone.
#include "meshtween/io/cells.h"
#include "meshtween/io/formats.h"
#include "meshtween/io/json_limits.h"
#include "meshtween/io/marker_files.h"
#include "meshtween/io/mesh_file.h"
#include "meshtween/io/output.h"
#include "meshtween/io/text.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <pugixml.hpp>

#include <algorithm>
#include <array>

namespace meshtween {
namespace {

using nlohmann::ordered_json; // keeps the file's order

std::string lower_extension(const std::filesystem::path& path) {
    std::string extension = path.extension().string();
    std::transform(extension.begin(), extension.end(), extension.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return extension;
}

[[noreturn]] void bad_entry(const std::filesystem::path& path, const std::string& where, std::string_view what) {
    bad_file(path, fmt::format("{}: {}", where, what));
}

// [triangle, u, v]: the place A u + B v + C (1 - u - v).
MarkerPlace wrap_place(const ordered_json& entry, const std::filesystem::path& path, const std::string& where) {
    if (!entry.is_array() || entry.size() != 3 || !entry[0].is_number_integer() || !entry[1].is_number() ||
        !entry[2].is_number())
        bad_entry(path, where, "should be [triangle, u, v]");
    const double u = entry[1].get<double>(), v = entry[2].get<double>();
    if (!(u >= -1e-6 && v >= -1e-6 && u + v <= 1 + 1e-6))
        bad_entry(path, where, fmt::format("u = {} and v = {} lie outside the triangle", u, v));
    const auto triangle = entry[0].get<long long>();
    if (triangle < 0 || triangle > std::numeric_limits<int>::max())
        bad_entry(path, where, fmt::format("{} is no triangle's number", triangle));
    return SurfacePoint{static_cast<int>(triangle), {u, v, 1 - u - v}};
}

MarkerFile wrap_points(const ordered_json& root, const std::filesystem::path& path) {
    MarkerFile file;
    file.sides = 1;
    std::size_t number = 0;
    for (const auto& [key, entry] : root.items()) {
        const std::string where = root.is_object() ? fmt::format("'{}'", shown(key)) : fmt::format("entry {}", number);
        ++number;
        const MarkerPlace place = entry.is_null() ? MarkerPlace() : wrap_place(entry, path, where);
        file.rows.push_back({root.is_object() ? key : std::string(), where, {place}});
    }
    return file;
}

MarkerPlace slicer_place(const ordered_json& point, const std::filesystem::path& path, const std::string& where) {
    const auto status = point.find("positionStatus");
    if (status != point.end() && *status != "defined" && *status != "preview") return {};
    const auto position = point.find("position");
    if (position == point.end() || position->is_null()) return {};
    Point result;
    if (!position->is_array() || position->size() != 3) bad_entry(path, where, "its position is not [x, y, z]");
    if (std::all_of(position->begin(), position->end(), [](const ordered_json& c) { return c.is_null(); })) return {};
    for (std::size_t k = 0; k < 3; ++k) {
        if (!(*position)[k].is_number()) bad_entry(path, where, "its position is not [x, y, z]");
        result[static_cast<Eigen::Index>(k)] = (*position)[k].get<double>();
    }
    return result;
}

// Slicer's default is LPS.
Space slicer_space(const ordered_json& markup, MarkerFile& file) {
    const auto entry = markup.find("coordinateSystem");
    if (entry == markup.end()) return Space::lps;
    const std::string word = entry->is_string() ? entry->get<std::string>() : entry->dump();
    const Space space = space_named(word);
    if (space == Space::unknown)
        file.notes.push_back(
            fmt::format("its system of coordinates, '{}', is neither RAS nor LPS and is not obeyed", shown(word)));
    return space;
}

void turn(MarkerPlace& place) {
    if (auto* point = std::get_if<Point>(&place)) *point = Point(-(*point)[0], -(*point)[1], (*point)[2]);
}

MarkerFile slicer_markups(const ordered_json& root, const std::filesystem::path& path) {
    MarkerFile file;
    file.sides = 1;
    for (const ordered_json& markup : root["markups"]) {
        if (!markup.is_object()) bad_file(path, "an entry of its markups is no object");
        const auto points = markup.find("controlPoints");
        if (points == markup.end()) continue;
        if (!points->is_array()) bad_file(path, "its controlPoints are no list");
        const Space space = slicer_space(markup, file);
        if (file.rows.empty()) file.space = space;
        for (const ordered_json& point : *points) {
            const std::string where = fmt::format("control point {}", file.rows.size());
            if (!point.is_object()) bad_entry(path, where, "is no object");
            const auto label = point.find("label");
            MarkerPlace place = slicer_place(point, path, where);
            if (space != Space::unknown && file.space != Space::unknown && space != file.space) turn(place);
            file.rows.push_back({label != point.end() && label->is_string() ? label->get<std::string>() : std::string(),
                                 where,
                                 {place}});
        }
    }
    return file;
}

double coordinate(const pugi::xml_node& node, const char* name, const std::filesystem::path& path,
                  const std::string& where) {
    double value = 0;
    if (!parse(node.attribute(name).value(), value) || !std::isfinite(value))
        bad_entry(path, where,
                  fmt::format("{} should be a number, not '{}'", name, shown(node.attribute(name).value())));
    return value;
}

} // namespace

MarkerFile read_picked_points(std::string_view bytes, const std::filesystem::path& path) {
    pugi::xml_document document;
    const pugi::xml_parse_result result = document.load_buffer(bytes.data(), bytes.size());
    const pugi::xml_node list = document.child("PickedPoints");
    if (!result || !list)
        bad_file(path,
                 fmt::format("is no whole list of picked points ({} at byte {}); it is truncated or of another format",
                             result ? "no PickedPoints" : result.description(), result.offset));
    MarkerFile file;
    file.sides = 1;
    for (const pugi::xml_node& node : list.children("point")) {
        const std::string where = fmt::format("point {}", file.rows.size());
        MarkerRow row{node.attribute("name").value(), where, {MarkerPlace()}};
        if (std::string_view(node.attribute("active").value()) != "0") // only this says that it was not picked
            row.places[0] = Point(coordinate(node, "x", path, where), coordinate(node, "y", path, where),
                                  coordinate(node, "z", path, where));
        file.rows.push_back(std::move(row));
    }
    return file;
}

namespace {

// What a line "# CoordinateSystem = LPS" says after its sign of equality.
std::string value_of(std::string_view line) {
    const std::size_t equals = line.find('=');
    const std::size_t first = line.find_first_not_of(" \t", equals + 1);
    return first == std::string_view::npos
               ? ""
               : std::string(line.substr(first, line.find_last_not_of(" \t\r") + 1 - first));
}

// The columns that Slicer 5 writes after those that its header names: the position's status, and one more.
std::size_t status_column(const std::vector<std::string>& columns) {
    const auto named = std::find(columns.begin(), columns.end(), "positionStatus");
    return static_cast<std::size_t>(named - columns.begin()); // the first after the named ones where it is none of them
}

} // namespace

MarkerFile read_slicer_fcsv(std::string_view bytes, const std::filesystem::path& path) {
    std::vector<std::string> columns{"id", "x",   "y",   "z",    "ow",    "ox",   "oy",
                                     "oz", "vis", "sel", "lock", "label", "desc", "associatedNodeID"};
    const auto column = [&](std::string_view name) {
        return static_cast<std::size_t>(std::find(columns.begin(), columns.end(), name) - columns.begin());
    };
    MarkerFile file;
    file.sides = 1;
    Text text(bytes, path);
    while (text.next_line()) {
        const std::string_view line = text.line();
        constexpr std::string_view heading = "# columns =", system = "# CoordinateSystem =";
        if (line.substr(0, heading.size()) == heading) columns = cells_of(line.substr(heading.size()), ',');
        if (line.substr(0, system.size()) == system) {
            file.space = space_named(value_of(line));
            if (file.space == Space::unknown)
                file.notes.push_back(fmt::format("its system of coordinates, '{}', is neither RAS nor LPS and is not "
                                                 "obeyed",
                                                 shown(value_of(line))));
        }
        if (line.find_first_not_of(" \t\r") == std::string_view::npos) continue;
        const std::vector<std::string> cells = cells_of(line, ',');
        const auto cell = [&](std::size_t k) { return k < cells.size() ? cells[k] : std::string(); };
        if (line[0] == '#' &&
            !(is_number(cell(column("x"))) && is_number(cell(column("y"))) && is_number(cell(column("z")))))
            continue; // a comment; else a point whose name begins so
        const std::string label = cell(column("label")), status = cell(status_column(columns));
        // vtkMRMLMarkupsNode: 0 undefined, 1 preview, 2 defined, 3 missing
        MarkerPlace place;
        const std::array<std::string, 3> numbers{cell(column("x")), cell(column("y")), cell(column("z"))};
        const bool unset = status == "0" || status == "3" ||
                           (cells.size() > 3 && std::all_of(numbers.begin(), numbers.end(), is_missing));
        if (!unset) {
            Point point;
            for (std::size_t k = 0; k < 3; ++k)
                point[static_cast<Eigen::Index>(k)] = text.finite_from(numbers[k], std::string(1, "xyz"[k]));
            place = point;
        }
        file.rows.push_back(
            {label.empty() ? cell(column("id")) : label, fmt::format("line {}", text.line_number()), {place}});
    }
    return file;
}

MarkerFile read_marker_json(std::string_view bytes, const std::filesystem::path& path) {
    if (const std::string_view trouble = json_trouble(bytes, true); !trouble.empty()) bad_file(path, trouble);
    ordered_json root;
    try {
        root = ordered_json::parse(bytes.begin(), bytes.end());
    } catch (const ordered_json::parse_error& error) {
        bad_file(path, fmt::format("its JSON cannot be read beyond byte {}; it is truncated or of another format",
                                   error.byte));
    } catch (const ordered_json::exception&) {
        bad_file(path, "its JSON holds a number that is too large; it is damaged or of another format");
    }
    if (!root.is_array() && !root.is_object())
        bad_file(path, "holds neither Slicer's markups nor Wrap's points on triangles");
    const bool slicer = root.is_object() && root.contains("markups") && root["markups"].is_array();
    return slicer ? slicer_markups(root, path) : wrap_points(root, path);
}

// "Version 1.0", a count, and a row "S000 x y z" a point; 9999 three times is a missing one.
MarkerFile read_landmark_pts(std::string_view bytes, const std::filesystem::path& path) {
    Text text(bytes, path);
    text.next_line();
    text.next_line();
    const long long count = text.integer("the number of landmarks");
    MarkerFile file;
    file.sides = 1;
    while (text.next_line()) {
        const std::string name(text.word());
        if (name.empty()) continue;
        const double x = text.finite("x"), y = text.finite("y"), z = text.finite("z");
        const bool missing = x == 9999 && y == 9999 && z == 9999;
        file.rows.push_back({name,
                             fmt::format("line {}", text.line_number()),
                             {missing ? MarkerPlace() : MarkerPlace(Point(x, y, z))}});
    }
    if (count != static_cast<long long>(file.rows.size()))
        bad_file(path, fmt::format("promises {} landmarks but holds {}; it is truncated or damaged", count,
                                   file.rows.size()));
    return file;
}

MarkerFile read_point_cloud(std::string_view bytes, const std::filesystem::path& path) {
    const PolygonMesh mesh = lower_extension(path) == ".ply" ? read_ply(bytes, path) : read_obj(bytes, path);
    if (!mesh.ends.empty())
        bad_file(path, fmt::format("is a mesh of {} faces, not a list of points; landmarks are its vertices where it "
                                   "has no faces",
                                   mesh.ends.size()));
    MarkerFile file;
    file.sides = 1;
    for (std::size_t i = 0; i + 2 < mesh.coordinates.size(); i += 3) {
        const Point point(mesh.coordinates[i], mesh.coordinates[i + 1], mesh.coordinates[i + 2]);
        const std::string where = fmt::format("vertex {}", i / 3);
        const bool missing = point.array().isNaN().all();
        if (!missing && !point.allFinite()) bad_entry(path, where, "is not finite");
        file.rows.push_back({"", where, {missing ? MarkerPlace() : MarkerPlace(point)}});
    }
    file.space = space_in_header(bytes, lower_extension(path));
    return file;
}

namespace {

bool begins_with_any(std::string_view bytes, std::initializer_list<std::string_view> starts) {
    return std::any_of(starts.begin(), starts.end(), [&](std::string_view start) { return bytes.starts_with(start); });
}

// Formats that share an extension, or have none of their own, by what they hold.
MarkerFile read_by_contents(std::string_view bytes, const std::filesystem::path& path) {
    std::string start(bytes.substr(
        bytes.find_first_not_of(" \t\r\n") == std::string_view::npos ? 0 : bytes.find_first_not_of(" \t\r\n"), 4096));
    if (begins_with_any(start, {"Version "})) return read_landmark_pts(bytes, path);
    if (begins_with_any(start, {"# AmiraMesh", "# Amira", "# Avizo", "# HyperMesh"})) return read_amira(bytes, path);
    std::transform(start.begin(), start.end(), start.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    if (begins_with_any(start, {"lm=", "lm3="})) return read_tps(bytes, path);
    if (start.find("[individuals]") != std::string::npos || start.find("[rawpoints]") != std::string::npos)
        return read_morphologika(bytes, path);
    if (start.find(" dim=") != std::string::npos) return read_nts(bytes, path);
    return read_marker_table(bytes, path);
}

} // namespace

MarkerFile read_marker_file(const std::filesystem::path& path) {
    std::string bytes = read_whole(path);
    const std::string extension = lower_extension(path);
    if (bytes.empty()) bad_file(path, "the file is empty; it should hold markers");
    if (extension == ".ply" || extension == ".obj") return read_point_cloud(bytes, path);
    if (extension != ".pp") bytes = plain_text(std::move(bytes)); // XML says its own encoding
    if (bytes.empty()) bad_file(path, "the file is empty; it should hold markers");
    if (bytes.find('\0') != std::string::npos) bad_file(path, "is no text; it is damaged or of another format");
    if (extension == ".pp") return read_picked_points(bytes, path);
    if (extension == ".json") return read_marker_json(bytes, path);
    if (extension == ".fcsv") return read_slicer_fcsv(bytes, path);
    if (extension == ".tps") return read_tps(bytes, path);
    if (extension == ".dta" || extension == ".nts") return read_nts(bytes, path);
    if (extension == ".landmarkascii" || extension == ".am") return read_amira(bytes, path);
    return read_by_contents(bytes, path);
}

} // namespace meshtween
