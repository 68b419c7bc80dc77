// Doi and Koide 1991, "An efficient method of triangulating equi-valued surfaces by using tetrahedral cells", on the
// six tetrahedra that Kuhn's cut makes of a cube.
#include "meshtween/geometry/isosurface.h"

#include "meshtween/core/parallel.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <unordered_map>
#include <vector>

namespace meshtween {
namespace {

struct Lattice {
    Point low;
    double cell;
    std::array<int, 3> nodes;
    int index(int i, int j, int k) const { return (k * nodes[1] + j) * nodes[0] + i; }
    Point point(int node) const {
        return low + cell * Point(node % nodes[0], node / nodes[0] % nodes[1], node / nodes[0] / nodes[1]);
    }
    // The node at a cube's corner: bits 1, 2 and 4 step along x, y and z.
    int corner(int node, int bits) const {
        return node + (bits & 1) + nodes[0] * ((bits >> 1 & 1) + nodes[1] * (bits >> 2 & 1));
    }
};

// Kuhn's tetrahedra: walks from corner 0 to corner 7 along the axes in each order, all positively oriented.
constexpr std::array<std::array<int, 4>, 6> tetrahedra{
    {{0, 1, 3, 7}, {0, 5, 1, 7}, {0, 3, 2, 7}, {0, 2, 6, 7}, {0, 4, 5, 7}, {0, 6, 4, 7}}};

// Values at the nodes; blocks that lie far from the surface keep their middle's value.
std::vector<float> values(const Field& field, const Lattice& lattice) {
    constexpr int block = 4;
    std::array<int, 3> blocks{};
    for (std::size_t a = 0; a < 3; ++a) blocks[a] = (lattice.nodes[a] + block - 1) / block;
    std::vector<float> value(static_cast<std::size_t>(lattice.nodes[0]) * lattice.nodes[1] * lattice.nodes[2]);
    const double far = 1.6 * std::sqrt(3.0) / 2 * block * lattice.cell; // fields are not quite distances: 1.6
    parallel_for(
        static_cast<std::ptrdiff_t>(blocks[0]) * blocks[1] * blocks[2],
        [&](std::ptrdiff_t b) {
            const int bi = static_cast<int>(b % blocks[0]), bj = static_cast<int>(b / blocks[0] % blocks[1]),
                      bk = static_cast<int>(b / blocks[0] / blocks[1]);
            const Point first(bi * block, bj * block, bk * block);
            const double centre = field(lattice.low + lattice.cell * (first + Point::Constant((block - 1) / 2.0)));
            for (int k = bk * block; k < std::min((bk + 1) * block, lattice.nodes[2]); ++k)
                for (int j = bj * block; j < std::min((bj + 1) * block, lattice.nodes[1]); ++j)
                    for (int i = bi * block; i < std::min((bi + 1) * block, lattice.nodes[0]); ++i) {
                        const int node = lattice.index(i, j, k);
                        value[static_cast<std::size_t>(node)] =
                            static_cast<float>(std::abs(centre) > far ? centre : field(lattice.point(node)));
                    }
        },
        64);
    return value;
}

// Vertices are numbered by the lattice edge that they cut: the lower node, and the step to the other as corner bits.
class Cuts {
public:
    Cuts(const Lattice& lattice, const std::vector<float>& value) : lattice_(lattice), value_(value) {}

