// What a ray meets first.
#pragma once

#include "meshtween/core/mesh.h"

#include <limits>
#include <memory>

namespace meshtween {

struct RayHit {
    int triangle = -1;                                         // none
    double distance = std::numeric_limits<double>::infinity(); // along the direction, in its lengths
    bool found() const { return triangle >= 0; }
};

// Prepared once over a mesh, asked often, from any number of threads.
class RayIndex {
public:
    RayIndex(const Points& positions, const Triangles& triangles); // O(n log n); both must outlive it
    ~RayIndex();
    RayIndex(RayIndex&&) noexcept;
    RayIndex& operator=(RayIndex&&) noexcept;

    // The first triangle, from either side, that the ray meets beyond `least`. Triangles seen edge on are not met.
    RayHit first(const Point& origin, const Point& direction, double least = 0) const;

private:
    struct Data;
    std::unique_ptr<const Data> data_;
};

} // namespace meshtween
