#include "meshtween/io/table.h"

#include "support/errors.h"
#include "support/scratch.h"

#include <gtest/gtest.h>

using namespace meshtween;

namespace {

TEST(Table, ComesBackAsItWas) {
    const Scratch folder;
    Table table{{"hip", "knee"}, Eigen::MatrixXd(2, 2)};
    table.values << 0.1, 1.0 / 3, 2, 1e-300;
    write_table(table, folder.path("t.csv"));
    const Table again = read_table(folder.path("t.csv"));
    EXPECT_EQ(again.names, table.names);
    EXPECT_EQ(again.values, table.values);
    table.names.clear();
    write_table(table, folder.path("t.csv"));
    EXPECT_EQ(read_table(folder.path("t.csv")).values, table.values);
}

TEST(Table, ReadsWhatPeopleHave) {
    const Scratch folder;
    const Table table = read_table(folder.file("t.txt", "# skin\n1; 2\n\n3; 4\n"));
    EXPECT_TRUE(table.names.empty());
    EXPECT_EQ(table.values, (Eigen::Matrix2d() << 1, 2, 3, 4).finished());
    EXPECT_EQ(read_table(folder.file("u.csv", "1\n2\n3\n")).values.rows(), 3);
}

TEST(Table, BadOnesAreToldByLine) {
    const Scratch folder;
    const auto message = [&](const char* contents) {
        return message_of(ErrorKind::file, [&] { read_table(folder.file("t.csv", contents)); });
    };
    EXPECT_NE(message("a,b\n1,2\n3\n").find("line 3"), std::string::npos);
    EXPECT_NE(message("a\n1\nx\n").find("line 3"), std::string::npos);
    EXPECT_NE(message("a\nnan\n").find("finite"), std::string::npos);
    EXPECT_NE(message("vertex,a\n0,1\n2,1\n").find("line 3"), std::string::npos);
    EXPECT_NE(message("").find("no rows"), std::string::npos);
    EXPECT_NE(message("a,b\n").find("no rows"), std::string::npos);
}

} // namespace
