// Baran, Vlasic, Grinspun and Popovic, Semantic Deformation Transfer, 2009, and Lipman, Sorkine, Levin and Cohen-Or,
// Linear Rotation-Invariant Coordinates for Meshes, 2005: the rotation of a patch is known only up to whole turns, but
// against its neighbour it is small, so those relative rotations are interpolated and then put together.
#include "meshtween/morph/turns.h"

#include "meshtween/core/parallel.h"
#include "meshtween/morph/rotation_graph.h"

#include <algorithm>
#include <cmath>

namespace meshtween {
namespace {

Eigen::Vector3d rotation_vector(Eigen::Quaterniond q) {
    if (q.w() < 0) q.coeffs() *= -1;
    const double s = q.vec().norm();
    return s > 1e-12 ? Eigen::Vector3d(q.vec() * (2 * std::atan2(s, q.w()) / s)) : Eigen::Vector3d(2 * q.vec());
}

// 1 for no rotation, 0 for a half turn, where the way round is anybody's guess.
double certainty(double angle) {
    const double c = (1 + std::cos(angle)) / 2;
    return c * c;
}

double way(const FaceField& faces, Eigen::Index t, const Patches& patches, int p) {
    return (faces.centre_from.row(t) - patches.centre_from.row(p)).norm() +
           (faces.centre_to.row(t) - patches.centre_to.row(p)).norm();
}

FaceTurn face_turn(const FaceField& faces, const Patches& patches, const std::vector<std::vector<int>>& neighbours,
                   Eigen::Index t) {
    const auto it = static_cast<std::size_t>(t);
    const int own = patches.of_triangle[it];
    const auto vector_in = [&](int p) -> Eigen::Vector3d {
        if (faces.area[t] <= 0) return Eigen::Vector3d::Zero(); // no rotation of its own: it goes with the patch
        return rotation_vector(patches.rotation[static_cast<std::size_t>(p)].conjugate() * faces.rotation[it]);
    };
    // Patches that turn far against each other say different things about a triangle between them on the way.
    const auto agreement = [&](int p, int q) {
        return certainty(1.4 * patches.rotation[static_cast<std::size_t>(p)].angularDistance(
                                   patches.rotation[static_cast<std::size_t>(q)]));
    };
    FaceTurn turn;
    turn.patch.fill(own);
    turn.rotation_vector.fill(Eigen::Vector3f::Zero());
    turn.rotation_vector[0] = vector_in(own).cast<float>();
    if (faces.area[t] <= 0) return turn;
    const double here = way(faces, t, patches, own);
    std::vector<std::pair<double, int>> others;
    for (const int p : neighbours[static_cast<std::size_t>(own)]) {
        const double apart = (patches.centre_from.row(p) - patches.centre_from.row(own)).norm() +
                             (patches.centre_to.row(p) - patches.centre_to.row(own)).norm();
        const double fade = 1 - (way(faces, t, patches, p) - here) / (0.5 * apart);
        if (fade > 0) others.emplace_back(-std::min(1.0, fade * fade), p);
    }
    std::sort(others.begin(), others.end());
    for (std::size_t k = 0; k < std::min(others.size(), FaceTurn::most - 1); ++k) {
        const Eigen::Vector3d vector = vector_in(others[k].second);
        turn.patch[k + 1] = others[k].second;
        turn.weight[k + 1] =
            static_cast<float>(-others[k].first * certainty(vector.norm()) * agreement(own, others[k].second));
        turn.rotation_vector[k + 1] = vector.cast<float>();
    }
    return turn;
}

// A rotation vector on its way: straight, or on a parabola.
Eigen::Vector3d on_the_way(double u, const Eigen::Vector3d& vector, const Eigen::Vector3d& bow) {
    return u * vector + 4 * u * (1 - u) * bow;
}

} // namespace

Eigen::Quaterniond exponential(const Eigen::Vector3d& v) {
    const double angle = v.norm();
    Eigen::Quaterniond q;
    q.w() = std::cos(angle / 2);
    q.vec() = v * (angle > 1e-8 ? std::sin(angle / 2) / angle : 0.5);
    return q;
}

Turns turns(const FaceField& faces, const Patches& patches, const std::vector<Attachment>& attached) {
    Turns result;
    const auto n = patches.rotation.size();
    result.patch_count = static_cast<int>(n);
    std::vector<std::vector<int>> neighbours(n);
    double total = 0;
    for (const PatchLink& link : patches.links) {
        neighbours[static_cast<std::size_t>(link.first)].push_back(link.second);
        neighbours[static_cast<std::size_t>(link.second)].push_back(link.first);
        total += link.length;
    }
    const auto add = [&](int p, int q, double weight) {
        const Eigen::Vector3d vector = rotation_vector(patches.rotation[static_cast<std::size_t>(p)].conjugate() *
                                                       patches.rotation[static_cast<std::size_t>(q)]);
        // Steep: where loops disagree, small rotations decide and large ones follow, or the sum could vanish on the
        // way.
        result.links.push_back({p, q, vector, weight * (std::exp(-6 * vector.squaredNorm()) + 1e-6)});
    };
    const double mean = patches.links.empty() ? 1 : total / static_cast<double>(patches.links.size());
    for (const PatchLink& link : patches.links) add(link.first, link.second, link.length / mean + 1e-6);
    for (const Attachment& a : attached) add(a.host, a.own, 1);
    double least = -1;
    for (std::size_t p = 0; p < n; ++p) // the largest |w| is the smallest angle
        if (const double w = std::abs(patches.rotation[p].w()); w > least + 1e-9) {
            least = w;
            result.root = static_cast<int>(p);
        }
    if (n > 0) result.root_vector = rotation_vector(patches.rotation[static_cast<std::size_t>(result.root)]);
    result.faces.resize(patches.of_triangle.size());
    parallel_for(static_cast<Eigen::Index>(result.faces.size()), [&](Eigen::Index t) {
        result.faces[static_cast<std::size_t>(t)] = face_turn(faces, patches, neighbours, t);
    });
    return result;
}

Turns by_way_of(Turns turns, const FaceField& to_middle, const std::vector<int>& patch_of_triangle) {
    const Quaternions patch = mean_rotations(to_middle, patch_of_triangle, turns.patch_count);
    const auto of = [&](int p) { return patch[static_cast<std::size_t>(p)]; };
    for (PatchTurn& link : turns.links)
        link.bow = rotation_vector(of(link.first).conjugate() * of(link.second)) - link.rotation_vector / 2;
    if (turns.patch_count > 0) turns.root_bow = rotation_vector(of(turns.root)) - turns.root_vector / 2;
    turns.face_bows.resize(turns.faces.size());
    parallel_for(static_cast<Eigen::Index>(turns.faces.size()), [&](Eigen::Index t) {
        const FaceTurn& face = turns.faces[static_cast<std::size_t>(t)];
        auto& bows = turns.face_bows[static_cast<std::size_t>(t)];
        bows.fill(Eigen::Vector3f::Zero());
        if (to_middle.area[t] <= 0) return;
        for (std::size_t k = 0; k < FaceTurn::most; ++k)
            bows[k] = rotation_vector(of(face.patch[k]).conjugate() * to_middle.rotation[static_cast<std::size_t>(t)])
                          .cast<float>() -
                      face.rotation_vector[k] / 2;
    });
    return turns;
}

Quaternions patch_rotations(const Turns& turns, const Eigen::VectorXd& u) {
    std::vector<RotationLink> links;
    for (const PatchTurn& link : turns.links) {
        const double own = (u[link.first] + u[link.second]) / 2;
        links.push_back({link.first, link.second,
                         exponential(on_the_way(own, link.rotation_vector, link.bow)).toRotationMatrix(), link.weight});
    }
    const Eigen::Vector3d root = on_the_way(u[turns.root], turns.root_vector, turns.root_bow);
    return synchronised(turns.patch_count, links, {{turns.root, exponential(root).toRotationMatrix()}});
}

Quaternions face_rotations(const Turns& turns, const Quaternions& patches, const Eigen::VectorXd& u) {
    Quaternions rotations(turns.faces.size());
    parallel_for(static_cast<Eigen::Index>(turns.faces.size()), [&](Eigen::Index t) {
        const FaceTurn& face = turns.faces[static_cast<std::size_t>(t)];
        const auto seen_from = [&](std::size_t k) {
            const Eigen::Vector3d vector = face.rotation_vector[k].cast<double>();
            const Eigen::Vector3d bow = turns.face_bows.empty()
                                            ? Eigen::Vector3d(0, 0, 0)
                                            : turns.face_bows[static_cast<std::size_t>(t)][k].cast<double>();
            return patches[static_cast<std::size_t>(face.patch[k])] * exponential(on_the_way(u[t], vector, bow));
        };
        const Eigen::Quaterniond own = seen_from(0);
        Eigen::Vector4d sum = own.coeffs();
        for (std::size_t k = 1; k < FaceTurn::most && face.weight[k] > 0; ++k) {
            const Eigen::Vector4d q = seen_from(k).coeffs();
            sum += (q.dot(own.coeffs()) < 0 ? -face.weight[k] : face.weight[k]) * q;
        }
        rotations[static_cast<std::size_t>(t)].coeffs() = sum.normalized();
    });
    return rotations;
}

} // namespace meshtween
