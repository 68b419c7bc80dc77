#include "meshtween/io/output.h"

#include "support/errors.h"
#include "support/scratch.h"

#include <sys/stat.h>

#include <stdexcept>

namespace meshtween {
namespace {

using testing::Test;

class Output : public Test {
protected:
    Scratch scratch;
};

TEST_F(Output, WhatIsWrittenIsRead) {
    std::string bytes(1000003, '\0');
    for (std::size_t i = 0; i < bytes.size(); ++i) bytes[i] = static_cast<char>(i * 31 % 257);
    const auto path = scratch.path("file.bin");
    write_whole(path, bytes);
    EXPECT_EQ(read_whole(path), bytes);
    write_whole(path, [&](std::ostream& stream) {
        for (const char c : bytes) stream.put(c);
        stream << bytes;
    });
    EXPECT_EQ(read_whole(path), bytes + bytes);
    EXPECT_EQ(scratch.entries(), 1);
}

TEST_F(Output, AFailureLeavesWhatWasThere) {
    const auto path = scratch.file("file.txt", "before");
    const auto half = [](std::ostream& stream) {
        stream << std::string(1 << 20, 'x');
        throw std::runtime_error("halfway");
    };
    EXPECT_THROW(write_whole(path, half), std::runtime_error);
    EXPECT_EQ(read_whole(path), "before");
    EXPECT_EQ(scratch.entries(), 1);
}

TEST_F(Output, AStreamThatFailedIsAFailure) {
    const auto path = scratch.path("file.txt");
    EXPECT_NE(
        message_of(ErrorKind::file, [&] { write_whole(path, [](std::ostream& s) { s.setstate(std::ios::failbit); }); })
            .find("file.txt"),
        std::string::npos);
    EXPECT_EQ(scratch.entries(), 0);
}

TEST_F(Output, SaysWhatCannotBeWritten) {
    EXPECT_NE(message_of(ErrorKind::file, [&] { write_whole(scratch.path("none/x.obj"), ""); }).find("no folder"),
              std::string::npos);
    EXPECT_NE(message_of(ErrorKind::file, [&] { write_whole(scratch.folder(), ""); }).find("is a folder"),
              std::string::npos);
    scratch.file("plain", "");
    EXPECT_NE(message_of(ErrorKind::file, [&] { write_whole(scratch.path("plain/x.obj"), ""); }).find("no folder"),
              std::string::npos);
    EXPECT_NE(message_of(ErrorKind::file, [&] { write_whole("", ""); }).find("file name"), std::string::npos);
}

TEST_F(Output, DevicesAreWrittenNotReplaced) {
    write_whole("/dev/null", "gone");
    struct stat status {};
    ASSERT_EQ(::stat("/dev/null", &status), 0);
    EXPECT_TRUE(S_ISCHR(status.st_mode));
    const std::string message =
        message_of(ErrorKind::file, [] { write_whole("/dev/full", std::string(1 << 20, 'x')); });
    EXPECT_NE(message.find("disk is full"), std::string::npos) << message;
}

TEST_F(Output, WritesThroughALink) {
    const auto real = scratch.file("real.txt", "before");
    std::filesystem::create_symlink("real.txt", scratch.path("link.txt"));
    write_whole(scratch.path("link.txt"), "after");
    EXPECT_EQ(read_whole(real), "after");
    EXPECT_TRUE(std::filesystem::is_symlink(scratch.path("link.txt")));
}

TEST_F(Output, SaysWhatCannotBeRead) {
    EXPECT_NE(message_of(ErrorKind::file, [&] { read_whole(scratch.path("none.obj")); }).find("no such file"),
              std::string::npos);
    EXPECT_NE(message_of(ErrorKind::file, [&] { read_whole(scratch.folder()); }).find("is a folder"),
              std::string::npos);
}

} // namespace
} // namespace meshtween
