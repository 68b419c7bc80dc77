// XML File Formats, in "VTK File Formats", The VTK User's Guide, Kitware 2010: PolyData, in one piece or several.
#include "meshtween/io/formats.h"
#include "meshtween/io/text.h"
#include "meshtween/io/vtp.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

namespace meshtween {
namespace {

constexpr std::string_view close_tag = "</AppendedData>";

long line_of(std::string_view bytes, std::ptrdiff_t offset) {
    const std::ptrdiff_t at = std::clamp<std::ptrdiff_t>(offset, 0, static_cast<std::ptrdiff_t>(bytes.size()));
    return 1 + std::count(bytes.begin(), bytes.begin() + at, '\n');
}

// Takes what comes behind the underscore of AppendedData out of the XML, where raw bytes cannot stand.
std::string without_appended(VtpFile& file, std::string_view bytes) {
    const std::size_t tag = bytes.find("<AppendedData");
    if (tag == std::string_view::npos) return std::string(bytes);
    const std::size_t begin = bytes.find('_', std::min(bytes.find('>', tag), bytes.size()));
    if (begin == std::string_view::npos) bad_file(file.path, "the appended data are missing; the file is truncated");
    const std::size_t end = bytes.rfind(close_tag);
    const bool closed = end != std::string_view::npos && end > begin;
    file.appended = bytes.substr(begin + 1, closed ? end - begin - 1 : std::string_view::npos);
    std::string xml(bytes.substr(0, begin + 1));
    return closed ? xml.append(bytes.substr(end)) : xml.append(close_tag).append("</VTKFile>");
}

void read_encoding(VtpFile& file, pugi::xml_node root) {
    file.encoding.big_endian = std::string_view(root.attribute("byte_order").value()) == "BigEndian";
    file.encoding.header_size = std::string_view(root.attribute("header_type").value()) == "UInt64" ? 8 : 4;
    const std::string_view compressor = root.attribute("compressor").value();
    file.encoding.compressed = !compressor.empty();
    if (!compressor.empty() && compressor != "vtkZLibDataCompressor")
        bad_file(file.path, fmt::format("it is compressed with {}, which is not read; save it with zlib or without "
                                        "compression",
                                        shown(compressor)));
    file.appended_base64 = std::string_view(root.child("AppendedData").attribute("encoding").value()) == "base64";
}

std::size_t promised(pugi::xml_node piece, const char* name) {
    return static_cast<std::size_t>(piece.attribute(name).as_ullong());
}

class VtpReader {
public:
    explicit VtpReader(const VtpFile& file) : file_(file) { surface_.path = file.path; }

    PolygonMesh read() {
        for (const pugi::xml_node piece : file_.pieces) read_piece(piece);
        std::vector<VtkArray> arrays;
        for (auto& [name, array] : arrays_) arrays.push_back(std::move(array));
        take_point_arrays(surface_, std::move(arrays));
        surface_.tell();
        return std::move(surface_.mesh);
    }

private:
    void read_piece(pugi::xml_node piece) {
        const std::size_t points = promised(piece, "NumberOfPoints");
        const auto base = static_cast<std::int64_t>(surface_.mesh.coordinates.size() / 3);
        const pugi::xml_node array = piece.child("Points").child("DataArray");
        if (!array && points > 0) bad_file(file_.path, "the points are missing; the file is truncated or damaged");
        if (points > any_count / 3) bad_file(file_.path, fmt::format("{} points are promised, too many", points));
        if (points > 0) {
            const std::vector<double> numbers = vtp_numbers(file_, array, "the points", 3 * points);
            surface_.mesh.coordinates.insert(surface_.mesh.coordinates.end(), numbers.begin(), numbers.end());
        }
        surface_.loose += promised(piece, "NumberOfVerts") + promised(piece, "NumberOfLines");
        read_cells(piece.child("Polys"), promised(piece, "NumberOfPolys"), "the polygons", vtk_polygon, base);
        read_cells(piece.child("Strips"), promised(piece, "NumberOfStrips"), "the strips", vtk_strip, base);
        for (const pugi::xml_node data : piece.child("PointData").children("DataArray"))
            read_point_array(piece.child("PointData"), data, points);
        for (const pugi::xml_node data : piece.child("CellData").children())
            if (data.attribute("Name")) only_here("cell data", data);
    }

