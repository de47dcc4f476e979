#include "tendril/rig/unit.hpp"

namespace tendril::rig {

Body::Body() noexcept = default;
Body::Body(std::initializer_list<Unit> units) : units_(units) {}
Body::Body(const Body&) = default;
Body::Body(Body&&) noexcept = default;
Body& Body::operator=(const Body&) = default;
Body& Body::operator=(Body&&) noexcept = default;
Body::~Body() = default;
bool Body::operator==(const Body& other) const {
    return units_ == other.units_;
}

Operation::Operation() noexcept = default;
Operation::Operation(const Operation&) = default;
Operation::Operation(Operation&&) noexcept = default;
Operation& Operation::operator=(const Operation&) = default;
Operation& Operation::operator=(Operation&&) noexcept = default;
Operation::~Operation() = default;
bool Operation::operator==(const Operation& other) const {
    return static_cast<const Variant&>(*this) == static_cast<const Variant&>(other);
}

const char* operation_name(std::size_t index) noexcept {
    constexpr const char* names[] = {"aim",
                                     "aim_math",
                                     "parent_constraint",
                                     "offset_transform",
                                     "set_transform",
                                     "set_rotation",
                                     "project_to_parent",
                                     "from_two_vectors",
                                     "transform_location",
                                     "transform_direction",
                                     "for_each",
                                     "alpha_interpolate",
                                     "spring_interpolate",
                                     "evaluate_curve",
                                     "set_curve",
                                     "two_bone",
                                     "fabrik",
                                     "spline"};
    static_assert(std::size(names) == std::variant_size_v<Operation::Variant>);
    return names[index];
}

namespace {

struct ResultType {
    Type operator()(const FromTwoVectors&) const { return Type::Rotation; }
    Type operator()(const SetRotation&) const { return Type::Rotation; }
    Type operator()(const TransformLocation&) const { return Type::Vector; }
    Type operator()(const TransformDirection&) const { return Type::Vector; }
    Type operator()(const ForEach&) const { return Type::Number; }
    Type operator()(const AlphaInterpolate&) const { return Type::Number; }
    Type operator()(const SpringInterpolate&) const { return Type::Number; }
    Type operator()(const EvaluateCurve&) const { return Type::Number; }
    Type operator()(const SetCurve&) const { return Type::Number; }
    Type operator()(const TwoBone&) const { return Type::Number; }
    Type operator()(const Fabrik&) const { return Type::Number; }
    Type operator()(const Spline&) const { return Type::Number; }
    Type operator()(const auto&) const { return Type::Transform; }
};

}  // namespace

std::vector<Output> outputs(const Operation& operation) {
    const Output result{"result", std::visit(ResultType(), operation)};
    if (std::holds_alternative<SpringInterpolate>(operation)) return {result, {"velocity", result.type}};
    if (std::holds_alternative<Spline>(operation))
        return {
            result, {"bones_past_end", Type::Number}, {"past_end", Type::Number}, {"factor", Type::Number}};
    return {result};
}

}  // namespace tendril::rig
