#include "meshtween/geometry/measure.h"
#include "meshtween/io/mesh_io.h"

#include "support/scratch.h"

namespace meshtween {
namespace {

class Obj : public testing::Test {
protected:
    Mesh read(std::string_view contents) const { return read_mesh(scratch.file("mesh.obj", contents)); }
    Scratch scratch;
};

Triangles rows(std::initializer_list<std::array<int, 3>> list) {
    Triangles result(static_cast<Eigen::Index>(list.size()), 3);
    Eigen::Index i = 0;
    for (const auto& row : list) result.row(i++) << row[0], row[1], row[2];
    return result;
}

TEST_F(Obj, IndicesFromOneAndFromTheEnd) {
    const Mesh mesh = read("v 0 0 0\nv 1 0 0\nv 0 1 0\nf -3 -2 -1\nv 0 0 1\nf 1/ 2// 4\nf 1 5 2\nv 9 9 9");
    EXPECT_EQ(mesh.positions.rows(), 5);
    EXPECT_EQ(mesh.triangles, rows({{0, 1, 2}, {0, 1, 3}, {0, 4, 1}}));
}

TEST_F(Obj, DoublesStayDoubles) {
    const Mesh mesh = read("v 0.1 +1e-300 123456789.123456789\nv 1 0 0\nv 0 1e-999 0\nf 1 2 3");
    EXPECT_EQ(mesh.positions(0, 0), 0.1);
    EXPECT_EQ(mesh.positions(0, 1), 1e-300);
    EXPECT_EQ(mesh.positions(0, 2), 123456789.123456789);
    EXPECT_EQ(mesh.positions(2, 1), 0);
}

TEST_F(Obj, LineEndsMarksCommentsAndStatementsOfNoConcern) {
    const Mesh mesh = read("\xEF\xBB\xBF# a cube?\r\nmtllib a.mtl\r\no caf\xC3\xA9\r\nv 0 0 0\r\nv 1 0 \\\r\n  0\r\n"
                           "vn 0 0 1\r\n\r\n\tv 0 1 0 1.0\r\nusemtl x\r\ns off\r\nl 1 2\r\nf 1//1 2//1 \\\r\n3//1\r\n");
    EXPECT_EQ(mesh.positions.rows(), 3);
    EXPECT_EQ(mesh.triangles, rows({{0, 1, 2}}));
    EXPECT_EQ(mesh.colors.rows(), 0);
}

TEST_F(Obj, SeamsKeepTheirTextureCoordinates) {
    const Mesh mesh = read("v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nvt 0 0\nvt 1 0\nvt 0 1\nvt .5 nan\n"
                           "f 1/1 2/2 3/3\nf 2/4 4/1 3/3\nf 1 2 4\n");
    EXPECT_EQ(mesh.texcoord_triangles, rows({{0, 1, 2}, {3, 0, 2}, {4, 4, 4}}));
    ASSERT_EQ(mesh.texcoords.rows(), 5);
    EXPECT_EQ(mesh.texcoords(3, 0), 0.5F);
    EXPECT_EQ(mesh.texcoords(3, 1), 0.0F);
}

TEST_F(Obj, ColoursBehindTheCoordinates) {
    const Mesh mesh = read("v 0 0 0\nv 1 0 0 0 0.5 1\nv 0 1 0 1 0 0 .25\nf 1 2 3");
    ASSERT_EQ(mesh.colors.rows(), 3);
    EXPECT_EQ(mesh.colors.row(0), Eigen::RowVector4f(1, 1, 1, 1));
    EXPECT_EQ(mesh.colors.row(1), Eigen::RowVector4f(0, 0.5, 1, 1));
    EXPECT_EQ(mesh.colors.row(2), Eigen::RowVector4f(1, 0, 0, 0.25));
    EXPECT_EQ(read("v 0 0 0 255 0 51\nv 1 0 0 0 0 0\nv 0 1 0 0 0 0\nf 1 2 3").colors.row(0),
              Eigen::RowVector4f(1, 0, 0.2F, 1));
}

double signed_area(const Mesh& mesh) { // of a flat mesh seen from +z
    double area = 0;
    for (Eigen::Index t = 0; t < mesh.triangles.rows(); ++t)
        area += double_area_normal(mesh.positions, mesh.triangles, t)[2] / 2;
    return area;
}

TEST_F(Obj, PolygonsAreCutIntoTrianglesThatFaceTheSameWay) {
    const struct {
        const char* name;
        const char* file;
        int triangles;
        double area;
    } rows[] = {
        {"square", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4", 2, 1},
        {"arrow, its notch second", "v 0 0 0\nv 1 .5 0\nv 2 0 0\nv 1 2 0\nf 1 2 3 4", 2, 1.5},
        {"arrow, its notch first", "v 1 .5 0\nv 2 0 0\nv 1 2 0\nv 0 0 0\nf 1 2 3 4", 2, 1.5},
        {"a corner in the middle of a side", "v 0 0 0\nv 1 0 0\nv 2 0 0\nv 0 1 0\nf 1 2 3 4", 2, 1},
        {"the letter E",
         "v 0 0 0\nv 3 0 0\nv 3 1 0\nv 1 1 0\nv 1 2 0\nv 3 2 0\nv 3 3 0\nv 1 3 0\nv 1 4 0\nv 3 4 0\nv 3 5 0\n"
         "v 0 5 0\nf 1 2 3 4 5 6 7 8 9 10 11 12",
         10, 11},
        {"a corner named twice", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 2 3 4 1", 2, 1},
    };
    for (const auto& row : rows) {
        const Mesh mesh = read(row.file);
        EXPECT_EQ(mesh.triangles.rows(), row.triangles) << row.name;
        EXPECT_NEAR(signed_area(mesh), row.area, 1e-12) << row.name;
        for (Eigen::Index t = 0; t < mesh.triangles.rows(); ++t)
            EXPECT_GT(double_area_normal(mesh.positions, mesh.triangles, t)[2], 0) << row.name << ", triangle " << t;
    }
}

TEST_F(Obj, ATriangleWithARepeatedVertexIsKept) {
    EXPECT_EQ(read("v 0 0 0\nv 1 0 0\nv 1 1 0\nf 1 2 2\nf 1 2 3").triangles, rows({{0, 1, 1}, {0, 1, 2}}));
}

TEST_F(Obj, TwoPosesOfOneQuadAreCutAlike) {
    const auto flat = scratch.file("a.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4");
    const auto arrow = scratch.file("b.obj", "v 1 .5 0\nv 2 0 0\nv 1 2 0\nv 0 0 0\nf 2 3 4 1");
    const auto notch = scratch.file("c.obj", "v 0 0 0\nv 1 .5 0\nv 2 0 0\nv 1 2 0\nf 1 2 3 4");
    EXPECT_NE(read_mesh(flat).triangles, read_mesh(notch).triangles);
    const std::vector<Mesh> meshes = read_meshes({flat, notch, arrow});
    EXPECT_EQ(meshes[0].triangles, meshes[1].triangles);
    EXPECT_EQ(meshes[0].triangles, meshes[2].triangles) << "whichever corner comes first";
}

} // namespace
} // namespace meshtween
