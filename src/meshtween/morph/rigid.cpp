// As-rigid-as-possible paths in closed form: each triangle's edges are blended in a frame that turns with it, and the
// positions follow from one Poisson system that is factorised once.
//   Alexa, Cohen-Or and Levin, As-Rigid-as-Possible Shape Interpolation, 2000 (rotation and stretch apart)
//   Sumner and Popovic, Deformation Transfer for Triangle Meshes, 2004, and Botsch, Sumner, Pauly and Gross,
//   Deformation Transfer for Detail-Preserving Surface Editing, 2006 (the Poisson system)
//   Baran et al. 2009 and Lipman et al. 2005 (rotations relative to neighbours; turns.cpp)
// With R the rotation of a triangle and a, b an edge in both shapes, the edge at u is R(u) ((1 - u) a + u R^T b): its
// stretch is blended linearly. The same shapes come from either end, and they are exact at both.
// Where neighbours turn far against each other, the angle across their edge says which way round (hinges.cpp).
// Where that strains edges much, as in a thick twisted bar, whose turns and stretches do not fit together on the way,
// a middle shape is sought whose lengths do (blended_lengths.cpp), and turns and edges go through it on parabolas.
#include "meshtween/core/parallel.h"
#include "meshtween/geometry/measure.h"
#include "meshtween/geometry/topology.h"
#include "meshtween/morph/blended_lengths.h"
#include "meshtween/morph/hinges.h"
#include "meshtween/morph/methods.h"
#include "meshtween/morph/rigid_motion.h"
#include "meshtween/morph/turns.h"
#include "meshtween/solve/cholesky.h"
#include "meshtween/solve/laplacian.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>

