// Simple Legacy Formats, in "VTK File Formats", The VTK User's Guide, Kitware 2010; OFFSETS and CONNECTIVITY of 5.1,
// METADATA and lengths of strings after vtkDataReader.cxx. Numbers of binary files are big-endian.
#include "meshtween/io/formats.h"
#include "meshtween/io/text.h"
#include "meshtween/io/vtk_legacy.h"
#include "meshtween/io/vtk_words.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstring>
#include <optional>

namespace meshtween {
namespace {

enum class Owner { points, cells, file };

class VtkScanner : VtkWords {
public:
    VtkScanner(std::string_view bytes, const std::filesystem::path& path) : VtkWords(bytes) { surface_.path = path; }

    VtkLegacyFile scan() {
        try {
            header();
            std::string word;
            while (!(word = upper_case(next_word())).empty() && word != "POINT_DATA" && word != "CELL_DATA")
                section(word);
            finish_cells();
            if (!word.empty()) attributes(word);
        } catch (const VtkDamage& damage) {
            bad_file(surface_.path, fmt::format("{}: {}", place(), damage.what));
        }
        take_point_arrays(surface_, std::move(arrays_));
        surface_.tell();
        result_.mesh = std::move(surface_.mesh);
        return std::move(result_);
    }

private:
    void header();
    void section(const std::string& keyword);
    void points();
    std::vector<double> connectivity(std::string_view what, std::vector<std::uint64_t>& ends);
    void surface_cells(const std::string& keyword);
    void finish_cells();
    void attributes(std::string keyword);
    bool attribute(const std::string& keyword, Owner owner, std::uint64_t tuples);
    void array(std::string_view name, std::string_view attribute, std::string_view type, std::uint64_t components,
               std::uint64_t tuples, Owner owner, bool next_line = true);
    void field(Owner owner);
    void skip_metadata();

