// A tree with eight children a node and eight triangles a leaf, laid out for vectors of floats; and the searches over
// it, one compiled for each vector width. Like nearest.h it is included where wider instructions are allowed: plain
// structs and arrays alone.
#pragma once

namespace meshtween::search {

constexpr int wide = 8;

struct alignas(64) WideNode {
    float low[3][wide], high[3][wide]; // in the frame; an empty child's box is inside out
    int child[wide];                   // a node, or ~block of a leaf
};

// Triangles as a corner and two edges, in coordinates of their own in which no corner is further than 1 along an axis;
// a short block repeats its last triangle.
struct alignas(64) TriangleBlock {
    float a[3][wide], ab[3][wide], ac[3][wide];
    int triangle[wide];
    double centre[3], scale, unit; // from the mesh's unit: (p - centre) * scale; unit = 1 / scale
    float slack;                   // times (4 + distance from the centre): more than a distance in floats is off
};

// All leaves about a few neighbouring ones: where the last answer's neighbourhood holds all that the answer can be, the
// search need not come down from the root.
constexpr int most_neighbours = 4 * wide;
struct alignas(64) Neighbourhood {
    float low[3][most_neighbours], high[3][most_neighbours]; // in the frame, as in WideNode
    int child[most_neighbours];
    float inside_low[3], inside_high[3]; // no other leaf comes in here
};

struct WideView {
    const WideNode* nodes;
    const TriangleBlock* blocks;
    const Neighbourhood* neighbourhoods;
    const int* home;              // the neighbourhood of each triangle
    double origin[3], scale;      // the frame of the nodes
    const double (*positions)[3]; // of the mesh
    const int (*triangles)[3];    // of the mesh
    const double (*normals)[3];   // a row a triangle
};

struct WideQuery {
    double point[3];
    double normal[3]; // asked of the triangles, with least_cosine, where `compatible`
    double least_cosine;
    bool compatible;
    double squared_distance; // in: the bound, or the hint's; out: the least
    int triangle;            // the one that has it, of several the first; -1 for none within the bound
    double v, w;             // out: barycentric coordinates of its second and third corner
};

// In doubles, by the same operations on every machine: takes a compatible triangle into the answer where it belongs.
void settle(const WideView& tree, WideQuery& query, int triangle);
bool agrees(const WideView& tree, const WideQuery& query, int triangle); // whether it is compatible

// Searches without floats, slowly: for queries so far from the mesh that floats would not tell its parts apart.
void search_far(const WideView& tree, WideQuery& query);

using WideSearch = void (*)(const WideView&, WideQuery&);
void search_plain(const WideView& tree, WideQuery& query);
void search_avx2(const WideView& tree, WideQuery& query); // only where the machine has AVX2 and FMA

} // namespace meshtween::search
