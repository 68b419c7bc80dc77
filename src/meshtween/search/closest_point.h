// The closest point on a surface: what the program does most.
#pragma once

#include "meshtween/core/mesh.h"

#include <concepts>
#include <limits>
#include <memory>
#include <span>
#include <vector>

namespace meshtween {

struct ClosestPoint {
    Point position{0, 0, 0};
    SurfacePoint where; // where.triangle is -1 where nothing was found within the bound
    double squared_distance = std::numeric_limits<double>::infinity();
    bool found() const { return where.triangle >= 0; }
};

// What a closest point must satisfy beside being close.
struct Compatible {
    Point normal{0, 0, 0};    // of the asking point, unit; zero accepts every triangle
    double least_cosine = -1; // between it and the triangle's normal
};

// Whether an index's mesh stays or is going to move.
enum class MeshIs { still, moving };

// Prepared once over a mesh, asked often, from any number of threads. Answers in double.
class ClosestPointIndex {
public:
    // O(n log n). Triangles without area are points and edges like any other. Throws Error(computation) without
    // triangles. One for a moving mesh is made faster; hints help it less.
    ClosestPointIndex(const Points& positions, const Triangles& triangles, MeshIs mesh = MeshIs::still);
    explicit ClosestPointIndex(const Mesh& mesh) : ClosestPointIndex(mesh.positions, mesh.triangles) {}
    ~ClosestPointIndex();
    ClosestPointIndex(ClosestPointIndex&&) noexcept;
    ClosestPointIndex& operator=(ClosestPointIndex&&) noexcept;

    // The same triangles with their vertices elsewhere, as many as before: answers as a new index would, in O(n). The
    // further they went, the slower the searches. Not while another thread asks.
    void move(const Points& positions);

    // The closest point; `hint` is a triangle that is probably near (the last answer's), which bounds the search.
    ClosestPoint closest(const Point& query, int hint = -1) const;

    // The closest point among the compatible triangles no further than max_distance; not found where there is none.
    ClosestPoint closest(const Point& query, const Compatible& compatible,
                         double max_distance = std::numeric_limits<double>::infinity(), int hint = -1) const;

    // Many queries, in parallel; hints empty or one a query. (A template for the type alone: a row of points is one
    // point.)
    template <std::same_as<Points> Queries>
    std::vector<ClosestPoint> closest(const Queries& queries, std::span<const int> hints = {}) const {
        return closest_of_each(queries, hints);
    }

    const Points& normals() const; // m x 3 unit triangle normals, zero rows for triangles without area

private:
    std::vector<ClosestPoint> closest_of_each(const Points& queries, std::span<const int> hints) const;

    struct Data;
    std::unique_ptr<Data> data_;
};

} // namespace meshtween
