// The Object File Format of Geomview (manual, section "OFF"): text, three dimensions, with the prefixes ST, C and N.
// Most files have a vertex or a face a line, with colours that their header does not announce; to others lines are no
// more than blanks.
#include "meshtween/io/off.h"

#include "meshtween/core/error.h"
#include "meshtween/io/formats.h"
#include "meshtween/io/text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <optional>
#include <string>

namespace meshtween {
namespace {

// What lines mean in a file.
struct Layout {
    bool vertex_lines = true, face_lines = true;
    bool edges = false; // their number must follow, wherever
};

class OffReader {
public:
    OffReader(std::string_view bytes, const std::filesystem::path& path, Layout layout, OffPlaces* places)
        : text_(bytes, path), size_(bytes.size()), layout_(layout), places_(places) {}

    PolygonMesh read() {
        const std::string first = read_header();
        const long long vertices = count(first.empty() ? next() : first, "vertices", 6),
                        faces = count(next(), "faces", layout_.face_lines ? 8 : 2);
        if (layout_.edges)
            next();
        else
            text_.word(); // edges, which nobody needs
        require_line_end(layout_.vertex_lines);
        mesh_.coordinates.reserve(static_cast<std::size_t>(3 * vertices));
        for (long long v = 0; v < vertices; ++v) vertex(v, vertices);
        if (!layout_.vertex_lines) require_line_end(layout_.face_lines);
        for (long long f = 0; f < faces; ++f) face(f, faces);
        tell_surplus();
        finish();
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

    // Where lines are to begin, nothing may be left of the last.
    void require_line_end(bool lines) {
        if (lines && !text_.peek().empty() && text_.peek()[0] != '#')
            text_.fail(fmt::format("'{}' follows where the line should end", shown(text_.peek())));
    }

    // Gives the number of vertices where it is glued to the keyword, as in most of ModelNet40.
    std::string read_header() {
        std::string word(next());
        std::transform(word.begin(), word.end(), word.begin(), [](unsigned char c) { return std::toupper(c); });
        std::string_view rest = word;
        const auto take = [&](std::string_view prefix) {
            const bool there = rest.substr(0, prefix.size()) == prefix;
            if (there) rest.remove_prefix(prefix.size());
            return there;
        };
        textured_ = take("ST");
        colored_ = take("C");
        normals_ = take("N");
        if (!take("OFF") || (!rest.empty() && std::isdigit(static_cast<unsigned char>(rest[0])) == 0))
            text_.fail("an OFF file begins with 'OFF'; this is damaged, of another format, or has other than three "
                       "dimensions");
        if (text_.peek() == "BINARY" || text_.peek() == "binary")
            text_.fail("binary OFF is not read; save it as text, or as PLY");
        return std::string(rest);
    }

    // Refuses counts that the file cannot hold, at `least` bytes each.
    long long count(std::string_view word, const char* what, long long least) {
        const long long value = text_.integer_from(word, fmt::format("the number of {}", what));
        if (value < 0 || value > static_cast<long long>(size_) / least + 1)
            text_.fail(fmt::format("{} {} do not fit into a file of {} bytes; it is truncated or damaged", value, what,
                                   size_));
        return value;
    }

    // x y z, then a normal (NOFF), a colour of three or four (COFF, and written without saying so by some), u v
    // (STOFF).
    void vertex(long long number, long long of) {
        if (layout_.vertex_lines) line("vertex", number, of);
        for (const char* name : {"x", "y", "z"}) {
            const std::string_view word = layout_.vertex_lines ? text_.word() : next();
            mesh_.coordinates.push_back(text_.finite_from(word, name));
            if (places_ != nullptr) places_->positions.push_back(word);
        }
        std::vector<double>& more = row_;
        more.clear();
        const std::size_t announced = (normals_ ? 3 : 0) + (colored_ ? 4 : 0) + (textured_ ? 2 : 0);
        while (layout_.vertex_lines || more.size() < announced) {
            const std::string_view word = layout_.vertex_lines ? text_.word() : next();
            if (word.empty() || word[0] == '#') break;
            if (places_ != nullptr && normals_ && more.size() < 3) places_->normals.push_back(word);
            double value = 0; // what is no number here harms no shape
            more.push_back(parse(word, value) && std::isfinite(value) ? value : 0);
        }
        attributes(number, more);
    }

    void attributes(long long number, const std::vector<double>& more) {
        std::size_t begin = normals_ ? 3 : 0, end = more.size();
        if (end < begin) text_.fail("the normal is missing; the file is truncated or damaged");
        mesh_normals_.insert(mesh_normals_.end(), more.begin(), more.begin() + static_cast<std::ptrdiff_t>(begin));
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

    // The number of corners, their vertices, and a colour, which is passed over.
    void face(long long number, long long of) {
        if (layout_.face_lines) line("face", number, of);
        const auto word = [&] { return layout_.face_lines ? text_.word() : next(); };
        const long long corners = text_.integer_from(word(), "the number of corners");
        if (corners < 0) text_.fail(fmt::format("a face of {} corners; the file is damaged", corners));
        const auto vertices = static_cast<long long>(mesh_.coordinates.size() / 3);
        const std::size_t begin = mesh_.corners.size();
        for (long long i = 0; i < corners; ++i) {
            const long long index = text_.integer_from(word(), "a vertex's number");
            if (index < 0 || index >= vertices)
                text_.fail(fmt::format("vertex {} is out of range: there are {}, 0 to {}; export the model again",
                                       index, vertices, vertices - 1));
            mesh_.corners.push_back(static_cast<int>(index));
        }
        if (layout_.face_lines && !text_.peek().empty() && text_.peek()[0] != '#') ++colored_faces_;
        if (corners >= 3) return mesh_.end_polygon();
        mesh_.corners.resize(begin); // a side or a point: no part of the surface
        if (short_faces_++ == 0) first_short_face_ = number;
    }

    // Goes to the next line that says something.
    void line(const char* what, long long number, long long of) {
        do
            if (!text_.next_line())
                text_.fail(fmt::format("the file ends before {} {} of {}; it is truncated", what, number, of));
        while (text_.peek().empty() || text_.peek()[0] == '#');
    }

    void tell_surplus() {
        if (!layout_.face_lines) require_line_end(true);
        std::size_t lines = 0;
        while (text_.next_line()) lines += !text_.peek().empty() && text_.peek()[0] != '#';
        if (lines == 0) return;
        if (!layout_.face_lines) text_.fail("more words follow than the header promises; the file is damaged");
        mesh_.file.notes.push_back(fmt::format(
            "{} behind what the header promises: passed over; the file may be damaged", counted(lines, "line")));
    }

    void finish() {
        if (!mesh_.colors.empty()) mesh_.colors.resize(mesh_.coordinates.size() / 3 * 4, 1);
        if (!mesh_.texcoords.empty()) mesh_.texcoord_corners = mesh_.corners;
        normalise_colors(mesh_.colors);
        MeshFile& file = mesh_.file;
        if (short_faces_ > 0)
            file.notes.push_back(fmt::format(
                "{} fewer than three corners, first face {} (counted from 0): passed over",
                short_faces_ == 1 ? "1 face has" : fmt::format("{} faces have", short_faces_), first_short_face_));
        if (colored_faces_ > 0) file.only_here.emplace_back("colours of faces");
        if (mesh_normals_.empty()) return;
        file.normals = Eigen::Map<const Points>(mesh_normals_.data(), std::ssize(mesh_normals_) / 3, 3);
        file.normal_corners = mesh_.corners;
    }

    Text text_;
    std::size_t size_;
    Layout layout_;
    OffPlaces* places_;
    bool textured_ = false, colored_ = false, normals_ = false;
    std::size_t short_faces_ = 0, colored_faces_ = 0;
    long long first_short_face_ = 0;
    std::vector<double> row_, mesh_normals_;
    PolygonMesh mesh_;
};

} // namespace

PolygonMesh read_off(std::string_view bytes, const std::filesystem::path& path, OffPlaces* places) {
    constexpr Layout layouts[] = {
        {true, true, false}, {false, true, false}, {false, false, false}, {false, false, true}};
    std::optional<Error> first; // what is wrong with the lines says more than what follows from it
    for (const Layout& layout : layouts) try {
            if (places != nullptr) *places = {};
            return OffReader(bytes, path, layout, places).read();
        } catch (const Error& error) {
            if (!first) first = error;
        }
    throw Error(*first);
}

PolygonMesh read_off(std::string_view bytes, const std::filesystem::path& path) {
    return read_off(bytes, path, nullptr);
}

} // namespace meshtween
