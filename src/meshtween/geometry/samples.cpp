#include "meshtween/geometry/samples.h"

#include "meshtween/core/error.h"
#include "meshtween/geometry/sample_makers.h"
#include "meshtween/geometry/shapes.h"
#include "meshtween/geometry/subdivide.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <numbers>

namespace meshtween {
namespace {

constexpr double bar_length = 4;

Mesh straight_bar(int subdivisions) {
    return subdivide(bar({bar_length, 1, 1}, {64, 16, 16}, 0.15), subdivisions);
}

// A sample of two shapes of one mesh, whose half-way shape is known.
Sample same_mesh(Mesh source, Points target, Points middle) {
    Sample sample;
    sample.same_connectivity = true;
    sample.target = source;
    sample.target.positions = target;
    sample.truth = std::move(target);
    sample.middle = std::move(middle);
    sample.source = std::move(source);
    return sample;
}

Sample bar_bend(int subdivisions) {
    const Mesh straight = straight_bar(subdivisions);
    const double angle = std::numbers::pi;
    return same_mesh(straight, bend(straight.positions, bar_length, angle),
                     bend(straight.positions, bar_length, angle / 2));
}

Sample bar_twist(int subdivisions) {
    const Mesh straight = straight_bar(subdivisions);
    const double angle = std::numbers::pi;
    return same_mesh(straight, twist(straight.positions, bar_length, angle),
                     twist(straight.positions, bar_length, angle / 2));
}

Sample sphere_turn(int subdivisions) {
    const Mesh ball = sphere(4 + subdivisions);
    const Point axis(1, 2, 0.5);
    const double angle = 2 * std::numbers::pi / 3;
    return same_mesh(ball, turn(ball.positions, axis, angle), turn(ball.positions, axis, angle / 2));
}

struct Entry {
    SampleInfo info;
    Sample (*make)(int subdivisions);
};

const std::vector<Entry>& entries() {
    static const std::vector<Entry> all{
        {{"bow", "a standing woman and a bowing man; two meshes, 40 markers"}, bow_sample},
        {{"bow-pose", "a woman who stands, and the same who bows; one mesh"}, bow_pose_sample},
        {{"build", "a woman and a man in one pose; two meshes, 40 markers"}, build_sample},
        {{"arms", "a woman, her arms down and raised; two meshes, 40 markers"}, arms_sample},
        {{"head", "two heads of different features, one turned; two meshes, 40 markers"}, head_sample},
        {{"scan", "a head, and a scan of another's face with a hole in it; two meshes, 24 markers"}, scan_sample},
        {{"bust", "a head with eyes and teeth, and another's scan with a table and bits; two meshes, 40 markers"},
         bust_sample},
        {{"torus", "a fat ring and a thin, wavy one; two meshes, 32 markers, genus 1"}, torus_sample},
        {{"cup", "two cups with two handles each; two meshes, 26 markers, genus 2"}, cup_sample},
        {{"bar-bend", "a straight bar, and the same bent by 180 degrees; one mesh"}, bar_bend},
        {{"bar-twist", "a straight bar, and the same twisted by 180 degrees; one mesh"}, bar_twist},
        {{"sphere-turn", "a sphere, and the same turned by 120 degrees; one mesh"}, sphere_turn},
    };
    return all;
}

} // namespace

const std::vector<SampleInfo>& samples() {
    static const std::vector<SampleInfo> infos = [] {
        std::vector<SampleInfo> list;
        for (const Entry& entry : entries()) list.push_back(entry.info);
        return list;
    }();
    return infos;
}

Sample sample(std::string_view name, int subdivisions) {
    if (subdivisions < 0 || subdivisions > 4)
        throw Error(ErrorKind::argument,
                    fmt::format("a sample cannot be subdivided {} times: give 0 to 4", subdivisions));
    for (const Entry& entry : entries())
        if (entry.info.name == name) {
            Sample made = entry.make(subdivisions);
            made.name = entry.info.name;
            made.description = entry.info.description;
            return made;
        }
    std::vector<std::string> names;
    for (const SampleInfo& info : samples()) names.push_back(info.name);
    throw Error(ErrorKind::argument,
                fmt::format("there is no sample '{}'; there are: {}", name, fmt::join(names, ", ")));
}

} // namespace meshtween
