// Cost of a forward solve, by number and kind of units.
//
// Claims, for the worst row:
//  - a unit of any kind except those that solve chains of bones takes at most 0.4 loops (measure.hpp) per
//    frame, among 1 000;
//  - a unit costs the same among 10 and among 10 000 of its kind, within a factor of 3.5: 10 000 do not fit
//    in a cache of 1 MB;
//  - a changed value (a slider's drag) costs at most a seventh of making the rig again, among at least 100
//    units.
#include "measure.hpp"
#include "tendril/rig/workspace.hpp"

namespace {

using namespace tendril::bench;
using namespace tendril::rig;

std::string numbered(const char* name, std::size_t number) {
    std::string result(name);
    result += std::to_string(number);
    return result;
}

struct Kind {
    const char* title;
    Operation (*operation)(const std::string& element);
};
constexpr Kind kinds[] = {
    {"aim",
     [](const std::string& element) {
         return Operation(
             Aim{.item = element,
                 .primary = {.target = FromElement{"target"}},
                 .secondary = AimInputs{.axis = glm::dvec3(0, 1, 0), .target = glm::dvec3(0, 9, 0)}});
     }},
    {"parent constraint",
     [](const std::string& element) {
         return Operation(ParentConstraint{.item = element, .parents = {{.item = "target"}}});
     }},
    {"parent constraint, 3 parents, filter",
     [](const std::string& element) {
         return Operation(ParentConstraint{.item = element,
                                           .parents = {{.item = "target"}, {.item = "b0"}, {.item = "b1"}},
                                           .filter = {.rotation = {true, false, true}}});
     }},
    {"offset",
     [](const std::string& element) {
         return Operation(OffsetTransform{.item = element, .offset = Transform{.translation = {0, 0.1, 0}}});
     }},
    {"offset, not propagating",
     [](const std::string& element) {
         return Operation(OffsetTransform{
             .item = element, .offset = Transform{.translation = {0, 0.1, 0}}, .propagate = false});
     }},
    {"spring of a vector",
     [](const std::string& element) {
         return Operation(SpringInterpolate{.target = FromElement{element}, .critical_damping = 0.5});
     }},
    {"curve",
     [](const std::string& element) {
         return Operation(EvaluateCurve{.value = FromElement{.element = element, .of = Of::X}});
     }},
};

/// `count` bones in lines of ten, one unit each, and a moving target.
struct Subject {
    Rig rig;
    State state;
    Workspace workspace;
    std::size_t target;
    double time = 0.0;

    static Definition definition(const Kind& kind, std::size_t count) {
        Definition made;
        made.elements.push_back({.name = "target", .kind = ElementKind::Control});
        for (std::size_t i = 0; i < count; ++i) {
            made.elements.push_back({.name = numbered("b", i)});
            made.elements.back().initial.translation = {1.0, static_cast<double>(i), 0.5};
            if (i % 10 != 0) made.elements.back().parent = numbered("b", i - 1);
            made.units.push_back({.name = numbered("u", i), .operation = kind.operation(numbered("b", i))});
        }
        return made;
    }
    Subject(const Kind& kind, std::size_t count)
        : rig(Rig::make(definition(kind, count)).value()),
          state(rig.initial_state()),
          workspace(rig),
          target(*rig.element("target")) {}

    void frame() {
        time += 1.0 / 60;
        Transform place{.translation = {5.0 + time, 3.0, 1.0}};
        static_cast<void>(rig.set_control(state, target, place));
        rig.solve(state, 1.0 / 60, workspace);
    }
};

/// Microseconds per frame, the median of many.
double microseconds(const Kind& kind, std::size_t count) {
    Subject subject(kind, count);
    const std::size_t times = std::max<std::size_t>(1, 2000 / count);
    const std::vector<double> seconds = race({[&] {
                                                 for (std::size_t i = 0; i < times; ++i) subject.frame();
                                             }},
                                             31);
    return seconds[0] * 1e6 / static_cast<double>(times);
}

/// How many times longer it takes to make the rig anew than to change a unit's weight, with the state
/// adopted.
double make_over_change(const Kind& kind, std::size_t count) {
    const Definition definition = Subject::definition(kind, count);
    const Rig rig = *Rig::make(definition);
    State state = rig.initial_state();
    Unit unit = definition.units[count / 2];
    double weight = 0.0;
    const auto change = [&] {
        unit.weight = weight = weight < 0.9 ? weight + 0.01 : 0.0;
        const Rig changed = *rig.with_unit(unit);
        state = changed.adopted(rig, std::move(state));
    };
    const auto make = [&] {
        Definition edited = definition;
        edited.units[count / 2].weight = weight = weight < 0.9 ? weight + 0.01 : 0.0;
        const Rig changed = *Rig::make(std::move(edited));
        state = changed.adopted(rig, std::move(state));
    };
    const std::vector<double> seconds = race({make, change}, 31);
    return seconds[0] / seconds[1];
}

}  // namespace

int main(int count, char** arguments) {
    double worst = 0.0, spread = 1.0, change = 1e9;
    std::printf("us a frame, by units%17s%12s%12s%12s\n", "10", "100", "1000", "10000");
    for (const Kind& kind : kinds) {
        std::printf("%-28.28s", kind.title);
        double least = 1e9, most = 0.0;
        for (const std::size_t units : {10u, 100u, 1'000u, 10'000u}) {
            const double frame = microseconds(kind, units);
            std::printf("%12.1f", frame);
            if (units == 1'000) worst = std::max(worst, frame);
            least = std::min(least, frame / static_cast<double>(units));
            most = std::max(most, frame / static_cast<double>(units));
        }
        for (const std::size_t units : {100u, 1'000u, 10'000u})
            change = std::min(change, make_over_change(kind, units));
        std::printf("\n");
        spread = std::min(spread, least / most);
    }
    bool all = claim_loops("a unit of a rig of 1000", 1e-9 * worst, 0.4);
    all &= claim("a unit: cheapest size over dearest", spread, 1.0 / 3.5);
    all &= claim("a changed value: make and adopt over with_unit", change, 7.0);
    return all || !has_flag(count, arguments, "--check") ? 0 : 1;
}
