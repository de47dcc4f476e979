// Prints all tables of the library as JSON, one row per line: core/bindings/tables.json, from which
// `generate` writes the interfaces for other languages. `update` runs it. Tables are C++ values, so only a
// program can read them.
#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <string>
#include <string_view>

#include "tendril/chain/chain.hpp"
#include "tendril/humanoid/body.hpp"
#include "tendril/humanoid/feet.hpp"
#include "tendril/humanoid/footsteps.hpp"
#include "tendril/humanoid/hands.hpp"
#include "tendril/humanoid/hold.hpp"
#include "tendril/humanoid/lint.hpp"
#include "tendril/humanoid/look_at.hpp"
#include "tendril/humanoid/spring_chain.hpp"
#include "tendril/ik/active_limit.hpp"
#include "tendril/ik/curve.hpp"
#include "tendril/ik/flip.hpp"
#include "tendril/ik/incident.hpp"
#include "tendril/ik/limit.hpp"
#include "tendril/ik/linkage.hpp"
#include "tendril/ik/linkage_sketch.hpp"
#include "tendril/ik/many.hpp"
#include "tendril/ik/mechanisms.hpp"
#include "tendril/ik/options.hpp"
#include "tendril/ik/plane.hpp"
#include "tendril/ik/report.hpp"
#include "tendril/ik/state.hpp"
#include "tendril/ik/tree.hpp"
#include "tendril/ik/two_bone.hpp"
#include "tendril/rig/aim.hpp"
#include "tendril/rig/backward.hpp"
#include "tendril/rig/collect.hpp"
#include "tendril/rig/parent_constraint.hpp"
#include "tendril/rope/body.hpp"
#include "tendril/rope/collider.hpp"
#include "tendril/rope/hair_roots.hpp"
#include "tendril/rope/settings.hpp"
#include "tendril/rope/state.hpp"
#include "tendril/rope/tie.hpp"
#include "tendril/signal/filter.hpp"
#include "tendril/signal/spring.hpp"

