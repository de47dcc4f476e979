#include "app/labs/kit/named_world.hpp"

#include <algorithm>
#include <numeric>
#include <stdexcept>

#include "app/io/json_complete.hpp"
#include "app/labs/kit/arguments.hpp"

namespace tendril::app {
namespace {

[[noreturn]] void refuse(const char* operation, const std::string& rule, std::string_view name) {
    throw std::invalid_argument(std::string(operation) + ": name must be " + rule + ", got \"" +
                                std::string(name) + "\"");
}

template <class Value>
void set_slot(std::vector<Value>& values, std::size_t slot, const Value& value) {
    if (values.size() <= slot) values.resize(slot + 1);
    values[slot] = value;
}

template <class List>
auto* named(const List& list, const std::vector<std::string>& names, std::string_view name) {
    const auto found = std::find_if(list.begin(), list.end(),
                                    [&](const auto& each) { return names[each.id.index] == name; });
    return found == list.end() ? nullptr : &*found;
}

/// Names by the slot of their object. Throws if one is empty or used twice.
template <class List>
std::vector<std::string> by_slot(const List& list, const std::vector<std::string>& given, const char* kind) {
    std::vector<std::string> names;
    std::vector<std::string> sorted = given;
    std::sort(sorted.begin(), sorted.end());
    const auto twice = std::adjacent_find(sorted.begin(), sorted.end());
    if (twice != sorted.end())
        throw std::invalid_argument(std::string("there are two ") + kind + " named \"" + *twice + "\"");
    if (!sorted.empty() && sorted.front().empty())
        throw std::invalid_argument(std::string("one of the ") + kind + " has no name");
    for (std::size_t i = 0; i < list.size(); ++i) set_slot(names, list[i].id.index, given[i]);
    return names;
}

}  // namespace

NamedWorld::NamedWorld(rope::State state, const std::vector<std::string>& bodies,
                       const std::vector<std::string>& colliders, const std::vector<std::string>& ties) {
    rope::number_slots(state);
    put(std::move(state));
    bodies_ = by_slot(this->state().bodies, bodies, "bodies");
    colours_.resize(bodies_.size());
    colliders_ = by_slot(this->state().colliders, colliders, "colliders");
    ties_ = by_slot(this->state().ties, ties, "ties");
}

void NamedWorld::put(rope::State state) {
    world_ = require_value(rope::World::from_state(std::move(state)));
}

const rope::Body* NamedWorld::find(std::string_view body) const {
    return named(state().bodies, bodies_, body);
}
const rope::Collider* NamedWorld::find_collider(std::string_view collider) const {
    return named(state().colliders, colliders_, collider);
}
const rope::Tie* NamedWorld::find_tie(std::string_view tie) const {
    return named(state().ties, ties_, tie);
}
rope::BodyId NamedWorld::id(std::string_view body) const {
    const rope::Body* found = find(body);
    return found == nullptr ? rope::BodyId{} : found->id;
}
rope::ColliderId NamedWorld::collider_id(std::string_view collider) const {
    const rope::Collider* found = find_collider(collider);
    return found == nullptr ? rope::ColliderId{} : found->id;
}

rope::TieId NamedWorld::tie_id(std::string_view tie) const {
    const rope::Tie* found = find_tie(tie);
    return found == nullptr ? rope::TieId{} : found->id;
}

void NamedWorld::check_free(const char* operation, std::string_view body) const {
    if (!body.empty() && find(body) != nullptr) refuse(operation, "one that no other body has", body);
}

std::string NamedWorld::name_body(rope::BodyId body, const std::string& wanted, const std::string& stem) {
    set_slot(bodies_, body.index, {});
    set_slot(colours_, body.index, BodyColour::ByKind);
    const auto taken = [&](const std::string& name) { return find(name) != nullptr; };
    return bodies_[body.index] = wanted.empty() || taken(wanted) ? free_name(stem, taken) : wanted;
}

/// Pieces of "cloth" are called "cloth 2" and "cloth 3"; a piece of "cloth 2" is called "cloth 4".
std::vector<std::string> NamedWorld::name_pieces(std::string_view of, std::span<const rope::BodyId> pieces) {
    std::string stem(of);
    const std::size_t end = stem.find_last_not_of("0123456789");
    if (end != std::string::npos && end > 0 && end + 1 < stem.size() && stem[end] == ' ') stem.resize(end);
    for (const rope::BodyId each : pieces) set_slot(bodies_, each.index, {});
    const BodyColour colour = colours_[id(of).index];
    std::vector<std::string> names;
    int number = 2;
    for (const rope::BodyId each : pieces) {
        const auto next = [&] { return stem + " " + std::to_string(number++); };
        std::string name = next();
        while (find(name) != nullptr) name = next();
        bodies_[each.index] = name;
        set_slot(colours_, each.index, colour);
        names.push_back(std::move(name));
    }
    return names;
}

void NamedWorld::set_settings(const rope::Settings& settings) {
    require_ok(world_.set_settings(settings));
}

std::string NamedWorld::add_rope(const std::string& name, const rope::RopeShape& shape) {
    check_free("add_rope", name);
    return name_body(require_value(world_.add_rope(shape)), name, "rope");
}
std::string NamedWorld::add_cloth(const std::string& name, const rope::ClothShape& shape) {
    check_free("add_cloth", name);
    return name_body(require_value(world_.add_cloth(shape)), name, "cloth");
}
std::string NamedWorld::add_hair(const std::string& name, rope::HairShape shape, const std::string& attach) {
    check_free("add_hair", name);
    if (!attach.empty()) shape.attach = collider_id(attach);
    return name_body(require_value(world_.add_hair(shape)), name, "hair");
}

Became NamedWorld::cut(std::string_view rope, std::size_t segment) {
    const rope::Body* const whole = find(rope);
    Became became{std::vector<std::size_t>(whole == nullptr ? 0 : whole->count), {}};
    std::iota(became.particles.begin(), became.particles.end(), std::size_t{0});
    const rope::BodyId rest = require_value(world_.cut(id(rope), segment));
    became.pieces = name_pieces(rope, {&rest, 1});
    return became;
}

std::size_t NamedWorld::particle(std::string_view body, std::size_t index) const {
    return require_value(world_.particle(id(body), index));
}
void NamedWorld::rename(std::string_view body, const std::string& name) {
    const rope::BodyId renamed = id(body);
    if (const rope::Body* other = find(name); other != nullptr && other->id == renamed) return;
    if (name.empty()) refuse("rename", "of at least one character", name);
    check_free("rename", name);
    require_value(world_.particle(renamed, 0));
    bodies_[renamed.index] = name;
}
void NamedWorld::set_colour(std::string_view body, BodyColour colour) {
    if (find(body) == nullptr) refuse("set_colour", "the name of a body", body);
    colours_[id(body).index] = colour;
}

Became NamedWorld::take(std::string_view body, Expected<rope::Edited> edited) {
    rope::Edited given = require_value(std::move(edited));
    world_ = std::move(given.world);
    return {std::move(given.becomes), name_pieces(body, given.pieces)};
}
Became NamedWorld::resample(std::string_view body, const rope::Resolution& to) {
    return take(body, rope::resample(world_, id(body), to));
}
Became NamedWorld::reverse(std::string_view rope) {
    return take(rope, rope::reverse(world_, id(rope)));
}
Became NamedWorld::cut_cloth(std::string_view cloth, std::span<const rope::ClothLine> lines) {
    return take(cloth, rope::cut_cloth(world_, id(cloth), lines));
}
Became NamedWorld::part_body(std::string_view body) {
    return take(body, rope::part_body(world_, id(body)));
}

void NamedWorld::pin(std::size_t particle, const glm::dvec3& at, double seconds) {
    require_ok(world_.pin(particle, at, seconds));
}
void NamedWorld::attach(std::size_t particle, std::string_view collider) {
    require_ok(world_.attach(particle, collider_id(collider)));
}
void NamedWorld::unpin(std::size_t particle) {
    require_ok(world_.unpin(particle));
}

std::string NamedWorld::tie(const std::string& name, std::size_t a, std::size_t b,
                            const rope::TieShape& shape) {
    if (!name.empty() && find_tie(name) != nullptr) refuse("tie", "one that no other tie has", name);
    std::string unused = name;
    for (int i = 1; unused.empty() || find_tie(unused) != nullptr; ++i)
        unused = i == 1 ? "tie" : "tie " + std::to_string(i);
    set_slot(ties_, require_value(world_.tie(a, b, shape)).index, unused);
    return unused;
}
void NamedWorld::set_collides(std::string_view a, std::string_view b, bool on) {
    require_ok(world_.set_collides(id(a), id(b), on));
}

void NamedWorld::add_collider(const std::string& name, const rope::Shape& shape) {
    if (name.empty()) refuse("add_collider", "not empty", name);
    if (find_collider(name) != nullptr) refuse("add_collider", "one that no other collider has", name);
    set_slot(colliders_, require_value(world_.add_collider(shape)).index, name);
}
void NamedWorld::drag_pins(rope::Workspace& workspace, std::span<const rope::PinPlace> pins) {
    require_ok(rope::drag_pins(world_, workspace, pins));
}
void NamedWorld::drag_collider(rope::Workspace& workspace, std::string_view name, const glm::vec3& to) {
    require_ok(rope::drag_collider(world_, workspace, collider_id(name), to));
}
void NamedWorld::drag_collider(rope::Workspace& workspace, std::string_view name, const rope::Shape& shape) {
    require_ok(rope::drag_collider(world_, workspace, collider_id(name), shape));
}

glm::vec3 NamedWorld::position(std::size_t particle) const {
    glm::dvec3 at(0.0);
    world_.pose({&at, 1}, particle);
    return glm::vec3(at);
}

std::vector<glm::vec3> NamedWorld::positions() const {
    std::vector<glm::dvec3> pose(size());
    world_.pose(pose);
    return {pose.begin(), pose.end()};
}

rope::Advance NamedWorld::advance(double seconds, rope::Workspace& workspace, std::uint64_t max_substeps) {
    return world_.advance(seconds, workspace, {.max_substeps = max_substeps, .impulses = true});
}

template <>
std::span<const FieldText> field_texts<rope::Settings>() {
    static constexpr EnumRow solvers[] = {rope_solvers.row(rope::Solver::Direct),
                                          rope_solvers.row(rope::Solver::Xpbd),
                                          rope_solvers.row(rope::Solver::Relaxation)};
    static constexpr FieldText texts[] = {
        {.name = "substep",  // the panel shows substeps per second
         .help = "The length of the equal steps that the simulation takes. Shorter ones follow fast motion "
                 "better and cost more."},
        {.name = "iterations",
         .label = "iterations",
         .help = "The maximum number of passes per substep. Direct stops as soon as it has converged; with "
                 "the others, more passes stretch a rope less and cost more.",
         .more = true},
        {.name = "solver",
         .label = "solver",
         .help = "How the lengths of ropes are kept.",
         .listed = true,
         .choices = solvers},
        {.name = "damping",
         .label = "damping",
         .help = "How fast motion dies away. Raise it if ropes swing for too long.",
         .more = true},
        {.name = "gravity",
         .label = "gravity",
         .help = "The acceleration due to gravity, along each axis; Y points up. On Earth it is 0, -9.81, 0.",
         .step = 0.05f,
         .more = true},
        {.name = "gravity_scale", .label = "gravity scale", .help = "Multiplies gravity.", .more = true},
        {.name = "external",
         .label = "push",
         .help = "A steady acceleration of everything that moves, in addition to gravity.",
         .step = 0.05f,
         .more = true},
        {.name = "wind",
         .label = "wind",
         .help =
             "The velocity of the air along x, y and z. It pushes cloth, ropes and hair, and makes a flag "
             "flutter. At 0 there is no air, unless still air resists.",
         .step = 0.05f,
         .decimals = 1,
         .in_line = true},
        {.name = "gusts",
         .label = "gusts",
         .help = "How much the wind varies, relative to its speed. At 0 it is steady.",
         .more = true},
        {.name = "still_air",
         .label = "Still air resists",
         .help = "Whether air resists without wind too: cloth then falls slowly, and swings less and less.",
         .more = true},
        {.name = "compliance",
         .label = "compliance",
         .help = "How elastic ropes are: the fraction of its length that a rope stretches per newton. 0 does "
                 "not stretch; relaxation ignores it.",
         .scale = 100.0,
         .unit = "%/N",
         .more = true},
        {.name = "friction",
         .label = "friction",
         .help = "Coulomb's coefficient between ropes and colliders. At 0 ropes slide off; more holds "
                 "them.",
         .more = true},
        {.name = "longest_frame",
         .label = "longest frame",
         .help = "The most time that a frame simulates; the rest is dropped, so that a slow frame does not "
                 "make the next one slower.",
         .step = 1.0f,
         .decimals = 0,
         .scale = 1000.0,
         .unit = "ms",
         .more = true}};
    return texts;
}

namespace {

/// The three rows from "wind" on.
template <class Row>
std::span<const Row> from_wind(std::span<const Row> rows) {
    const auto wind =
        std::ranges::find_if(rows, [](const Row& each) { return std::string_view(each.name) == "wind"; });
    return {wind, wind + 3};
}

}  // namespace

std::span<const Field> wind_fields() {
    return from_wind(fields<rope::Settings>());
}

std::span<const FieldText> wind_texts() {
    return from_wind(field_texts<rope::Settings>());
}

}  // namespace tendril::app
