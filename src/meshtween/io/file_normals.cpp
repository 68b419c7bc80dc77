// Weights by angle: Thuermer and Wuethrich, "Computing Vertex Normals from Polygonal Facets", Journal of Graphics Tools
// 3(1), 1998. They do not depend on how a polygon is cut.
#include "meshtween/io/file_normals.h"

#include "meshtween/geometry/measure.h"
#include "meshtween/io/mesh_file.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <vector>

namespace meshtween {
namespace {

// Sets of normals that are to stay alike.
class Sets {
public:
    explicit Sets(std::size_t count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), 0); }
    int find(int i) {
        while (at(i) != i) i = at(i) = at(at(i));
        return i;
    }
    void join(int a, int b) {
        a = find(a), b = find(b);
        at(std::max(a, b)) = std::min(a, b);
    }

private:
    int& at(int i) { return parent_[static_cast<std::size_t>(i)]; }
    std::vector<int> parent_;
};

// A normal that is used at a place.
struct Use {
    std::uint64_t place; // a hash of the position
    int vertex, normal;

    bool operator<(const Use& other) const {
        return place != other.place ? place < other.place : normal < other.normal;
    }
    bool operator==(const Use& other) const { return place == other.place && normal == other.normal; }
};

std::uint64_t hash(const Point& p) {
    std::uint64_t result = 0;
    for (int k = 0; k < 3; ++k) {
        result = (result ^ std::bit_cast<std::uint64_t>(p[k] + 0.0)) * 0x9E3779B97F4A7C15U; // -0 becomes 0
        result ^= result >> 29;
    }
    return result;
}

std::vector<Use> uses_by_place(const Mesh& mesh) {
    const MeshFile& file = *mesh.file;
    std::vector<Use> uses;
    std::vector<int> last(static_cast<std::size_t>(mesh.positions.rows()),
                          -1); // most corners repeat their vertex' last
    for (std::size_t c = 0; c < file.corners.size(); ++c) {
        const int vertex = file.corners[c], normal = file.normal_corners[c];
        int& known = last[static_cast<std::size_t>(vertex)];
        if (normal < 0 || normal == known) continue;
        known = normal;
        uses.push_back({hash(mesh.positions.row(vertex)), vertex, normal});
    }
    std::sort(uses.begin(), uses.end());
    uses.erase(std::unique(uses.begin(), uses.end()), uses.end());
    return uses;
}

void join_alike(const Mesh& mesh, Sets& sets) {
    constexpr double alike = 1e-3;      // text files print few digits
    constexpr std::ptrdiff_t most = 64; // compared at one place; more than any real mesh has
    const Points& normals = mesh.file->normals;
    const std::vector<Use> uses = uses_by_place(mesh);
    for (std::size_t begin = 0, end = 0; begin < uses.size(); begin = end) {
        while (end < uses.size() && uses[end].place == uses[begin].place) ++end;
        for (std::size_t i = begin; i < end; ++i)
            for (std::size_t j = i + 1; j < end && j - i < static_cast<std::size_t>(most); ++j)
                if ((normals.row(uses[i].normal) - normals.row(uses[j].normal)).norm() < alike &&
                    mesh.positions.row(uses[i].vertex) == mesh.positions.row(uses[j].vertex))
                    sets.join(uses[i].normal, uses[j].normal);
    }
}

double angle(const Point& a, const Point& b) {
    return std::atan2(a.cross(b).norm(), a.dot(b));
}

} // namespace

Points file_normals(const Mesh& mesh) {
    const MeshFile& file = *mesh.file;
    Points normals = file.normals;
    Sets sets(static_cast<std::size_t>(normals.rows()));
    join_alike(mesh, sets);
    Points sums = Points::Zero(normals.rows(), 3);
    const Points flat = triangle_normals(mesh.positions, mesh.triangles);
    for (Eigen::Index t = 0; t < mesh.triangles.rows(); ++t)
        for (int k = 0; k < 3; ++k) {
            const int normal = file.normal_corners[static_cast<std::size_t>(file.cut(t, k))];
            if (normal < 0) continue;
            const Point here = mesh.positions.row(mesh.triangles(t, k));
            const Point next = mesh.positions.row(mesh.triangles(t, (k + 1) % 3)) - here,
                        before = mesh.positions.row(mesh.triangles(t, (k + 2) % 3)) - here;
            sums.row(sets.find(normal)) += angle(next, before) * flat.row(t);
        }
    for (Eigen::Index i = 0; i < normals.rows(); ++i) {
        const Point sum = sums.row(sets.find(static_cast<int>(i)));
        if (const double length = sum.norm(); length > 1e-12) normals.row(i) = sum / length;
    }
    return normals;
}

} // namespace meshtween
