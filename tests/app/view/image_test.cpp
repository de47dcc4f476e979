// PNG files read back unchanged, and errors name the file.
#include "app/io/image.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <stdexcept>

namespace tendril::app {
namespace {

class Png : public testing::Test {
  protected:
    Png() { std::filesystem::create_directories(folder_); }
    ~Png() override { std::filesystem::remove_all(folder_); }
    std::filesystem::path folder_ = std::filesystem::path(testing::TempDir()) /
                                    testing::UnitTest::GetInstance()->current_test_info()->name();
};

TEST_F(Png, IsReadBackUnchanged) {
    Image image{{3, 2}, {}};
    for (int i = 0; i < 24; ++i) image.rgba.push_back(static_cast<std::uint8_t>(10 * i));
    const auto path = folder_ / "picture.png";
    write_png(path, image);
    const Image read = read_png(path);
    EXPECT_EQ(read.size, image.size);
    EXPECT_EQ(read.rgba, image.rgba);
}

TEST_F(Png, ErrorsNameThePath) {
    const auto says = [](const std::filesystem::path& path, auto action) {
        try {
            action();
        } catch (const std::runtime_error& error) {
            return std::string(error.what()).find(path.string()) != std::string::npos;
        }
        return false;
    };
    const auto missing = folder_ / "missing.png", broken = folder_ / "broken.png",
               nowhere = folder_ / "no" / "a.png";
    std::ofstream(broken) << "not a picture";
    EXPECT_TRUE(says(missing, [&] { read_png(missing); }));
    EXPECT_TRUE(says(broken, [&] { read_png(broken); }));
    EXPECT_TRUE(says(nowhere, [&] { write_png(nowhere, {{1, 1}, {0, 0, 0, 0}}); }));
    EXPECT_TRUE(says(missing, [&] { write_png(missing, {{2, 2}, {0}}); }));
}

}  // namespace
}  // namespace tendril::app
