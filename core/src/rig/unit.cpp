#include "tendril/rig/unit.hpp"

#include <algorithm>
#include <atomic>
#include <memory>

namespace tendril::rig {

struct Units::Held : Unit {
    Block* block;
};
/// Units side by side in memory, in the order in which a solve reads them. Freed when no list refers to any.
struct Units::Block {
    std::vector<Held> units;
    std::atomic<std::uint32_t> owners{0};  ///< references from lists, over all units

    explicit Block(std::size_t count) { units.reserve(count); }
    void add(Unit&& unit) { units.push_back({std::move(unit), this}); }
    static Block& of(const Unit* unit) noexcept { return *static_cast<const Held*>(unit)->block; }
    static void release(const Unit* unit) noexcept {
        Block& block = of(unit);
        if (block.owners.fetch_sub(1, std::memory_order_acq_rel) == 1) delete &block;
    }
};

Units::Units() noexcept = default;
Units::Units(Units&&) noexcept = default;
Units::Units(std::initializer_list<Unit> units) : Units() {
    append(units);
}
Units::Units(const Units& other) : Units() {
    append(other);
}
Units& Units::operator=(Units other) noexcept {
    return std::swap(held_, other.held_), *this;
}
Units::~Units() {
    for (Unit* const each : held_) Block::release(each);
}
template <class List>
void Units::append(const List& units) {
    auto block = std::make_unique<Block>(units.size());
    for (const Unit& each : units) block->add(Unit(each));
    refer_to(std::move(block), size());
}
void Units::pack() {
    Units packed;
    auto block = std::make_unique<Block>(size());
    for (Unit& each : *this) block->add(std::move(each));
    packed.refer_to(std::move(block), 0);
    *this = std::move(packed);
}
void Units::refer_to(std::unique_ptr<Block> block, std::size_t index) {
    held_.insert(held_.begin() + static_cast<std::ptrdiff_t>(index), block->units.size(), nullptr);
    for (Held& each : block->units) held_[index++] = &each;
    block->owners = static_cast<std::uint32_t>(block->units.size());
    if (block->owners > 0) static_cast<void>(block.release());
}
void Units::push_back(Unit unit) {
    insert(size(), std::move(unit));
}
void Units::insert(std::size_t index, Unit unit) {
    auto block = std::make_unique<Block>(1);
    block->add(std::move(unit));
    refer_to(std::move(block), index);
}
void Units::erase(std::size_t index) noexcept {
    Block::release(held_[index]);
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
    changed.insert(0, std::move(unit));
    Unit* const own = changed.held_[0];
    changed.held_.clear();
    for (std::size_t i = 0; i < size(); ++i) {  // nothing here throws
        if (i != index) Block::of(held_[i]).owners.fetch_add(1, std::memory_order_relaxed);
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
