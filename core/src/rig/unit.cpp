#include "tendril/rig/unit.hpp"

#include <algorithm>
#include <atomic>
#include <memory>

namespace tendril::rig {

struct Units::Held : Unit {
    std::atomic<std::uint32_t> owners{1};

    explicit Held(Unit&& unit) : Unit(std::move(unit)) {}
    static Held* of(Unit* unit) noexcept { return static_cast<Held*>(unit); }
    static void release(Unit* unit) noexcept {
        if (of(unit)->owners.fetch_sub(1, std::memory_order_acq_rel) == 1) delete of(unit);
    }
};

Units::Units() noexcept = default;
Units::Units(Units&&) noexcept = default;
// Delegates to Units(), so that the destructor frees the units already added if adding another throws.
Units::Units(std::initializer_list<Unit> units) : Units() {
    for (const Unit& each : units) push_back(each);
}
Units::Units(const Units& other) : Units() {
    held_.reserve(other.size());
    for (const Unit& each : other) push_back(each);
}
Units& Units::operator=(Units other) noexcept {
    return std::swap(held_, other.held_), *this;
}
Units::~Units() {
    for (Unit* const each : held_) Held::release(each);
}
void Units::push_back(Unit unit) {
    insert(size(), std::move(unit));
}
void Units::insert(std::size_t index, Unit unit) {
    auto held = std::make_unique<Held>(std::move(unit));
    held_.insert(held_.begin() + static_cast<std::ptrdiff_t>(index), held.get());
    static_cast<void>(held.release());
}
void Units::erase(std::size_t index) noexcept {
    Held::release(held_[index]);
    held_.erase(held_.begin() + static_cast<std::ptrdiff_t>(index));
}
void Units::resize(std::size_t count) {
    while (size() > count) erase(size() - 1);
    while (size() < count) push_back({});
}
bool Units::operator==(const Units& other) const noexcept {
    return std::equal(held_.begin(), held_.end(), other.held_.begin(), other.held_.end(),
                      [](const Unit* a, const Unit* b) { return a == b || *a == *b; });
}
Units Units::with(std::size_t index, Unit unit) const {
    Units changed;
    changed.held_.reserve(size());
    Unit* const own = new Held(std::move(unit));
    for (std::size_t i = 0; i < size(); ++i) {  // nothing here throws
        if (i != index) Held::of(held_[i])->owners.fetch_add(1, std::memory_order_relaxed);
        changed.held_.push_back(i == index ? own : held_[i]);
    }
    return changed;
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
