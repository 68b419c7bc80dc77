// Elements are named by their numbers, counted from 0, as everywhere in the library.
#include "meshtween/geometry/check.h"

#include "meshtween/core/parallel.h"
#include "meshtween/geometry/measure.h"
#include "meshtween/geometry/topology.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <iterator>
#include <numeric>
#include <tuple>
#include <utility>

namespace meshtween {
namespace {

constexpr std::size_t named = 5; // elements of a kind that a sentence names

std::string number_word(long count) {
    static constexpr std::array words{"no", "one", "two", "three", "four", "five", "six", "seven", "eight", "nine"};
    return count < std::ssize(words) ? words[static_cast<std::size_t>(count)] : std::to_string(count);
}

// "4", "4 and 9", "4, 9 and 17", or "4, 9, 17, 20, 31, ..." where there are more.
template <typename Items>
std::string listed(const Items& items, std::size_t count) {
    std::string result;
    std::size_t i = 0;
    for (const auto& item : items) {
        if (i > 0) result += i + 1 == count ? " and " : ", ";
        result += fmt::format("{}", item);
        if (++i == named) break;
    }
    return count > named ? result + ", ..." : result;
}

// Elements of one kind: all counted, the first few kept.
template <typename Item>
struct Found {
    std::vector<Item> first;
    long count = 0;
    void add(Item item) {
        if (first.size() < named) first.push_back(std::move(item));
        ++count;
    }
    bool any() const { return count > 0; }
    std::string list() const { return listed(first, static_cast<std::size_t>(count)); }
    // "face 4 has", "faces 4 and 9 have"
    std::string with(const char* one, const char* many, const char* verb_one, const char* verb_many) const {
        if (count == 1) return fmt::format("{} {} {}", one, list(), verb_one);
        const std::string total = count > static_cast<long>(named) ? fmt::format("{} {} ({})", count, many, list())
                                                                   : fmt::format("{} {}", many, list());
        return fmt::format("{} {}", total, verb_many);
    }
};

class Checker {
public:
    Checker(const Mesh& mesh, const Weld& weld)
        : mesh_(mesh), t_(mesh.triangles), weld_(weld), w_(weld.any() ? weld.by_first() : mesh.triangles) {}

    std::vector<Finding> run() {
        if (t_.rows() == 0)
            add(Severity::error, 0, fmt::format("there are no faces, only {} vertices", mesh_.positions.rows()));
        const bool finite = check_coordinates(), in_range = check_indices();
        if (t_.rows() == 0 || !in_range) return std::move(findings_);
        top_ = topology(mesh_.positions.rows(), w_);
        check_repeated_vertices();
        if (finite) check_areas();
        check_duplicate_faces();
        check_unused_vertices();
        if (finite) check_seams();
        check_edges();
        check_vertex_fans();
        check_orientation();
        check_components();
        if (finite && closed_ && oriented_) check_inside_out();
        if (manifold_) check_genus();
        return std::move(findings_);
    }

private:
    void add(Severity severity, long count, std::string what) {
        findings_.push_back({severity, std::move(what), count});
    }

    bool degenerate(Eigen::Index t) const {
        return t_(t, 0) == t_(t, 1) || t_(t, 1) == t_(t, 2) || t_(t, 2) == t_(t, 0);
    }

    bool check_coordinates() {
        Found<Eigen::Index> bad;
        for (Eigen::Index v = 0; v < mesh_.positions.rows(); ++v)
            if (!mesh_.positions.row(v).allFinite()) bad.add(v);
        if (bad.any())
            add(Severity::error, bad.count,
                bad.with("vertex", "vertices", "has a coordinate that is not a finite number",
                         "have coordinates that are not finite numbers"));
        return !bad.any();
    }

    bool check_indices() {
        Found<Eigen::Index> bad;
        for (Eigen::Index t = 0; t < t_.rows(); ++t)
            if (t_.row(t).minCoeff() < 0 || t_.row(t).maxCoeff() >= mesh_.positions.rows()) bad.add(t);
        if (bad.any())
            add(Severity::error, bad.count,
                bad.with("face", "faces", "names", "name") +
                    fmt::format(" a vertex that does not exist: there are {}", mesh_.positions.rows()));
        return !bad.any();
    }

