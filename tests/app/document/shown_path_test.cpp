// Paths of files in toasts.
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <string>

#include "app/document/atomic_file.hpp"

namespace tendril::app {
namespace {

class ShownPath : public testing::Test {
  protected:
    ShownPath() { ::setenv("HOME", "/home/ada", 1); }

  private:
    const Environment home_{"HOME"};
};

TEST_F(ShownPath, IsWholeAndShortUnderHome) {
    EXPECT_EQ(shown_path("/srv/films/a.mp4"), "/srv/films/a.mp4");
    EXPECT_EQ(shown_path("/home/ada/pictures/a.png"), "~/pictures/a.png");
    EXPECT_EQ(shown_path("/home/adam/a.png"), "/home/adam/a.png");
    EXPECT_EQ(shown_path("a.png"), shown_path(std::filesystem::current_path() / "a.png"));
    EXPECT_EQ(shown_path("/srv/x/../a.png"), "/srv/a.png");
    EXPECT_EQ(written_text("/home/ada/a.png"), "Written: ~/a.png");
}

TEST_F(ShownPath, OmitsTheMiddleOfALongPath) {
    std::string deep = "/srv";
    for (int i = 0; i < 30; ++i) deep += "/folder" + std::to_string(i);
    const std::string shown = shown_path(deep + "/tendril-1.png");
    EXPECT_LE(shown.size(), longest_shown_path);
    EXPECT_EQ(shown.rfind("/srv/.../", 0), 0u) << shown;
    EXPECT_TRUE(shown.ends_with("/folder29/tendril-1.png")) << shown;
    const std::string name(150, 'x');
    EXPECT_TRUE(shown_path("/srv/" + name).ends_with(name)) << "the name is whole";
}

}  // namespace
}  // namespace tendril::app
