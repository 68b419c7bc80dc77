// 3D Slicer, vtkMRMLModelStorageNode: the header of a model's file holds "SPACE=RAS" or "SPACE=LPS".
#include "meshtween/io/space.h"

#include "meshtween/core/error.h"
#include "meshtween/io/mesh_file.h"
#include "meshtween/io/vtp.h"

#include <algorithm>
#include <cctype>

namespace meshtween {
namespace {

std::string lower(std::string_view text) {
    std::string result(text);
    std::transform(result.begin(), result.end(), result.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return result;
}

// The part of a mesh's file where words for people stand.
std::string_view header_of(std::string_view bytes, std::string_view format) {
    constexpr std::size_t most = 4096;
    const std::string_view start = bytes.substr(0, most);
    if (format == ".ply") return start.substr(0, start.find("end_header"));
    if (format == ".stl") return start.substr(0, bytes.substr(0, 5) == "solid" ? start.find('\n') : 80);
    if (format == ".vtk") { // a version, then the title
        const std::size_t title = start.find('\n');
        return title == std::string_view::npos ? "" : start.substr(0, start.find('\n', title + 1));
    }
    if (format == ".obj" || format == ".off") { // comments before all else
        std::size_t end = 0;
        while (end < start.size() && (start[end] == '#' || start[end] == '\r' || start[end] == '\n'))
            end = std::min(start.size(), start.find('\n', end)) + 1;
        return start.substr(0, end);
    }
    return "";
}

// VTK's field data, where Slicer names the system too.
Space space_in_field(std::string_view bytes, std::string_view format) {
    if (format == ".vtp") {
        try {
            return space_named(vtp_field_text(bytes, {}, "SPACE"));
        } catch (const Error&) {
            return Space::unknown; // what cannot be read says nothing
        }
    }
    constexpr std::string_view key = "\nSPACE 1 1 string\n";
    std::size_t at = bytes.substr(0, 4096).find(key);
    if (format != ".vtk" || at == std::string_view::npos) return Space::unknown;
    at += key.size();
    if (at < bytes.size() && static_cast<unsigned char>(bytes[at]) >= 0x80) ++at; // a length, in binary files
    return space_named(bytes.substr(std::min(at, bytes.size()), 3));
}

} // namespace

Space space_named(std::string_view word) {
    const std::string name = lower(word);
    if (name == "ras" || name == "0" || name == "right-anterior-superior") return Space::ras;
    if (name == "lps" || name == "1" || name == "left-posterior-superior") return Space::lps;
    return Space::unknown;
}

Space space_in_header(std::string_view bytes, std::string_view format) {
    constexpr std::string_view key = "space=";
    const std::string header = lower(header_of(bytes, format));
    const std::size_t at = header.find(key);
    return at == std::string::npos ? space_in_field(bytes, format) : space_named(header.substr(at + key.size(), 3));
}

Space space_of(const Mesh& mesh) {
    return mesh.file ? space_in_header(mesh.file->bytes, mesh.file->format) : Space::unknown;
}

std::string_view name_of(Space space) {
    return space == Space::ras ? "RAS" : space == Space::lps ? "LPS" : "no named system";
}

} // namespace meshtween