    void check_repeated_vertices() {
        Found<Eigen::Index> bad;
        for (Eigen::Index t = 0; t < t_.rows(); ++t)
            if (degenerate(t)) bad.add(t);
        if (bad.any())
            add(Severity::warning, bad.count,
                bad.with("face", "faces", "names a vertex more than once", "name a vertex more than once"));
    }

    // Without area: its height is below 1e-10 of its longest edge.
    void check_areas() {
        Found<Eigen::Index> bad;
        for (Eigen::Index t = 0; t < t_.rows(); ++t) {
            if (degenerate(t)) continue;
            double longest = 0;
            for (int k = 0; k < 3; ++k)
                longest = std::max(
                    longest, (mesh_.positions.row(t_(t, k)) - mesh_.positions.row(t_(t, (k + 1) % 3))).squaredNorm());
            if (double_area_normal(mesh_.positions, t_, t).norm() <= 1e-10 * longest) bad.add(t);
        }
        if (bad.any()) add(Severity::warning, bad.count, bad.with("face", "faces", "has no area", "have no area"));
    }

    // Faces by their corners in order: those whose first is v.
    using Face = std::pair<std::array<int, 3>, int>;
    std::vector<Face> faces_from(int v) const {
        std::vector<Face> faces;
        for (const int t : top_.vertex_triangles[v]) {
            std::array<int, 3> key{w_(t, 0), w_(t, 1), w_(t, 2)};
            std::sort(key.begin(), key.end());
            if (key[0] == v) faces.emplace_back(key, t);
        }
        std::sort(faces.begin(), faces.end());
        faces.erase(std::unique(faces.begin(), faces.end()), faces.end()); // v twice in a face
        return faces;
    }

    static bool each_once(const std::vector<Face>& faces) {
        return std::adjacent_find(faces.begin(), faces.end(),
                                  [](const Face& a, const Face& b) { return a.first == b.first; }) == faces.end();
    }

    // Ascending.
    template <typename Test>
    std::vector<int> vertices_where(const Test& test) const {
        std::vector<char> flag(static_cast<std::size_t>(mesh_.positions.rows()));
        parallel_for(mesh_.positions.rows(),
                     [&](Eigen::Index v) { flag[static_cast<std::size_t>(v)] = test(static_cast<int>(v)) ? 1 : 0; });
        std::vector<int> result;
        for (std::size_t v = 0; v < flag.size(); ++v)
            if (flag[v] != 0) result.push_back(static_cast<int>(v));
        return result;
    }

    void check_duplicate_faces() {
        Found<std::string> bad;
        for (const int v : vertices_where([&](int v) { return !each_once(faces_from(v)); })) {
            const auto faces = faces_from(v);
            for (std::size_t i = 1, first = 0; i < faces.size(); ++i) {
                if (faces[i].first != faces[first].first)
                    first = i;
                else
                    bad.add(fmt::format("{} as {}", faces[i].second, faces[first].second));
            }
        }
        if (bad.any())
            add(Severity::warning, bad.count,
                bad.count == 1 ? fmt::format("a face has the same vertices as another: {}", bad.list())
                               : fmt::format("{} faces have the same vertices as others: {}", bad.count, bad.list()));
    }

    void check_unused_vertices() {
        Found<Eigen::Index> bad;
        std::vector<char> used(static_cast<std::size_t>(mesh_.positions.rows()), 0);
        for (const int v : t_.reshaped()) used[static_cast<std::size_t>(v)] = 1;
        for (std::size_t v = 0; v < used.size(); ++v)
            if (used[v] == 0) bad.add(static_cast<Eigen::Index>(v));
        unused_ = bad.count;
        if (bad.any())
            add(Severity::warning, bad.count,
                bad.with("vertex", "vertices", "belongs to no face", "belong to no face"));
    }

