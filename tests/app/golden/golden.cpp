#include "tests/app/golden/golden.hpp"

#include <algorithm>
#include <cstdlib>

#include "tests/app/golden/compare.hpp"

namespace tendril::test {
namespace fs = std::filesystem;

fs::path golden_folder() {
    return fs::path(TENDRIL_SOURCE_DIR) / "tests/app/golden";
}

std::vector<fs::path> golden_scripts() {
    std::vector<fs::path> scripts;
    for (const auto& entry : fs::directory_iterator(golden_folder())) {
        if (entry.path().extension() == ".jsonl") scripts.push_back(entry.path());
    }
    std::sort(scripts.begin(), scripts.end());
    return scripts;
}

fs::path output_folder() {
    const char* const wanted = std::getenv("TENDRIL_TEST_OUTPUT");
    return wanted != nullptr && *wanted != '\0' ? fs::path(wanted)
                                                : fs::path(TENDRIL_SOURCE_DIR) / "tests/output";
}

testing::AssertionResult looks_like(const app::Image& actual, const fs::path& golden,
                                    const std::string& name) {
    if (!fs::exists(golden)) {
        return testing::AssertionFailure() << golden << " is missing; tests/app/golden/renew draws it";
    }
    const app::Image expected = app::read_png(golden);
    const Difference difference = compare(expected, actual);
    if (difference.same) return testing::AssertionSuccess();

    const fs::path folder = output_folder();
    fs::create_directories(folder);
    const fs::path actual_path = folder / (name + ".actual.png");
    const fs::path difference_path = folder / (name + ".difference.png");
    app::write_png(actual_path, actual);
    app::write_png(difference_path, difference.picture);
    auto failure = testing::AssertionFailure();
    failure << "expected " << golden.filename();
    if (expected.size != actual.size) {
        failure << ", " << expected.size.x << "x" << expected.size.y << ", found " << actual.size.x << "x"
                << actual.size.y;
    } else {
        failure << ": " << difference.text();
    }
    return failure << "\nsee " << actual_path << "\nand " << difference_path
                   << "\nIf it is meant to look so, tests/app/golden/renew.";
}

Renewal wanted_renewal() {
    const char* const text = std::getenv("TENDRIL_RENEW_GOLDENS");
    const std::string wanted = text != nullptr ? text : "";
    if (wanted.empty() || wanted == "0") return Renewal::None;
    return wanted == "all" ? Renewal::All : Renewal::Failing;
}

void renew_golden(const fs::path& golden, const app::Image& actual) {
    app::write_png(golden, actual);
}

}  // namespace tendril::test
