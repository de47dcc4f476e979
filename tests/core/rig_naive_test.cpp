// Random rigs, solved by the library and by a literal implementation of a solve as specified, which looks up
// names each time and prepares nothing. Single operations are the library's own, with separate tests.
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>

#include "rig_maker.hpp"
#include "rig_rigs.hpp"
#include "rig_support.hpp"
#include "tendril/rig/collect.hpp"
#include "tendril/rig/transform_units.hpp"
#include "tests/places.hpp"

namespace tendril::rig {
namespace {

/// Supports everything but bone chains and aims with a speed limit.
class NaiveRig {
  public:
    explicit NaiveRig(Definition definition) : definition_(std::move(definition)) {
        for (std::size_t left = definition_.elements.size(); left > 0;)
            for (const Element& element : definition_.elements) {
                if (ids.contains(element.name)) continue;
                if (!element.parent.empty() && !ids.contains(element.parent)) continue;
                const ElementId parent = element.parent.empty() ? ElementId{} : ids.at(element.parent);
                ids[element.name] = tree.add(element.kind, parent, element.initial).value();
                if (element.control)
                    values[element.name] =
                        clamped(*element.control, rest_value(*element.control, element.initial));
                --left;
            }
    }

    void set(const Element& control, const Value& value) {
        values[control.name] = clamped(*control.control, value);
    }

    void solve(double dt) {
        dt_ = dt;
        tree.copy_pose(Pose::Input, Pose::Current);
        for (const Element& element : definition_.elements)
            if (element.control)
                tree.put(ids.at(element.name), Space::Local,
                         posed(*element.control, element.initial, values.at(element.name)));
        for (const NamedCurve& curve : definition_.curves) curves[curve.name] = curve.value;
        for (const Unit& unit : definition_.units) run(unit);
    }

    Hierarchy tree;
    std::map<std::string, ElementId> ids;
    std::map<std::string, Value> values;
    std::map<std::string, double> curves;
    std::map<std::string, std::vector<Value>> outputs;

  private:
    struct Here {
        ElementId element;
        double index = 0.0, count = 0.0;
    };

    ElementId item(const Item& item) const {
        const auto* name = std::get_if<std::string>(&item.which);
        return name ? ids.at(*name) : here_.element;
    }
    std::string name_of(ElementId id) const {
        for (const auto& [name, each] : ids)
            if (each == id) return name;
        return {};
    }
    Value read(const FromElement& from) {
        const ElementId id = item(from.element);
        if (from.of == Of::ControlValue) return values.at(name_of(id));
        const Transform pose = tree.get(id, from.space, from.pose);
        const glm::dvec3& t = pose.translation;
        switch (from.of) {
            case Of::Transform:
                return pose;
            case Of::Rotation:
                return pose.rotation;
            case Of::Scale:
                return pose.scale;
            case Of::X:
                return t.x;
            case Of::Y:
                return t.y;
            case Of::Z:
                return t.z;
            default:
                return t;
        }
    }
    Value read(const FromUnit& from) {
        for (const Unit& unit : all())
            if (unit.name == from.unit) {
                const std::vector<Output> names = rig::outputs(unit.operation);
                for (std::size_t i = 0; i < names.size(); ++i)
                    if (names[i].name == from.output) return outputs.at(unit.name).at(i);
            }
        std::abort();
    }
    Value read(Each each) const {
        if (each == Each::Count) return here_.count;
        if (each == Each::Index) return here_.index;
        return here_.count > 1.0 ? here_.index / (here_.count - 1.0) : 0.0;
    }
    template <class T>
    T read(const Input<T>& input) {
        if (const T* literal = input.literal()) return *literal;
        const Value value = std::visit(
            [&](const auto& from) -> Value {
                if constexpr (std::is_same_v<std::decay_t<decltype(from)>, T>)
                    return false;
                else
                    return read(from);
            },
            input.source);
        if constexpr (std::is_same_v<T, Value>) {
            return value;
        } else {
            // A whole pose is accepted for one of its parts.
            const auto* pose = std::get_if<Transform>(&value);
            if constexpr (std::is_same_v<T, glm::dvec3>)
                if (pose) return pose->translation;
            if constexpr (std::is_same_v<T, glm::dquat>)
                if (pose) return pose->rotation;
            if constexpr (std::is_same_v<T, double>)
                if (const bool* on = std::get_if<bool>(&value)) return *on ? 1.0 : 0.0;
            return std::get<T>(value);
        }
    }
    std::vector<Unit> all() const {
        std::vector<Unit> units;
        for (const Unit& unit : definition_.units) {
            units.push_back(unit);
            if (const auto* loop = std::get_if<ForEach>(&unit.operation))
                for (const Unit& inner : loop->body) units.push_back(inner);
        }
        return units;
    }

