// XML of version 1.0 with arrays in base64, compressed by zlib: what VTK 6 and later read, and any XML reader.
#include "meshtween/core/version.h"
#include "meshtween/geometry/measure.h"
#include "meshtween/io/formats.h"
#include "meshtween/io/output.h"
#include "meshtween/io/seams.h"
#include "meshtween/io/space.h"
#include "meshtween/io/vtp.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <ostream>
#include <set>
#include <sstream>

namespace meshtween {
namespace {

template <typename Derived>
std::string as_bytes(const Eigen::MatrixBase<Derived>& rows, VtkType type) {
    std::string bytes;
    bytes.reserve(static_cast<std::size_t>(rows.size()) * size_of(type));
    for (Eigen::Index i = 0; i < rows.rows(); ++i)
        for (Eigen::Index k = 0; k < rows.cols(); ++k) append_number(bytes, static_cast<double>(rows(i, k)), type);
    return bytes;
}

// New numbers for some arrays of a file.
class VtpEdit {
public:
    VtpEdit(VtpFile& file) : file_(file) {}

    void set(pugi::xml_node array, const Points& rows) {
        const VtkType type = is_float(vtp_type(array)) ? vtp_type(array) : VtkType::float64;
        if (type != vtp_type(array)) array.attribute("type").set_value("Float64");
        const std::string format = array.attribute("format").as_string("ascii");
        for (const char* range : {"RangeMin", "RangeMax"}) array.remove_attribute(range); // of the lengths before
        while (array.child("InformationKey")) array.remove_child("InformationKey");       // likewise
        if (format == "appended")
            appended_[array.attribute("offset").as_ullong()] =
                vtp_encoded(as_bytes(rows, type), type, file_.encoding, file_.appended_base64);
        else if (format == "binary")
            array.text().set(("\n" + vtp_encoded(as_bytes(rows, type), type, file_.encoding, true) + "\n").c_str());
        else
            array.text().set(as_text(rows).c_str());
    }

    std::string finished() {
        std::string appended = move_appended();
        std::ostringstream stream;
        file_.xml.save(stream, "", pugi::format_raw | pugi::format_no_declaration, pugi::encoding_utf8);
        std::string text = stream.str();
        if (const std::size_t at = text.rfind("</AppendedData>"); at != std::string::npos) text.insert(at, appended);
        return text;
    }

private:
    static std::string as_text(const Points& rows) {
        fmt::memory_buffer text;
        fmt::format_to(std::back_inserter(text), "\n");
        for (Eigen::Index i = 0; i < rows.rows(); ++i)
            fmt::format_to(std::back_inserter(text), "{} {} {}\n", rows(i, 0), rows(i, 1), rows(i, 2));
        return fmt::to_string(text);
    }

    // The appended data with the new arrays; every offset is told again.
    std::string move_appended() {
        std::map<std::uint64_t, std::uint64_t> moved; // offsets before and now
        const auto each = [&](const auto& visit) {
            const auto matches =
                file_.xml.select_nodes("//DataArray[@format='appended'] | //Array[@format='appended']");
            for (const pugi::xpath_node& found : matches) visit(found.node().attribute("offset"));
        };
        each([&](pugi::xml_attribute offset) { moved[offset.as_ullong()] = 0; });
        std::string result;
        for (auto at = moved.begin(); at != moved.end(); ++at) {
            const std::uint64_t end = std::next(at) == moved.end() ? file_.appended.size() : std::next(at)->first;
            at->second = result.size();
            const auto edited = appended_.find(at->first);
            if (edited != appended_.end())
                result += edited->second;
            else if (at->first < file_.appended.size())
                result += file_.appended.substr(at->first, end - at->first);
        }
        each([&](pugi::xml_attribute offset) {
            offset.set_value(static_cast<unsigned long long>(moved[offset.as_ullong()]));
        });
        return result;
    }

