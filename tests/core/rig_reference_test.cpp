// Numeric cases from an independent implementation in double precision. Skipped if the files are missing; the
// other tests do not need them.
#include <filesystem>
#include <fstream>

#include "rig_script.hpp"
#include "tendril/rig/aim.hpp"
#include "tests/places.hpp"

namespace tendril::test {
namespace {

/// The cases in a file; none if it is missing.
Json cases_of(const char* name) {
    std::ifstream file(reference_path(name));
    return file ? Json::parse(file) : Json::array();
}

class RigReference : public ::testing::TestWithParam<const char*> {};

TEST_P(RigReference, AgreesWithAnIndependentImplementation) {
    const Json cases = cases_of(GetParam());
    if (cases.empty()) GTEST_SKIP() << GetParam() << " is not there";
    double worst = 0.0;
    for (const Json& example : cases) {
        SCOPED_TRACE(example.at("name").get<std::string>());
        RigScript script;
        for (const Json& each : example.at("commands")) {
            const Result result = script.command(each);
            EXPECT_TRUE(result.ok()) << result.message();
        }
        for (const auto& [name, spaces] : example.at("expect").items()) {
            for (const auto& [space, wanted] : spaces.items()) {
                const rig::Transform want = transform_of(wanted), got = script.transform(name, space);
                const double off =
                    std::max({distance(got.translation, want.translation),
                              distance(got.rotation, want.rotation), distance(got.scale, want.scale)});
                EXPECT_LE(off, example.at("tolerance").get<double>()) << name << ' ' << space;
                worst = std::max(worst, off);
            }
        }
    }
    std::printf("%zu cases, worst deviation %.2g\n", cases.size(), worst);
    EXPECT_LE(worst, 1e-9) << "within their tolerance, but no longer what double precision gives";
}
INSTANTIATE_TEST_SUITE_P(Commands, RigReference,
                         ::testing::Values("hierarchy.json", "parent_constraint.json", "for_each.json"),
                         [](const auto& name) {
                             const std::string file = name.param;
                             return file.substr(0, file.find('.'));
                         });

rig::AimPart part_of(const Json& json) {
    return {.axis = vector_of(json.at("axis")),
            .target = vector_of(json.at("target")),
            .kind = json.at("kind") == "location" ? rig::AimTarget::Location : rig::AimTarget::Direction};
}

TEST(RigAimReference, AgreesWithAnIndependentImplementation) {
    const Json cases = cases_of("aim.json");
    if (cases.empty()) GTEST_SKIP() << "aim.json is not there";
    Random random(3);
    double worst = 0.0;
    for (const Json& example : cases) {
        SCOPED_TRACE(example.at("name").get<std::string>());
        const rig::AimOptions options{.primary = part_of(example.at("primary")),
                                      .secondary = part_of(example.at("secondary")),
                                      .weight = example.at("weight")};
        for (int i = 0; i < 20; ++i) {  // from any rotation
            rig::Transform item = some_transform(random);
            item.translation = vector_of(example.at("position"));
            const rig::AimResult aimed = rig::aim(item, options);
            const rig::Transform& got = aimed.transform;
            EXPECT_EQ(aimed.primary, rig::AimWarning::None);
            EXPECT_EQ(aimed.secondary, rig::AimWarning::None);
            EXPECT_EQ(got.translation, item.translation);
            EXPECT_EQ(got.scale, item.scale);
            const Json& expected = example.at("expect");
            const double off = std::max(
                distance(got.rotation * options.primary.axis, vector_of(expected.at("primary_axis_world"))),
                distance(got.rotation * options.secondary.axis,
                         vector_of(expected.at("secondary_axis_world"))));
            EXPECT_LE(off, example.at("tolerance").get<double>());
            worst = std::max(worst, off);
        }
    }
    std::printf("%zu cases, worst deviation %.2g\n", cases.size(), worst);
}

}  // namespace
}  // namespace tendril::test
