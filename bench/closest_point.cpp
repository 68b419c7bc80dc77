// A million closest points near a bumpy sphere of 101,568 triangles, one thread: ours, Embree's point query with the
// callback of its tutorial, and CGAL's AABB tree with its fastest kernel.
#include "compare.h"

#include "meshtween/core/parallel.h"
#include "meshtween/geometry/measure.h"
#include "meshtween/geometry/shapes.h"
#include "meshtween/search/closest_point.h"
#include "meshtween/search/wide_build.h"

#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/AABB_triangle_primitive.h>
#include <CGAL/Simple_cartesian.h>
#include <Eigen/Geometry>
#include <benchmark/benchmark.h>
#include <embree3/rtcore.h>

#include <algorithm>
#include <numeric>
#include <random>

namespace meshtween {
namespace {

constexpr Eigen::Index query_count = 1000000;

Mesh bumpy_sphere() {
    Mesh mesh = bar({1, 1, 1}, {92, 92, 92});
    for (auto&& p : mesh.positions.rowwise()) {
        const Point n = Point(p - Point(0.5, 0, 0)).normalized();
        p = n * (1 + 0.1 * std::sin(5 * n[0]) * std::cos(7 * n[1]) + 0.03 * std::sin(23 * n[2] + 11 * n[0]));
    }
    return mesh;
}

// Queries along the normals of points spread over the faces, in the mesh's order or shuffled; the hints are the answers
// for the same queries before they went half of their way to the surface, as from one round of a fit to the next.
struct Scene {
    Mesh mesh = bumpy_sphere();
    ClosestPointIndex index{mesh};
    Points ordered{query_count, 3}, random{query_count, 3}, moved{query_count, 3};
    std::vector<int> hints;

    Scene() {
        std::mt19937_64 generator(1);
        std::uniform_real_distribution<double> unit(0, 1);
        std::normal_distribution<double> offset(0, 0.005 * diagonal(mesh));
        const Points normals = vertex_normals(mesh.positions, mesh.triangles);
        for (Eigen::Index i = 0; i < query_count; ++i) {
            const int t = static_cast<int>(i * mesh.triangles.rows() / query_count);
            const double u = std::sqrt(unit(generator)), v = unit(generator);
            const SurfacePoint where{t, {1 - u, u * (1 - v), u * v}};
            ordered.row(i) = position(mesh.positions, mesh.triangles, where) +
                             offset(generator) * position(normals, mesh.triangles, where);
        }
        std::vector<Eigen::Index> shuffled(query_count);
        std::iota(shuffled.begin(), shuffled.end(), 0);
        std::shuffle(shuffled.begin(), shuffled.end(), generator);
        for (Eigen::Index i = 0; i < query_count; ++i)
            random.row(i) = ordered.row(shuffled[static_cast<std::size_t>(i)]);
        const std::vector<ClosestPoint> before = index.closest(ordered);
        for (Eigen::Index i = 0; i < query_count; ++i) {
            const ClosestPoint& answer = before[static_cast<std::size_t>(i)];
            hints.push_back(answer.where.triangle);
            moved.row(i) = 0.5 * (ordered.row(i) + answer.position);
        }
    }
};

const Scene& scene() {
    static const Scene it;
    return it;
}

using Kernel = CGAL::Simple_cartesian<double>;
using Faces = std::vector<Kernel::Triangle_3>;
using CgalTree =
    CGAL::AABB_tree<CGAL::AABB_traits<Kernel, CGAL::AABB_triangle_primitive<Kernel, Faces::const_iterator>>>;

const CgalTree& cgal_tree() {
    static Faces faces;
    static CgalTree tree;
    if (faces.empty()) {
        const Mesh& mesh = scene().mesh;
        const auto corner = [&](Eigen::Index t, int k) {
            const Point p = mesh.positions.row(mesh.triangles(t, k));
            return Kernel::Point_3(p[0], p[1], p[2]);
        };
        for (Eigen::Index t = 0; t < mesh.triangles.rows(); ++t)
            faces.emplace_back(corner(t, 0), corner(t, 1), corner(t, 2));
        tree.insert(faces.begin(), faces.end());
        tree.accelerate_distance_queries();
    }
    return tree;
}

void with_cgal(benchmark::State& state, const Points& queries) {
    const CgalTree& tree = cgal_tree();
    for (auto _ : state)
        for (const auto& q : queries.rowwise())
            benchmark::DoNotOptimize(tree.closest_point_and_primitive(Kernel::Point_3(q[0], q[1], q[2])));
}

// Embree's tutorial "closest_point", its function of the same name (after Ericson), in float as all of Embree.
using Float3 = Eigen::Vector3f;
Float3 closest_on_triangle(const Float3& p, const Float3& a, const Float3& b, const Float3& c) {
    const Float3 ab = b - a, ac = c - a, ap = p - a;
    const float d1 = ab.dot(ap), d2 = ac.dot(ap);
    if (d1 <= 0 && d2 <= 0) return a;
    const Float3 bp = p - b;
    const float d3 = ab.dot(bp), d4 = ac.dot(bp);
    if (d3 >= 0 && d4 <= d3) return b;
    const Float3 cp = p - c;
    const float d5 = ab.dot(cp), d6 = ac.dot(cp);
    if (d6 >= 0 && d5 <= d6) return c;
    const float vc = d1 * d4 - d3 * d2;
    if (vc <= 0 && d1 >= 0 && d3 <= 0) return a + d1 / (d1 - d3) * ab;
    const float vb = d5 * d2 - d1 * d6;
    if (vb <= 0 && d2 >= 0 && d6 <= 0) return a + d2 / (d2 - d6) * ac;
    const float va = d3 * d6 - d5 * d4;
    if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0) return b + (d4 - d3) / (d4 - d3 + d5 - d6) * (c - b);
    const float scale = 1 / (va + vb + vc);
    return a + vb * scale * ab + vc * scale * ac;
}

struct EmbreeScene {
    RTCDevice device = rtcNewDevice("threads=1");
    RTCScene scene = rtcNewScene(device);
    const float* vertices = nullptr;
    const unsigned* triangles = nullptr;

