// Random rigs, solved by the library and by the literal implementation.
#include <fstream>
#include <nlohmann/json.hpp>

#include "rig_maker.hpp"
#include "rig_naive.hpp"
#include "rig_support.hpp"
#include "tests/places.hpp"

namespace tendril::rig {
namespace {

double apart(const Value& a, const Value& b) {
    if (a.index() != b.index()) return 1e9;
    return std::visit(
        [&](const auto& one) -> double {
            using T = std::decay_t<decltype(one)>;
            const T& other = std::get<T>(b);
            if constexpr (std::is_same_v<T, bool>)
                return one == other ? 0.0 : 1.0;
            else if constexpr (std::is_same_v<T, double>)
                return std::abs(one - other) / std::max(1.0, std::abs(other));
            else if constexpr (std::is_same_v<T, glm::dvec3>)
                return test::distance(one, other) / std::max(1.0, test::norm(other));
            else
                return test::distance(one, other);
        },
        a);
}

/// Whether the naive rig supports it: no bone chains, and no aims with a speed limit.
bool is_plain(const Units& units) {
    return std::ranges::all_of(units, [](const Unit& unit) {
        const Operation& what = unit.operation;
        if (std::holds_alternative<TwoBone>(what) || std::holds_alternative<Fabrik>(what) ||
            std::holds_alternative<Spline>(what))
            return false;
        if (const auto* aim = std::get_if<AimMath>(&what)) return aim->max_speed == Input<double>(0.0);
        if (const auto* loop = std::get_if<ForEach>(&what)) return is_plain(loop->body);
        return true;
    });
}

TEST(RigNaive, ASolveMatchesTheLiteralSpecification) {
    std::size_t compared = 0;
    for (std::uint64_t seed = 0; compared < 20'000; ++seed) {
        Maker maker(seed, true);
        const Definition definition = maker.definition();
        if (!is_plain(definition.units)) continue;
        Held rig(definition);
        NaiveRig naive(definition);
        test::Random random(seed);
        for (int tick = 0; tick < 4; ++tick) {
            for (std::size_t i = 0; i < definition.elements.size(); ++i) {
                const Element& element = definition.elements[i];
                if (!element.control || random.chance(2)) continue;
                const Value value = maker.value(type_of(element.control->kind));
                if (rig.rig.set_control(rig.state, i, value)) naive.set(element, value);
            }
            const double dt = random.chance(3) ? 0.0 : 1.0 / 30;
            rig.solve(dt);
            naive.solve(dt);
            bool warned = false;  // some value is out of range and ignored
            for (const UnitState& unit : rig.state.units) warned |= unit.warning == Warning::OutOfRange;
            if (warned) break;
            for (const Element& element : definition.elements)
                for (const Space space : {Space::Local, Space::Global}) {
                    const Transform is = rig.state.elements.get(rig.rig.id(rig.element(element.name)), space);
                    const Transform should = naive.tree.get(naive.ids.at(element.name), space);
                    ASSERT_LE(test::distance(is, should), 1e-9) << seed << ": " << element.name;
                    ++compared;
                }
            for (const auto& [name, outputs] : naive.outputs)
                for (std::size_t i = 0; i < outputs.size(); ++i)
                    ASSERT_LE(apart(rig.unit(name).outputs.at(i), outputs[i]), 1e-9) << seed << ": " << name;
            for (const auto& [name, value] : naive.curves)
                ASSERT_LE(apart(rig.state.curves[*rig.rig.curve(name)], value), 1e-9) << seed;
        }
    }
}

// Random rigs, most of them meaningless: results are finite, solving twice equals solving once, and a copy
// continues like the original.

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

// Numeric cases of aim() from an independent implementation in double precision; skipped if the file is
// missing. Tests of the Rig lab run the cases that are commands.

using Json = nlohmann::json;

glm::dvec3 vector_of(const Json& json) {
    return {json.at(0).get<double>(), json.at(1).get<double>(), json.at(2).get<double>()};
}
AimPart part_of(const Json& json) {
    return {.axis = vector_of(json.at("axis")),
            .target = vector_of(json.at("target")),
            .kind = json.at("kind") == "location" ? AimTarget::Location : AimTarget::Direction};
}

TEST(RigAimReference, AgreesWithAnIndependentImplementation) {
    std::ifstream file(test::reference_path("aim.json"));
    if (!file) GTEST_SKIP() << "aim.json is not there";
    const Json cases = Json::parse(file);
    test::Random random(3);
    double worst = 0.0;
    for (const Json& example : cases) {
        SCOPED_TRACE(example.at("name").get<std::string>());
        const AimOptions options{.primary = part_of(example.at("primary")),
                                 .secondary = part_of(example.at("secondary")),
                                 .weight = example.at("weight")};
        for (int i = 0; i < 20; ++i) {  // each from a random rotation
            Transform item = test::some_transform(random);
            item.translation = vector_of(example.at("position"));
            const AimResult aimed = aim(item, options);
            const Transform& got = aimed.transform;
            EXPECT_EQ(aimed.primary, AimWarning::None);
            EXPECT_EQ(aimed.secondary, AimWarning::None);
            EXPECT_EQ(got.translation, item.translation);
            EXPECT_EQ(got.scale, item.scale);
            const Json& expected = example.at("expect");
            const double off = std::max(test::distance(got.rotation * options.primary.axis,
                                                       vector_of(expected.at("primary_axis_world"))),
                                        test::distance(got.rotation * options.secondary.axis,
                                                       vector_of(expected.at("secondary_axis_world"))));
            EXPECT_LE(off, example.at("tolerance").get<double>());
            worst = std::max(worst, off);
        }
    }
    std::printf("%zu cases, worst deviation %.2g\n", cases.size(), worst);
}

}  // namespace
}  // namespace tendril::rig
