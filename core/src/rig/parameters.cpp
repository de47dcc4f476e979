#include "rig/parameters.hpp"

#include <algorithm>
#include <limits>

#include "rig/math.hpp"

namespace tendril::rig {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

glm::dquat rotation_by(const glm::dvec3& vector) noexcept {
    const double angle = detail::length(vector);
    if (!(angle > 1e-12)) return {1.0, 0.5 * vector.x, 0.5 * vector.y, 0.5 * vector.z};
    return detail::rotation_about(detail::times(vector, 1.0 / angle), angle);
}

}  // namespace

Parameters::Parameters(const Definition& definition, std::vector<Value> start) : start_(std::move(start)) {
    const auto add = [&](std::size_t element, Kind kind, int axis, double now) {
        const Control& control = *definition.elements[element].control;
        const bool bounded = kind == Kind::Translation || kind == Kind::Number;
        const double low = bounded && control.minimum ? (*control.minimum)[axis] : -infinity;
        const double high = bounded && control.maximum ? (*control.maximum)[axis] : infinity;
        parts_.push_back({element, kind, axis, low, high});
        numbers_.push_back(now);
    };
    for (std::size_t i = 0; i < definition.elements.size(); ++i) {
        if (!definition.elements[i].control) continue;
        const ControlKind kind = definition.elements[i].control->kind;
        const Value& value = start_[i];
        if (const auto* transform = std::get_if<Transform>(&value)) {
            for (int axis = 0; axis < 3; ++axis)
                add(i, Kind::Translation, axis, transform->translation[axis]);
            for (int axis = 0; axis < 3; ++axis) add(i, Kind::Rotation, axis, 0.0);
            for (int axis = 0; axis < 3; ++axis) add(i, Kind::Scale, axis, transform->scale[axis]);
        } else if (const auto* vector = std::get_if<glm::dvec3>(&value)) {
            for (int axis = 0; axis < (kind == ControlKind::Vector2d ? 2 : 3); ++axis)
                add(i, Kind::Translation, axis, (*vector)[axis]);
        } else if (std::holds_alternative<glm::dquat>(value)) {
            for (int axis = 0; axis < 3; ++axis) add(i, Kind::Rotation, axis, 0.0);
        } else if (const auto* number = std::get_if<double>(&value)) {
            add(i, Kind::Number, 0, *number);
        }
    }
}

void Parameters::clamp() noexcept {
    for (std::size_t i = 0; i < parts_.size(); ++i)
        numbers_[i] = std::clamp(numbers_[i], parts_[i].minimum, parts_[i].maximum);
}

bool Parameters::at_minimum(std::size_t parameter) const noexcept {
    return numbers_[parameter] <= parts_[parameter].minimum;
}
bool Parameters::at_maximum(std::size_t parameter) const noexcept {
    return numbers_[parameter] >= parts_[parameter].maximum;
}

void Parameters::write(std::vector<Value>& controls) const {
    std::vector<glm::dvec3> turns;  // per element; zero if it does not turn
    turns.resize(controls.size(), glm::dvec3(0.0));
    controls = start_;
    for (std::size_t i = 0; i < parts_.size(); ++i) {
        const Part& part = parts_[i];
        Value& value = controls[part.element];
        auto* transform = std::get_if<Transform>(&value);
        switch (part.kind) {
            case Kind::Translation:
                (transform ? transform->translation : std::get<glm::dvec3>(value))[part.axis] = numbers_[i];
                break;
            case Kind::Scale:
                transform->scale[part.axis] = numbers_[i];
                break;
            case Kind::Number:
                value = numbers_[i];
                break;
            case Kind::Rotation:
                turns[part.element][part.axis] = numbers_[i];
        }
    }
    for (std::size_t i = 0; i < controls.size(); ++i) {
        if (turns[i] == glm::dvec3(0.0)) continue;
        auto* transform = std::get_if<Transform>(&controls[i]);
        glm::dquat& rotation = transform ? transform->rotation : std::get<glm::dquat>(controls[i]);
        rotation = normalised(math::compose(rotation_by(turns[i]), rotation));
    }
}

}  // namespace tendril::rig