namespace meshtween {
namespace {

using Corners = Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor>;

// Moves a component so that its patch lies against the host's patch as the path says.
struct Hook {
    Attachment patches;
    int component = 0;
    std::vector<int> host_triangles, own_triangles;
    Eigen::Vector3d from, to; // from the host's centre to its own, in the host's frame
};

// The parameter of every vertex, triangle and patch, and of the rigid motion.
struct Times {
    Eigen::VectorXd vertices, triangles, patches;
    double whole = 0;
};

struct Prepared {
    Points from, to;    // centred, the rigid motion taken out
    Points first, last; // as they were given
    Triangles triangles;
    RigidMotion motion;
    Turns turns;
    Hinges hinges;
    std::vector<int> patch_of_triangle;
    Points back_01, back_12; // m x 3: edges of `to`, turned back by the triangle's rotation
    Points bow_01,
        bow_12;      // m x 3: how far the middle's edges, turned back, lie beside the mean; empty without a middle
    Corners weights; // half cotangents
    Lists vertex_triangles;
    std::vector<std::vector<int>> component_vertices;
    std::vector<char> isolated; // vertices of no triangle, which move on straight lines
    int root = 0;
    std::vector<Hook> hooks;
    SparseCholesky poisson;
};

// A third of the areas around each vertex, the mean of both shapes; all ones where there is no area.
Eigen::VectorXd vertex_areas(const Points& from, const Points& to, const Triangles& triangles) {
    Eigen::VectorXd area = Eigen::VectorXd::Zero(from.rows());
    for (Eigen::Index t = 0; t < triangles.rows(); ++t) {
        const double a = triangle_area(from, triangles, t) + triangle_area(to, triangles, t);
        for (int k = 0; k < 3; ++k) area[triangles(t, k)] += a / 6;
    }
    return area.sum() > 0 ? area : Eigen::VectorXd::Ones(from.rows());
}

Point centre_of(const Points& p, const Triangles& triangles, const std::vector<int>& which) {
    Point sum = Point::Zero();
    for (const int t : which)
        for (int k = 0; k < 3; ++k) sum += p.row(triangles(t, k)) / 3;
    return sum / static_cast<double>(which.size());
}

std::vector<Hook> hooks(const Patches& patches, const std::vector<Attachment>& attached, const Quaternions& end,
                        const Points& from, const Points& to, const Triangles& triangles) {
    std::vector<std::vector<int>> members(patches.rotation.size());
    if (!attached.empty())
        for (std::size_t t = 0; t < patches.of_triangle.size(); ++t)
            members[static_cast<std::size_t>(patches.of_triangle[t])].push_back(static_cast<int>(t));
    std::vector<Hook> result;
    for (const Attachment& a : attached) {
        Hook hook;
        hook.patches = a;
        hook.component = patches.component[static_cast<std::size_t>(a.own)];
        hook.host_triangles = members[static_cast<std::size_t>(a.host)];
        hook.own_triangles = members[static_cast<std::size_t>(a.own)];
        const auto offset = [&](const Points& p) -> Eigen::Vector3d {
            return (centre_of(p, triangles, hook.own_triangles) - centre_of(p, triangles, hook.host_triangles))
                .transpose();
        };
        hook.from = offset(from);
        hook.to = end[static_cast<std::size_t>(a.host)].conjugate() * offset(to);
        result.push_back(std::move(hook));
    }
    return result;
}

// A triangle's edges at u from corner k to k + 1, stretched but not turned yet.
TriangleEdges local_edges(const Prepared& s, int t, double u) {
    const auto p = [&](int k) { return s.from.row(s.triangles(t, k)); };
    TriangleEdges edge;
    edge[0] = ((1 - u) * (p(1) - p(0)) + u * s.back_01.row(t)).transpose();
    edge[1] = ((1 - u) * (p(2) - p(1)) + u * s.back_12.row(t)).transpose();
    if (s.bow_01.rows() > 0) {
        edge[0] += 4 * u * (1 - u) * s.bow_01.row(t).transpose();
        edge[1] += 4 * u * (1 - u) * s.bow_12.row(t).transpose();
    }
    edge[2] = -edge[0] - edge[1];
    return edge;
}

// Where a triangle is stretched one way and squeezed the other, blending the stretch linearly makes it larger on the
// way than its areas at both ends say, and a twisted bar fatter. The excess is u (1 - u) (1 - s)(s' - 1) with the
// stretches s and s'. Scaled by this, part of it goes: with none taken edges keep their lengths best, with all areas,
// and in between volumes do (bars of 4 : 1 : 1 twisted by 180 and 270 degrees, to 0.5 %, where none gives 1.4 %). Less
// of it goes where it is large: there lengths are what is left to keep.
double area_correction(const Prepared& s, int t, double u) {
    if (s.bow_01.rows() > 0) return 1; // the middle shape has the right area
    const auto edge = local_edges(s, t, u);
    const auto p = [&](int k) { return Point(s.from.row(s.triangles(t, k))); };
    const double have = edge[0].cross(edge[1]).norm();
    const double first = Point(p(1) - p(0)).cross(Point(p(2) - p(1))).norm();
    const double last = Point(s.back_01.row(t)).cross(Point(s.back_12.row(t))).norm();
    const double want = (1 - u) * first + u * last;
    if (!(have > want && want > 0)) return 1;
    const double excess = (have / want - 1) / 0.06, share = 0.4 / (1 + excess * excess);
    return std::pow(want / have, share / 2);
}

// The right side: at each vertex the edges that its triangles want there, weighted.
Points divergence(const Prepared& s, const Quaternions& rotation, const Eigen::VectorXd& u) {
    std::vector<double> scale(rotation.size());
    parallel_for(s.triangles.rows(), [&](Eigen::Index t) {
        scale[static_cast<std::size_t>(t)] = area_correction(s, static_cast<int>(t), u[t]);
    });
    Points right(s.from.rows(), 3);
    parallel_for(s.from.rows(), [&](Eigen::Index i) {
        Eigen::Vector3d sum = Eigen::Vector3d::Zero();
        for (const int t : s.vertex_triangles[i]) {
            const auto edge = local_edges(s, t, u[t]);
            const auto it = static_cast<std::size_t>(t);
            for (std::size_t k = 0; k < 3; ++k) {
                const auto corner = static_cast<Eigen::Index>(k), before = (corner + 2) % 3;
                if (s.triangles(t, corner) != i) continue;
                sum += scale[it] * (rotation[it] * Eigen::Vector3d(s.weights(t, before) * edge[(k + 2) % 3] -
                                                                   s.weights(t, corner) * edge[k]));
            }
        }
        right.row(i) = sum.transpose();
    });
    return right;
}

void shift(Points& p, const std::vector<int>& vertices, const Point& by) {
    for (const int i : vertices) p.row(i) += by;
}

// Each component came out of the solve at some place of its own.
Points put_together(const Prepared& s, Points p, const Quaternions& patches, const Times& times) {
    const auto straight = [&](Eigen::Index i) -> Point {
        return s.from.row(i) + times.vertices[i] * (s.to.row(i) - s.from.row(i));
    };
    if (!s.component_vertices.empty()) {
        const std::vector<int>& vertices = s.component_vertices[static_cast<std::size_t>(s.root)];
        Point off = Point::Zero();
        for (const int i : vertices) off += straight(i) - p.row(i);
        shift(p, vertices, off / static_cast<double>(vertices.size()));
    }
    for (const Hook& hook : s.hooks) {
        const double u = times.patches[hook.patches.own];
        const Eigen::Vector3d offset =
            patches[static_cast<std::size_t>(hook.patches.host)] * Eigen::Vector3d((1 - u) * hook.from + u * hook.to);
        const Point wanted = centre_of(p, s.triangles, hook.host_triangles) + offset.transpose();
        shift(p, s.component_vertices[static_cast<std::size_t>(hook.component)],
              wanted - centre_of(p, s.triangles, hook.own_triangles));
    }
    for (Eigen::Index i = 0; i < p.rows(); ++i)
        if (s.isolated[static_cast<std::size_t>(i)]) p.row(i) = straight(i);
    return p;
}

Times same_times(const Prepared& s, double u) {
    return {Eigen::VectorXd::Constant(s.from.rows(), u), Eigen::VectorXd::Constant(s.triangles.rows(), u),
            Eigen::VectorXd::Constant(s.turns.patch_count, u), u};
}

Times own_times(const Prepared& s, const Eigen::VectorXd& own, double whole) {
    Times times{own, Eigen::VectorXd(s.triangles.rows()), Eigen::VectorXd::Zero(s.turns.patch_count), whole};
    Eigen::VectorXd members = Eigen::VectorXd::Zero(s.turns.patch_count);
    for (Eigen::Index t = 0; t < s.triangles.rows(); ++t) {
        times.triangles[t] = (own[s.triangles(t, 0)] + own[s.triangles(t, 1)] + own[s.triangles(t, 2)]) / 3;
        const int p = s.patch_of_triangle[static_cast<std::size_t>(t)];
        times.patches[p] += times.triangles[t];
        members[p] += 1;
    }
    times.patches.array() /= members.array();
    return times;
}

Quaternions triangle_rotations(const Prepared& s, const Quaternions& patches, const Eigen::VectorXd& u) {
    const auto edges = [&](int t) { return local_edges(s, t, u[t]); };
    return turned_on_hinges(s.hinges, edges, u, face_rotations(s.turns, patches, u));
}

Points shape_at(const Prepared& s, const Times& times) {
    const Quaternions patches = patch_rotations(s.turns, times.patches);
    const Points right = divergence(s, triangle_rotations(s, patches, times.triangles), times.triangles);
    return placed(s.motion, put_together(s, s.poisson.solve(right), patches, times), times.whole);
}

// An edge turned back by a rotation, for both edges that a triangle is made of.
void turn_back(const Quaternions& rotation, const Points& shape, const Triangles& triangles, Points& edge_01,
               Points& edge_12) {
    edge_01.resize(triangles.rows(), 3);
    edge_12.resize(triangles.rows(), 3);
    parallel_for(triangles.rows(), [&](Eigen::Index t) {
        const Eigen::Quaterniond back = rotation[static_cast<std::size_t>(t)].conjugate();
        const auto p = [&](int k) { return shape.row(triangles(t, k)); };
        edge_01.row(t) = (back * Eigen::Vector3d((p(1) - p(0)).transpose())).transpose();
        edge_12.row(t) = (back * Eigen::Vector3d((p(2) - p(1)).transpose())).transpose();
    });
}

// Where patches are entangled, the angles across edges say which way round they and their triangles turn.
void follow_hinges(Prepared& s, const Topology& top, const FaceField& faces, const Patches& parts) {
    std::vector<char> flags = entangled(faces, parts);
    const auto none = [&] { return std::none_of(flags.begin(), flags.end(), [](char flag) { return flag; }); };
    if (none()) return;
    const auto half_edges = [&](int t) { return local_edges(s, t, 0.5); };
    const Times times = same_times(s, 0.5);
    s.turns = way_round(std::move(s.turns), s.from, s.to, s.triangles, top, faces, parts, half_edges);
    const Quaternions half = face_rotations(s.turns, patch_rotations(s.turns, times.patches), times.triangles);
    flags = misled(flags, s.from, s.to, s.triangles, top, faces, parts, half_edges, half);
    if (none()) return;
    std::vector<char> inside;
    for (const int p : parts.of_triangle) inside.push_back(flags[static_cast<std::size_t>(p)]);
    s.hinges = hinges(s.from, s.to, s.triangles, top, faces, inside, half_edges, half);
}

// Leads the path through a middle shape with the lengths that edges should have there, where they lack much.
void lead_through_middle(Prepared& s, bool closed, int rounds) {
    constexpr double much = 0.002; // mean strain: less is not worth the solves
    const LengthProblem lengths{s.from, s.to, s.triangles, s.weights, s.vertex_triangles, s.poisson, closed};
    const Times half = same_times(s, 0.5);
    const Quaternions patches = patch_rotations(s.turns, half.patches);
    const Points straight =
        s.poisson.solve(divergence(s, triangle_rotations(s, patches, half.triangles), half.triangles));
    const double strain = middle_strain(lengths, straight);
    if (!(strain > much)) return;
    const Points middle = with_blended_lengths(lengths, straight, rounds);
    if (!(middle_strain(lengths, middle) < 0.95 * strain)) return;
    s.turns = by_way_of(std::move(s.turns), face_field(s.from, middle, s.triangles), s.patch_of_triangle);
    const Quaternions turned = face_rotations(s.turns, patch_rotations(s.turns, half.patches), half.triangles);
    turn_back(turned, middle, s.triangles, s.bow_01, s.bow_12);
    parallel_for(s.triangles.rows(), [&](Eigen::Index t) {
        const auto p = [&](int k) { return s.from.row(s.triangles(t, k)); };
        s.bow_01.row(t) -= (p(1) - p(0) + s.back_01.row(t)) / 2;
        s.bow_12.row(t) -= (p(2) - p(1) + s.back_12.row(t)) / 2;
    });
    for (std::size_t n = 0; n < s.hinges.triangles.size(); ++n) // what the hinges turn keeps to their way
        if (s.hinges.inside[n]) {
            s.bow_01.row(s.hinges.triangles[n]).setZero();
            s.bow_12.row(s.hinges.triangles[n]).setZero();
        }
}

} // namespace

Morph rigid_morph(const Mesh& from, const Points& to, const MorphOptions& options, const Progress& progress) {
    if (from.triangles.rows() == 0) return linear_morph(from.positions, to);
    const Triangles& triangles = from.triangles;
    const auto tell = [&](double fraction) { return keep_going(progress, fraction, "preparing the path"); };
    tell(0);
    const Topology top = topology(from.positions.rows(), triangles);
    const RigidMotion motion = best_rigid_motion(from.positions, to, vertex_areas(from.positions, to, triangles));
    Points a = centred_from(motion, from.positions), b = centred_to(motion, to);
    const std::vector<int> component = components(top);
    Corners weights = half_cotangents((edge_lengths(a, triangles) + edge_lengths(b, triangles)) / 2);
    SparseCholesky poisson(held(cotangent_laplacian(a.rows(), triangles, weights), component));
    tell(0.6);
    const FaceField faces = face_field(a, b, triangles);
    const Patches parts = patches(faces, triangles, top, options.patches);
    const std::vector<Attachment> attached = attachments(parts);
    auto s = std::make_shared<Prepared>(Prepared{std::move(a),
                                                 std::move(b),
                                                 from.positions,
                                                 to,
                                                 triangles,
                                                 motion,
                                                 turns(faces, parts, attached),
                                                 {},
                                                 parts.of_triangle,
                                                 {},
                                                 {},
                                                 {},
                                                 {},
                                                 std::move(weights),
                                                 top.vertex_triangles,
                                                 {},
                                                 {},
                                                 root_component(parts),
                                                 {},
                                                 std::move(poisson)});
    const Times last = same_times(*s, 1);
    const Quaternions patch_end = patch_rotations(s->turns, last.patches);
    const Quaternions end = face_rotations(s->turns, patch_end, last.triangles);
    turn_back(end, s->to, triangles, s->back_01, s->back_12);
    follow_hinges(*s, top, faces, parts);
    tell(0.8);
    if (options.rounds > 0) {
        const bool closed =
            std::none_of(top.on_boundary.begin(), top.on_boundary.end(), [](char open) { return open; });
        lead_through_middle(*s, closed, options.rounds);
    }
    for (std::size_t i = 0; i < component.size(); ++i) {
        const auto c = static_cast<std::size_t>(component[i]);
        if (c >= s->component_vertices.size()) s->component_vertices.resize(c + 1);
        s->component_vertices[c].push_back(static_cast<int>(i));
        s->isolated.push_back(s->vertex_triangles[static_cast<std::ptrdiff_t>(i)].empty());
    }
    s->hooks = hooks(parts, attached, patch_end, s->from, s->to, triangles);
    tell(1);
    return {[s](double u) { return u == 0   ? s->first
                                   : u == 1 ? s->last
                                            : shape_at(*s, same_times(*s, u)); },
            [s](const Eigen::VectorXd& own, double whole) { return shape_at(*s, own_times(*s, own, whole)); },
            [] { return SolveReport{}; }};
}

} // namespace meshtween
