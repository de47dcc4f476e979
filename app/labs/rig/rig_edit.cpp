#include "app/labs/rig/rig_edit.hpp"

#include <algorithm>
#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <map>
#include <memory>
#include <regex>
#include <set>
#include <stdexcept>
#include <string_view>
#include <utility>

#include "app/io/json_complete.hpp"
#include "app/io/text.hpp"
#include "app/labs/kit/arguments.hpp"
#include "app/labs/rig/definition_json.hpp"
#include "app/labs/rig/take.hpp"
#include "app/labs/rig/unit_inputs.hpp"

namespace tendril::app {
namespace {

std::string quoted(const std::string& name) {
    return '"' + name + '"';
}

void check_count(std::size_t count, std::size_t most, const char* what) {
    if (count > most)
        throw std::invalid_argument("the rig would have " + std::to_string(count) + " " + what +
                                    "; the maximum is " + std::to_string(most));
}

/// Names must fit on a line and be storable in a file.
void check_name(const std::string& name) {
    constexpr std::size_t longest = 100;
    if (name.size() > longest)
        throw std::invalid_argument("a name has " + std::to_string(name.size()) +
                                    " characters; the most is " + std::to_string(longest));
    if (std::any_of(name.begin(), name.end(), [](unsigned char c) { return c < 0x20 || c == 0x7f; }))
        throw std::invalid_argument("a name has an unprintable character");
    if (!is_storable(name)) throw std::invalid_argument("a name must be valid UTF-8");
}

/// Number of elements that a for-each visits; stops counting above `most`.
std::size_t visits(const rig::Rig& rig, const rig::State& rest, const rig::ForEach& loop, std::size_t most) {
    std::size_t count = 0;
    for (const std::string& root : loop.roots) {
        const auto element = rig.element(root);
        if (!element) continue;  // refused later, by Rig::make
        const rig::ElementId top = rig.id(*element);
        for (rig::ElementId at = top; at && count <= most; at = rest.elements.next_depth_first(at, top))
            ++count;
    }
    return count;
}

/// Refuses rigs that would run too long before making them: one line of a file can request millions of runs.
void check_runs(const rig::Definition& definition) {
    const auto is_loop = [](const rig::Unit& unit) {
        return std::holds_alternative<rig::ForEach>(unit.operation);
    };
    if (std::none_of(definition.units.begin(), definition.units.end(), is_loop)) return;
    const rig::Rig rig =
        require_value(rig::Rig::make({.elements = definition.elements, .curves = {}, .units = {}}));
    const rig::State rest = rig.initial_state();
    std::size_t runs = 0;
    for (const rig::Unit& unit : definition.units) {
        if (const auto* loop = std::get_if<rig::ForEach>(&unit.operation))
            runs += visits(rig, rest, *loop, max_lab_runs) * std::max<std::size_t>(1, loop->body.size());
        if (runs > max_lab_runs)
            throw std::invalid_argument("unit " + quoted(unit.name) +
                                        ": a solve would run more units than the maximum of " +
                                        std::to_string(max_lab_runs));
    }
}

/// Calls `found` with the list that contains the unit of that name, and its index there.
bool find_unit(auto& units, std::string_view name, const auto& found) {
    for (std::size_t i = 0; i < units.size(); ++i) {
        if (units[i].name == name) {
            found(units, i);
            return true;
        }
        if (auto* loop = std::get_if<rig::ForEach>(&units[i].operation))
            if (find_unit(loop->body, name, found)) return true;
    }
    return false;
}

void require_unit(auto& definition, std::string_view name, const auto& found) {
    if (!find_unit(definition.units, name, found))
        throw std::invalid_argument("there is no unit " + quoted(std::string(name)));
}

/// The elements with the same names in the other rig, where they exist.
Selection in_other_rig(const Selection& before, const rig::Rig& from, const rig::Rig& to) {
    std::vector<std::size_t> there;
    const auto keep = [&](std::size_t element) {
        if (const auto at = to.element(from.definition().elements[element].name)) there.push_back(*at);
    };
    for (const std::size_t each : before.all())
        if (each != before.active()) keep(each);
    if (before.active()) keep(*before.active());
    Selection result;
    result.take(there, false);
    return result;
}

}  // namespace

rig::Rig make_rig(rig::Definition definition) {
    check_count(definition.elements.size(), max_lab_elements, "elements");
    check_count(definition.curves.size(), max_lab_curves, "curves");
    std::size_t units = definition.units.size();
    for (const rig::Unit& unit : definition.units)
        if (const auto* loop = std::get_if<rig::ForEach>(&unit.operation)) units += loop->body.size();
    check_count(units, max_lab_units, "units");
    for (const rig::Element& each : definition.elements) check_name(each.name);
    for (const rig::NamedCurve& each : definition.curves) check_name(each.name);
    std::set<std::string> names;
    collect_names(definition.units, names);
    for (const std::string& each : names) check_name(each);
    check_runs(definition);
    return require_value(rig::Rig::make(std::move(definition)));
}

namespace {

void adopt(RigPart& part, rig::Rig rig) {
    if (!rig.keeps_states_of(part.rig)) part.state = rig.adopted(part.rig, part.state);
    const rig::Rig before = std::exchange(part.rig, std::move(rig));
    select_as_in(part, part.selected, before);
    std::erase_if(part.walks, [&](const RigWalk& walk) { return !part.rig.element(walk.control); });
    changed(part);
}

}  // namespace

void redefine(RigPart& part, rig::Definition definition) {
    adopt(part, make_rig(std::move(definition)));
}

void select_as_in(RigPart& part, RigSelection selected, const rig::Rig& other) {
    selected.elements = in_other_rig(selected.elements, other, part.rig);
    part.selected = std::move(selected);
    forget_missing_unit(part);
}

void forget_missing_unit(RigPart& part) {
    const auto names = part.rig.unit_names();
    if (std::ranges::find(names, part.selected.unit) == names.end()) part.selected.unit.clear();
    part.selected.unit_last =
        !part.selected.unit.empty() && (part.selected.unit_last || part.selected.elements.empty());
}

void changed(RigPart& part) {
    part.moving = true;
    part.edited = true;
    part.backward.reset();
    part.rates.reset();
    part.clip_left.reset();  // it belongs to the old rig
    begin_take(part);
}

void remove_elements(RigPart& part, const std::vector<std::size_t>& elements) {
    rig::Definition definition = part.rig.definition();
    std::set<std::string> names;
    for (const std::size_t each : elements) names.insert(definition.elements[each].name);
    for (const rig::Element& each : definition.elements)
        if (names.contains(each.parent) && !names.contains(each.name))
            throw std::invalid_argument(quoted(each.parent) + " is the parent of " + quoted(each.name));
    if (const auto use = first_use(definition.units, Named::Element, names))
        throw std::invalid_argument("unit " + quoted(use->unit) + " needs " + quoted(use->name) + " as its " +
                                    use->member);
    std::erase_if(definition.elements, [&](const rig::Element& each) { return names.contains(each.name); });
    redefine(part, std::move(definition));
}

namespace {

/// Swaps the first word for a side, as in "left hand", "HandLeft", "LEFT_HAND", "hand.L" and "L_hand".
std::string on_other_side(const std::string& name) {
    static const std::regex side(
        "(?:^|[^A-Za-z])(left|right)(?![a-z])|(Left|Right)(?![a-z])|(?:^|[^A-Z])(LEFT|RIGHT)(?![A-Za-z])|"
        "[._](L|R)(?![A-Za-z0-9])|(?:^|[^A-Za-z0-9])(L|R)(?=_)");
    static const std::map<std::string, const char*> others{
        {"left", "right"}, {"Left", "Right"}, {"LEFT", "RIGHT"}, {"L", "R"},
        {"right", "left"}, {"Right", "Left"}, {"RIGHT", "LEFT"}, {"R", "L"}};
    std::smatch found;
    if (!std::regex_search(name, found, side)) return name;
    std::size_t word = 1;
    while (!found[word].matched) ++word;
    return std::string(name.begin(), found[word].first) + others.at(found.str(word)) +
           std::string(found[word].second, name.end());
}

/// The number of the control's value that changes sign in a mirror.
std::optional<int> number_along_x(const rig::Control& control) {
    using Kind = rig::ControlKind;
    if (control.kind == Kind::Vector2d)
        for (int i = 0; i < 2; ++i)
            if (control.axes[static_cast<std::size_t>(i)] == 0) return i;
    if (control.kind == Kind::Transform || control.kind == Kind::Position) return 0;
    return std::nullopt;
}

rig::Control mirrored(rig::Control control, const std::string& name) {
    const auto x = number_along_x(control);
    if (!x || (!control.minimum && !control.maximum)) return control;
    if (!control.minimum || !control.maximum)
        throw std::invalid_argument(quoted(name) + " has a limit on one side only, which cannot be mirrored");
    std::swap((*control.minimum)[*x], (*control.maximum)[*x]);
    (*control.minimum)[*x] *= -1.0;
    (*control.maximum)[*x] *= -1.0;
    return control;
}

glm::dquat mirrored(const glm::dquat& q) {
    return {q.w, q.x, -q.y, -q.z};
}

rig::Transform mirrored(const rig::Transform& pose) {
    return {{0.0 - pose.translation.x, pose.translation.y, pose.translation.z},
            mirrored(pose.rotation),
            pose.scale};
}

rig::Value mirrored(const rig::Control& control, rig::Value value) {
    if (auto* const pose = std::get_if<rig::Transform>(&value)) *pose = mirrored(*pose);
    if (auto* const rotation = std::get_if<glm::dquat>(&value)) *rotation = mirrored(*rotation);
    if (auto* const vector = std::get_if<glm::dvec3>(&value))
        if (const auto x = number_along_x(control)) (*vector)[*x] *= -1.0;
    return value;
}

}  // namespace

void remove_unit(RigPart& part, const std::string& name) {
    rig::Definition definition = part.rig.definition();
    require_unit(definition, name, [&](rig::Units& units, std::size_t at) { units.erase(at); });
    if (const auto use = first_use(definition.units, Named::Unit, {name}))
        throw std::invalid_argument("unit " + quoted(use->unit) + " takes its " + use->member + " from " +
                                    quoted(name));
    redefine(part, std::move(definition));
}

void enable_unit(RigPart& part, const std::string& name, bool on) {
    rig::Definition definition = part.rig.definition();
    bool was = on;
    require_unit(definition, name,
                 [&](rig::Units& units, std::size_t at) { was = std::exchange(units[at].enabled, on); });
    if (was != on) redefine(part, std::move(definition));
}

void move_unit(RigPart& part, const std::string& name, int at) {
    rig::Definition definition = part.rig.definition();
    require_unit(definition, name, [&](rig::Units& units, std::size_t from) {
        const int last = static_cast<int>(units.size()) - 1;
        if (at > last)
            throw std::invalid_argument("at must be 0 to " + std::to_string(last) + ", got " +
                                        std::to_string(at));
        rig::Unit moved = std::move(units[from]);
        units.erase(from);
        units.insert(static_cast<std::size_t>(at), std::move(moved));
    });
    if (!(definition == part.rig.definition())) redefine(part, std::move(definition));
}

void add_unit(RigPart& part, rig::Unit unit, int at, const std::string& into) {
    rig::Definition definition = part.rig.definition();
    rig::Units* list = &definition.units;
    const auto body_of = [&](rig::Units& units, std::size_t found) {
        auto* const loop = std::get_if<rig::ForEach>(&units[found].operation);
        if (loop == nullptr) throw std::invalid_argument("into: unit " + quoted(into) + " is not a for-each");
        list = &loop->body;
    };
    if (!into.empty()) require_unit(definition, into, body_of);
    const int count = static_cast<int>(list->size());
    if (at > count)
        throw std::invalid_argument("at must be 0 to " + std::to_string(count) + ", got " +
                                    std::to_string(at));
    std::set<std::string> taken;
    collect_names(definition.units, taken);
    rig::Units added{std::move(unit)};
    collect_names(added, taken);  // the library refuses duplicate names
    name_units(added, taken);
    const std::string name = added[0].name;
    list->insert(static_cast<std::size_t>(at < 0 ? count : at), std::move(added[0]));
    redefine(part, std::move(definition));
    part.selected.unit = name;  // the inspector shows it
    part.selected.unit_last = true;
}

void set_unit(RigPart& part, const std::string& name, rig::Unit unit) {
    if (!std::holds_alternative<rig::ForEach>(unit.operation)) {
        if (!(unit == unit_named(part, name)))
            adopt(part, require_value(part.rig.with_unit(std::move(unit))));
        return;
    }
    rig::Definition definition = part.rig.definition();
    require_unit(definition, name, [&](rig::Units& units, std::size_t at) {
        std::set<std::string> taken;
        collect_names(definition.units, taken);
        rig::Units bodies{std::move(unit)};
        collect_names(bodies, taken);
        name_units(bodies, taken);
        units[at] = std::move(bodies[0]);
    });
    if (!(definition == part.rig.definition())) redefine(part, std::move(definition));
}

const rig::Unit& unit_named(const RigPart& part, std::string_view name) {
    const rig::Unit* result = nullptr;
    require_unit(part.rig.definition(), name,
                 [&](const rig::Units& units, std::size_t at) { result = &units[at]; });
    return *result;
}

std::vector<std::size_t> from_the_roots(const rig::Rig& rig, const rig::Hierarchy& tree) {
    std::vector<std::size_t> at(tree.size()), order;
    for (std::size_t i = 0; i < at.size(); ++i) at[rig.id(i).index] = i;
    for (rig::ElementId top = tree.first_child({}); top; top = tree.next_sibling(top))
        for (rig::ElementId each = top; each; each = tree.next_depth_first(each, top))
            order.push_back(at[each.index]);
    return order;
}

std::size_t element_named(const RigPart& part, const std::string& name) {
    const auto found = part.rig.element(name);
    if (!found) throw std::invalid_argument("there is no element " + quoted(name));
    return *found;
}

std::vector<std::string> names_of(const RigPart& part, const std::vector<std::size_t>& elements) {
    std::vector<std::string> names;
    for (const std::size_t each : elements) names.push_back(part.rig.definition().elements[each].name);
    return names;
}

std::size_t curve_named(const RigPart& part, const std::string& name) {
    const auto found = part.rig.curve(name);
    if (!found) throw std::invalid_argument("there is no curve " + quoted(name));
    return *found;
}

namespace {

/// Calls `take(unit, member, kind, name)` for every name that units refer to, including bodies. `take` may
/// change the names; those of inputs are then set.
template <class Take>
class UsedNames {
  public:
    explicit UsedNames(const Take& take) : take_(take) {}

