// Numeric cases of aim() from an independent implementation in double precision; skipped if the file is
// missing. Tests of the Rig lab run the cases that are commands.
#include <fstream>
#include <nlohmann/json.hpp>

#include "rig_support.hpp"
#include "tendril/rig/aim.hpp"
#include "tests/places.hpp"

namespace tendril::test {
namespace {

using Json = nlohmann::json;

glm::dvec3 vector_of(const Json& json) {
    return {json.at(0).get<double>(), json.at(1).get<double>(), json.at(2).get<double>()};
}
rig::AimPart part_of(const Json& json) {
    return {.axis = vector_of(json.at("axis")),
            .target = vector_of(json.at("target")),
            .kind = json.at("kind") == "location" ? rig::AimTarget::Location : rig::AimTarget::Direction};
}

TEST(RigAimReference, AgreesWithAnIndependentImplementation) {
    std::ifstream file(reference_path("aim.json"));
    if (!file) GTEST_SKIP() << "aim.json is not there";
    const Json cases = Json::parse(file);
    Random random(3);
    double worst = 0.0;
    for (const Json& example : cases) {
        SCOPED_TRACE(example.at("name").get<std::string>());
        const rig::AimOptions options{.primary = part_of(example.at("primary")),
                                      .secondary = part_of(example.at("secondary")),
                                      .weight = example.at("weight")};
        for (int i = 0; i < 20; ++i) {  // each from a random rotation
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
