// Golden pictures: what the program is expected to draw, kept beside the scripts that lead there.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

#include "app/document/json_complete.hpp"
#include "app/io/image.hpp"
#include "tests/app/golden/compare.hpp"
#include "tests/app/support/frame_record.hpp"

namespace tendril::test {

/// tests/app/golden
std::filesystem::path golden_folder();
/// Every script there, sorted; its picture has the same name, with .png.
std::vector<std::filesystem::path> golden_scripts();

/// Where pictures that failed are left: $TENDRIL_TEST_OUTPUT, else tests/output.
std::filesystem::path output_folder();

/// What of a window a golden picture shows, so that a label renamed in a panel renews few of them: of some
/// scripts the whole window, of the others the middle, with the view, plots and strip, at half the size.
app::Image golden_part(const std::string& name, const app::Image& window, const app::Json& state);

/// The texts of the panels, one a line with its place in pixels: what a picture of them would hold, for a
/// person to read in a diff.
std::string panel_texts(const FrameRecord& frame);

/// Forgives the rounding of the golden picture's colours.
Difference compare_with_golden(const app::Image& golden, const app::Image& actual);

/// Whether the picture looks as the golden one does. Where not, leaves `name`.actual.png and
/// `name`.difference.png in the output folder and says so.
testing::AssertionResult looks_like(const app::Image& actual, const std::filesystem::path& golden,
                                    const std::string& name);

/// What $TENDRIL_RENEW_GOLDENS asks for: nothing, "1" to renew the pictures that no longer pass, "all" for
/// every one.
enum class Renewal { None, Failing, All };
Renewal wanted_renewal();

/// Keeps `actual` as the golden picture, in few colours.
void renew_golden(const std::filesystem::path& golden, const app::Image& actual);

}  // namespace tendril::test
