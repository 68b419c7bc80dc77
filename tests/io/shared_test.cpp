// Real models and their markers, where there are some.
#include "meshtween/geometry/check.h"
#include "meshtween/io/markers.h"
#include "meshtween/io/mesh_io.h"
#include "meshtween/io/output.h"

#include "support/shared.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace meshtween {
namespace {

TEST(SharedModels, AreReadAsTheirDescriptionSays) {
    for (const auto& folder : shared_cases()) {
        const auto about = nlohmann::json::parse(read_whole(folder / "case.json"));
        const Mesh source = read_mesh(folder / "source.obj"), target = read_mesh(folder / "target.obj");
        EXPECT_EQ(source.positions.rows(), about["source_vertices"]) << folder;
        EXPECT_EQ(source.triangles.rows(), about["source_faces"]) << folder;
        EXPECT_EQ(target.positions.rows(), about["target_vertices"]) << folder;
        EXPECT_EQ(target.triangles.rows(), about["target_faces"]) << folder;
        for (const Mesh* mesh : {&source, &target})
            for (const Finding& finding : check(*mesh))
                EXPECT_EQ(finding.severity, Severity::note) << folder << ": " << finding.what;
        if (std::filesystem::exists(folder / "markers.csv")) {
            const MarkerPairs markers = read_marker_pairs(folder / "markers.csv", source, target);
            EXPECT_EQ(markers.pairs.size(), about["markers"]) << folder;
            EXPECT_TRUE(markers.notes.empty()) << folder << ": " << markers.notes[0];
        }
        if (std::filesystem::exists(folder / "truth.csv")) {
            EXPECT_EQ(read_points(folder / "truth.csv").rows(), source.positions.rows()) << folder;
        }
    }
}

} // namespace
} // namespace meshtween
