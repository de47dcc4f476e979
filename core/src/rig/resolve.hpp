// Resolves the names in the inputs of units, and refuses what is missing or has the wrong type. Not
// installed.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "tendril/fields.hpp"
#include "tendril/rig/definition.hpp"

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

    /// Does not resolve the units in the unit's body. `index`: its index among all units. `for_each`: the
    /// index of the for-each that contains it, if any. Returns its outputs.
    Expected<std::vector<Output>> resolve(Unit& unit, std::size_t index, std::optional<std::size_t> for_each);

  private:
    void spring(std::vector<Output>& outputs);
    void refuse(const std::string& what);
    void rows(std::span<const Field> table, void* object, const std::string& above = {});
    void row(const Field& field, void* at, const std::string& name);
    void item(const std::string& name, Item& item);
    void input(const std::string& name, const InputAccess& access, void* at);
    void check_values(std::span<const Field> table, const void* object);

    Type type_of_source(const std::string& name, Value& literal);
    Type type_of_source(const std::string& name, FromElement& from);
    Type type_of_source(const std::string& name, FromUnit& from);
    Type type_of_source(const std::string& name, Each& each);

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
