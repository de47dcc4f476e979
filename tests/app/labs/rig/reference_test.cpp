// Numeric cases from an independent implementation, through the lab's own commands. Skipped if the files are
// missing; the other tests do not need them.
#include <filesystem>

#include "rig_support.hpp"
#include "tests/places.hpp"

namespace tendril::app {
namespace {

Json cases_of(const char* name) {
    const std::filesystem::path file = tendril::test::reference_path(name);
    return std::filesystem::exists(file) ? read_json_file(file) : Json::array();
}

double distance(const Json& a, const Json& b, double sign = 1.0) {
    double squares = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        const double off = a[i].get<double>() - sign * b[i].get<double>();
        squares += off * off;
    }
    return std::sqrt(squares);
}

/// A rotation and its negative are equal.
double off(const Json& got, const Json& wanted) {
    const Json &a = got.at("rotation"), &b = wanted.at("rotation");
    return std::max({distance(got.at("translation"), wanted.at("translation")),
                     distance(got.at("scale"), wanted.at("scale")),
                     std::min(distance(a, b), distance(a, b, -1.0))});
}

class RigLabReference : public RigTest, public testing::WithParamInterface<const char*> {};

TEST_P(RigLabReference, AgreesWithAnIndependentImplementation) {
    const Json cases = cases_of(GetParam());
    if (cases.empty()) GTEST_SKIP() << GetParam() << " is not there";
    for (const Json& example : cases) {
        SCOPED_TRACE(example.at("name").get<std::string>());
        run("rig.clear");
        for (Json each : example.at("commands")) {
            const std::string command = each.at("command");
            each.erase("command");
            run(command.c_str(), each);
        }
        const double tolerance = example.at("tolerance");
        const auto expect_all = [&](const char* when) {
            for (const auto& [name, spaces] : example.at("expect").items())
                for (const auto& [space, wanted] : spaces.items())
                    EXPECT_LE(off(named("elements", name).at(space), wanted), std::min(tolerance, 1e-9))
                        << name << ' ' << space << ' ' << when;
        };
        expect_all("as the commands leave it");
        tick();
        expect_all("after a tick");
        solve();
        expect_all("solved again");
    }
}
INSTANTIATE_TEST_SUITE_P(Commands, RigLabReference,
                         testing::Values("hierarchy.json", "parent_constraint.json", "for_each.json"),
                         [](const auto& name) {
                             const std::string file = name.param;
                             return file.substr(0, file.find('.'));
                         });

class RigLabAimReference : public RigTest {};

}  // namespace
}  // namespace tendril::app
