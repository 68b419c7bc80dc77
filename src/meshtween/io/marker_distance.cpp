#include "meshtween/io/marker_distance.h"

#include "meshtween/core/parallel.h"
#include "meshtween/geometry/measure.h"
#include "meshtween/geometry/place_on_triangle.h"

#include <Eigen/Geometry>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

namespace meshtween {
namespace {

constexpr double far_away = 0.05, elsewhere = 0.25; // of the diagonal

// A mesh's surface by some of its triangles, spread over all of it. Enough to tell 5 % of the diagonal, and quick.
class Surface {
public:
    explicit Surface(const Mesh& mesh) : mesh_(mesh) {
        constexpr Eigen::Index most = 20000;
        const Eigen::Index count = mesh.triangles.rows();
        auto step = static_cast<Eigen::Index>(0.618 * static_cast<double>(count)) + 1;
        while (std::gcd(step, count) != 1) ++step; // so that all are met, neighbours long after each other
        for (Eigen::Index i = 0; i < std::min(count, most); ++i)
            balls_.push_back(ball_around(static_cast<Eigen::Index>(i * step % count)));
        const Eigen::AlignedBox3d box = bounding_box(mesh.positions, mesh.triangles);
        low_ = box.min().transpose();
        high_ = box.max().transpose();
        diagonal_ = (high_ - low_).norm();
    }

    // Whether the point is within 5 % of the diagonal; most answers come after a few triangles.
    bool is_near(const Point& point) const {
        const double reach = far_away * diagonal_;
        if (((point - high_).array() > reach).any() || ((low_ - point).array() > reach).any()) return false;
        return std::any_of(balls_.begin(), balls_.end(), [&](const Ball& ball) {
            return ball.distance(point) <= reach && distance_to(ball.triangle, point) <= reach;
        });
    }

    double diagonal() const { return diagonal_; }

    // Of the diagonal.
    double distance(const Point& point) const {
        double least = std::numeric_limits<double>::infinity();
        for (const Ball& ball : balls_)
            if (ball.distance(point) < least) least = std::min(least, distance_to(ball.triangle, point));
        return least / diagonal_;
    }

private:
    // Around a triangle: no place of it is nearer.
    struct Ball {
        Eigen::Index triangle;
        Point centre;
        double radius;
        double distance(const Point& point) const { return (point - centre).norm() - radius; }
    };

    Ball ball_around(Eigen::Index t) const {
        const auto corner = [&](int k) -> Point { return mesh_.positions.row(mesh_.triangles(t, k)); };
        const Point centre = (corner(0) + corner(1) + corner(2)) / 3;
        double radius = 0;
        for (int k = 0; k < 3; ++k) radius = std::max(radius, (corner(k) - centre).norm());
        return {t, centre, radius * (1 + 1e-9)};
    }

    double distance_to(Eigen::Index t, const Point& point) const {
        const auto corner = [&](int k) -> Point { return mesh_.positions.row(mesh_.triangles(t, k)); };
        return std::sqrt(place_on_triangle(point, corner(0), corner(1), corner(2)).squared_distance);
    }