    void run(const Unit& unit) {
        unit_ = unit.name;
        on_ = unit.enabled && read(unit.when);
        weight_ = on_ ? std::clamp(read(unit.weight), 0.0, 1.0) * around_ : 0.0;
        std::visit([&](const auto& operation) { operate(operation); }, unit.operation);
    }
    void hand_out(const Value& value) { outputs[unit_] = {value}; }
    void put(ElementId id, Space space, const Transform& to, bool propagate = true) {
        if (weight_ > 0.0) tree.put(id, space, to, propagate ? Propagate::Yes : Propagate::No);
    }
    static Transform unit_length(Transform transform) {
        transform.rotation = normalised(transform.rotation);
        return transform;
    }

    AimPart part(const AimInputs& from) {
        return {read(from.axis), read(from.target), from.kind, std::clamp(read(from.weight), 0.0, 1.0)};
    }
    template <class Op>
    Transform aimed(const Transform& from, const Op& op) {
        AimOptions options{.primary = part(op.primary), .weight = weight_};
        if (op.secondary) options.secondary = part(*op.secondary);
        return aim(from, options).transform;
    }
    void operate(const Aim& op) {
        const ElementId id = item(op.item);
        put(id, Space::Global, aimed(tree.get(id, Space::Global), op));
        hand_out(tree.get(id, Space::Global));
    }
    void operate(const AimMath& op) { hand_out(aimed(read(op.transform), op)); }
    void operate(const ParentConstraint& op) {
        const ElementId id = item(op.item), above = tree.parent(id);
        std::vector<ConstraintParent> parents;
        for (const ParentInputs& each : op.parents) {
            const ElementId parent = item(each.item);
            parents.push_back({tree.get(parent, Space::Global),
                               tree.get(parent, Space::Global, Pose::Initial), read(each.weight)});
        }
        const ConstraintChild child{tree.get(id, Space::Global), tree.get(id, Space::Global, Pose::Initial),
                                    above ? tree.get(above, Space::Global) : Transform()};
        put(id, Space::Global,
            parent_constraint(child, parents, {read(op.maintain_offset), op.filter, weight_}));
        hand_out(tree.get(id, Space::Global));
    }
    void operate(const OffsetTransform& op) {
        const ElementId id = item(op.item);
        put(id, Space::Global,
            offset_transform(tree.get(id, Space::Global), unit_length(read(op.offset)), weight_),
            read(op.propagate));
        hand_out(tree.get(id, Space::Global));
    }
    void operate(const SetTransform& op) {
        const ElementId id = item(op.item);
        put(id, op.space, set_transform(tree.get(id, op.space), unit_length(read(op.transform)), weight_),
            read(op.propagate));
        hand_out(tree.get(id, Space::Global));
    }
    void operate(const SetRotation& op) {
        const ElementId id = item(op.item);
        put(id, op.space, set_rotation(tree.get(id, op.space), normalised(read(op.rotation)), weight_),
            read(op.propagate));
        hand_out(tree.get(id, op.space).rotation);
    }
    void operate(const ProjectToParent& op) {
        const ElementId child = item(op.child);
        hand_out(project_to_parent(tree.get(child, Space::Global),
                                   tree.get(child, Space::Global, Pose::Initial),
                                   tree.get(item(op.old_parent), Space::Global, Pose::Initial),
                                   tree.get(item(op.new_parent), Space::Global), weight_));
    }
    void operate(const FromTwoVectors& op) {
        hand_out(blend(glm::dquat(1, 0, 0, 0), from_two_vectors(read(op.from), read(op.to)), weight_));
    }
    void operate(const TransformLocation& op) {
        const glm::dvec3 from = read(op.location);
        hand_out(mixed(from, transform_location(read(op.transform), from)));
    }
    void operate(const TransformDirection& op) {
        const glm::dvec3 from = read(op.direction);
        hand_out(mixed(from, transform_direction(read(op.transform), from)));
    }
    template <class T>
    T mixed(const T& from, const T& to) const {
        return from + (to - from) * weight_;
    }
    static glm::dquat mixed(const glm::dquat& from, const glm::dquat& to, double part) {
        return blend(from, to, part);
    }