    explicit EmbreeScene(const Mesh& mesh) {
        const RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
        const auto n = static_cast<std::size_t>(mesh.positions.rows()),
                   m = static_cast<std::size_t>(mesh.triangles.rows());
        auto* v = static_cast<float*>(
            rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 3 * sizeof(float), n));
        auto* t = static_cast<unsigned*>(
            rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 3 * sizeof(unsigned), m));
        std::transform(mesh.positions.data(), mesh.positions.data() + 3 * n, v, [](double x) { return float(x); });
        std::copy(mesh.triangles.data(), mesh.triangles.data() + 3 * m, t);
        vertices = v;
        triangles = t;
        rtcSetGeometryBuildQuality(geometry, RTC_BUILD_QUALITY_HIGH);
        rtcCommitGeometry(geometry);
        rtcAttachGeometry(scene, geometry);
        rtcReleaseGeometry(geometry);
        rtcSetSceneBuildQuality(scene, RTC_BUILD_QUALITY_HIGH);
        rtcCommitScene(scene);
    }
};

struct EmbreeAnswer {
    const EmbreeScene* scene;
    Float3 query, position;
    unsigned triangle;
};

bool embree_visit(RTCPointQueryFunctionArguments* arguments) {
    auto& answer = *static_cast<EmbreeAnswer*>(arguments->userPtr);
    const unsigned* t = answer.scene->triangles + 3 * arguments->primID;
    const auto corner = [&](int k) { return Eigen::Map<const Float3>(answer.scene->vertices + 3 * t[k]); };
    const Float3 p = closest_on_triangle(answer.query, corner(0), corner(1), corner(2));
    const float distance = (p - answer.query).norm();
    if (distance >= arguments->query->radius) return false;
    arguments->query->radius = distance;
    answer.position = p;
    answer.triangle = arguments->primID;
    return true;
}