    const Mesh& mesh_;
    double diagonal_ = 0; // of the vertices of faces
    std::vector<Ball> balls_;
    Point low_, high_;
};

// The places that are near the surface.
std::vector<char> near_flags(const Points& places, const Surface& surface) {
    std::vector<char> flags(static_cast<std::size_t>(places.rows()));
    parallel_for(
        places.rows(),
        [&](Eigen::Index i) { flags[static_cast<std::size_t>(i)] = surface.is_near(places.row(i)) ? 1 : 0; }, 16);
    return flags;
}

bool nearly_all(const std::vector<char>& flags) {
    return static_cast<double>(std::count(flags.begin(), flags.end(), 1)) >= 0.9 * static_cast<double>(flags.size());
}

struct Cause {
    Eigen::Matrix3d undo; // applied to a column
    std::string remedy;
};

// What goes wrong most often between programs: signs, axes and units, alone and together.
std::vector<Cause> causes() {
    const struct {
        std::array<int, 9> matrix;
        const char* remedy;
    } axes[] = {
        {{1, 0, 0, 0, 1, 0, 0, 0, 1}, ""},
        {{-1, 0, 0, 0, -1, 0, 0, 0, 1},
         "negate x and y (the markers are in LPS and the model in RAS coordinates, or the other way round)"},
        {{1, 0, 0, 0, 0, 1, 0, -1, 0}, "replace y by z and z by -y (the file has z upwards, the model y)"},
        {{1, 0, 0, 0, 0, -1, 0, 1, 0}, "replace y by -z and z by y (the file has y upwards, the model z)"},
        {{1, 0, 0, 0, 0, 1, 0, 1, 0}, "exchange y and z"},
        {{-1, 0, 0, 0, 1, 0, 0, 0, 1}, "negate x (the model is mirrored)"},
    };
    std::vector<Cause> result;
    for (const double scale : {1.0, 1000.0, 0.001, 100.0, 0.01, 10.0, 0.1, 25.4, 1 / 25.4})
        for (const auto& axis : axes) {
            Cause cause;
            for (int i = 0; i < 9; ++i) cause.undo(i / 3, i % 3) = scale * axis.matrix[static_cast<std::size_t>(i)];
            cause.remedy = axis.remedy;
            if (scale != 1)
                cause.remedy += fmt::format("{}multiply all by {:.4g} (another unit of length)",
                                            cause.remedy.empty() ? "" : " and ", scale);
            if (!cause.remedy.empty()) result.push_back(std::move(cause));
        }
    return result;
}

std::string likely_remedy(const Points& places, const Surface& own, const NamedMesh& other, const std::string& system) {
    constexpr Eigen::Index most = 64;
    const Points some = places.topRows(std::min(places.rows(), most));
    if (other.mesh != nullptr && nearly_all(near_flags(some, Surface(*other.mesh))))
        return fmt::format("they lie on the {}, so the two sides seem to be exchanged", other.name);
    for (const Cause& cause : causes())
        if (const Points mended = some * cause.undo.transpose();
            diagonal(mended) > far_away * own.diagonal() && nearly_all(near_flags(mended, own))) // not all in one spot
            return fmt::format("they would lie on it if one would {}; {}", cause.remedy,
                               !system.empty() && cause.undo == Eigen::Vector3d(-1, -1, 1).asDiagonal().toDenseMatrix()
                                   ? fmt::format("do that to the file, or give --markers-system {}", system)
                                   : "do that to the file");
    return "see whether they belong to this model, in this place";
}

// Root mean square distance of the places, of the diagonal.
double rms_distance(const Points& places, const Surface& surface) {
    std::vector<double> each(static_cast<std::size_t>(places.rows()));
    parallel_for(
        places.rows(), [&](Eigen::Index i) { each[static_cast<std::size_t>(i)] = surface.distance(places.row(i)); }, 4);
    return std::sqrt(std::inner_product(each.begin(), each.end(), each.begin(), 0.0) /
                     static_cast<double>(each.size()));
}

// On a shape that is nearly the same from behind, wrong signs move no marker far. They still show: with x and y negated
// all lie on the surface, as they do not now. Root mean square distances, of the diagonal.
struct Signs {
    double given = 0, negated = 0;
    bool wrong = false;
};

Signs signs_of(const Points& places, const Surface& surface) {
    constexpr Eigen::Index most = 16, least = 3; // each is held against all of the surface
    constexpr double off = 1e-3;                 // of the diagonal: what facets and hands do
    constexpr double clearly = 1.0 / 3;          // of the distance as it is
    if (places.rows() < least) return {};
    const Points some = places.topRows(std::min(places.rows(), most));
    Signs signs{rms_distance(some, surface), 0, false};
    if (signs.given < off) return signs;
    signs.negated = rms_distance(some * Eigen::Vector3d(-1, -1, 1).asDiagonal(), surface);
    signs.wrong = signs.negated <= clearly * signs.given;
    return signs;
}

} // namespace

MarkerDistances marker_distances(const Points& places, const std::vector<std::string>& names, const NamedMesh& own,
                                 const NamedMesh& other, const std::string& system, std::string_view what) {
    MarkerDistances result;
    if (names.empty() || own.mesh->triangles.rows() == 0) return result;
    const Surface surface(*own.mesh);
    const std::vector<char> near = near_flags(places, surface);
    double farthest = 0;
    std::size_t far_off = 0;
    for (std::size_t i = 0; i < names.size(); ++i) {
        if (near[i] != 0) continue;
        const double distance = surface.distance(places.row(static_cast<Eigen::Index>(i)));
        farthest = std::max(farthest, distance);
        far_off += distance > elsewhere ? 1 : 0;
        result.far_names.push_back(names[i]);
    }
    const std::size_t count = result.far_names.size();
    if (count == 0) {
        if (const Signs signs = signs_of(places, surface); signs.wrong)
            result.note = fmt::format(
                "the {} lie further from the {} than they would with x and y negated, {:.2g} % of its diagonal (root "
                "mean square) and not {:.2g} %: one is in LPS coordinates and the other in RAS, it seems; negate x "
                "and y in the file{}",
                what, own.name, 100 * signs.given, 100 * signs.negated,
                system.empty() ? "" : fmt::format(", or give --markers-system {}", system));
        return result;
    }
    constexpr std::size_t most = 5;
    const bool few = 2 * count < names.size(); // a wrong unit or axis moves most of them
    const std::string remedy =
        few ? "see whether they are where they should be" : likely_remedy(places, surface, other, system);
    result.elsewhere = 2 * far_off > names.size();
    result.note = fmt::format(
        "{} of {} {} lie further from the {} than 5 % of its diagonal, up to {:.3g} % ({}{}): {}", count, names.size(),
        what, own.name, 100 * farthest,
        fmt::join(result.far_names.begin(), result.far_names.begin() + std::ptrdiff_t(std::min(most, count)), ", "),
        count > most ? ", ..." : "", remedy);
    return result;
}

std::vector<std::string> far_markers(const std::vector<MarkerPair>& pairs, const Mesh& source, const Mesh& target) {
    std::vector<std::string> names, notes;
    Points sources(std::ssize(pairs), 3), targets(std::ssize(pairs), 3);
    for (const MarkerPair& pair : pairs) {
        sources.row(std::ssize(names)) = pair.source;
        targets.row(std::ssize(names)) = pair.target;
        names.push_back(pair.name);
    }
    const NamedMesh a{&source, "source"}, b{&target, "target"};
    for (MarkerDistances far : {marker_distances(sources, names, a, b, {}), marker_distances(targets, names, b, a, {})})
        if (!far.note.empty()) notes.push_back(std::move(far.note));
    return notes;
}

bool lie_on(const Points& points, const Mesh& mesh) {
    return points.rows() > 0 && mesh.triangles.rows() > 0 && nearly_all(near_flags(points, Surface(mesh)));
}

bool have_wrong_signs(const Points& points, const Mesh& mesh) {
    return mesh.triangles.rows() > 0 && signs_of(points, Surface(mesh)).wrong;
}

} // namespace meshtween