    void tetrahedron(int node, std::array<int, 4> corners) {
        const auto inside = [&](int bits) { return value_[static_cast<std::size_t>(lattice_.corner(node, bits))] < 0; };
        int count = 0; // those inside go to the front; each exchange turns the orientation
        bool odd = false;
        for (std::size_t i = 0; i < 4; ++i)
            if (inside(corners[i])) {
                const auto to = static_cast<std::size_t>(count++);
                for (std::size_t j = i; j > to; --j) std::swap(corners[j], corners[j - 1]), odd = !odd;
            }
        if (count == 0 || count == 4) return;
        if (odd) count == 3 ? std::swap(corners[0], corners[1]) : std::swap(corners[2], corners[3]);
        const auto [a, b, c, d] = corners;
        const auto cut = [&](int from, int to) { return vertex(node, from, to); };
        if (count == 1)
            triangles.push_back({cut(a, b), cut(a, c), cut(a, d)});
        else if (count == 3)
            triangles.push_back({cut(a, d), cut(b, d), cut(c, d)});
        else {
            const int ac = cut(a, c), ad = cut(a, d), bd = cut(b, d), bc = cut(b, c);
            triangles.push_back({ac, ad, bd}), triangles.push_back({ac, bd, bc});
        }
    }

    struct LatticeEdge {
        int from, to;
    };
    std::vector<LatticeEdge> edges;
    std::vector<std::array<int, 3>> triangles;

private:
    int vertex(int node, int from, int to) {
        const int low = from & to, high = from | to; // Kuhn's edges never go down
        const int base = lattice_.corner(node, low);
        const long key = 8L * base + (high - low);
        const auto [at, is_new] = numbers_.try_emplace(key, static_cast<int>(edges.size()));
        if (is_new) edges.push_back({base, lattice_.corner(node, high)});
        return at->second;
    }

    const Lattice& lattice_;
    const std::vector<float>& value_;
    std::unordered_map<long, int> numbers_;
};

// Where the field changes its sign between two points, kept a little off both ends.
Point crossing(const Field& field, const Point& a, double va, const Point& b, double vb) {
    double low = 0, high = 1, t = va / (va - vb);
    for (int i = 0; i < 3; ++i) {
        const double v = field(a + t * (b - a));
        if ((v < 0) == (va < 0))
            low = t, va = v;
        else
            high = t, vb = v;
        t = va == vb ? (low + high) / 2 : low + (high - low) * va / (va - vb);
    }
    return a + std::clamp(t, 0.05, 0.95) * (b - a);
}

} // namespace

Mesh isosurface(const Field& field, const Box& box, double cell) {
    Lattice lattice{box.low, cell, {}};
    for (int a = 0; a < 3; ++a)
        lattice.nodes[static_cast<std::size_t>(a)] = static_cast<int>(std::ceil((box.high[a] - box.low[a]) / cell)) + 1;
    const std::vector<float> value = values(field, lattice);
    Cuts cuts(lattice, value);
    for (int k = 0; k + 1 < lattice.nodes[2]; ++k)
        for (int j = 0; j + 1 < lattice.nodes[1]; ++j)
            for (int i = 0; i + 1 < lattice.nodes[0]; ++i) {
                const int node = lattice.index(i, j, k);
                int inside = 0;
                for (int bits = 0; bits < 8; ++bits)
                    inside += value[static_cast<std::size_t>(lattice.corner(node, bits))] < 0;
                if (inside == 0 || inside == 8) continue;
                for (const auto& corners : tetrahedra) cuts.tetrahedron(node, corners);
            }
    Mesh mesh;
    mesh.positions.resize(static_cast<Eigen::Index>(cuts.edges.size()), 3);
    parallel_for(mesh.positions.rows(), [&](Eigen::Index v) {
        const auto [from, to] = cuts.edges[static_cast<std::size_t>(v)];
        mesh.positions.row(v) = crossing(field, lattice.point(from), value[static_cast<std::size_t>(from)],
                                         lattice.point(to), value[static_cast<std::size_t>(to)]);
    });
    mesh.triangles.resize(static_cast<Eigen::Index>(cuts.triangles.size()), 3);
    for (std::size_t t = 0; t < cuts.triangles.size(); ++t)
        mesh.triangles.row(static_cast<Eigen::Index>(t)) << cuts.triangles[t][0], cuts.triangles[t][1],
            cuts.triangles[t][2];
    return mesh;
}

} // namespace meshtween