    void of(rig::Units& units) {
        for (rig::Unit& each : units) unit(each);
    }

  private:
    void members(const std::string& place, std::span<const Field> table, void* object) {
        for (const Field& field : table) {
            if (field.address == nullptr) {
                member(field, object, place + field.name);
                continue;
            }
            const std::size_t count = field.count != nullptr ? field.count(object) : 1;
            for (std::size_t i = 0; i < count; ++i) {
                void* const at = field.address_in(object, i);
                if (field.type == FieldType::Kind)
                    members(place, field.kind(object).table(), at);
                else if (at != nullptr && field.holds<rig::Unit>())
                    unit(*static_cast<rig::Unit*>(at));
                else if (at != nullptr && field.type == FieldType::Struct)
                    members(place + field.name + (field.count ? '[' + std::to_string(i) + "]." : "."),
                            field.table(), at);
                else if (at != nullptr)
                    member(field, at, place + field.name);
            }
        }
    }
    void unit(rig::Unit& unit) {
        const rig::Unit* const around = std::exchange(unit_, &unit);
        members("", fields<rig::Unit>(), &unit);
        unit_ = around;
    }

    void member(const Field& field, void* at, const std::string& place) {
        if (field.type == FieldType::Text && *field.of != '\0') {
            const bool curve = field.of == std::string_view("curves");
            std::string name(field.text(at));
            take_(unit_->name, place, curve ? Named::Curve : Named::Element, name);
            if (name != field.text(at)) field.set_text(at, name);
        }
        if (field.type != FieldType::Other) return;
        rig::Input<rig::Value> input = rig::access_of(field).get(at);
        if constexpr (requires { take_.source(*unit_, place, input); }) take_.source(*unit_, place, input);
        if (auto* const from = std::get_if<rig::FromElement>(&input.source))
            if (auto* const name = std::get_if<std::string>(&from->element.which))
                take_(unit_->name, place, Named::Element, *name);
        if (auto* const from = std::get_if<rig::FromUnit>(&input.source))
            take_(unit_->name, place, Named::Unit, from->unit);
        rig::access_of(field).set(at, input);
    }

