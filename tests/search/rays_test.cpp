#include "meshtween/search/rays.h"

#include "meshtween/geometry/shapes.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <random>

using namespace meshtween;

namespace {

// By looking at every triangle.
RayHit slowly(const Mesh& mesh, const Point& origin, const Point& direction) {
    RayHit hit;
    for (int t = 0; t < mesh.triangles.rows(); ++t) {
        const Point a = mesh.positions.row(mesh.triangles(t, 0)), b = mesh.positions.row(mesh.triangles(t, 1)),
                    c = mesh.positions.row(mesh.triangles(t, 2));
        const Point n = (b - a).cross(c - a);
        const double distance = n.dot(a - origin) / n.dot(direction);
        if (!(distance > 0) || distance >= hit.distance) continue;
        const Point p = origin + distance * direction;
        if (n.dot((b - a).cross(p - a)) < 0 || n.dot((c - b).cross(p - b)) < 0 || n.dot((a - c).cross(p - c)) < 0)
            continue;
        hit = {t, distance};
    }
    return hit;
}

TEST(Rays, MeetWhatASlowSearchMeetsFirst) {
    Mesh mesh = sphere(3);
    mesh.positions.col(1) *= 2;
    for (const double shift : {0.0, 1e4}) {
        mesh.positions.array() += shift;
        const RayIndex rays(mesh.positions, mesh.triangles);
        std::mt19937 random(7);
        std::uniform_real_distribution<double> unit(-1, 1);
        int met = 0;
        for (int i = 0; i < 500; ++i) {
            const Point origin = Point(3 * unit(random), 3 * unit(random), 3 * unit(random)).array() + shift,
                        direction(unit(random), unit(random), unit(random));
            const RayHit have = rays.first(origin, direction), want = slowly(mesh, origin, direction);
            EXPECT_EQ(have.triangle, want.triangle);
            EXPECT_NEAR(want.found() ? have.distance : 1, want.found() ? want.distance : 1, 1e-6);
            met += want.found() ? 1 : 0;
        }
        EXPECT_GT(met, 30);
        EXPECT_LT(met, 400);
        mesh.positions.array() -= shift;
    }
}

TEST(Rays, BeginBeyondTheLeastDistance) {
    const Mesh box = bar({2, 2, 2}, {1, 1, 1});
    const RayIndex rays(box.positions, box.triangles);
    const Point middle = box.positions.colwise().mean(), from = middle - Point(3, 0.1, 0.2);
    const RayHit near = rays.first(from, {1, 0, 0}), far = rays.first(from, {1, 0, 0}, 2.5);
    EXPECT_NEAR(near.distance, 2, 1e-12);
    EXPECT_NEAR(far.distance, 4, 1e-12);
    EXPECT_FALSE(rays.first(from, {-1, 0, 0}).found());
}

} // namespace
