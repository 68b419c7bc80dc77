// Every verb, run as a user would.
#include "support/cut.h"
#include "support/program.h"

#include "meshtween/geometry/measure.h"
#include "meshtween/geometry/shapes.h"
#include "meshtween/io/markers.h"
#include "meshtween/io/mesh_io.h"
#include "meshtween/io/table.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <fstream>
#include <sstream>

namespace {

using Json = nlohmann::json;

Json read_json(const std::filesystem::path& path) {
    std::ifstream in(path);
    return Json::parse(in);
}

class Verbs : public testing::Test {
protected:
    std::string file(const std::string& name) const { return (folder_ / name).string(); }
    Ran run(const std::vector<std::string>& arguments) const {
        Ran ran = run_program(arguments);
        EXPECT_EQ(ran.status, 0) << ran.err;
        return ran;
    }
    void sample(const std::string& name) const { run({"sample", name, "-o", folder_.path().string()}); }
    // A ball, a finer egg of its shape, and a dozen markers between them: quickly fitted.
    void egg() const {
        const auto longer = [](meshtween::Mesh mesh) {
            mesh.positions.col(1) *= 1.3;
            return mesh;
        };
        const meshtween::Mesh ball = meshtween::sphere(3), egg = longer(meshtween::sphere(4));
        meshtween::write_mesh(ball, folder_ / "ball.ply");
        meshtween::write_mesh(egg, folder_ / "egg.ply");
        std::vector<meshtween::MarkerPair> markers;
        for (int i = 0; i < 12; ++i)
            markers.push_back({"m" + std::to_string(i), ball.positions.row(i), egg.positions.row(i)});
        meshtween::write_marker_pairs(markers, folder_ / "egg.csv");
    }
    TemporaryFolder folder_;
};

TEST_F(Verbs, VersionAndHelpGoToStandardOutput) {
    EXPECT_FALSE(run({"--version"}).out.empty());
    for (const char* verb : {"morph", "fit", "tween", "blend", "rotate", "measure", "check", "sample", "transfer"}) {
        const Ran ran = run({verb, "--help"});
        EXPECT_NE(ran.out.find("Example"), std::string::npos) << verb;
    }
}

TEST_F(Verbs, MorphWritesEveryKindAndAReport) {
    sample("build");
    run({"morph", file("build_source.ply"), file("build_target.ply"), "--markers", file("build_markers.csv"), "-o",
         file("m.glb"), "-o", file("m.html"), "-o", file("m.png"), "-o", file("f_###.ply"), "--frames", "3", "--report",
         file("r.json")});
    for (const char* name : {"m.glb", "m.html", "m.png", "f_000.ply", "f_001.ply", "f_002.ply", "r.json"})
        EXPECT_TRUE(std::filesystem::file_size(folder_ / name) > 100) << name;
    const Json report = read_json(folder_ / "r.json");
    EXPECT_EQ(report["verb"], "morph");
    EXPECT_EQ(report["outputs"].size(), 6u);
    EXPECT_LT(report["fit"]["quality"]["fitted_to_target"]["mean"], 0.3);
    const auto source = meshtween::read_mesh(folder_ / "build_source.ply"),
               first = meshtween::read_mesh(folder_ / "f_000.ply");
    EXPECT_EQ(source.triangles, first.triangles);
    EXPECT_LT((source.positions - first.positions).cwiseAbs().maxCoeff(), 1e-9);
}

TEST_F(Verbs, FitThenMeasureAgreesWithTheReport) {
    sample("build");
    run({"fit", file("build_source.ply"), file("build_target.ply"), "--markers", file("build_markers.csv"), "-o",
         file("fitted.ply"), "--report", file("r.json")});
    const Json measured =
        Json::parse(run({"measure", file("build_source.ply"), file("fitted.ply"), file("build_target.ply"), "--markers",
                         file("build_markers.csv"), "--truth", file("build_truth.csv")})
                        .out);
    const Json reported = read_json(folder_ / "r.json")["fit"]["quality"];
    EXPECT_NEAR(measured["target_to_fitted"]["mean"], reported["target_to_fitted"]["mean"], 1e-6);
    EXPECT_TRUE(measured.contains("truth_error"));
    EXPECT_TRUE(measured.contains("marker_error"));
}

TEST_F(Verbs, MarkersExactEndsOnTheMarkersAndSeedsReachTheMeasures) {
    egg();
    const auto fit_with_seed = [&](const char* seed) {
        run({"fit", file("ball.ply"), file("egg.ply"), "--markers", file("egg.csv"), "--markers-exact", "--seed", seed,
             "-o", file("fitted.ply"), "--report", file("r.json")});
        return read_json(folder_ / "r.json")["fit"]["quality"];
    };
    const Json one = fit_with_seed("1"), two = fit_with_seed("2");
    EXPECT_LT(one["marker_error"]["max"], 1e-7); // percent
    EXPECT_NE(one["fitted_to_target"]["mean"], two["fitted_to_target"]["mean"]);
    EXPECT_EQ(one["eq7"], two["eq7"]);
}

TEST_F(Verbs, OnSurfaceLeavesEveryVertexOnTheTarget) {
    egg();
    const auto quality_with = [&](const std::vector<std::string>& more) {
        std::vector<std::string> arguments{"fit", file("ball.ply"), file("egg.ply"), "--markers",   file("egg.csv"),
                                           "-o",  file("f.ply"),    "--report",      file("f.json")};
        arguments.insert(arguments.end(), more.begin(), more.end());
        run(arguments);
        return read_json(folder_ / "f.json")["fit"]["quality"];
    };
    const Json on = quality_with({"--on-surface"}), lifted = quality_with({});
    EXPECT_LT(on["vertex_to_target"]["max"], 1e-5);
    EXPECT_GT(lifted["vertex_to_target"]["mean"], 1e-2) << "else they are lifted";
    EXPECT_LT(lifted["fitted_to_target"]["mean"], on["fitted_to_target"]["mean"]) << "so that the triangles lie on it";
}

// A cube of quads with all that people choose a template for.
const std::string cube = "mtllib cube.mtl\n# by hand\no box\nv -1 -1 -1\nv -1 1 -1\nv 1 1 -1\nv 1 -1 -1\nv -1 -1 1\n"
                         "v -1 1 1\nv 1 1 1\nv 1 -1 1\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\ng side\nusemtl red\n"
                         "f 4/4 3/3 2/2 1/1\nf 5/1 6/2 7/3 8/4\ng rest\nusemtl blue\ns 1\nf 1/1 2/2 6/3 5/4\n"
                         "f 2/1 3/2 7/3 6/4\nf 3/1 4/2 8/3 7/4\nf 4/1 1/2 5/3 8/4\n";

std::string text_of(const std::filesystem::path& path) {
    std::ifstream in(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

std::string without_vertices(const std::string& text) {
    std::istringstream in(text);
    std::string result;
    for (std::string line; std::getline(in, line);)
        if (line.substr(0, 2) != "v ") result += line + "\n";
    return result;
}

TEST_F(Verbs, AFitKeepsWhatTheTemplateHas) {
    std::filesystem::create_directory(folder_ / "out");
    std::filesystem::create_directory(folder_ / "referring");
    std::ofstream(folder_ / "cube.obj") << cube;
    std::ofstream(folder_ / "cube.mtl") << "newmtl red\nmap_Kd red.png\nnewmtl blue\nKd 0 0 1\n";
    std::ofstream(folder_ / "red.png") << "picture";
    const Ran ran = run({"fit", file("cube.obj"), file("cube.obj"), "-o", file("out/fitted.obj"), "-o",
                         file("out/fitted.ply"), "-o", file("out/fitted.stl")});
    EXPECT_EQ(without_vertices(text_of(folder_ / "out" / "fitted.obj")), without_vertices(cube));
    EXPECT_EQ(text_of(folder_ / "out" / "red.png"), "picture");
    EXPECT_NE(ran.err.find("fitted.ply: left behind 1 object, 2 groups, 1 smoothing group and 2 materials; write .obj"),
              std::string::npos)
        << ran.err;
    EXPECT_EQ(ran.err.find("fitted.obj: left"), std::string::npos) << ran.err;
    run({"tween", file("cube.obj"), file("out/fitted.ply"), "--at", "0.5", "-o", file("referring/half.obj"),
         "--textures", "refer"});
    EXPECT_EQ(without_vertices(text_of(folder_ / "referring" / "half.obj")),
              without_vertices("mtllib ../cube.mtl" + cube.substr(15)));
    EXPECT_FALSE(std::filesystem::exists(folder_ / "referring" / "cube.mtl"));
    // A triangulated copy is the same mesh still.
    meshtween::Mesh triangles = meshtween::read_mesh(folder_ / "cube.obj");
    triangles.file = nullptr;
    meshtween::write_mesh(triangles, folder_ / "triangles.ply");
    run({"measure", file("triangles.ply"), file("out/fitted.obj"), file("cube.obj")});
    run({"measure", file("out/fitted.obj"), file("triangles.ply"), file("cube.obj")});
    run({"blend", file("triangles.ply"), file("cube.obj"), "-o", file("mean.obj")});
}

TEST_F(Verbs, RefinedSourcesServeTween) {
    egg();
    meshtween::write_mesh(meshtween::sphere(2), folder_ / "coarse.ply");
    run({"fit", file("coarse.ply"), file("egg.ply"), "--markers", file("egg.csv"), "-o", file("fitted.ply"), "--refine",
         file("finer.ply"), "--report", file("r.json")});
    const auto coarse = meshtween::read_mesh(folder_ / "coarse.ply"),
               finer = meshtween::read_mesh(folder_ / "finer.ply");
    ASSERT_GT(finer.positions.rows(), coarse.positions.rows());
    EXPECT_EQ(finer.positions.topRows(coarse.positions.rows()), coarse.positions);
    const Json fit = read_json(folder_ / "r.json")["fit"];
    EXPECT_EQ(fit["refined"]["vertices"], finer.positions.rows());
    EXPECT_EQ(fit["quality"]["vertices"], finer.positions.rows());
    run({"tween", file("finer.ply"), file("fitted.ply"), "--at", "0.5", "-o", file("half.ply")});
    run({"morph", file("coarse.ply"), file("egg.ply"), "--markers", file("egg.csv"), "--refine", file("again.ply"),
         "--at", "0", "-o", file("start.ply")});
    EXPECT_EQ(meshtween::read_mesh(folder_ / "start.ply").triangles, finer.triangles);
}

TEST_F(Verbs, TransferCarriesWhatTheFitMatched) {
    egg();
    meshtween::Mesh target = meshtween::read_mesh(folder_ / "egg.ply");
    target.colors = meshtween::Colors::Ones(target.positions.rows(), 4);
    const double low = target.positions.col(1).minCoeff(), high = target.positions.col(1).maxCoeff();
    target.colors.col(0) = ((target.positions.col(1).array() - low) / (high - low)).cast<float>();
    meshtween::write_mesh(target, folder_ / "coloured.ply");
    run({"fit", file("ball.ply"), file("coloured.ply"), "--markers", file("egg.csv"), "-o", file("fitted.ply"), "--map",
         file("map.csv"), "--weights", file("weights.csv"), "--report", file("r.json")});
    run({"fit", file("ball.ply"), file("coloured.ply"), "-o", file("guess.ply"), "--weights", file("trust.ply")});
    EXPECT_GT(meshtween::read_mesh(folder_ / "trust.ply").colors.rows(), 0);

    const auto source = meshtween::read_mesh(folder_ / "ball.ply");
    run({"transfer", file("fitted.ply"), file("coloured.ply"), "--template", file("ball.ply"), "-o",
         file("template.ply")});
    const auto coloured = meshtween::read_mesh(folder_ / "template.ply");
    EXPECT_EQ(coloured.positions, source.positions);
    const meshtween::Points fitted = meshtween::read_mesh(folder_ / "fitted.ply").positions;
    for (Eigen::Index i = 0; i < fitted.rows(); ++i)
        EXPECT_NEAR(coloured.colors(i, 0), (fitted(i, 1) - low) / (high - low), 0.02);

    run({"transfer", file("fitted.ply"), file("coloured.ply"), "--to", "target", "--values", file("weights.csv"),
         "--values-out", file("target_weights.csv")});
    const auto given = meshtween::read_table(folder_ / "weights.csv"),
               got = meshtween::read_table(folder_ / "target_weights.csv");
    EXPECT_EQ(got.names, given.names);
    EXPECT_EQ(got.values.rows(), target.positions.rows());
    EXPECT_LE(got.values.col(0).maxCoeff(), given.values.col(0).maxCoeff());

    std::ofstream(folder_ / "points.csv") << "name,x,y,z\ncrown," << target.positions(0, 0) << ','
                                          << target.positions(0, 1) << ',' << target.positions(0, 2) << '\n';
    run({"transfer", file("fitted.ply"), file("coloured.ply"), "--points", file("points.csv"), "--points-out",
         file("there.csv")});
    std::ifstream there(folder_ / "there.csv");
    std::string header, row;
    std::getline(there, header), std::getline(there, row);
    EXPECT_EQ(row.substr(0, 6), "crown,");

    const Json fit = read_json(folder_ / "r.json")["fit"];
    EXPECT_TRUE(fit["guards"].contains("flips_mended"));
    EXPECT_EQ(fit["guards"]["flips_left"], fit["quality"]["flipped_faces"]);
    EXPECT_EQ(fit["next_markers"].size(), 5u);
    for (const Json& place : fit["worst"]) EXPECT_LT(place["vertex"], source.positions.rows());
}

TEST_F(Verbs, TweenIsExactAtBothEnds) {
    sample("bar-bend");
    const auto from = meshtween::read_mesh(folder_ / "bar-bend_source.ply"),
               to = meshtween::read_mesh(folder_ / "bar-bend_target.ply");
    for (const char* method : {"linear", "laplacian", "dual"}) {
        for (const char* u : {"0", "1"})
            run({"tween", file("bar-bend_source.ply"), file("bar-bend_target.ply"), "--method", method, "--at", u, "-o",
                 file("at" + std::string(u) + ".ply")});
        const double tolerance = 1e-9 * meshtween::diagonal(from);
        EXPECT_LT((meshtween::read_mesh(folder_ / "at0.ply").positions - from.positions).cwiseAbs().maxCoeff(),
                  tolerance)
            << method;
        EXPECT_LT((meshtween::read_mesh(folder_ / "at1.ply").positions - to.positions).cwiseAbs().maxCoeff(), tolerance)
            << method;
    }
}

TEST_F(Verbs, TweenGoesThroughSeveralShapesAndTellsHowWell) {
    sample("bar-bend");
    const std::string a = file("bar-bend_source.ply"), b = file("bar-bend_target.ply");
    run({"tween", a, b, a, "--times", "0,0.25,1", "--frames", "5", "--ping-pong", "-o", file("f_#.ply"), "-o",
         file("x.svg"), "--report", file("r.json")});
    const auto shape = [&](const std::string& name) { return meshtween::read_mesh(name).positions; };
    EXPECT_LT((shape(file("f_1.ply")) - shape(b)).cwiseAbs().maxCoeff(), 1e-9);
    EXPECT_LT((shape(file("f_4.ply")) - shape(a)).cwiseAbs().maxCoeff(), 1e-9);
    EXPECT_EQ(shape(file("f_7.ply")), shape(file("f_1.ply"))); // back again, without the ends
    EXPECT_FALSE(std::filesystem::exists(folder_ / "f_8.ply"));
    std::ifstream svg(folder_ / "x.svg");
    EXPECT_EQ(std::string(std::istreambuf_iterator<char>(svg), {}).substr(0, 4), "<svg");
    const Json path = read_json(folder_ / "r.json")["path"];
    ASSERT_EQ(path["shapes"].size(), 21u); // eleven from key to key
    for (const Json& frame : path["shapes"]) {
        EXPECT_NEAR(frame["volume_ratio"], 1, 0.02);
        EXPECT_EQ(frame["flipped_faces"], 0);
        EXPECT_EQ(frame["self_intersections"], 0);
    }
}

TEST_F(Verbs, TargetsCapTheFileAndTellTheCost) {
    sample("bar-bend");
    const Ran ran = run({"tween", file("bar-bend_source.ply"), file("bar-bend_target.ply"), "--targets", "3", "-o",
                         file("x.glb"), "--report", file("r.json")});
    const Json curve = read_json(folder_ / "r.json")["path"]["curve"];
    EXPECT_EQ(curve["meshes"], 4);
    EXPECT_GT(curve["deviation"], curve["tolerance"]);
    EXPECT_NE(ran.err.find("--targets"), std::string::npos) << ran.err;
}

TEST_F(Verbs, EaseMovesFramesInTime) {
    sample("bar-bend");
    const std::string a = file("bar-bend_source.ply"), b = file("bar-bend_target.ply");
    run({"tween", a, b, "--ease", "in", "--frames", "3", "-o", file("f_#.ply")});
    run({"tween", a, b, "--at", "0.25", "-o", file("q.ply")}); // in: half of the time is a quarter of the way
    const auto middle = meshtween::read_mesh(folder_ / "f_1.ply").positions,
               quarter = meshtween::read_mesh(folder_ / "q.ply").positions;
    EXPECT_LT((middle - quarter).rowwise().norm().maxCoeff(), 1e-4 * meshtween::diagonal(quarter));
}

TEST_F(Verbs, RegionsMoveAtTheirTimes) {
    sample("bar-bend");
    const std::string a = file("bar-bend_source.ply");
    const auto bar = meshtween::read_mesh(a).positions;
    meshtween::Mesh longer = meshtween::read_mesh(a);
    longer.positions.col(1) *= 1.5;
    meshtween::write_mesh(longer, folder_ / "wide.ply");
    Eigen::Index low = 0, high = 0;
    bar.col(0).minCoeff(&low), bar.col(0).maxCoeff(&high);
    std::ofstream(folder_ / "r.csv") << "vertex,start,end\n" << low << ",0,0.4\n" << high << ",0.6,1\n";
    run({"tween", a, file("wide.ply"), "--method", "linear", "--regions", file("r.csv"), "--at", "0.5", "-o",
         file("half.ply")});
    const auto half = meshtween::read_mesh(folder_ / "half.ply").positions;
    EXPECT_NEAR(half(low, 1), 1.5 * bar(low, 1), 0.05 * std::abs(bar(low, 1)));
    EXPECT_NEAR(half(high, 1), bar(high, 1), 0.05 * std::abs(bar(high, 1)));
}

TEST_F(Verbs, RepairBendsWhatCutsItselfUnlessToldNotTo) {
    const auto two_boxes = [&](const std::string& name, double place) { // the second passes through the first
        std::ofstream obj(folder_ / name);
        for (const double shift : {0.0, place})
            for (int i = 0; i < 8; ++i)
                obj << "v " << (i & 1) * 4 + (shift != 0 ? 0.1 : 0) << ' ' << (i >> 1 & 1) + shift << ' '
                    << (i >> 2 & 1) + (shift != 0 ? 0.6 : 0) << '\n';
        for (const int b : {1, 9})
            for (const auto& f :
                 {std::array{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}})
                obj << "f " << b + f[0] << ' ' << b + f[1] << ' ' << b + f[2] << ' ' << b + f[3] << '\n';
    };
    two_boxes("a.obj", -3), two_boxes("b.obj", 3);
    const auto report_with = [&](const std::vector<std::string>& options) {
        std::vector<std::string> all{"tween", file("a.obj"), file("b.obj"), "--method",    "linear",
                                     "-o",    file("x.glb"), "--report",    file("r.json")};
        all.insert(all.end(), options.begin(), options.end());
        run(all);
        const Json path = read_json(folder_ / "r.json")["path"];
        int cuts = 0;
        for (const Json& frame : path["shapes"]) cuts += frame["self_intersections"].get<int>();
        return std::pair(path, cuts);
    };
    EXPECT_GT(report_with({"--no-repair"}).second, 0);
    const auto [path, cuts] = report_with({});
    EXPECT_EQ(cuts, 0);
    EXPECT_GT(path["repair"]["cuts_before"], 0);
    EXPECT_EQ(path["repair"]["places_bent"], 1);
}

TEST_F(Verbs, BlendIsAMeanAndACaricature) {
    sample("build");
    const std::string a = file("build_source.ply");
    meshtween::Mesh other = meshtween::read_mesh(a);
    const auto shape = other.positions;
    other.positions.col(0) *= 1.2;
    meshtween::write_mesh(other, folder_ / "b.ply");
    run({"blend", a, file("b.ply"), "--method", "linear", "-o", file("mean.ply")});
    EXPECT_NEAR((meshtween::read_mesh(folder_ / "mean.ply").positions.col(0) - 1.1 * shape.col(0)).norm(), 0, 1e-9);
    run({"blend", a, file("b.ply"), "--method", "linear", "--weights", "3,-1", "-o", file("over.ply")});
    EXPECT_NEAR((meshtween::read_mesh(folder_ / "over.ply").positions.col(0) - 0.9 * shape.col(0)).norm(), 0, 1e-9);
}

TEST_F(Verbs, QuadsInTwoPosesAreCutAlike) {
    std::ofstream(folder_ / "a.obj") << "v 0 0 0\nv 2 0 0\nv 2 1 0\nv 0 1 0.4\nv 1 1 1\nf 1 2 3 4\nf 1 2 5\n";
    std::ofstream(folder_ / "b.obj") << "v 0 0 0\nv 2 0 0.4\nv 2 1 0\nv 0 1 0\nv 1 1 1\nf 1 2 3 4\nf 1 2 5\n";
    run({"tween", file("a.obj"), file("b.obj"), "--at", "0.5", "-o", file("c.obj")});
}

TEST_F(Verbs, TheSameBitsWithOneAndTwoThreads) {
    sample("build");
    for (const char* threads : {"1", "2"})
        run({"morph", file("build_source.ply"), file("build_target.ply"), "--markers", file("build_markers.csv"),
             "--at", "0.5", "--threads", threads, "-o", file("t" + std::string(threads) + ".ply")});
    const auto bytes = [&](const char* name) {
        std::ifstream in(folder_ / name, std::ios::binary);
        return std::string(std::istreambuf_iterator<char>(in), {});
    };
    EXPECT_EQ(bytes("t1.ply"), bytes("t2.ply"));
}

TEST_F(Verbs, OneTemplateOnTwoTargets) {
    sample("build");
    std::ifstream markers(folder_ / "build_markers.csv");
    std::ofstream self(folder_ / "self.csv"); // the template's own markers on both sides
    for (std::string line; std::getline(markers, line);) {
        std::vector<std::string> cells(1);
        for (const char c : line) {
            if (c == ',')
                cells.emplace_back();
            else
                cells.back() += c;
        }
        ASSERT_EQ(cells.size(), 7u);
        if (cells[1] == "sx") continue;
        const std::string place = cells[1] + "," + cells[2] + "," + cells[3];
        self << cells[0] << ',' << place << ',' << place << '\n';
    }
    self.close();
    run({"morph", file("build_target.ply"), file("build_source.ply"), "--template", file("build_source.ply"),
         "--markers-a", file("build_markers.csv"), "--markers-b", file("self.csv"), "--at", "1", "-o",
         file("one.ply")});
    EXPECT_TRUE(std::filesystem::exists(folder_ / "one.ply"));
}

TEST_F(Verbs, SeamsStayClosed) {
    egg();
    const meshtween::CutMesh flat = meshtween::flat_shaded(meshtween::read_mesh(folder_ / "ball.ply"));
    meshtween::write_mesh(flat.mesh, folder_ / "flat.ply");
    EXPECT_NE(run({"check", file("flat.ply")}).out.find("a seam of the file"), std::string::npos);
    const auto opened = [&](const std::string& name) {
        const meshtween::Points x = meshtween::read_mesh(folder_ / name).positions;
        std::vector<Eigen::Index> first(flat.vertex.size(), -1);
        bool open = false;
        for (std::size_t i = 0; i < flat.vertex.size(); ++i) {
            Eigen::Index& there = first[static_cast<std::size_t>(flat.vertex[i])];
            if (there < 0) there = static_cast<Eigen::Index>(i);
            open = open || x.row(static_cast<Eigen::Index>(i)) != x.row(there);
        }
        return open;
    };
    run({"fit", file("flat.ply"), file("egg.ply"), "--markers", file("egg.csv"), "-o", file("fitted.ply")});
    EXPECT_FALSE(opened("fitted.ply"));
    run({"fit", file("flat.ply"), file("egg.ply"), "--markers", file("egg.csv"), "-o", file("apart.ply"), "--no-weld"});
    EXPECT_TRUE(opened("apart.ply"));
    run({"tween", file("flat.ply"), file("fitted.ply"), "--at", "0.3", "-o", file("between.ply")});
    EXPECT_FALSE(opened("between.ply"));
    const Json measured = Json::parse(run({"measure", file("flat.ply"), file("fitted.ply"), file("egg.ply")}).out);
    EXPECT_EQ(measured["self_intersections"], 0);
    EXPECT_EQ(measured["vertices"], 642);
}

TEST_F(Verbs, CheckSpeaksOnStandardOutput) {
    sample("build");
    const Ran ran = run({"check", file("build_source.ply")});
    EXPECT_NE(ran.out.find("vertices"), std::string::npos);
    std::ofstream(folder_ / "bad.obj") << "v 0 0 0\n";
    EXPECT_EQ(run_program({"check", file("bad.obj")}).status, 3);
    std::ofstream(folder_ / "side.obj") << "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nf 1 2\n";
    EXPECT_NE(run({"check", file("side.obj")}).out.find("fewer than three corners"), std::string::npos);
}

TEST_F(Verbs, RotateTurnsWhatTurnsAndHoldsWhatHolds) {
    sample("bar-bend");
    const auto bar = meshtween::read_mesh(folder_ / "bar-bend_source.ply");
    Eigen::Index low = 0, high = 0;
    bar.positions.col(0).minCoeff(&low), bar.positions.col(0).maxCoeff(&high);
    std::ofstream csv(folder_ / "r.csv");
    csv.precision(17);
    long turning = 0;
    const double x0 = bar.positions(low, 0), x1 = bar.positions(high, 0);
    for (Eigen::Index i = 0; i < bar.positions.rows(); ++i) {
        const double x = bar.positions(i, 0);
        if (x > x0 + 1e-9 && x < x1 - 1e-9) continue;
        csv << i << ',' << x << ',' << bar.positions(i, 1) << ',' << bar.positions(i, 2) << ','
            << (x > (x0 + x1) / 2 ? "turn" : "hold") << '\n';
        turning += x > (x0 + x1) / 2;
    }
    csv.close();
    ASSERT_GT(turning, 0);
    run({"rotate", file("bar-bend_source.ply"), "--markers", file("r.csv"), "--axis", "1,0,0", "--centre", "0,0,0",
         "--angle", "90", "-o", file("turned.ply")});
    const auto turned = meshtween::read_mesh(folder_ / "turned.ply");
    EXPECT_LT((turned.positions.row(low) - bar.positions.row(low)).norm(), 1e-9);
    const meshtween::Point want(bar.positions(high, 0), -bar.positions(high, 2), bar.positions(high, 1));
    EXPECT_LT((turned.positions.row(high) - want).norm(), 1e-6);
}

} // namespace
