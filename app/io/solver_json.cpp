#include "app/io/solver_json.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <span>

#include "app/document/json_complete.hpp"
#include "app/io/solver_text.hpp"

namespace tendril::app {
namespace {

/// An angle of a limit: its name in files, its member in ik::Limit, and its range in degrees.
struct Field {
    const char* name;
    float ik::Limit::*angle;
    double low, high;
};

constexpr Field hinge_fields[] = {{"min_deg", &ik::Limit::min, -180, 180},
                                  {"max_deg", &ik::Limit::max, -180, 180}};
constexpr Field cone_fields[] = {
    {"up_deg", &ik::Limit::up, 0, 180},
    {"down_deg", &ik::Limit::down, 0, 180},
    {"left_deg", &ik::Limit::left, 0, 180},
    {"right_deg", &ik::Limit::right, 0, 180},
    {"twist_min_deg", &ik::Limit::twist_min, -180, 180},
    {"twist_max_deg", &ik::Limit::twist_max, -180, 180},
};

constexpr std::array all_kinds{ik::JointKind::Free,         ik::JointKind::Suture, ik::JointKind::Hinge,
                               ik::JointKind::Gliding,      ik::JointKind::Saddle, ik::JointKind::Pivot,
                               ik::JointKind::BallAndSocket};

std::span<const Field> fields_of(ik::JointKind kind) {
    if (kind == ik::JointKind::Free) return {};
    if (kind == ik::JointKind::Hinge) return hinge_fields;
    return cone_fields;
}

ik::JointKind read_kind(const Json& json, const std::string& where) {
    const std::string name = json_text(json, where);
    std::string names;
    for (const ik::JointKind kind : all_kinds) {
        if (name == ik::name(kind)) return kind;
        names += (names.empty() ? "" : ", ") + std::string(ik::name(kind));
    }
    throw std::runtime_error(where + ": expected one of " + names + ", found " + json_summary(json));
}

float read_angle(const Json& json, const Field& field, const std::string& where) {
    const float radians = json_degrees(json, where);
    const double found = json.get<double>();
    if (found >= field.low && found <= field.high) return radians;
    throw std::runtime_error(where + ": expected " + std::to_string(std::lround(field.low)) + " to " +
                             std::to_string(std::lround(field.high)) + " degrees, found " +
                             json_summary(json));
}

glm::vec3 read_axis(const Json& json, const std::string& where) {
    const glm::vec3 axis = json_point(json, where);
    const double size =
        std::hypot(static_cast<double>(axis.x), static_cast<double>(axis.y), static_cast<double>(axis.z));
    if (size > 1e-6) return axis;
    throw std::runtime_error(where + ": expected a non-zero axis, found " + json_summary(json));
}

void check_order(float low, float high, const char* low_name, const char* high_name,
                 const std::string& where) {
    if (low <= high) return;
    throw std::runtime_error(where + ": expected " + low_name + " at most " + high_name + ", found " +
                             degrees(low).dump() + " and " + degrees(high).dump());
}

Json finite_number(float value) {
    return std::isfinite(value) ? number(value) : Json(nullptr);
}

}  // namespace

Json limit_json(const ik::Limit& limit) {
    Json json{{"kind", ik::name(limit.kind)}};
    if (limit.kind == ik::JointKind::Free) return json;
    json["axis"] = point(limit.axis);
    for (const Field& field : fields_of(limit.kind)) json[field.name] = degrees(limit.*field.angle);
    return json;
}

ik::Limit limit_from_json(const Json& json, const std::string& where) {
    ik::Limit limit = ik::Limit::of(read_kind(json_member(json, "kind", where), where + ".kind"));
    if (limit.kind == ik::JointKind::Free) return limit;
    const auto given = [&](const char* name) { return json.find(name); };
    if (const auto axis = given("axis"); axis != json.end()) limit.axis = read_axis(*axis, where + ".axis");
    for (const Field& field : fields_of(limit.kind)) {
        if (const auto angle = given(field.name); angle != json.end())
            limit.*field.angle = read_angle(*angle, field, where + "." + field.name);
    }
    if (limit.kind == ik::JointKind::Hinge)
        check_order(limit.min, limit.max, "min_deg", "max_deg", where);
    else
        check_order(limit.twist_min, limit.twist_max, "twist_min_deg", "twist_max_deg", where);
    return limit;
}

Json report_json(ik::Method method, const ik::Report& report, bool within_limits) {
    return {{"solver", ik::name(method)},
            {"status", ik::name(report.status)},
            {"iterations", report.iterations},
            // Refused input has no residual.
            {"residual",
             report.status == ik::Status::InvalidInput ? Json(nullptr) : finite_number(report.residual)},
            {"ran", ran_text(method, report, within_limits)}};
}

Json active_limit_json(const ik::ActiveLimit& limit) {
    return {{"joint", limit.joint},
            {"kind", ik::name(limit.kind)},
            {"bound", ik::name(limit.bound)},
            {"limit_deg", degrees(limit.limit)},
            {"needed_deg", degrees(limit.needed)},
            {"enough", limit.enough}};
}

ik::Method method_from_name(const std::string& name, const std::string& where) {
    if (const auto method = ik::method_named(name)) return *method;
    throw std::runtime_error(where + ": expected one of " + method_names() + ", found " +
                             json_summary(Json(name)));
}

std::string method_names() {
    std::string names;
    for (const ik::Method method : ik::all_methods)
        names += (names.empty() ? "" : ", ") + std::string(ik::name(method));
    return names;
}

}  // namespace tendril::app