    void check_seams() {
        Found<std::string> copies;
        for (const int v : weld_.on_seam) {
            const int first = weld_.first[static_cast<std::size_t>(weld_.vertex[static_cast<std::size_t>(v)])];
            if (v != first) copies.add(fmt::format("{} on {}", v, first));
        }
        copies_ = copies.count;
        if (copies.any())
            add(Severity::note, copies.count,
                fmt::format("{} where edges pair up ({}): a seam of the file, the surface is whole there and each "
                            "counts once",
                            copies.count == 1 ? "a vertex lies on another"
                                              : fmt::format("{} vertices lie on others", copies.count),
                            copies.list()));
        Found<int> slit, apart;
        for (const int v : weld_.left_open) slit.add(v);
        for (const int v : weld_.touching)
            if (!std::binary_search(weld_.left_open.begin(), weld_.left_open.end(), v)) apart.add(v);
        if (slit.any())
            add(Severity::note, slit.count,
                slit.with("vertex", "vertices", "lies", "lie") +
                    " along a slit whose sides touch, such as closed lips: a border, for the texture goes on there and "
                    "nothing but the shape split it");
        if (apart.any())
            add(Severity::note, apart.count,
                apart.with("vertex", "vertices", "lies on another where edges do", "lie on others where edges do") +
                    " not pair up: a border, the surface is cut there; weld it if it should be whole");
    }

    std::vector<int> triangles_on(const Edge& edge) const {
        const auto a = top_.vertex_triangles[edge.vertices[0]], b = top_.vertex_triangles[edge.vertices[1]];
        std::vector<int> result;
        std::set_intersection(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(result));
        return result;
    }

    void check_edges() {
        Found<const Edge*> bad;
        for (const Edge& edge : top_.edges) {
            closed_ = closed_ && edge.count != 1;
            if (edge.count > 2) bad.add(&edge);
        }
        if (!bad.any()) return;
        manifold_ = false;
        const auto name = [](const Edge& edge) { return fmt::format("{}-{}", edge.vertices[0], edge.vertices[1]); };
        const Edge& first = *bad.first[0];
        std::string what = fmt::format("edge {} belongs to {} faces ({})", name(first), number_word(first.count),
                                       listed(triangles_on(first), static_cast<std::size_t>(first.count)));
        std::vector<std::string> others;
        for (std::size_t i = 1; i < bad.first.size(); ++i) others.push_back(name(*bad.first[i]));
        if (!others.empty())
            what += fmt::format(", and {} more belong to more than two ({}{})", bad.count - 1, fmt::join(others, ", "),
                                bad.count > static_cast<long>(named) ? ", ..." : "");
        add(Severity::warning, bad.count, what);
    }

    // Around a vertex its triangles should hang together by their edges, as one fan.
    bool is_one_fan(int v) const {
        const auto around = top_.vertex_triangles[v];
        std::vector<std::pair<int, int>> spokes; // the vertex at an edge's other end, and the triangle
        for (int i = 0; i < static_cast<int>(around.size()); ++i)
            for (int k = 0; k < 3; ++k)
                if (const int w = w_(around[static_cast<std::size_t>(i)], k); w != v) spokes.emplace_back(w, i);
        std::sort(spokes.begin(), spokes.end());
        std::vector<int> parent(around.size());
        std::iota(parent.begin(), parent.end(), 0);
        const auto root = [&](int i) {
            auto at = static_cast<std::size_t>(i);
            while (parent[at] != static_cast<int>(at)) {
                parent[at] = parent[static_cast<std::size_t>(parent[at])];
                at = static_cast<std::size_t>(parent[at]);
            }
            return static_cast<int>(at);
        };
        auto parts = static_cast<std::ptrdiff_t>(around.size());
        for (std::size_t s = 1; s < spokes.size(); ++s) {
            if (spokes[s].first != spokes[s - 1].first) continue;
            const int a = root(spokes[s].second), b = root(spokes[s - 1].second);
            if (a == b) continue;
            parent[static_cast<std::size_t>(a)] = b;
            --parts;
        }
        return parts <= 1;
    }

    void check_vertex_fans() {
        Found<int> bad;
        for (const int v : vertices_where([&](int v) { return !is_one_fan(v); })) bad.add(v);
        if (!bad.any()) return;
        manifold_ = false;
        add(Severity::warning, bad.count,
            bad.with("vertex", "vertices", "joins parts of the surface that share nothing else there",
                     "join parts of the surface that share nothing else there"));
    }

