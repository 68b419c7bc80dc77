#include "meshtween/geometry/topology.h"
#include "meshtween/morph/laplacian_coordinates.h"
#include "meshtween/morph/morph.h"
#include "meshtween/solve/laplacian.h"
#include "support/posed.h"

#include <gtest/gtest.h>

namespace meshtween {
namespace {

TEST(LaplacianMorph, HasTheBlendedCoordinates) {
    const Mesh from = test::bar(12, 3);
    const Points to = test::bent(from.positions, 1);
    const Lists neighbours = topology(from.positions.rows(), from.triangles).neighbours;
    const double u = 0.3;
    const Points wanted =
        blended_coordinates(uniform_laplacian(from.positions, neighbours), uniform_laplacian(to, neighbours), u);
    const Points shape = morph(from, to, {.method = MorphMethod::laplacian}).at(u);
    const Points found = uniform_laplacian(shape, neighbours);
    // Every vertex but the held one, the first, satisfies Eq. 8.
    EXPECT_LT((found - wanted).bottomRows(found.rows() - 1).norm(), 1e-8);
    const Point straight = (1 - u) * from.positions.row(0) + u * to.row(0);
    EXPECT_LT((shape.row(0) - straight).norm(), 1e-9);
}

} // namespace
} // namespace meshtween