    VtpFile& file_;
    std::map<std::uint64_t, std::string> appended_; // by offset, as they are to be written
};

pugi::xml_node normals_of(pugi::xml_node piece) {
    const pugi::xml_node data = piece.child("PointData");
    for (const pugi::xml_node array : data.children("DataArray")) {
        const std::string_view name = array.attribute("Name").value();
        const bool told = !name.empty() && name == data.attribute("Normals").value();
        if (vtk_role(name, told ? "NORMALS" : "", vtp_type(array), vtp_components(array)) == VtkRole::normals)
            return array;
    }
    return {};
}

std::string rewritten(const Mesh& mesh) {
    if (shape_key(mesh) == mesh.file->shape) return mesh.file->bytes;
    VtpFile file;
    open_vtp(file, mesh.file->bytes, mesh.file->path);
    Points normals;
    if (mesh.file->normals.rows() == mesh.positions.rows()) {
        const Triangles cut = mesh.file->cut;
        normals = renewed_normals(cut_mesh(read_vtp(mesh.file->bytes, mesh.file->path), cut), mesh);
    }
    VtpEdit edit(file);
    Eigen::Index begin = 0;
    for (const pugi::xml_node piece : file.pieces) {
        const auto count = static_cast<Eigen::Index>(piece.attribute("NumberOfPoints").as_ullong());
        if (count > 0) edit.set(piece.child("Points").child("DataArray"), mesh.positions.middleRows(begin, count));
        const pugi::xml_node array = normals_of(piece);
        if (count > 0 && array && normals.rows() > 0) edit.set(array, normals.middleRows(begin, count));
        begin += count;
    }
    return edit.finished();
}

class VtpOut {
public:
    explicit VtpOut(std::ostream& stream) : stream_(stream) {}

    template <typename Derived>
    void array(const char* name, const char* type, const Eigen::MatrixBase<Derived>& rows) {
        const VtkType kind = vtp_type_named(type);
        stream_ << fmt::format("<DataArray type=\"{}\" Name=\"{}\" NumberOfComponents=\"{}\" format=\"binary\">", type,
                               name, rows.cols())
                << vtp_encoded(as_bytes(rows, kind), kind, {false, true, 8}, true) << "</DataArray>\n";
    }

private:
    std::ostream& stream_;
};

void write_point_data(const Mesh& mesh, std::ostream& stream) {
    VtpOut out(stream);
    const Texcoords texcoords = texcoords_of_vertices(mesh);
    const bool colored = mesh.colors.rows() > 0, normals = is_described(mesh) && mesh.file->normals.rows() > 0;
    stream << fmt::format("<PointData{}{}{}>\n", colored ? " Scalars=\"RGB\"" : "",
                          normals ? " Normals=\"Normals\"" : "", texcoords.rows() > 0 ? " TCoords=\"TCoords\"" : "");
    if (colored) {
        const Eigen::Index channels = (mesh.colors.col(3).array() == 1).all() ? 3 : 4;
        out.array("RGB", "UInt8", (mesh.colors.leftCols(channels).cwiseMax(0).cwiseMin(1) * 255).eval());
    }
    if (normals) out.array("Normals", "Float32", vertex_normals(mesh.positions, mesh.triangles, seams(mesh)));
    if (texcoords.rows() > 0) out.array("TCoords", "Float32", texcoords);
    stream << "</PointData>\n";
}

void write_new(const Mesh& mesh, std::ostream& stream) {
    const WrittenPolygons polygons = written_polygons(mesh);
    const auto column = [](const std::vector<int>& numbers) {
        return Eigen::Map<const Eigen::VectorXi>(numbers.data(), static_cast<Eigen::Index>(numbers.size()));
    };
    VtpOut out(stream);
    stream << "<?xml version=\"1.0\"?>\n<VTKFile type=\"PolyData\" version=\"1.0\" byte_order=\"LittleEndian\" "
              "header_type=\"UInt64\" compressor=\"vtkZLibDataCompressor\">\n"
           << fmt::format("<!-- written by meshtween {} -->\n<PolyData>\n", version());
    if (const Space space = space_of(mesh); space != Space::unknown) // as 3D Slicer names it
        stream << fmt::format(
            "<FieldData><Array type=\"String\" Name=\"SPACE\" NumberOfTuples=\"1\" format=\"ascii\">{} 0"
            "</Array></FieldData>\n",
            fmt::join(std::vector<int>(name_of(space).begin(), name_of(space).end()), " "));
    stream << fmt::format("<Piece NumberOfPoints=\"{}\" NumberOfVerts=\"0\" NumberOfLines=\"0\" NumberOfStrips=\"0\" "
                          "NumberOfPolys=\"{}\">\n",
                          mesh.positions.rows(), polygons.ends.size());
    write_point_data(mesh, stream);
    stream << "<Points>\n";
    out.array("Points", "Float64", mesh.positions);
    stream << "</Points>\n<Polys>\n";
    out.array("connectivity", "Int64", column(polygons.corners));
    out.array("offsets", "Int64", column(polygons.ends));
    stream << "</Polys>\n</Piece>\n</PolyData>\n</VTKFile>\n";
}

} // namespace

std::vector<std::string> write_vtp(const Mesh& mesh, const std::filesystem::path& path, const WriteOptions&) {
    if (is_rewritable(mesh, ".vtp")) {
        write_whole(path, rewritten(mesh));
        return {};
    }
    write_whole(path, [&](std::ostream& stream) { write_new(mesh, stream); });
    return seams_left_behind(mesh, path);
}

} // namespace meshtween