namespace {

using namespace tendril;

std::string text_of(std::string_view text) {
    return '"' + std::string(text) + '"';
}

/// The shortest decimals that read back as the same number: 0.1 and not 0.10000000149.
std::string text_of(double number) {
    if (!std::isfinite(number)) return "null";
    char buffer[32];
    const auto single = static_cast<float>(number);
    const auto end = static_cast<double>(single) == number
                         ? std::to_chars(buffer, buffer + sizeof buffer, single)
                         : std::to_chars(buffer, buffer + sizeof buffer, number);
    return {buffer, end.ptr};
}

/// "i32", "u8"...: a row says only that it is an integer, but out-of-range values become the limits of its
/// type. Restores `fresh` afterwards.
std::string integer_type(const Field& row, void* fresh) {
    const FieldValue before = row.get(fresh);
    row.set(fresh, {-1e300});
    const bool has_sign = row.get(fresh)[0] < 0.0;
    row.set(fresh, {1e300});
    const double most = row.get(fresh)[0];
    row.set(fresh, before);
    int bits = has_sign ? 1 : 0;
    for (double left = most; left >= 1.0; left /= 2.0) ++bits;
    return (has_sign ? "i" : "u") + std::to_string(bits / 8 * 8);  // the largest of 64 bits is rounded up
}

std::string type_of(const Field& row, void* fresh) {
    const char* const single = row.exact ? "" : "f";
    switch (row.type) {
        case FieldType::Flag:
            return "flag";
        case FieldType::Integer:
            return row.count == nullptr ? integer_type(row, fresh) : "integer";
        case FieldType::Number:
            return row.exact ? "f64" : "f32";
        case FieldType::Pair:
            return std::string("vec2") + single;
        case FieldType::Point:
            return std::string("vec3") + single;
        case FieldType::Rotation:
            return std::string("quat") + single;
        case FieldType::Choice:
            return "choice";
        case FieldType::Text:
            return "text";
        case FieldType::Index:
            return "index";
        case FieldType::Struct:
            return "struct";
        case FieldType::Kind:
            return "kind";
        case FieldType::Other:
            return "other";
    }
    return "";
}

/// Strips the library's own namespace.
std::string_view short_name(std::string_view name) {
    constexpr std::string_view space = "tendril::";
    return name.starts_with(space) ? name.substr(space.size()) : name;
}

void print_row(const Field& row, void* fresh) {
    std::string line = "{\"name\": " + text_of(row.name);
    const auto add = [&](const char* key, const std::string& value) {
        line.append(", \"").append(key).append("\": ").append(value);
    };
    const bool choice = row.type == FieldType::Choice;
    if (!choice && !row.in_code.empty()) add("member", text_of(row.in_code));
    add("type", text_of(type_of(row, fresh)));
    if (row.count != nullptr) add("list", "true");
    if (row.optional) add("optional", "true");
    if (row.unit[0] != '\0') add("unit", text_of(row.unit));
    if (choice) {
        add("enum", text_of(short_name(row.in_code)));
        std::string choices;
        for (const char* const each : row.choices) choices += (choices.empty() ? "" : ", ") + text_of(each);
        add("choices", "[" + choices + "]");
    } else if (row.type == FieldType::Struct) {
        add("struct", text_of(short_name(row.kinds[0].in_code)));
    } else if (row.get != nullptr && row.type != FieldType::Flag && row.type != FieldType::Index) {
        add("range", "[" + text_of(row.range.low) + ", " + text_of(row.range.high) + "]");
        if (row.over_low) add("over", "true");
        if (row.usual.low < row.usual.high)
            add("usual", "[" + text_of(row.usual.low) + ", " + text_of(row.usual.high) + "]");
    }
    if (row.get != nullptr && row.count == nullptr && row.type != FieldType::Other) {
        const FieldValue value = row.get(fresh);
        std::string all;
        for (int i = 0; i < row.size(); ++i)
            all += (i > 0 ? ", " : "") + text_of(value[static_cast<std::size_t>(i)]);
        add("default", row.empty(fresh) ? "null" : row.size() > 1 ? "[" + all + "]" : all);
    }
    std::printf("  %s}", line.c_str());
}

bool first = true;

void print_table(std::string_view name, std::string_view header, std::span<const Field> table, void* fresh) {
    std::printf("%s{\"struct\": \"%.*s\", \"header\": \"%.*s\", \"rows\": [\n", first ? "" : ",\n",
                static_cast<int>(name.size()), name.data(), static_cast<int>(header.size()), header.data());
    first = false;
    for (const Field& row : table) {
        print_row(row, fresh);
        std::puts(&row == &table.back() ? "" : ",");
    }
    std::printf("]}");
}

template <class Struct>
void dump(std::string_view header) {
    Struct fresh{};
    print_table(short_name(detail::type_name<Struct>()), header, fields<Struct>(), &fresh);
}

}  // namespace

