#include "meshtween/app/regions.h"

#include "meshtween/geometry/measure.h"
#include "meshtween/io/marker_files.h"
#include "meshtween/io/mesh_io.h"
#include "meshtween/io/output.h"
#include "meshtween/io/text.h"

#include <algorithm>

namespace meshtween {
namespace {

// The Rec. 709 weights of red, green and blue.
double brightness(const Colors& colors, Eigen::Index i) {
    const double light = 0.2126 * colors(i, 0) + 0.7152 * colors(i, 1) + 0.0722 * colors(i, 2);
    return std::clamp(light, 0.0, 1.0);
}

std::vector<TimedVertex> painted(const std::filesystem::path& path, const Mesh& mesh, double span) {
    const Mesh paint = read_mesh(path);
    if (paint.positions.rows() != mesh.positions.rows())
        bad_file(path, fmt::format("it has {} vertices and the morph {}; paint the mesh that is morphed",
                                   paint.positions.rows(), mesh.positions.rows()));
    if (paint.colors.rows() != paint.positions.rows())
        bad_file(path, "it has no vertex colours; paint early parts dark and late ones bright, and save as .ply");
    std::vector<TimedVertex> given;
    for (Eigen::Index i = 0; i < paint.colors.rows(); ++i) {
        const double start = brightness(paint.colors, i) * (1 - span);
        given.push_back({static_cast<int>(i), start, std::min(1.0, start + span)});
    }
    return given;
}

int nearest_vertex(const Mesh& mesh, const Point& point, const std::string& name, const Text& text) {
    Eigen::Index nearest = 0;
    const double distance = std::sqrt((mesh.positions.rowwise() - point).rowwise().squaredNorm().minCoeff(&nearest));
    if (distance > 0.1 * diagonal(mesh))
        text.fail(fmt::format("'{}' lies off the mesh by {:.3g} of its diagonal; check its unit and axes", shown(name),
                              distance / diagonal(mesh)));
    return static_cast<int>(nearest);
}

TimedVertex timed_vertex(const std::vector<std::string>& cells, const Mesh& mesh, const Text& text) {
    TimedVertex v;
    if (cells.size() == 6) {
        Point point;
        for (std::size_t k = 0; k < 3; ++k)
            point[static_cast<Eigen::Index>(k)] = text.finite_from(cells[k + 1], std::string(1, "xyz"[k]));
        v.vertex = nearest_vertex(mesh, point, cells[0], text);
    } else {
        const long long index = text.integer_from(cells[0], "the vertex");
        if (index < 0 || index >= mesh.positions.rows())
            text.fail(fmt::format("there is no vertex {}; the mesh has 0 to {}", index, mesh.positions.rows() - 1));
        v.vertex = static_cast<int>(index);
    }
    v.start = text.finite_from(cells[cells.size() - 2], "start");
    v.end = text.finite_from(cells[cells.size() - 1], "end");
    if (!(v.start >= 0 && v.start < v.end && v.end <= 1))
        text.fail(
            fmt::format("it moves from {} to {}; times lie in 0 to 1, the first before the second", v.start, v.end));
    return v;
}

std::vector<TimedVertex> listed(const std::filesystem::path& path, const Mesh& mesh) {
    const std::string bytes = read_whole(path);
    Text text(bytes, path);
    std::vector<TimedVertex> given;
    while (text.next_line()) {
        const std::string_view first = text.peek();
        if (first.empty() || first.front() == '#') continue;
        const std::vector<std::string> cells = cells_of(text.line());
        if (cells.size() != 3 && cells.size() != 6)
            text.fail(fmt::format("a row of {} cells; name,x,y,z,start,end has six and vertex,start,end three",
                                  cells.size()));
        if (cells.back() == "end") continue; // the header
        given.push_back(timed_vertex(cells, mesh, text));
    }
    if (given.empty()) bad_file(path, "no row says when anything moves");
    return given;
}

} // namespace

RegionTiming read_regions(const std::filesystem::path& path, const Mesh& mesh, const RegionOptions& options) {
    if (!(options.span > 0 && options.span <= 1))
        throw Error(ErrorKind::argument, fmt::format("a span of {}: it must be above 0 and at most 1", options.span));
    std::string extension = path.extension().string();
    std::transform(extension.begin(), extension.end(), extension.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    const auto meshes = readable_extensions();
    const bool paint = std::find(meshes.begin(), meshes.end(), extension) != meshes.end();
    return region_timing(mesh, paint ? painted(path, mesh, options.span) : listed(path, mesh), options.width);
}

} // namespace meshtween