    // Whether triangle t runs from a to b.
    bool runs(int t, int a, int b) const {
        for (int k = 0; k < 3; ++k)
            if (w_(t, k) == a && w_(t, (k + 1) % 3) == b) return true;
        return false;
    }

    void check_orientation() {
        Found<std::string> bad;
        for (const Edge& edge : top_.edges) {
            if (edge.count != 2 || degenerate(edge.triangles[0]) || degenerate(edge.triangles[1])) continue;
            const auto [a, b] = edge.vertices;
            if (runs(edge.triangles[0], a, b) == runs(edge.triangles[1], a, b))
                bad.add(fmt::format("{} and {} at edge {}-{}", edge.triangles[0], edge.triangles[1], a, b));
        }
        if (!bad.any()) return;
        oriented_ = false;
        add(Severity::warning, bad.count,
            bad.count == 1 ? fmt::format("two neighbouring faces look to opposite sides: {}", bad.list())
                           : fmt::format("{} pairs of neighbouring faces look to opposite sides: {}", bad.count,
                                         fmt::join(bad.first, "; ")));
    }

    // Parts by their size; vertices of no face are no part.
    void check_components() {
        const std::vector<int> component = components(top_);
        std::vector<long> sizes(component.empty() ? 0 : *std::max_element(component.begin(), component.end()) + 1, 0);
        for (std::size_t v = 0; v < component.size(); ++v)
            if (!top_.vertex_triangles[static_cast<std::ptrdiff_t>(v)].empty())
                ++sizes[static_cast<std::size_t>(component[v])];
        std::erase(sizes, 0);
        std::sort(sizes.rbegin(), sizes.rend());
        parts_ = std::ssize(sizes);
        if (parts_ > 1)
            add(Severity::note, parts_,
                fmt::format("the surface has {} separate parts, of {} vertices", number_word(parts_),
                            listed(sizes, sizes.size())));
        if (closed_) return;
        const auto loops = boundary_loops(w_, top_);
        std::vector<std::size_t> lengths;
        lengths.reserve(loops.size());
        for (const auto& loop : loops) lengths.push_back(loop.size());
        std::sort(lengths.rbegin(), lengths.rend());
        loops_ = std::ssize(loops);
        add(Severity::note, loops_,
            loops_ == 1 ? fmt::format("the surface is open: a boundary of {} edges", lengths[0])
                        : fmt::format("the surface is open: {} boundaries, of {} edges", number_word(loops_),
                                      listed(lengths, lengths.size())));
    }

    void check_inside_out() {
        if (volume(mesh_.positions, w_) < 0)
            add(Severity::warning, 1, "the surface is inside out: its faces look inwards, turn them all over");
    }

    // Euler and Poincare: V - E + F + loops = 2 (parts - handles).
    void check_genus() {
        const long characteristic = static_cast<long>(mesh_.positions.rows()) - unused_ - copies_ -
                                    std::ssize(top_.edges) + static_cast<long>(w_.rows()) + loops_;
        const long doubled = 2 * parts_ - characteristic;
        if (oriented_ && doubled > 0 && doubled % 2 == 0)
            add(Severity::note, doubled / 2,
                fmt::format("the surface has {} handle{} (its genus)", number_word(doubled / 2),
                            doubled == 2 ? "" : "s"));
    }

    const Mesh& mesh_;
    const Triangles& t_;
    const Weld& weld_;
    Triangles w_; // each corner the first of the vertices that are one
    Topology top_;
    std::vector<Finding> findings_;
    long unused_ = 0, copies_ = 0, parts_ = 0, loops_ = 0;
    bool closed_ = true, oriented_ = true, manifold_ = true;
};

} // namespace

std::vector<Finding> check(const Mesh& mesh) {
    return check(mesh, weld(mesh));
}

std::vector<Finding> check(const Mesh& mesh, const Weld& weld) {
    return Checker(mesh, weld).run();
}

} // namespace meshtween
