// Resolves the names in the inputs of units, and refuses what is missing or has the wrong type. Not
// installed.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "tendril/rig/definition.hpp"
#include "tendril/rig/fields.hpp"

namespace tendril::rig {

/// List indices by name.
using Names = std::map<std::string, std::size_t, std::less<>>;

namespace detail {
struct Layout;
}

/// Resolves the names in a unit's inputs. The layout has the elements, the curves, the units that run before
/// this one and, when an existing unit is replaced, those after it.
class Resolver {
  public:
    Resolver(const Definition& definition, const detail::Layout& layout)
        : definition_(definition), layout_(layout) {}

    /// Does not resolve the units in its body. `index`: the unit's among all units. `for_each`: the index of
    /// the for-each that contains it, if any. Returns its outputs.
    Expected<std::vector<Output>> resolve(Unit& unit, std::size_t index, std::optional<std::size_t> for_each);

  private:
    void spring(std::vector<Output>& handed_out);
    void refuse(const std::string& what);
    void field(const std::string& name, Item& item);
    void field(const std::string& name, AimInputs& inputs);
    void field(const std::string& name, std::vector<ParentInputs>& parents);
    void field(const std::string& name, Body& body);
    void field(const std::string& name, std::vector<std::string>& roots);
    void field(const std::string&, std::string&) {}
    void field(const std::string& name, std::array<double, 2>& range);
    void field(const std::string& name, Space& space);
    void field(const std::string& name, signal::Curve& curve);
    void field(const std::string&, TransformFilter&) {}
    void field(const std::string&, AimTarget&) {}
    void field(const std::string&, bool&) {}
    template <class T>
    void field(const std::string& name, std::optional<T>& maybe) {
        if (maybe) field(name, *maybe);
    }
    template <class T>
    void field(const std::string& name, Input<T>& input);

    Type type_of_source(const std::string& name, FromElement& from);
    Type type_of_source(const std::string& name, FromUnit& from);
    Type type_of_source(const std::string& name, Each& each);
    void check_literal(const std::string& name, const Value& value);

    const Definition& definition_;
    const detail::Layout& layout_;
    std::size_t index_ = 0;
    std::optional<std::size_t> for_each_;
    std::vector<Type> any_types_;  ///< types of the inputs that take any type: a spring's target and force
    std::string place_;            ///< `unit "look"`
    Result refusal_;
};

/// Whether an input of one type accepts a value of the other: the same type, a bool as 0 or 1, the
/// translation or the rotation of a transform.
bool converts(Type from, Type to) noexcept;

}  // namespace tendril::rig
