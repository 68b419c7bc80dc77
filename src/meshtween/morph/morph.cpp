#include "meshtween/morph/morph.h"

#include "meshtween/core/error.h"
#include "meshtween/geometry/measure.h"
#include "meshtween/io/seams.h"
#include "meshtween/morph/methods.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <array>
#include <memory>
#include <utility>

namespace meshtween {
namespace {

struct Named {
    MorphMethod method;
    std::string_view name;
};
constexpr std::array named{Named{MorphMethod::rigid, "rigid"},
                           Named{MorphMethod::linear, "linear"},
                           Named{MorphMethod::laplacian, "laplacian"},
                           Named{MorphMethod::dual, "dual"},
                           Named{MorphMethod::dual_as_printed, "dual-as-printed"},
                           Named{MorphMethod::edges, "edges"},
                           Named{MorphMethod::dual_mesh, "dual-mesh"}};

void require_sound(const Mesh& from, const Points& to, const MorphOptions& options) {
    if (from.positions.rows() != to.rows())
        throw Error(ErrorKind::argument,
                    fmt::format("the shapes have {} and {} vertices; a morph needs one mesh in two shapes: fit first",
                                from.positions.rows(), to.rows()));
    if (!from.positions.allFinite() || !to.allFinite())
        throw Error(ErrorKind::argument, "a vertex is not finite; `check` names it");
    const Eigen::Index n = from.positions.rows();
    for (Eigen::Index t = 0; t < from.triangles.rows(); ++t)
        if (from.triangles.row(t).minCoeff() < 0 || from.triangles.row(t).maxCoeff() >= n)
            throw Error(ErrorKind::argument, fmt::format("triangle {} names a vertex outside 0..{}", t, n - 1));
    if (!(options.c1 > options.c2 && options.c2 > 0))
        throw Error(ErrorKind::argument,
                    fmt::format("C1 = {} and C2 = {}: Eq. 12 needs C1 > C2 > 0", options.c1, options.c2));
    if (!(options.tolerance > 0) || options.max_sweeps < 1)
        throw Error(ErrorKind::argument, "the solve needs a tolerance above 0 and at least one sweep");
}

} // namespace

void MostLaborious::add(const SolveReport& report) {
    const std::lock_guard lock(mutex_);
    if (report.sweeps >= report_.sweeps) report_ = report;
}

SolveReport MostLaborious::get() const {
    const std::lock_guard lock(mutex_);
    return report_;
}

MorphMethod morph_method(std::string_view name) {
    std::vector<std::string_view> names;
    for (const Named& n : named) {
        if (n.name == name) return n.method;
        names.push_back(n.name);
    }
    throw Error(ErrorKind::argument,
                fmt::format("no method is called \"{}\"; there are {}", name, fmt::join(names, ", ")));
}

std::string_view name_of(MorphMethod method) {
    for (const Named& n : named)
        if (n.method == method) return n.name;
    return "";
}

const std::vector<MorphMethod>& morph_methods() {
    static const std::vector<MorphMethod> all = [] {
        std::vector<MorphMethod> methods;
        for (const Named& n : named) methods.push_back(n.method);
        return methods;
    }();
    return all;
}

namespace {

Morph morph_by_method(const Mesh& from, const Points& to, const MorphOptions& options, const Progress& progress) {
    switch (options.method) {
    case MorphMethod::rigid:
        return rigid_morph(from, to, options, progress);
    case MorphMethod::linear:
        return linear_morph(from.positions, to);
    case MorphMethod::laplacian:
        return laplacian_morph(from, to);
    case MorphMethod::dual:
        return dual_morph(from, to, options, progress);
    case MorphMethod::dual_as_printed:
        return dual_as_printed_morph(from, to, options);
    case MorphMethod::edges:
        return edges_morph(from, to);
    case MorphMethod::dual_mesh:
        return dual_mesh_morph(from, to, options);
    }
    throw Error(ErrorKind::argument, "no such method");
}

// The file's numbering around a path of the welded mesh.
Morph expanded(Morph inner, Weld seams) {
    const auto shared = std::make_shared<const Weld>(std::move(seams));
    Morph result = inner;
    result.at = [shared, at = inner.at](double u) { return shared->expanded(at(u)); };
    result.at_each = [shared, at_each = inner.at_each](const Eigen::VectorXd& own, double whole) {
        const Eigen::VectorXd of_first = own(shared->first);
        return shared->expanded(at_each(of_first, whole));
    };
    return result;
}

// Vertices of no face have no part in the shape's motion and may lie anywhere: they go straight.
Morph straight_strays(Morph inner, const Mesh& from, const Points& to) {
    std::vector<char> used(static_cast<std::size_t>(from.positions.rows()), 0);
    for (const int v : from.triangles.reshaped()) used[static_cast<std::size_t>(v)] = 1;
    std::vector<int> strays;
    for (std::size_t i = 0; i < used.size(); ++i)
        if (used[i] == 0) strays.push_back(static_cast<int>(i));
    if (strays.empty() || from.triangles.rows() == 0) return inner;
    const Points start = from.positions(strays, Eigen::all), way = to(strays, Eigen::all) - start;
    Morph result = inner;
    result.at = [=, at = inner.at](double u) {
        Points x = at(u);
        x(strays, Eigen::all) = start + u * way;
        return x;
    };
    result.at_each = [=, at_each = inner.at_each](const Eigen::VectorXd& own, double whole) {
        Points x = at_each(own, whole);
        x(strays, Eigen::all) = start + own(strays).asDiagonal() * way;
        return x;
    };
    return result;
}

Morph welded_morph(const Mesh& from, const Points& to, const MorphOptions& options, const Progress& progress) {
    if (!options.weld || options.method == MorphMethod::linear) return morph_by_method(from, to, options, progress);
    Weld found = seams(from, {&from.positions, &to});
    if (!found.any()) return morph_by_method(from, to, options, progress);
    Morph inner = morph_by_method(welded(from, found), found.reduced(to), options, progress);
    return expanded(std::move(inner), std::move(found));
}

} // namespace

Morph morph(const Mesh& from, const Points& to, const MorphOptions& options, const Progress& progress) {
    require_sound(from, to, options);
    Morph result = straight_strays(welded_morph(from, to, options, progress), from, to);
    result.diagonal = diagonal(from);
    return result;
}

} // namespace meshtween
