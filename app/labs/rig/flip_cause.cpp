#include "app/labs/rig/flip_cause.hpp"

#include <algorithm>
#include <tendril/rig/workspace.hpp>

#include "app/labs/rig/rig_edit.hpp"

namespace tendril::app {
namespace {

constexpr const char* not_known = "cause not known";

/// How bones are turned before the first unit and after each.
class Turns final : public rig::Observer {
  public:
    Turns(const rig::Rig& rig, const std::vector<BoneFlip>& flips) : rig_(rig), flips_(flips) {}

    void begin(rig::State& state) override { row(state); }
    void unit_done(std::size_t, rig::State& state) override { row(state); }
    const glm::dquat& at(std::size_t row, std::size_t flip) const { return rows_[row][flip]; }
    std::size_t rows() const { return rows_.size(); }
    /// The unit that turned it last; none where none did.
    std::optional<std::size_t> last_unit(std::size_t flip) const {
        constexpr double touched = 1e-7;  // radians
        for (std::size_t row = rows_.size(); row-- > 1;)
            if (turn_between(at(row - 1, flip), at(row, flip)) > touched) return row - 1;
        return std::nullopt;
    }

  private:
    void row(rig::State& state) {
        std::vector<glm::dquat>& row = rows_.emplace_back();
        for (const BoneFlip& flip : flips_)
            row.push_back(state.elements.get(rig_.id(flip.element), rig::Space::Global).rotation);
    }

    const rig::Rig& rig_;
    const std::vector<BoneFlip>& flips_;
    std::vector<std::vector<glm::dquat>> rows_;
};

/// The rig before and after one unit.
class Witness final : public rig::Observer {
  public:
    Witness(std::size_t unit, UnitSolve& solve) : unit_(unit), solve_(solve) {}

    void begin(rig::State& state) override {
        if (unit_ == 0) solve_.found.state = state;
    }
    void unit_done(std::size_t unit, rig::State& state) override {
        if (unit + 1 == unit_) solve_.found.state = state;
        if (unit == unit_) solve_.left.state = state;
    }

  private:
    std::size_t unit_;
    UnitSolve& solve_;
};

UnitSolve solve_of(const RigPart& part, rig::State state, std::size_t unit, rig::Workspace& scratch) {
    UnitSolve solve{part, part};
    Witness witness(unit, solve);
    part.rig.solve(state, 0.0, scratch, &witness);
    solve.found.state.elements.resolve_all();
    solve.left.state.elements.resolve_all();
    return solve;
}

/// The first unit after which the two are turned as differently as half the flip.
std::optional<std::size_t> parting_unit(const Turns& was, const Turns& is, std::size_t flip, double radians) {
    for (std::size_t row = 1; row < std::min(was.rows(), is.rows()); ++row)
        if (turn_between(was.at(row, flip), is.at(row, flip)) >= 0.5 * radians) return row - 1;
    return std::nullopt;
}

}  // namespace

std::vector<FlipCause> flip_causes(const RigPart& part, const rig::State& was, const rig::State& is,
                                   const std::vector<BoneFlip>& flips) {
    const std::vector<rig::Unit>& units = part.rig.definition().units;
    rig::Workspace scratch(part.rig);
    Turns before(part.rig, flips), after(part.rig, flips);
    rig::State first = was, second = is;
    part.rig.solve(first, 0.0, scratch, &before);
    part.rig.solve(second, 0.0, scratch, &after);
    std::vector<FlipCause> causes;
    for (std::size_t i = 0; i < flips.size(); ++i) {
        const auto unit = parting_unit(before, after, i, flips[i].radians);
        if (!unit) {
            causes.push_back({std::nullopt, not_known});
            continue;
        }
        std::string who = "unit " + units[*unit].name;
        if (const auto last = after.last_unit(i); last && *last != *unit)
            who += " (unit " + units[*last].name + " wrote it last)";
        const auto why = unit_cause(units[*unit], solve_of(part, was, *unit, scratch),
                                    solve_of(part, is, *unit, scratch), flips[i].radians);
        causes.push_back({unit, who + ": " + why.value_or(not_known)});
    }
    return causes;
}

}  // namespace tendril::app
