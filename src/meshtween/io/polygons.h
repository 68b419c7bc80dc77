// What a mesh file holds, before its polygons are cut into triangles: the common end of every reader.
#pragma once

#include "meshtween/core/mesh.h"
#include "meshtween/io/mesh_file.h"

#include <algorithm>
#include <filesystem>
#include <limits>
#include <optional>
#include <vector>

namespace meshtween {

struct PolygonMesh {
    std::vector<double> coordinates;   // x y z a vertex
    std::vector<int> corners;          // vertex indices, polygon after polygon
    std::vector<int> ends;             // a polygon: where its corners end
    std::vector<float> texcoords;      // u v each
    std::vector<int> texcoord_corners; // beside each corner its index into texcoords, -1 for none; or empty
    std::vector<float> colors;         // r g b a a vertex; or empty
    MeshFile file;                     // what else the reader found; cut_mesh adds the polygons

    void end_polygon() { // more corners than an int can count are refused by require_sound
        ends.push_back(static_cast<int>(std::min<std::size_t>(corners.size(), std::numeric_limits<int>::max())));
    }
};

// Takes u v a corner as the mesh's texture coordinates, those of one vertex that are equal only once, in order of first
// appearance.
void share_texcoords(PolygonMesh& polygons, const std::vector<float>& wedges);

// m x 3: the triangles as indices into `corners`. A polygon whose fan from its first corner turns no triangle over is
// cut so, whatever its shape, which cuts a model alike in most poses; the others are cut by clipping ears. Corners that
// repeat the one before are passed over in polygons of more than three.
Triangles cut_polygons(const PolygonMesh& polygons);

// The polygons cut into these triangles (of vertices), polygon after polygon; nothing where they cannot be.
std::optional<Triangles> cut_like(const PolygonMesh& polygons, const Triangles& triangles);

// Throws Error(file) naming the element: no vertices, no faces, too many of either, an index out of range, a coordinate
// that is not finite.
void require_sound(const PolygonMesh& polygons, const std::filesystem::path& path);

// The mesh with these triangles of cut_polygons.
Mesh cut_mesh(PolygonMesh&& polygons, const Triangles& cut);

} // namespace meshtween
