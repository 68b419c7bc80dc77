// What a template's file holds goes along where its triangles are cut finer.
#include "meshtween/fit/refined_file.h"
#include "meshtween/fit/refined_fit.h"
#include "meshtween/geometry/subdivide.h"
#include "meshtween/io/mesh_io.h"
#include "meshtween/io/output.h"

#include "support/scratch.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace meshtween {
namespace {

// Two squares and a triangle, in two groups and materials.
constexpr const char* strip = "mtllib strip.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 2 0 0\nv 2 1 0\nv 3 0 0\n"
                              "g left\nusemtl red\nf 1 2 3 4\ng right\nusemtl blue\nf 2 5 6 3\nf 5 7 6\n";

TEST(RefinedFile, KeepsGroupsMaterialsAndWhatIsNotCut) {
    Scratch scratch;
    scratch.file("strip.mtl", "newmtl red\nKd 1 0 0\nnewmtl blue\nKd 0 0 1\n");
    const Mesh source = read_mesh(scratch.file("strip.obj", strip));
    const Topology edges = topology(source.positions.rows(), source.triangles);
    std::vector<char> cut(edges.edges.size(), 0);
    for (std::size_t e = 0; e < cut.size(); ++e) // the two edges at the last vertex
        if (edges.edges[e].vertices[1] == 6) cut[e] = 1;
    Mesh finer = subdivide(source, edges, cut);
    const std::vector<int> uncut = uncut_triangles(source.triangles, edges, cut);
    EXPECT_EQ(uncut, (std::vector<int>{0, 1, 2, 3, 4, 4, 4}));
    finer.file = refined_file(source, finer, uncut);
    ASSERT_TRUE(is_described(finer));
    write_mesh(finer, scratch.path("finer.obj"));
    const Mesh again = read_mesh(scratch.path("finer.obj"));
    const MeshFile& file = *again.file;
    ASSERT_EQ(file.ends.size(), 5u); // two squares, three pieces
    EXPECT_EQ(file.ends[1], 8);
    const auto name = [&](std::size_t p) { return file.groups.names[static_cast<std::size_t>(file.groups.of[p])]; };
    const auto material = [&](std::size_t p) {
        return file.materials[static_cast<std::size_t>(file.polygon_materials[p])].name;
    };
    for (std::size_t p = 0; p < 5; ++p) {
        EXPECT_EQ(name(p), p == 0 ? "left" : "right");
        EXPECT_EQ(material(p), p == 0 ? "red" : "blue");
    }
}

TEST(RefinedFile, OfAWholeRefinedFit) {
    Scratch scratch;
    const Mesh source = read_mesh(scratch.file("strip.obj", strip));
    Mesh target = subdivide(source, 3);
    target.positions.col(2) = 0.1 * (3 * target.positions.col(0)).array().sin();
    FitOptions options;
    const RefinedFit done = refined_fit(source, target, {}, options);
    ASSERT_FALSE(done.added.empty());
    ASSERT_TRUE(is_described(done.source));
    const MeshFile& file = *done.source.file;
    ASSERT_EQ(file.groups.of.size(), file.ends.size());
    const std::vector<int> polygon = polygon_of_triangles(file);
    for (Eigen::Index t = 0; t < done.source.triangles.rows(); ++t) {
        double x = 0; // of the triangle's middle in the source
        for (int k = 0; k < 3; ++k) x += done.source.positions(done.source.triangles(t, k), 0) / 3;
        const int group = file.groups.of[static_cast<std::size_t>(polygon[static_cast<std::size_t>(t)])];
        EXPECT_EQ(file.groups.names[static_cast<std::size_t>(group)], x < 1 ? "left" : "right");
    }
}

} // namespace
} // namespace meshtween
