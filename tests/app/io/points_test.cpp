#include "app/io/points.hpp"

#include <gtest/gtest.h>

#include <string>

#include "tests/app/support/temp_folder.hpp"
#include "tests/says.hpp"

namespace tendril::test {
namespace {

using app::read_points;
using Points = std::vector<glm::vec3>;

TEST(PointsFromText, AreReadAsTablesListsAndSourceCode) {
    const Points one{{1, -2.5f, 3}}, two{{1, 2, 3}, {4, 5, 6}};
    for (const char* text :
         {"1 -2.5 3", "1,-2.5,3\n", "1;-2.5;3", "1\t-2.5\t3\r\n", "(1, -2.5, 3)", "[1, -2.5, 3]",
          "{1,-2.5,3};", "Vector3(1, -2.5, 3)", "new Vector3(1f, -2.5f, 3f)", "FVector(X=1.0 Y=-2.5 Z=3.0)",
          "(X=1,Y=-2.5,Z=3)", "(Z=3,X=1,Y=-2.5)", "vec3(1.0, -2.5, 3.0)", "glm::vec3{1, -2.5, 3}",
          "{\"x\": 1, \"y\": -2.5, \"z\": 3}", "[\n  1,\n  -2.5,\n  3\n]", "+1 -25e-1 3.", "x,y,z\n1,-2.5,3"})
        EXPECT_EQ(read_points(text, 10), one) << text;
    for (const char* text :
         {"1 2 3\n4 5 6", "1,2,3\n\n4,5,6\n", "[[1, 2, 3], [4, 5, 6]]", "{{1,2,3},{4,5,6}}",
          "[[1. 2. 3.]\n [4. 5. 6.]]", "[[\n1,\n2,\n3\n],\n[4,5,6]\n]\n", "[1, 2, 3\n 4, 5, 6]",
          "Vector3(1,2,3), Vector3(4,5,6)", "x y z\n1 2 3\n4 5 6", "(X=1,Y=2,Z=3)\n(X=4,Y=5,Z=6)",
          "new Vector3(1f, 2f, 3f),\nnew Vector3(4f, 5f, 6f),",
          "\xef\xbb\xbf"
          "1 2 3\n4 5 6"})
        EXPECT_EQ(read_points(text, 10), two) << text;
}

TEST(PointsFromText, InvalidTextIsRefusedWithLineAndContent) {
    struct Bad {
        std::string text, told;
    };
    std::string many;
    for (int i = 0; i < 100'000; ++i) many += "1 2 3\n";
    for (const Bad& bad :
         {Bad{"", "line 1 nothing"}, Bad{"1 2 3\n4 5", "line 2 three two"},
          Bad{"1 2 3\n4 5 6 7", "line 2 fourth 7"}, Bad{"[1,2,3,4,5,6]", "line 1 fourth 4"},
          Bad{"1 2 nan", "line 1 nan"}, Bad{"1 2 1000000001", "line 1 1000000001"},
          Bad{"1 2 3m", "line 1 3m"}, Bad{"hello world", "line 1 hello"},
          Bad{"(1, 2, 3", "line 1 not closed"}, Bad{"1 2 3)", "line 1 too many"},
          Bad{"(X=1,X=2,Z=3)", "line 1 x twice"}, Bad{"(X=1,2,Z=3)", "line 1 names none"},
          Bad{"X=1 Y=", "line 1 three one"}, Bad{"sin(1,2,3)", "line 1 sin"},
          Bad{std::string("1 2 \0", 5), "line 1"}, Bad{std::string(1 << 20, '['), "not closed"},
          Bad{std::string(1 << 20, 'j'), "line 1 expected a number"},
          Bad{std::string(1 << 20, '7'), "line 1 1e9"}, Bad{many, "line 10001 10000"}}) {
        const std::string told = message_of([&] { read_points(bad.text, 10'000); });
        EXPECT_TRUE(says(told, bad.told)) << bad.text.substr(0, 40);
        EXPECT_LT(told.size(), 200u);
    }
}

}  // namespace
}  // namespace tendril::test