    void read_cells(pugi::xml_node cells, std::size_t count, std::string_view what, int type, std::int64_t base) {
        if (count == 0) return;
        const pugi::xml_node corners_array = vtp_array(cells, "connectivity"), ends_array = vtp_array(cells, "offsets");
        if (!corners_array || !ends_array)
            bad_file(file_.path,
                     fmt::format("{} have no connectivity and offsets; the file is truncated or damaged", what));
        const std::vector<double> ends = vtp_numbers(file_, ends_array, fmt::format("the offsets of {}", what), count);
        const bool text = std::string_view(corners_array.attribute("format").as_string("ascii")) == "ascii";
        const double last = ends.back();
        const std::vector<double> corners = vtp_numbers(file_, corners_array, fmt::format("the corners of {}", what),
                                                        text                       ? any_count
                                                        : last >= 0 && last < 1e15 ? static_cast<std::size_t>(last)
                                                                                   : 0);
        std::size_t begin = 0;
        std::vector<std::int64_t> cell;
        for (std::size_t i = 0; i < ends.size(); ++i) {
            if (!(ends[i] >= static_cast<double>(begin) && ends[i] <= static_cast<double>(corners.size())))
                bad_file(file_.path,
                         fmt::format("offset {} (counted from 0) of {} is {}, but offsets rise and there are {} "
                                     "corners; the file is damaged",
                                     i, what, ends[i], corners.size()));
            const auto end = static_cast<std::size_t>(ends[i]);
            cell.clear();
            for (; begin < end; ++begin)
                cell.push_back(std::abs(corners[begin]) < 1e15 ? static_cast<std::int64_t>(corners[begin]) : -1);
            surface_.add(type, cell, base);
        }
        if (begin != corners.size())
            bad_file(file_.path, fmt::format("{} take {} corners, but there are {}; the file is damaged", what, begin,
                                             corners.size()));
    }

    // Nothing here changes the shape, so nothing here refuses the file.
    void read_point_array(pugi::xml_node data, pugi::xml_node array, std::size_t points) {
        const std::string name = array.attribute("Name").value();
        std::string_view attribute;
        for (const auto& [set, meaning] : {std::pair{"Normals", "NORMALS"}, std::pair{"TCoords", "TCOORDS"},
                                           std::pair{"Scalars", "SCALARS"}, std::pair{"Vectors", "VECTORS"}})
            if (!name.empty() && name == data.attribute(set).value()) attribute = meaning;
        const VtkType type = vtp_type(array);
        const int components = vtp_components(array);
        if (vtk_role(name, attribute, type, components) == VtkRole::none) return only_here("point data", array);
        try {
            const std::vector<double> numbers = vtp_numbers(file_, array, fmt::format("'{}'", shown(name)),
                                                            points * static_cast<std::size_t>(components));
            VtkArray& all =
                arrays_.try_emplace(name, VtkArray{name, std::string(attribute), type, components, {}}).first->second;
            all.values.insert(all.values.end(), numbers.begin(), numbers.end());
        } catch (const Error& error) {
            surface_.mesh.file.notes.push_back(fmt::format("passed over: {}", error.what()));
        }
    }

    void only_here(std::string_view kind, pugi::xml_node array) {
        std::string name = fmt::format("the {} '{}'", kind, shown(array.attribute("Name").value()));
        if (known_.insert(name).second) surface_.mesh.file.only_here.push_back(std::move(name));
    }

    const VtpFile& file_;
    VtkSurface surface_;
    std::map<std::string, VtkArray> arrays_; // of points, by name
    std::set<std::string> known_;            // what is told to be only here
};

} // namespace

void open_vtp(VtpFile& file, std::string_view bytes, const std::filesystem::path& path) {
    file.path = path;
    const std::string text = without_appended(file, bytes);
    constexpr unsigned keep_all = pugi::parse_pi | pugi::parse_comments | pugi::parse_cdata | pugi::parse_escapes |
                                  pugi::parse_ws_pcdata | pugi::parse_declaration | pugi::parse_doctype;
    const pugi::xml_parse_result parsed = file.xml.load_buffer(text.data(), text.size(), keep_all);
    const pugi::xml_node root = file.xml.child("VTKFile");
    if (!root && text.find("<VTKFile") == std::string::npos)
        bad_file(path, "holds no <VTKFile>; it is damaged or of another format");
    if (!parsed)
        bad_file(path, fmt::format("line {}: {}; the file is truncated or damaged", line_of(text, parsed.offset),
                                   parsed.description()));
    const std::string_view type = root.attribute("type").value();
    if (type != "PolyData")
        bad_file(path, fmt::format("holds data of the kind {}, not PolyData; extract the surface (in ParaView: Extract "
                                   "Surface) and save it as .vtp",
                                   shown(type)));
    read_encoding(file, root);
    for (const pugi::xml_node piece : root.child("PolyData").children("Piece")) file.pieces.push_back(piece);
}

std::string vtp_field_text(std::string_view bytes, const std::filesystem::path& path, const char* name) {
    VtpFile file;
    open_vtp(file, bytes, path);
    std::string text;
    for (const pugi::xml_node array : file.xml.child("VTKFile").child("PolyData").child("FieldData").children()) {
        if (std::string_view(array.attribute("Name").value()) != name || vtp_type(array) != VtkType::text) continue;
        for (const double letter : vtp_numbers(file, array, name, any_count)) {
            if (letter == 0) break; // the end of the first text
            text += static_cast<char>(letter);
        }
    }
    return text;
}

PolygonMesh read_vtp(std::string_view bytes, const std::filesystem::path& path) {
    VtpFile file;
    open_vtp(file, bytes, path);
    return VtpReader(file).read();
}

} // namespace meshtween
