// Golden pictures: the expected output of the program, beside the scripts that produce it.
#pragma once

#include <gtest/gtest.h>
#include <imgui.h>

#include <set>

#include "app/io/json_complete.hpp"
#include "tests/app/golden/compare.hpp"
#include "tests/app/support/frame_record.hpp"

namespace tendril::test {

/// tests/app/golden
std::filesystem::path golden_folder();
/// Every script there, sorted; its picture has the same name with .png.
std::vector<std::filesystem::path> golden_scripts();

/// The folder for pictures that failed: $TENDRIL_TEST_OUTPUT, else tests/output.
std::filesystem::path output_folder();

/// The part of a window that a golden picture shows: the whole window for some scripts, otherwise the middle
/// at half the size (view, plots and strip), so that renaming a label in a panel affects few pictures.
app::Image golden_part(const std::string& name, const app::Image& window, const app::Json& state);

/// The texts of the panels, one per line with its position in pixels: the contents of a panel's picture in a
/// form that is readable in a diff.
std::string panel_texts(const FrameRecord& frame);

/// Dear ImGui 1.86 drew the golden pictures. Others may set a text a pixel aside: then one pixel in a hundred
/// of a picture may differ, and texts are compared without their places.
inline constexpr bool places_are_those_of_goldens = IMGUI_VERSION_NUM < 18700;
std::multiset<std::string> without_places(const std::string& panel_texts);

/// Ignores the rounding of the golden picture's colours.
Difference compare_with_golden(const app::Image& golden, const app::Image& actual);

/// Whether the picture looks like the golden one. If not, writes `name`.actual.png and `name`.difference.png
/// to the output folder and says so.
testing::AssertionResult looks_like(const app::Image& actual, const std::filesystem::path& golden,
                                    const std::string& name);

/// The request in $TENDRIL_RENEW_GOLDENS: nothing, "1" to renew the pictures that fail, "all" for all.
enum class Renewal { None, Failing, All };
Renewal wanted_renewal();

/// Writes `actual` as the golden picture, with few colours.
void renew_golden(const std::filesystem::path& golden, const app::Image& actual);

}  // namespace tendril::test
