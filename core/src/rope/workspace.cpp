// Workspaces: memory sized by a world's state.
#include "tendril/rope/workspace.hpp"

#include <utility>

#include "math/checks.hpp"
#include "math/tasks.hpp"
#include "rope/build.hpp"
#include "rope/scratch.hpp"

namespace tendril::rope {
namespace {

/// Sizes all memory, so that nothing is allocated later.
void size(Scratch& scratch, const State& state, const Plan& plan) {
    const std::size_t particles = state.position.size();
    scratch.x.resize(particles);
    scratch.base.resize(particles);
    scratch.weight.resize(particles);
    scratch.touch.assign(particles, Touch{});
    scratch.body_near.assign(state.bodies.size(), Scratch::Nearest::None);
    scratch.body_group.assign(state.bodies.size(), 0);
    scratch.body_failed.assign(state.bodies.size(), 0);
    scratch.multiplier.resize(state.links.size());
    scratch.chunk_low.resize(plan.chunks.size());
    scratch.chunk_high.resize(plan.chunks.size());
    scratch.chain_solved.assign(plan.chains.size(), 0);
    scratch.chain_error.assign(plan.chains.size(), 0.0);
    scratch.body_contacts.resize(plan.colliding);
    for (BodyContactScratch& each : scratch.body_contacts) each.listed = false;
    scratch.listed.resize(plan.colliding > 0 ? state.position.size() : 0);
    scratch.chain_contacts.resize(plan.colliding > 0 ? plan.chains.size() : 0);
    scratch.cloths.resize(plan.grids.size());
    for (std::size_t i = 0; i < plan.grids.size(); ++i)
        scratch.cloths[i].resize(plan.grids[i].columns, plan.grids[i].rows);
    scratch.tied.resize(plan.tied.size());
    scratch.tie_forces.resize(plan.tied.size());
    for (std::size_t i = 0; i < plan.tied.size(); ++i) {
        scratch.tied[i].resize(plan.tied[i].order);
        scratch.tie_forces[i].resize(plan.tied[i].across.size(), plan.tied[i].order.rank.size());
    }
    scratch.tied_step.resize(plan.tied.empty() ? 0 : particles);
    scratch.tie_multiplier.assign(state.ties.size(), 0.0);
}

void size(IslandScratch& scratch, const State& state, const Plan& plan, std::size_t lanes) {
    scratch.done = {};
    scratch.pushes.clear();
    scratch.touched.clear();
    scratch.touched.reserve(state.position.size());
    scratch.near.reserve(4 * plan.chunks.size());
    scratch.members.reserve(plan.chains.size() + plan.islands.size() + plan.parts.size());
    const std::size_t cells = plan.grids.empty() && plan.tied.empty() ? 0 : state.position.size();
    scratch.cloth_contacts.reserve(cells);
    scratch.earlier_contacts.reserve(cells);
    const std::size_t nodes = plan.longest + 1;
    ContactScratch& contact = scratch.contact;
    contact.nodes.reserve(nodes), contact.bonds.reserve(nodes), contact.saved.reserve(nodes);
    contact.contacts.reserve(nodes), contact.node_effects.reserve(nodes), contact.planes.reserve(4 * nodes);
    const std::size_t touches = nodes * detail::ChainBond::max_contacts;
    contact.link_contacts.reserve(nodes), contact.bond_effects.reserve(touches);
    contact.saved_contacts.reserve(touches), contact.link_colliders.reserve(4 * nodes);
    constexpr std::size_t alignment = 8;  // doubles: 64 bytes
    scratch.block.assign(detail::Block::doubles(plan.longest, lanes) + alignment, 0.0);
    const auto address = reinterpret_cast<std::uintptr_t>(scratch.block.data());
    scratch.block_offset = (64 - address % 64) % 64 / sizeof(double);
}

}  // namespace

Workspace::Workspace() : parts_(std::make_unique<Parts>()) {
    parts_->scratch.unit = detail::vector_unit("");
    parts_->scratch.grid_unit = detail::grid_unit("");
    parts_->scratch.cloth_unit = detail::cloth_unit("");
}
Workspace::Workspace(Workspace&&) noexcept = default;
Workspace& Workspace::operator=(Workspace&&) noexcept = default;
Workspace::~Workspace() = default;

Result Workspace::use_vector_unit(std::string_view name) {
    if (!parts_) return tendril::detail::moved_from("use_vector_unit", "workspace");
    const bool single = name == "none";
    const detail::VectorUnit unit = detail::vector_unit(single ? "" : name);
    if (unit.solve == nullptr) {
        return tendril::detail::refused("use_vector_unit", "name", "one of ik::vector_units(), or \"none\"",
                                        name);
    }
    parts_->scratch.unit = single ? detail::VectorUnit{unit.single, unit.single, 1} : unit;
    parts_->scratch.grid_unit = detail::grid_unit(single ? "" : name);
    parts_->scratch.cloth_unit = detail::cloth_unit(single ? "" : name);
    parts_->prepared = false;
    return {};
}

Result Workspace::use_threads(int threads, const Tasks& tasks) {
    if (!parts_) return tendril::detail::moved_from("use_threads", "workspace");
    if (threads < 1 || threads > static_cast<int>(tendril::detail::max_threads))
        return tendril::detail::refused("use_threads", "threads", "1 to 256", threads);
    parts_->threads.resize(static_cast<std::size_t>(threads));
    parts_->tasks = tasks;
    parts_->prepared = false;
    return {};
}

void Workspace::Parts::prepare(const State& state) {
    if (!std::exchange(prepared, false) || !plan.fits(state)) replan(state);
    scratch.colliders.resize(state.colliders.size());
    if (plan.tears) torn.reserve(state.links.size());
    if (detail::has_air(state.settings)) scratch.wind_move.assign(state.position.size(), glm::dvec3(0.0));
    for (IslandScratch& thread : threads) thread.close.reserve(state.colliders.size());
    scratch.collider_at.resize(state.collider_slots.size());
    for (std::uint32_t i = 0; i < state.colliders.size(); ++i)
        scratch.collider_at[state.colliders[i].id.index] = i;
}

void Workspace::Parts::replan(const State& state) {
    plan = Plan(state);
    size(scratch, state, plan);
    for (IslandScratch& thread : threads) size(thread, state, plan, scratch.unit.lanes);
}

}  // namespace tendril::rope
