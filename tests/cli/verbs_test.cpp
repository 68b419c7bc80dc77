// Every verb, run as a user would.
#include "support/program.h"

#include "meshtween/geometry/measure.h"
#include "meshtween/io/mesh_io.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <fstream>

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
    TemporaryFolder folder_;
};

TEST_F(Verbs, VersionAndHelpGoToStandardOutput) {
    EXPECT_FALSE(run({"--version"}).out.empty());
    for (const char* verb : {"morph", "fit", "tween", "rotate", "measure", "check", "sample"}) {
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
    sample("build");
    const auto fit_with_seed = [&](const char* seed) {
        run({"fit", file("build_source.ply"), file("build_target.ply"), "--markers", file("build_markers.csv"),
             "--markers-exact", "--seed", seed, "-o", file("fitted.ply"), "--report", file("r.json")});
        return read_json(folder_ / "r.json")["fit"]["quality"];
    };
    const Json one = fit_with_seed("1"), two = fit_with_seed("2");
    EXPECT_LT(one["marker_error"]["max"], 1e-7); // percent
    EXPECT_NE(one["fitted_to_target"]["mean"], two["fitted_to_target"]["mean"]);
    EXPECT_EQ(one["eq7"], two["eq7"]);
}

TEST_F(Verbs, TweenIsExactAtBothEnds) {
    sample("bar-bend");
    const auto from = meshtween::read_mesh(folder_ / "bar-bend_source.ply"),
               to = meshtween::read_mesh(folder_ / "bar-bend_target.ply");
    for (const char* method : {"linear", "laplacian", "dual"}) {
        for (const char* u : {"0", "1"})
            run({"tween", file("bar-bend_source.ply"), file("bar-bend_target.ply"), "--method", method, "--at", u, "-o",
                 file("at" + std::string(u) + ".ply")});
        const double tolerance = 1e-9 * meshtween::diagonal(from.positions);
        EXPECT_LT((meshtween::read_mesh(folder_ / "at0.ply").positions - from.positions).cwiseAbs().maxCoeff(),
                  tolerance)
            << method;
        EXPECT_LT((meshtween::read_mesh(folder_ / "at1.ply").positions - to.positions).cwiseAbs().maxCoeff(), tolerance)
            << method;
    }
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

TEST_F(Verbs, CheckSpeaksOnStandardOutput) {
    sample("build");
    const Ran ran = run({"check", file("build_source.ply")});
    EXPECT_NE(ran.out.find("vertices"), std::string::npos);
    std::ofstream(folder_ / "bad.obj") << "v 0 0 0\n";
    EXPECT_EQ(run_program({"check", file("bad.obj")}).status, 3);
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