int main() {
    std::printf("[\n");
    dump<FixedOptions>("chain/chain.hpp");
    dump<Segment>("chain/chain.hpp");
    dump<ik::ActiveLimit>("ik/active_limit.hpp");
    dump<ik::CurveOptions>("ik/curve.hpp");
    dump<ik::FlipRule>("ik/flip.hpp");
    dump<ik::BendLimit>("ik/incident.hpp");
    dump<ik::IncidentOptions>("ik/incident.hpp");
    dump<ik::Limit>("ik/limit.hpp");
    dump<ik::Closure>("ik/linkage.hpp");
    dump<ik::JointPlace>("ik/linkage.hpp");
    dump<ik::Link>("ik/linkage.hpp");
    dump<ik::LinkPoint>("ik/linkage.hpp");
    dump<ik::Linkage>("ik/linkage.hpp");
    dump<ik::LinkageFreedom>("ik/linkage.hpp");
    dump<ik::LinkageOptions>("ik/linkage.hpp");
    dump<ik::LinkageReport>("ik/linkage.hpp");
    dump<ik::LinkageState>("ik/linkage.hpp");
    dump<ik::LinkageSketch>("ik/linkage_sketch.hpp");
    dump<ik::SketchBar>("ik/linkage_sketch.hpp");
    dump<ik::SketchMotor>("ik/linkage_sketch.hpp");
    dump<ik::SketchPoint>("ik/linkage_sketch.hpp");
    dump<ik::ManyOptions>("ik/many.hpp");
    dump<ik::Delta>("ik/mechanisms.hpp");
    dump<ik::FourBar>("ik/mechanisms.hpp");
    dump<ik::Jansen>("ik/mechanisms.hpp");
    dump<ik::Pantograph>("ik/mechanisms.hpp");
    dump<ik::Peaucellier>("ik/mechanisms.hpp");
    dump<ik::ScissorLift>("ik/mechanisms.hpp");
    dump<ik::SliderCrank>("ik/mechanisms.hpp");
    dump<ik::Stewart>("ik/mechanisms.hpp");
    dump<ik::Options>("ik/options.hpp");
    dump<ik::AngleLimit>("ik/plane.hpp");
    dump<ik::Plane>("ik/plane.hpp");
    dump<ik::Report>("ik/report.hpp");
    dump<ik::LimitMemory>("ik/state.hpp");
    dump<ik::PoleMemory>("ik/state.hpp");
    dump<ik::Effector>("ik/tree.hpp");
    dump<ik::TreeJoint>("ik/tree.hpp");
    dump<ik::TreeOptions>("ik/tree.hpp");
    dump<ik::TwoBoneOptions>("ik/two_bone.hpp");
    dump<rope::Body>("rope/body.hpp");
    dump<rope::ClothShape>("rope/body.hpp");
    dump<rope::HairShape>("rope/body.hpp");
    dump<rope::RopeShape>("rope/body.hpp");
    dump<rope::Box>("rope/collider.hpp");
    dump<rope::Capsule>("rope/collider.hpp");
    dump<rope::Collider>("rope/collider.hpp");
    dump<rope::Drive>("rope/collider.hpp");
    dump<rope::Plane>("rope/collider.hpp");
    dump<rope::Sphere>("rope/collider.hpp");
    dump<rope::HairPatch>("rope/hair_roots.hpp");
    dump<rope::Settings>("rope/settings.hpp");
    dump<rope::Pin>("rope/state.hpp");
    dump<rope::Tie>("rope/tie.hpp");
    dump<rope::TieShape>("rope/tie.hpp");
    dump<signal::InertializeState>("signal/filter.hpp");
    dump<signal::MotionState>("signal/filter.hpp");
    dump<signal::MovingAverageState>("signal/filter.hpp");
    dump<signal::OutputState>("signal/filter.hpp");
    dump<signal::SpringState<double>>("signal/spring.hpp");
    dump<rig::AimOptions>("rig/aim.hpp");
    dump<rig::AimPart>("rig/aim.hpp");
    dump<rig::BackwardOptions>("rig/backward.hpp");
    dump<rig::CollectOptions>("rig/collect.hpp");
    dump<rig::ParentConstraintOptions>("rig/parent_constraint.hpp");
    dump<rig::TransformFilter>("rig/parent_constraint.hpp");
    dump<humanoid::BodyOptions>("humanoid/body.hpp");
    dump<humanoid::BodyState>("humanoid/body.hpp");
    dump<humanoid::BodyTarget>("humanoid/body.hpp");
    dump<humanoid::FootShift>("humanoid/body.hpp");
    dump<humanoid::FeetOptions>("humanoid/feet.hpp");
    dump<humanoid::FeetState>("humanoid/feet.hpp");
    dump<humanoid::FootState>("humanoid/feet.hpp");
    dump<humanoid::Footstep>("humanoid/footsteps.hpp");
    dump<humanoid::FootstepOptions>("humanoid/footsteps.hpp");
    dump<humanoid::FootstepsState>("humanoid/footsteps.hpp");
    dump<humanoid::HandState>("humanoid/hands.hpp");
    dump<humanoid::HandsOptions>("humanoid/hands.hpp");
    dump<humanoid::HandsState>("humanoid/hands.hpp");
    dump<humanoid::HoldOptions>("humanoid/hold.hpp");
    dump<humanoid::HoldState>("humanoid/hold.hpp");
    dump<humanoid::LintSettings>("humanoid/lint.hpp");
    dump<humanoid::LookAtOptions>("humanoid/look_at.hpp");
    dump<humanoid::LookAtState>("humanoid/look_at.hpp");
    dump<humanoid::SpringChainState>("humanoid/spring_chain.hpp");
    dump<humanoid::SpringMass>("humanoid/spring_chain.hpp");
    dump<humanoid::SpringOptions>("humanoid/spring_chain.hpp");
    dump<ik::TwoBone>("ik/two_bone.hpp");
    dump<ik::TwoBoneResult>("ik/two_bone.hpp");
    for (const signal::Kind& kind : signal::kinds()) {
        signal::Filter filter = kind.blank();
        print_table(short_name(kind.in_code), "signal", kind.table(), signal::fields_in(filter));
    }
    std::printf("\n]\n");
}
