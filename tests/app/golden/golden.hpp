// Golden pictures: what the program is expected to draw, kept beside the scripts that lead there.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

#include "app/io/image.hpp"

namespace tendril::test {

/// tests/app/golden
std::filesystem::path golden_folder();
/// Every script there, sorted; its picture has the same name, with .png.
std::vector<std::filesystem::path> golden_scripts();

/// Where pictures that failed are left: $TENDRIL_TEST_OUTPUT, else tests/output.
std::filesystem::path output_folder();

/// Whether the picture looks as the golden one does. Where not, leaves `name`.actual.png and
/// `name`.difference.png in the output folder and says so.
testing::AssertionResult looks_like(const app::Image& actual, const std::filesystem::path& golden,
                                    const std::string& name);

/// What $TENDRIL_RENEW_GOLDENS asks for: nothing, "1" to renew the pictures that no longer pass, "all" for
/// every one.
enum class Renewal { None, Failing, All };
Renewal wanted_renewal();

/// Keeps `actual` as the golden picture.
void renew_golden(const std::filesystem::path& golden, const app::Image& actual);

}  // namespace tendril::test
