#include "tendril/rig/unit.hpp"

namespace tendril::rig {

Body::Body() noexcept = default;
Body::Body(std::initializer_list<Unit> units) : units_(units) {}
Body::Body(const Body&) = default;
Body::Body(Body&&) noexcept = default;
Body& Body::operator=(const Body&) = default;
Body& Body::operator=(Body&&) noexcept = default;
Body::~Body() = default;
std::size_t Body::size() const noexcept {
    return units_.size();
}
const Unit& Body::operator[](std::size_t index) const noexcept {
    return units_[index];
}
void Body::resize(std::size_t count) {
    units_.resize(count);
}
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
