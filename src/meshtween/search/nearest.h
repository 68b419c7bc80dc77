// The nearest point of a triangle, for one triangle or a vector of them. This file is compiled for several instruction
// sets, so it includes nothing and all in it has internal linkage: no function of it may be shared with code for a
// lesser machine.
#pragma once

namespace meshtween::search {
namespace {

template <typename T>
struct Vector3 {
    T x, y, z;
};
template <typename T>
inline Vector3<T> operator-(const Vector3<T>& a, const Vector3<T>& b) {
    return {a.x - b.x, a.y - b.y, a.z - b.z};
}
template <typename T>
inline Vector3<T> operator*(const T& s, const Vector3<T>& a) {
    return {s * a.x, s * a.y, s * a.z};
}
template <typename T>
inline T dot(const Vector3<T>& a, const Vector3<T>& b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}
template <typename T>
inline Vector3<T> cross(const Vector3<T>& a, const Vector3<T>& b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
template <typename T>
inline T smaller(const T& a, const T& b) {
    return a < b ? a : b;
}
template <typename T>
inline T larger(const T& a, const T& b) {
    return a > b ? a : b;
}

template <typename T>
struct Nearest {
    T squared_distance;
    T v, w; // barycentric coordinates of the second and third corner
};

// Of the triangle a, a + ab, a + ac, seen from ap away from a. The least of the distances to the three edges and, where
// the query's foot lies inside, to the foot. Each candidate is a point of the triangle whatever the rounding, so that
// slivers and triangles without area need no case of their own. Comparisons are written such that 0/0, from an edge
// without length or a triangle without area, falls on the harmless side.
template <typename T>
inline Nearest<T> nearest(const Vector3<T>& ap, const Vector3<T>& ab, const Vector3<T>& ac) {
    const T zero{}, one = zero + 1;
    const auto along = [&](const Vector3<T>& from, const Vector3<T>& edge) {
        return larger<T>(smaller<T>(dot(from, edge) / dot(edge, edge), one), zero);
    };
    const Vector3<T> bc = ac - ab, bp = ap - ab;
    const T t_ab = along(ap, ab), t_ac = along(ap, ac), t_bc = along(bp, bc);
    const Vector3<T> to_ab = ap - t_ab * ab, to_ac = ap - t_ac * ac, to_bc = bp - t_bc * bc;
    Nearest<T> best{dot(to_ab, to_ab), t_ab, zero};
    const auto offer = [&](const auto& closer, const T& d, const T& v, const T& w) {
        best.squared_distance = closer ? d : best.squared_distance;
        best.v = closer ? v : best.v;
        best.w = closer ? w : best.w;
    };
    const T d_ac = dot(to_ac, to_ac), d_bc = dot(to_bc, to_bc);
    offer(d_ac < best.squared_distance, d_ac, zero, t_ac);
    offer(d_bc < best.squared_distance, d_bc, one - t_bc, t_bc);
    const Vector3<T> n = cross(ab, ac);
    const T per_area = one / dot(n, n);
    const T v = dot(cross(ap, ac), n) * per_area, w = dot(cross(ab, ap), n) * per_area;
    const Vector3<T> to_foot = ap - v * ab - w * ac;
    const T d_foot = dot(to_foot, to_foot);
    offer((v >= zero) & (w >= zero) & (v + w <= one) & (d_foot < best.squared_distance), d_foot, v, w);
    return best;
}

} // namespace
} // namespace meshtween::search
