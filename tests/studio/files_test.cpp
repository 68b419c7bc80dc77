#include "files.h"

#include "support/errors.h"
#include "support/scratch.h"

#include <gtest/gtest.h>

namespace meshtween::studio {
namespace fs = std::filesystem;
namespace {

TEST(Files, plain_names_have_no_folders_and_no_surprises) {
    EXPECT_EQ(plain_name("igea.ply"), "igea.ply");
    EXPECT_EQ(plain_name("../../etc/passwd"), "passwd");
    EXPECT_EQ(plain_name("C:\\models\\a b.obj"), "a b.obj");
    EXPECT_EQ(plain_name("Тест é 頭.obj"), "Тест é 頭.obj") << "a name keeps its letters";
    EXPECT_EQ(plain_name("a:b*c?\n.obj"), "a_b_c__.obj");
    EXPECT_EQ(plain_name("\xff\xc3.obj"), "__.obj") << "no UTF-8";
    EXPECT_EQ(plain_name("\xed\xa0\x80"), "___") << "no letter";
    EXPECT_EQ(plain_name("name. "), "name");
    EXPECT_EQ(plain_name("...hidden"), "hidden");
    EXPECT_EQ(plain_name("frame_####.png"), "frame_####.png");
    EXPECT_EQ(plain_name(std::string(500, 'x')).size(), 120U);
    std::string cyrillic;
    for (int i = 0; i < 100; ++i) cyrillic += "щ";
    EXPECT_EQ(plain_name(cyrillic + ".obj"), cyrillic.substr(0, 116) + ".obj")
        << "cut between letters, the ending stays";
    for (const char* name : {"", "..", "a/", "/"})
        EXPECT_NE(message_of(ErrorKind::argument, [&] { plain_name(name); }).find("name"), std::string::npos) << name;
}

TEST(Access, reaches_the_project_and_what_was_opened_and_nothing_else) {
    const Scratch scratch;
    const fs::path project = scratch.path("project");
    Access access(project);
    const fs::path inside = project / "a.ply", outside = scratch.file("b.ply", "b"),
                   opened = scratch.file("c.ply", "c");
    access.open(opened);
    EXPECT_EQ(access.checked(inside), fs::weakly_canonical(inside));
    EXPECT_EQ(access.checked(opened), fs::canonical(opened));
    for (const fs::path& file : {outside, project / "../b.ply", fs::path("/etc/passwd"), project, project / ".."})
        EXPECT_NE(message_of(ErrorKind::file, [&] { access.checked(file); }).find("outside"), std::string::npos)
            << file;
    fs::create_symlink(outside, project / "link.ply");
    EXPECT_NE(message_of(ErrorKind::file, [&] { access.checked(project / "link.ply"); }), "");
    // A folder whose name merely begins alike lies outside.
    fs::create_directory(scratch.path("project2"));
    EXPECT_NE(message_of(ErrorKind::file, [&] { access.checked(scratch.path("project2") / "a.ply"); }), "");
}

TEST(Access, writes_through_no_link) {
    const Scratch scratch;
    const Access access(scratch.path("project"));
    const fs::path file = access.place_for("exports", "../morph.glb");
    EXPECT_EQ(file, access.folder() / "exports" / "morph.glb");
    fs::create_symlink(scratch.path("elsewhere.glb"), file); // leads to nothing yet
    EXPECT_NE(message_of(ErrorKind::file, [&] { access.place_for("exports", "morph.glb"); }).find("link"),
              std::string::npos);
    fs::create_directory_symlink(scratch.folder(), access.folder() / "models");
    EXPECT_NE(message_of(ErrorKind::file, [&] { access.place_for("models", "a.ply"); }), "");
}

} // namespace
} // namespace meshtween::studio