    const Take& take_;
    const rig::Unit* unit_ = nullptr;
};

}  // namespace

std::optional<Use> first_use(rig::Units units, Named kind, const std::set<std::string>& names) {
    std::optional<Use> found;
    const auto take = [&](const std::string& unit, const std::string& place, Named of,
                          const std::string& name) {
        if (!found && of == kind && names.contains(name)) found = {unit, place, name};
    };
    UsedNames(take).of(units);
    return found;
}

namespace {

using Copies = std::map<std::string, std::string>;

/// Rewrites a unit for the other side: its names and literals. The flags describe the last rewritten unit.
struct OtherSide {
    const Copies &elements, &units;
    const RigPart& part;
    rig::Transform plane;                      ///< mirror plane: across the x of the branch's parent at rest
    mutable bool names = false, sets = false;  ///< elements of the branch
    mutable bool sets_outside = false, counts = false;  ///< other elements; the elements of a for-each

    rig::Unit of(const rig::Unit& unit) const {
        names = sets = sets_outside = counts = false;
        rig::Units copy{unit};
        if (auto* const loop = std::get_if<rig::ForEach>(&copy[0].operation)) {
            std::erase_if(loop->roots, [&](const std::string& root) { return !elements.contains(root); });
            sets_outside = loop->roots.empty();
        }
        UsedNames(*this).of(copy);
        if (const auto name = units.find(unit.name); name != units.end()) copy[0].name = name->second;
        if (auto* const loop = std::get_if<rig::ForEach>(&copy[0].operation))
            for (rig::Unit& each : loop->body)
                if (const auto name = units.find(each.name); name != units.end()) each.name = name->second;
        return copy[0];
    }
    void operator()(const std::string&, const std::string& place, Named kind, std::string& name) const {
        const auto copy = elements.find(name);
        const bool found = kind == Named::Element && copy != elements.end();
        names |= found;
        for (const char* set : {"item", "root", "tip", "roots", "curve"})
            if (place == set) (found ? sets : sets_outside) = true;
        if (found) name = copy->second;
        if (const auto unit = units.find(name); kind == Named::Unit && unit != units.end())
            name = unit->second;
    }
    void source(const rig::Unit& unit, const std::string& place, rig::Input<rig::Value>& input) const {
        counts |= std::holds_alternative<rig::Each>(input.source);
        rig::Value* const value = std::get_if<0>(&input.source);
        if (value == nullptr) return;
        const auto space = space_of(unit.operation, place);
        const auto across = [&](const rig::Transform& pose) {
            return space ? rig::compose(*space, mirrored(rig::relative(*space, pose))) : mirrored(pose);
        };
        // A force on a rotation is a rotation axis.
        const bool turns =
            place == "force" && part.state->units[unit_row(part, unit.name)->at].outputs[0].index() ==
                                    static_cast<std::size_t>(rig::Type::Rotation);
        if (auto* const pose = std::get_if<rig::Transform>(value)) *pose = across(*pose);
        if (auto* const turn = std::get_if<glm::dquat>(value)) *turn = across({.rotation = *turn}).rotation;
        if (auto* const vector = std::get_if<glm::dvec3>(value))
            *vector = (turns ? -1.0 : 1.0) * across({.translation = *vector}).translation;
        if (auto* const roll = std::get_if<double>(value); roll && place.starts_with("roll_")) *roll *= -1.0;
    }