    VtkLegacyFile result_;
    VtkSurface surface_;
    std::vector<VtkArray> arrays_; // of points
    std::vector<double> grid_corners_, grid_types_;
    std::vector<std::uint64_t> grid_ends_;
    bool has_types_ = false;
};

void VtkScanner::header() {
    if (upper_case(rest_of_line().substr(0, 14)) != "# VTK DATAFILE")
        throw VtkDamage{"a VTK file begins with '# vtk DataFile Version'; this is damaged or of another format"};
    rest_of_line(); // the title
    const std::string encoding = upper_case(next_word());
    if (encoding != "ASCII" && encoding != "BINARY")
        throw VtkDamage{fmt::format("'{}' should be ASCII or BINARY", shown(encoding))};
    result_.ascii = ascii = encoding == "ASCII";
}

void VtkScanner::section(const std::string& keyword) {
    if (keyword == "DATASET") {
        const std::string kind = upper_case(next_word());
        if (kind != "POLYDATA" && kind != "UNSTRUCTURED_GRID")
            throw VtkDamage{
                fmt::format("holds a data set of the kind {}, which is not a surface; extract its surface (in "
                            "ParaView: Extract Surface) and save it as PolyData",
                            shown(kind))};
    } else if (keyword == "POINTS") {
        points();
    } else if (keyword == "POLYGONS" || keyword == "TRIANGLE_STRIPS" || keyword == "VERTICES" || keyword == "LINES") {
        surface_cells(keyword);
    } else if (keyword == "CELLS") {
        grid_corners_ = connectivity("CELLS", grid_ends_);
    } else if (keyword == "CELL_TYPES") {
        const std::uint64_t cells = count("the number of cell types");
        rest_of_line();
        grid_types_.clear();
        numbers("int", cells, "the cell types", &grid_types_);
        has_types_ = true;
    } else if (keyword == "FIELD") {
        field(Owner::file);
    } else if (keyword == "METADATA") {
        skip_metadata();
    } else {
        go_back();
        throw VtkDamage{fmt::format("'{}' is no section of a surface; the file is damaged", shown(keyword))};
    }
}

void VtkScanner::points() {
    if (result_.points.begin != 0) throw VtkDamage{"a second section POINTS; the file is damaged"};
    const std::uint64_t total = count("the number of points");
    const std::string_view type = next_word();
    rest_of_line();
    std::vector<double>& coordinates = surface_.mesh.coordinates;
    result_.points = numbers(type, product(3, total, "the points"), "the points", &coordinates);
    if (!is_float(result_.points.type) && size_of(result_.points.type) == 0)
        throw VtkDamage{fmt::format("points cannot be of the type '{}'", shown(type))};
    const auto bad = std::find_if(coordinates.begin(), coordinates.end(), [](double x) { return !std::isfinite(x); });
    if (bad != coordinates.end()) {
        const auto i = static_cast<std::size_t>(bad - coordinates.begin());
        throw VtkDamage{
            fmt::format("point {} (counted from 0): {} is no finite number; mend the coordinates or export the "
                        "model again",
                        i / 3, "xyz"[i % 3])};
    }
}

// Either each cell's count before its corners, or since version 5.1 two arrays.
std::vector<double> VtkScanner::connectivity(std::string_view what, std::vector<std::uint64_t>& ends) {
    const std::uint64_t cells = count("the number of cells"), total = count("the number of corners");
    rest_of_line();
    ends.clear();
    std::vector<double> list;
    const std::size_t here = at();
    const bool two_arrays = follows("OFFSETS ");
    if (two_arrays) {
        std::vector<double> offsets;
        next_word();
        const std::string_view offsets_type = next_word();
        rest_of_line();
        numbers(offsets_type, cells, fmt::format("the offsets of {}", what), &offsets);
        if (offsets.size() != cells)
            throw VtkDamage{fmt::format("the offsets of {} are no numbers; the file is damaged", what)};
        if (upper_case(next_word()) != "CONNECTIVITY") throw VtkDamage{"CONNECTIVITY is missing; the file is damaged"};
        const std::string_view type = next_word();
        rest_of_line();
        numbers(type, total, fmt::format("the corners of {}", what), &list);
        if (list.size() != total)
            throw VtkDamage{fmt::format("the corners of {} are no numbers; the file is damaged", what)};
        for (std::size_t i = 1; i < offsets.size(); ++i) {
            if (!(offsets[i] >= offsets[i - 1]) || offsets[0] != 0 || offsets[i] > static_cast<double>(total))
                throw VtkDamage{
                    fmt::format("the offsets of {} do not rise from 0 to {}; the file is damaged", what, total)};
            ends.push_back(static_cast<std::uint64_t>(offsets[i]));
        }
        if (!offsets.empty() && offsets.back() != static_cast<double>(total))
            throw VtkDamage{fmt::format("the offsets of {} end at {}, but there are {} corners; the file is damaged",
                                        what, offsets.back(), total)};
        return list;
    }
    std::vector<double> counted;
    numbers("int", total, fmt::format("the cells of {}", what), &counted);
    list.reserve(counted.size());
    std::size_t next = 0;
    for (std::uint64_t cell = 0; cell < cells; ++cell) {
        const double left = static_cast<double>(counted.size() - next) - 1;
        if (!(left >= 0 && counted[next] >= 0 && counted[next] <= left)) {
            go(here);
            throw VtkDamage{
                fmt::format("{} promises {} cells in {} numbers, but cell {} (counted from 0) does not fit; the "
                            "file is damaged",
                            what, cells, total, cell)};
        }
        const auto corners = static_cast<std::size_t>(counted[next++]);
        for (std::size_t k = 0; k < corners; ++k) list.push_back(counted[next++]);
        ends.push_back(list.size());
    }
    if (next != counted.size()) {
        go(here);
        throw VtkDamage{fmt::format("{} promises {} cells in {} numbers, but they take {}; the file is damaged", what,
                                    cells, total, next)};
    }
    return list;
}

std::vector<std::int64_t> cell_of(const std::vector<double>& corners, std::uint64_t begin, std::uint64_t end) {
    std::vector<std::int64_t> cell;
    for (std::uint64_t i = begin; i < end; ++i)
        cell.push_back(std::abs(corners[i]) < 1e15 ? static_cast<std::int64_t>(corners[i]) : -1);
    return cell;
}

void VtkScanner::surface_cells(const std::string& keyword) {
    std::vector<std::uint64_t> ends;
    const std::vector<double> corners = connectivity(keyword, ends);
    const int type = keyword == "POLYGONS" ? vtk_polygon : keyword == "TRIANGLE_STRIPS" ? vtk_strip : 0;
    std::uint64_t begin = 0;
    for (const std::uint64_t end : ends) {
        surface_.add(type, cell_of(corners, begin, end));
        begin = end;
    }
}

void VtkScanner::finish_cells() {
    if (grid_ends_.empty()) return;
    if (!has_types_ || grid_types_.size() != grid_ends_.size())
        throw VtkDamage{fmt::format("there are {} cells, but {} cell types; the file is truncated or damaged",
                                    grid_ends_.size(), grid_types_.size())};
    std::uint64_t begin = 0;
    for (std::size_t i = 0; i < grid_ends_.size(); ++i) {
        if (!(grid_types_[i] >= 0 && grid_types_[i] <= 255))
            throw VtkDamage{
                fmt::format("cell {} is of type {}, which does not exist; the file is damaged", i, grid_types_[i])};
        surface_.add(static_cast<int>(grid_types_[i]), cell_of(grid_corners_, begin, grid_ends_[i]));
        begin = grid_ends_[i];
    }
}

// Data of points and cells. Nothing here changes the shape, so nothing here refuses the file.
void VtkScanner::attributes(std::string keyword) {
    Owner owner = Owner::points;
    std::uint64_t tuples = 0;
    try {
        for (; !keyword.empty(); keyword = upper_case(next_word())) {
            if (keyword == "POINT_DATA" || keyword == "CELL_DATA") {
                owner = keyword == "POINT_DATA" ? Owner::points : Owner::cells;
                tuples = count("the number of values");
                const std::uint64_t points = surface_.mesh.coordinates.size() / 3;
                if (owner == Owner::points && tuples != points)
                    surface_.mesh.file.notes.push_back(
                        fmt::format("data of {} points are passed over, because there are {} points", tuples, points));
            } else if (!attribute(keyword, owner, tuples)) {
                go_back();
                throw VtkDamage{fmt::format("'{}' is not known here", shown(keyword))};
            }
        }
    } catch (const VtkDamage& damage) {
        surface_.mesh.file.notes.push_back(
            fmt::format("what comes after the faces was passed over from {} on: {}", place(), damage.what));
    }
}

bool VtkScanner::attribute(const std::string& keyword, Owner owner, std::uint64_t tuples) {
    if (keyword == "METADATA") {
        skip_metadata();
        return true;
    }
    if (keyword == "FIELD") {
        field(owner);
        return true;
    }
    const std::string_view name = next_word();
    if (keyword == "SCALARS") {
        const std::string_view type = next_word(), more = rest_of_line();
        std::uint64_t components = 1;
        double value = 1;
        if (parse(more.substr(std::min(more.find_first_not_of(' '), more.size()),
                              std::min(more.find_last_not_of(" \r"), more.size()) -
                                  std::min(more.find_first_not_of(' '), more.size()) + 1),
                  value) &&
            value >= 1 && value <= 1e6)
            components = static_cast<std::uint64_t>(value);
        const std::size_t here = at();
        if (upper_case(next_word()) == "LOOKUP_TABLE")
            rest_of_line();
        else
            go(here);
        array(name, keyword, type, components, tuples, owner, false);
    } else if (keyword == "COLOR_SCALARS") {
        const std::uint64_t components = count("the number of values a point");
        array(name, keyword, ascii ? "float" : "unsigned_char", components, tuples, owner);
    } else if (keyword == "LOOKUP_TABLE") {
        const std::uint64_t rows = count("the number of colours");
        array(name, keyword, ascii ? "float" : "unsigned_char", 4, rows, Owner::file);
    } else if (keyword == "TEXTURE_COORDINATES") {
        const std::uint64_t components = count("the number of texture coordinates a point");
        array(name, "TCOORDS", next_word(), components, tuples, owner);
    } else if (keyword == "NORMALS" || keyword == "VECTORS" || keyword == "TENSORS" || keyword == "TENSORS6") {
        const std::uint64_t components = keyword == "TENSORS" ? 9 : keyword == "TENSORS6" ? 6 : 3;
        array(name, keyword, next_word(), components, tuples, owner);
    } else if (keyword == "GLOBAL_IDS" || keyword == "PEDIGREE_IDS" || keyword == "EDGE_FLAGS") {
        array(name, keyword, next_word(), 1, tuples, owner);
    } else {
        return false;
    }
    return true;
}

void VtkScanner::array(std::string_view name, std::string_view attribute, std::string_view type,
                       std::uint64_t components, std::uint64_t tuples, Owner owner, bool next_line) {
    if (next_line) rest_of_line();
    VtkArray read{decoded_vtk_name(name), std::string(attribute), vtk_type_named(type), 1, {}};
    read.components = static_cast<int>(std::min<std::uint64_t>(components, 1 << 20));
    const std::string what = fmt::format("'{}'", shown(read.name));
    const bool here = owner == Owner::points && tuples == surface_.mesh.coordinates.size() / 3;
    const VtkRole role = here ? vtk_role(read.name, attribute, read.type, read.components) : VtkRole::none;
    const std::uint64_t total = product(components, tuples, what);
    const VtkBlock block = numbers(type, total, what, role != VtkRole::none ? &read.values : nullptr);
    if (role == VtkRole::normals && result_.normals.begin == 0) result_.normals = block;
    if (role != VtkRole::none)
        arrays_.push_back(std::move(read));
    else if (owner != Owner::file)
        surface_.mesh.file.only_here.push_back(
            fmt::format("the {} '{}'", owner == Owner::points ? "point data" : "cell data", shown(read.name)));
}

void VtkScanner::field(Owner owner) {
    next_word(); // the field's name
    const std::uint64_t arrays = count("the number of arrays");
    rest_of_line();
    for (std::uint64_t i = 0; i < arrays;) {
        const std::string_view name = next_word();
        if (name.empty()) throw VtkDamage{fmt::format("array {} of {} is missing; the file is truncated", i, arrays)};
        if (name == "METADATA") {
            skip_metadata();
            continue;
        }
        ++i;
        if (name == "NULL_ARRAY") continue;
        const std::uint64_t components = count("the number of values"), tuples = count("the number of rows");
        array(name, "", next_word(), components, tuples, owner);
    }
}

// Lines up to an empty one.
void VtkScanner::skip_metadata() {
    rest_of_line();
    while (!at_end()) {
        const std::string_view line = rest_of_line();
        if (line.find_first_not_of(" \t\r") == std::string_view::npos) return;
    }
}

} // namespace

VtkLegacyFile scan_vtk(std::string_view bytes, const std::filesystem::path& path) {
    return VtkScanner(bytes, path).scan();
}

PolygonMesh read_vtk(std::string_view bytes, const std::filesystem::path& path) {
    return scan_vtk(bytes, path).mesh;
}

} // namespace meshtween