    void operate(const ForEach& op) {
        const std::string own = unit_;
        const bool runs = weight_ > 0.0;
        around_ = weight_;
        double count = 0.0;
        for (const std::string& root : op.roots) {
            std::vector<ElementId> found;
            EXPECT_TRUE(collect_children(tree, ids.at(root), {op.include_parent, op.recursive}, found));
            for (std::size_t i = 0; i < found.size() && runs; ++i) {
                here_ = {found[i], static_cast<double>(i), static_cast<double>(found.size())};
                round_ = static_cast<int>(count) + static_cast<int>(i);
                for (const Unit& unit : op.body) run(unit);
            }
            count += static_cast<double>(found.size());
        }
        round_ = 0;
        around_ = 1.0;
        outputs[own] = {count};
    }

    void operate(const AlphaInterpolate& op) {
        const double value = read(op.value);
        const signal::ScaleBiasClamp parameters{.map_range = read(op.map_range),
                                                .in_range = op.in_range,
                                                .out_range = op.out_range,
                                                .scale = read(op.scale),
                                                .bias = read(op.bias),
                                                .clamp = read(op.clamp),
                                                .clamp_min = read(op.clamp_min),
                                                .clamp_max = read(op.clamp_max),
                                                .interp = read(op.interp),
                                                .speed_increasing = read(op.speed_increasing),
                                                .speed_decreasing = read(op.speed_decreasing)};
        if (!on_) return hand_out(value);
        hand_out(mixed(value, signal::step(parameters, eased_[{unit_, round_}], value, dt_)));
    }
    template <class T, class Rate>
    void spring(const SpringInterpolate& op, const T& target, const Rate& none,
                std::map<std::pair<std::string, int>, signal::SpringState<T>>& states) {
        outputs[unit_] = {target, none};
        if (!on_) return;
        signal::Spring<T> parameters{
            .strength = std::clamp(read(op.strength), 0.0, 1e4),
            .critical_damping = std::clamp(read(op.critical_damping), 0.0, 1e3),
            .target_velocity_amount = std::clamp(read(op.target_velocity_amount), 0.0, 1.0)};
        if (op.force) parameters.force = std::get<Rate>(read(*op.force));
        signal::SpringState<T>& state = states[{unit_, round_}];
        const T result = signal::step(parameters, state, target, dt_);
        if constexpr (std::is_same_v<T, glm::dquat>)
            outputs[unit_] = {mixed(target, result, weight_), state.velocity};
        else
            outputs[unit_] = {mixed(target, result), state.velocity};
    }
    void operate(const SpringInterpolate& op) {
        const Value target = read(op.target);
        if (const auto* number = std::get_if<double>(&target)) return spring(op, *number, 0.0, numbers_);
        if (const auto* vector = std::get_if<glm::dvec3>(&target))
            return spring(op, *vector, glm::dvec3(0.0), vectors_);
        spring(op, std::get<glm::dquat>(target), glm::dvec3(0.0), rotations_);
    }
    void operate(const EvaluateCurve& op) {
        const double value = read(op.value);
        hand_out(mixed(value, signal::evaluate(op.curve, value)));
    }
    void operate(const SetCurve& op) {
        curves[op.curve] = mixed(curves[op.curve], read(op.value));
        hand_out(curves[op.curve]);
    }
    void operate(const TwoBone&) { ADD_FAILURE(); }
    void operate(const Fabrik&) { ADD_FAILURE(); }
    void operate(const Spline&) { ADD_FAILURE(); }

    Definition definition_;
    Here here_{};
    int round_ = 0;
    std::string unit_;
    bool on_ = true;
    double weight_ = 1.0, around_ = 1.0, dt_ = 0.0;
    std::map<std::pair<std::string, int>, signal::OutputState> eased_;
    std::map<std::pair<std::string, int>, signal::SpringState<double>> numbers_;
    std::map<std::pair<std::string, int>, signal::SpringState<glm::dvec3>> vectors_;
    std::map<std::pair<std::string, int>, signal::SpringState<glm::dquat>> rotations_;
};

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
