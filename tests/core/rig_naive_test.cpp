// Random rigs, solved by the library and by the literal implementation.
#include "rig_maker.hpp"
#include "rig_naive.hpp"
#include "rig_support.hpp"

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

}  // namespace
}  // namespace tendril::rig