  private:
    /// The plane that mirrors a literal: the rest plane in global space; none if its space is mirrored with
    /// it, such as the item's own.
    std::optional<rig::Transform> space_of(const rig::Operation& operation, const std::string& place) const {
        using Space = std::optional<rig::Transform>;
        const rig::Transform directions{.rotation = plane.rotation};
        const auto of = [&](const auto& does) -> Space {
            if constexpr (requires { does.space; }) {
                return does.space == rig::Space::Global ? Space(plane) : std::nullopt;
            } else if constexpr (requires { does.primary; }) {
                if (place.ends_with(".axis")) return std::nullopt;
                const rig::AimInputs& aim = place.starts_with("secondary") ? *does.secondary : does.primary;
                return aim.kind == rig::AimTarget::Direction && place != "transform" ? directions : plane;
            }
            if (place == "up" || place == "force") return directions;
            constexpr bool is_chain = requires {
                does.pole_target;
            };
            return is_chain || place == "transform" ? Space(plane) : std::nullopt;
        };
        return std::visit(of, static_cast<const rig::Operation::Variant&>(operation));
    }
};

/// Copies the units that set the branch, and the units that only these use, each after its original. A unit
/// that the mirror leaves unchanged serves both sides. So does a for-each, unless its body changes, or it
/// counts only elements of the branch.
void mirror_units(rig::Units& units, const RigPart& part, const Copies& elements,
                  const rig::Transform& plane) {
    Copies copies;
    std::set<std::string> taken, here, elsewhere;
    collect_names(units, taken);
    const OtherSide other_side{elements, copies, part, plane};
    std::vector<bool> copied(units.size());
    for (std::size_t i = units.size(); i-- > 0;) {
        rig::Units one{other_side.of(units[i])};
        const bool used = here.contains(units[i].name), only_here = !elsewhere.contains(units[i].name);
        copied[i] = !other_side.sets_outside && (other_side.sets || used || (other_side.names && only_here));
        const auto use = [&](const std::string&, const std::string&, Named kind, const std::string& name) {
            if (kind == Named::Unit) (copied[i] ? here : elsewhere).insert(name);
        };
        UsedNames(use).of(one);
    }
    for (std::size_t i = 0, at = 0; i < copied.size(); ++i, ++at) {
        rig::Unit copy = other_side.of(units[at]);
        if (auto* const loop = std::get_if<rig::ForEach>(&units[at].operation); loop && other_side.sets) {
            auto& other = std::get<rig::ForEach>(copy.operation);
            const bool counts = other_side.counts && other.roots.size() == loop->roots.size();
            if (other_side.sets_outside || (other.body == loop->body && !counts)) {
                loop->roots.insert(loop->roots.end(), other.roots.begin(), other.roots.end());
                continue;
            }
        }
        if (!copied[i] || copy == units[at]) continue;
        std::set<std::string> names;
        collect_names({units[at]}, names);
        for (const std::string& each : names) {
            std::string& name = copies[each] = on_other_side(each);
            if (taken.contains(name)) name = each;
            while (!taken.insert(name).second) name += " mirrored";
        }
        copy = other_side.of(units[at]);
        units.insert(++at, std::move(copy));
    }
}

}  // namespace

void mirror_branch(RigPart& part, const std::string& top) {
    element_named(part, top);  // refuses a missing one
    rig::Definition definition = part.rig.definition();
    Copies copies;
    for (const std::size_t at : from_the_roots(part.rig, part.state->elements)) {
        rig::Element copy = part.rig.definition().elements[at];
        const std::string name = copy.name;
        if (name != top && !copies.contains(copy.parent)) continue;
        copy.name = on_other_side(name);
        if (std::ranges::find(definition.elements, copy.name, &rig::Element::name) !=
            definition.elements.end())
            copy.name = name + " mirrored";
        copies[name] = copy.name;
        if (name != top) copy.parent = copies[copy.parent];
        copy.initial = mirrored(copy.initial);
        if (copy.control) copy.control = mirrored(*copy.control, name);
        definition.elements.push_back(std::move(copy));
    }
    rig::Hierarchy tree = part.state->elements;
    const auto above = tree.parent(part.rig.id(*part.rig.element(top)));
    rig::Transform plane = above ? tree.get(above, rig::Space::Global, rig::Pose::Initial) : rig::Transform();
    plane.scale = glm::dvec3(1.0);
    mirror_units(definition.units, part, copies, plane);
    redefine(part, std::move(definition));
    rig::State& state = part.state.edit();
    for (const auto& [from, to] : copies) {
        const std::size_t at = *part.rig.element(from), there = *part.rig.element(to);
        const rig::Transform input = state.elements.get(part.rig.id(at), rig::Space::Local, rig::Pose::Input);
        require_ok(part.rig.set_element(state, there, rig::Space::Local, mirrored(input)));
        if (const auto& control = part.rig.definition().elements[at].control)
            require_ok(part.rig.set_control(state, there, mirrored(*control, state.controls[at])));
    }
    part.selected.elements.only(*part.rig.element(copies[top]));
    part.selected.unit_last = false;
}

namespace {

/// Throws std::invalid_argument if nothing has the name `from`, or something else has the name `to`.
void rename_in(rig::Definition& definition, Named kind, const std::string& from, const std::string& to) {
    const auto among = [&](auto& list, const char* what) {
        const auto has = [&](const std::string& name) {
            return std::ranges::find(list, name, [](const auto& each) { return each.name; });
        };
        const auto found = has(from);
        if (found == list.end())
            throw std::invalid_argument(std::string("there is no ") + what + " " + quoted(from));
        if (has(to) != list.end())
            throw std::invalid_argument(std::string("to: there is already ") +
                                        (what[0] == 'e' ? "an " : "a ") + what + " " + quoted(to));
        found->name = to;
    };
    if (kind == Named::Element) {
        among(definition.elements, "element");
        for (rig::Element& each : definition.elements)
            if (each.parent == from) each.parent = to;
    } else if (kind == Named::Curve) {
        among(definition.curves, "curve");
    } else {
        std::set<std::string> names;
        collect_names(definition.units, names);
        require_unit(definition, from, [&](rig::Units& units, std::size_t at) { units[at].name = to; });
        if (names.contains(to)) throw std::invalid_argument("to: there is already a unit " + quoted(to));
    }
    const auto take = [&](const std::string&, const std::string&, Named of, std::string& name) {
        if (of == kind && name == from) name = to;
    };
    UsedNames(take).of(definition.units);
}

}  // namespace

void rename(RigPart& part, Named kind, const std::string& from, const std::string& to) {
    if (to.empty()) throw std::invalid_argument("to: a name must not be empty");
    rig::Definition definition = part.rig.definition();
    if (from == to) return;
    if (const auto& clip = part.clip; kind == Named::Element && clip != nullptr) {
        const auto has = [&](const std::string& name) {
            return std::ranges::find(clip->bones, name) != clip->bones.end();
        };
        if (has(from) && has(to))
            throw std::invalid_argument("to: the clip still has a removed bone " + quoted(to) +
                                        "; record it again first");
    }
    rename_in(definition, kind, from, to);
    part.rig = make_rig(std::move(definition));  // the order is the same, so the state fits it
    const auto follow = [&](std::string& name) {
        if (name == from) name = to;
    };
    if (kind == Named::Unit) follow(part.selected.unit);
    if (kind != Named::Element) return;
    for (RigWalk& walk : part.walks) follow(walk.control);
    if (part.backward) follow(part.backward->bone);
    if (part.rates) follow(part.rates->bone);
    if (!part.clip) return;
    RigClip clip = *part.clip;
    for (std::string& bone : clip.bones) follow(bone);
    part.clip = std::make_shared<const RigClip>(std::move(clip));
}

}  // namespace tendril::app
