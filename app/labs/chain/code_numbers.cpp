#include "app/labs/chain/code_numbers.hpp"

#include <cmath>
#include <cstdio>
#include <glm/trigonometric.hpp>

#include "app/labs/kit/code_text.hpp"

namespace tendril::app {
std::string degrees_text(float radians) {
    char text[32];
    std::snprintf(text, sizeof text, "%.4g", glm::degrees(static_cast<double>(radians)));
    return text;
}

std::string enumerator(ik::Method method) {
    return pascal_text(ik::name(method));
}

std::string enumerator(ik::JointKind kind) {
    return pascal_text(ik::name(kind));
}

std::string readable(const std::string& name, const ik::Limit& limit, const std::string& margin) {
    if (limit.kind == ik::JointKind::Hinge) {
        return margin + name + " = ik::Limit::hinge(" + braced(limit.axis) + ", " + literal(limit.min) +
               ", " + literal(limit.max) + ");  // " + degrees_text(limit.min) + " to " +
               degrees_text(limit.max) + " degrees\n";
    }
    const std::string next = margin + std::string(name.size() + 4, ' ');
    std::string text = margin + name + " = {.kind = ik::JointKind::" + enumerator(limit.kind) + ",\n";
    text += next + ".axis = " + braced(limit.axis) + ",\n";
    const std::pair<const char*, float> angles[] = {
        {"up", limit.up},       {"down", limit.down},           {"left", limit.left},
        {"right", limit.right}, {"twist_min", limit.twist_min}, {"twist_max", limit.twist_max}};
    for (const auto& [field, angle] : angles) {
        if (angle == 0.0f) continue;  // as it is by itself
        text += next + "." + field + " = " + literal(angle) + ",  // " + degrees_text(angle) + " degrees\n";
    }
    return text + margin + "};\n";
}

std::string number_table(const char* name, const std::vector<float>& numbers) {
    std::string text = "static const float " + std::string(name) + "[] = {\n";
    for (std::size_t i = 0; i < numbers.size(); ++i) {
        text += i % 4 == 0 ? "    " : " ";
        text += literal(numbers[i]);
        text += i % 4 == 3 ? ",\n" : ",";
    }
    return text + "};\n";
}

std::vector<float> segment_numbers(const Chain& chain) {
    std::vector<float> numbers;
    for (const auto& [position, length] : chain.segments())
        numbers.insert(numbers.end(), {position.x, position.y, position.z, length});
    return numbers;
}

std::vector<float> rotation_numbers(const std::vector<glm::quat>& rotations) {
    std::vector<float> numbers;
    for (const glm::quat& q : rotations) numbers.insert(numbers.end(), {q.w, q.x, q.y, q.z});
    return numbers;
}

std::string limit_table(const std::vector<ik::Limit>& limits) {
    std::string text =
        "struct JointLimit {\n"
        "    std::size_t joint;\n"
        "    ik::Limit limit;\n"
        "};\n"
        "// Kind, axis, min and max; up, down, left, right; twist_min and twist_max.\n"
        "static const JointLimit joint_limits[] = {\n";
    for (std::size_t i = 0; i < limits.size(); ++i) {
        const ik::Limit& limit = limits[i];
        if (limit.kind == ik::JointKind::Free) continue;
        text += "    {" + std::to_string(i) + ", {ik::JointKind::" + enumerator(limit.kind) + ", " +
                braced(limit.axis);
        for (const float angle : {limit.min, limit.max, limit.up, limit.down, limit.left, limit.right,
                                  limit.twist_min, limit.twist_max})
            text += ", " + literal(angle);
        text += "}},\n";
    }
    return text + "};\n";
}

}  // namespace tendril::app
