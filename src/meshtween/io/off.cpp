// The Object File Format of Geomview (manual, section "OFF"): text, three dimensions, with the prefixes ST, C and N.
#include "meshtween/io/formats.h"
#include "meshtween/io/output.h"
#include "meshtween/io/text.h"
#include "meshtween/io/text_out.h"

#include <fmt/format.h>

#include <string_view>
#include <vector>

namespace meshtween {
namespace {

class OffReader {
public:
    OffReader(std::string_view bytes, const std::filesystem::path& path) : text_(bytes, path), size_(bytes.size()) {}

    PolygonMesh read() {
        read_header();
        const long long vertices = count("vertices", 6), faces = count("faces", 8); // and edges, which nobody needs
        mesh_.coordinates.reserve(static_cast<std::size_t>(3 * vertices));
        for (long long v = 0; v < vertices; ++v) vertex(v, vertices);
        for (long long f = 0; f < faces; ++f) face(f, faces);
        if (!mesh_.colors.empty()) mesh_.colors.resize(mesh_.coordinates.size() / 3 * 4, 1);
        if (!mesh_.texcoords.empty()) mesh_.texcoord_corners = mesh_.corners;
        normalise_colors(mesh_.colors);
        return std::move(mesh_);
    }

private:
    // The next word, over lines without one and over comments.
    std::string_view next() {
        std::string_view word = text_.word();
        while (word.empty() || word[0] == '#') {
            if (!text_.next_line()) text_.fail("the file ends too early; it is truncated");
            word = text_.word();
        }
        return word;
    }

    void read_header() {
        std::string_view word = next();
        if (word.substr(0, 2) == "ST") {
            textured_ = true;
            word.remove_prefix(2);
        }
        if (word.substr(0, 1) == "C") word.remove_prefix(1); // seen by the length of the lines
        if (word.substr(0, 1) == "N") {
            normals_ = true;
            word.remove_prefix(1);
        }
        if (word != "OFF")
            text_.fail("an OFF file begins with 'OFF'; this is damaged, of another format, or has other than three "
                       "dimensions");
        if (text_.peek() == "BINARY") text_.fail("binary OFF is not read; save it as text, or as PLY");
    }

    // Refuses counts that the file cannot hold, at `least` bytes each.
    long long count(const char* what, long long least) {
        const long long value = text_.integer_from(next(), fmt::format("the number of {}", what));
        if (value < 0 || value > static_cast<long long>(size_) / least + 1)
            text_.fail(fmt::format("{} {} do not fit into a file of {} bytes; it is truncated or damaged", value, what,
                                   size_));
        return value;
    }

    // x y z, then a normal (NOFF), a colour of three or four (COFF, and written without saying so by some), u v
    // (STOFF).
    void vertex(long long number, long long of) {
        line("vertex", number, of);
        for (const char* name : {"x", "y", "z"}) mesh_.coordinates.push_back(text_.finite(name));
        std::vector<double>& more = row_;
        more.clear();
        for (std::string_view word = text_.word(); !word.empty() && word[0] != '#'; word = text_.word())
            more.push_back(text_.finite_from(word, "a number behind z"));
        std::size_t begin = normals_ ? 3 : 0, end = more.size();
        if (textured_) {
            if (end < begin + 2) text_.fail("the texture coordinate is missing; the file is truncated or damaged");
            end -= 2;
            for (std::size_t i = end; i < more.size(); ++i) mesh_.texcoords.push_back(static_cast<float>(more[i]));
        }
        if (end < begin + 3) return;
        mesh_.colors.resize(static_cast<std::size_t>(number) * 4, 1);
        for (std::size_t i = begin; i < begin + 4; ++i)
            mesh_.colors.push_back(i < end ? static_cast<float>(more[i]) : 1.0F);
    }

    // The number of corners, their vertices, and a colour that is passed over.
    void face(long long number, long long of) {
        line("face", number, of);
        const long long corners = text_.integer("the number of corners");
        if (corners < 3)
            text_.fail(fmt::format("a face needs three corners, this has {}; the file is damaged", corners));
        const auto vertices = static_cast<long long>(mesh_.coordinates.size() / 3);
        for (long long i = 0; i < corners; ++i) {
            const long long index = text_.integer("a vertex's number");
            if (index < 0 || index >= vertices)
                text_.fail(fmt::format("vertex {} is out of range: there are {}, 0 to {}; export the model again",
                                       index, vertices, vertices - 1));
            mesh_.corners.push_back(static_cast<int>(index));
        }
        mesh_.end_polygon();
    }

    // Goes to the next line that says something.
    void line(const char* what, long long number, long long of) {
        do
            if (!text_.next_line())
                text_.fail(fmt::format("the file ends before {} {} of {}; it is truncated", what, number, of));
        while (text_.peek().empty() || text_.peek()[0] == '#');
    }

    Text text_;
    std::size_t size_;
    bool textured_ = false, normals_ = false;
    std::vector<double> row_;
    PolygonMesh mesh_;
};

} // namespace

PolygonMesh read_off(std::string_view bytes, const std::filesystem::path& path) {
    return OffReader(bytes, path).read();
}

namespace {

void write_new(const Mesh& mesh, std::ostream& stream) {
    TextOut out(stream);
    const bool colored = mesh.colors.rows() > 0;
    out.put("{}OFF\n{} {} 0\n", colored ? "C" : "", mesh.positions.rows(), mesh.triangles.rows());
    for (Eigen::Index i = 0; i < mesh.positions.rows(); ++i) {
        out.put("{} {} {}", mesh.positions(i, 0), mesh.positions(i, 1), mesh.positions(i, 2));
        if (colored)
            out.put(" {} {} {} {}", mesh.colors(i, 0), mesh.colors(i, 1), mesh.colors(i, 2), mesh.colors(i, 3));
        out.put("\n");
    }
    for (Eigen::Index t = 0; t < mesh.triangles.rows(); ++t)
        out.put("3 {} {} {}\n", mesh.triangles(t, 0), mesh.triangles(t, 1), mesh.triangles(t, 2));
}

} // namespace

std::vector<std::string> write_off(const Mesh& mesh, const std::filesystem::path& path, const WriteOptions&) {
    write_whole(path, [&](std::ostream& stream) { write_new(mesh, stream); });
    return {};
}

} // namespace meshtween
