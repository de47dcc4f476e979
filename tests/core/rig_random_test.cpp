// Random rigs, most of them meaningless: results are finite, solving twice equals solving once, and a copy
// continues like the original.
#include <gtest/gtest.h>

#include "rig_maker.hpp"

namespace tendril::rig {
namespace {

bool finite(const Transform& pose) {
    const auto fine = [](double value) { return std::abs(value) < 1e200; };
    return fine(pose.translation.x) && fine(pose.translation.y) && fine(pose.translation.z) &&
           fine(pose.scale.x) && fine(pose.scale.y) && fine(pose.scale.z) &&
           std::abs(glm::length(pose.rotation) - 1.0) < 1e-6;
}

TEST(RigProperty, RandomRigsGiveFiniteResults) {
    constexpr double times[] = {0.0, 1.0 / 60, 10.0, -1.0, std::numeric_limits<double>::infinity(), 1e-12};
    std::size_t units = 0;
    for (std::uint64_t seed = 0; seed < 3000; ++seed) {
        Maker maker(seed);
        const Definition definition = maker.definition();
        units += definition.units.size();
        Held rig(definition), twin(definition);
        test::Random random(seed + 77);
        for (int tick = 0; tick < 6; ++tick) {
            const std::size_t element = random.below(definition.elements.size());
            if (definition.elements[element].control) {
                const Value value = maker.value(type_of(definition.elements[element].control->kind));
                const bool taken = static_cast<bool>(rig.rig.set_control(rig.state, element, value));
                ASSERT_EQ(static_cast<bool>(twin.rig.set_control(twin.state, element, value)), taken) << seed;
            }
            const double dt = times[random.below(std::size(times))];
            rig.solve(dt);
            twin.workspace = Workspace(twin.rig);
            twin.solve(dt);
            ASSERT_TRUE(rig.state == twin.state) << seed << ", tick " << tick;
            State again = rig.state;
            rig.rig.solve(again, 0.0, rig.workspace);
            for (const ElementId id : {rig.rig.id(0), rig.rig.id(definition.elements.size() - 1)}) {
                const Transform pose = rig.state.elements.get(id, Space::Global);
                ASSERT_TRUE(finite(pose)) << seed;
                ASSERT_TRUE(finite(again.elements.get(id, Space::Global))) << seed;
            }
            for (const double curve : rig.state.curves) ASSERT_TRUE(std::isfinite(curve)) << seed;
        }
    }
    EXPECT_GT(units, 3000u) << "most of what is made up has to be taken";
}

}  // namespace
}  // namespace tendril::rig