void with_embree(benchmark::State& state, const Points& queries) {
    static const EmbreeScene embree(scene().mesh);
    for (auto _ : state)
        for (const auto& q : queries.rowwise()) {
            RTCPointQuery query{float(q[0]), float(q[1]), float(q[2]), 0, std::numeric_limits<float>::infinity()};
            EmbreeAnswer answer{&embree, {query.x, query.y, query.z}, Float3::Zero(), 0};
            RTCPointQueryContext context;
            rtcInitPointQueryContext(&context);
            rtcPointQuery(embree.scene, &query, &context, embree_visit, &answer);
            benchmark::DoNotOptimize(answer);
        }
}

void one_by_one(benchmark::State& state, const Points& queries, const std::vector<int>& hints) {
    const ClosestPointIndex& index = scene().index;
    for (auto _ : state)
        for (Eigen::Index i = 0; i < queries.rows(); ++i)
            benchmark::DoNotOptimize(
                index.closest(Point(queries.row(i)), hints.empty() ? -1 : hints[static_cast<std::size_t>(i)]));
}

void batch(benchmark::State& state, const Points& queries, const std::vector<int>& hints) {
    const ClosestPointIndex& index = scene().index;
    set_threads(1);
    for (auto _ : state) benchmark::DoNotOptimize(index.closest(queries, hints));
    set_threads(0);
}

void build(benchmark::State& state) {
    set_threads(1);
    for (auto _ : state) benchmark::DoNotOptimize(ClosestPointIndex(scene().mesh));
    set_threads(0);
}

template <typename Run, typename... Arguments>
void add(const std::string& name, Run run, Arguments... arguments) {
    benchmark::RegisterBenchmark(name.c_str(), run, arguments...)->Iterations(1)->Unit(benchmark::kMillisecond);
}

void register_peers(const std::string& all) {
    add(all + "embree/ordered", [](benchmark::State& s) { with_embree(s, scene().ordered); });
    add(all + "embree/random", [](benchmark::State& s) { with_embree(s, scene().random); });
    add(all + "embree/moved", [](benchmark::State& s) { with_embree(s, scene().moved); });
    add(all + "cgal/ordered", [](benchmark::State& s) { with_cgal(s, scene().ordered); });
    add(all + "cgal/random", [](benchmark::State& s) { with_cgal(s, scene().random); });
}

void register_ours(const std::string& all, const search::NamedSearch& path) {
    const std::string ours = all + path.name + "/", title = std::string(path.name) + ", ";
    const auto add_ours = [&](const std::string& name, auto run) {
        add(ours + name, [path, run](benchmark::State& state) {
            search::use_search(path.search);
            run(state);
            search::use_search(nullptr);
        });
    };
    add_ours("ordered", [](benchmark::State& s) { batch(s, scene().ordered, {}); });
    add_ours("random", [](benchmark::State& s) { batch(s, scene().random, {}); });
    add_ours("ordered_one_by_one", [](benchmark::State& s) { one_by_one(s, scene().ordered, {}); });
    add_ours("moved_one_by_one", [](benchmark::State& s) { one_by_one(s, scene().moved, {}); });
    add_ours("moved_hints", [](benchmark::State& s) { one_by_one(s, scene().moved, scene().hints); });
    for (const std::string order : {"ordered", "random"}) {
        compare(title + order + ": Embree", all + "embree/" + order, ours + order, 2);
        compare(title + order + ": CGAL", all + "cgal/" + order, ours + order, 4);
    }
    compare(title + "ordered, one call a query: Embree", all + "embree/ordered", ours + "ordered_one_by_one", 1);
    compare(title + "last answer as hint: Embree", all + "embree/moved", ours + "moved_hints", 3);
    compare(title + "last answer as hint: ours without", ours + "moved_one_by_one", ours + "moved_hints", 2);
}

bool register_all() {
    const std::string all = "closest_point/";
    register_peers(all);
    for (const auto& path : search::searches()) register_ours(all, path);
    add(all + "build", build);
    return true;
}
const bool registered = register_all();

} // namespace
} // namespace meshtween
