// Conversion between C structs, which begin with their size, and the library's structs. The caller's struct
// may be older and shorter: it is read over the defaults, and written only up to its own end.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "call.hpp"
#include "tendril/fields.hpp"
#include "tendril/quat.hpp"
#include "tendril/vec3.hpp"

namespace tendril::door {

// Values. An optional number that is unset is NaN in C, an optional count -1.
inline std::array<double, 2> value_of(tendril_vec2 v) noexcept {
    return {v.x, v.y};
}
inline tendril_vec2 value_of(const std::array<double, 2>& v) noexcept {
    return {v[0], v[1]};
}
inline glm::vec3 value_of(tendril_vec3f v) noexcept {
    return {v.x, v.y, v.z};
}
inline glm::dvec3 value_of(tendril_vec3 v) noexcept {
    return {v.x, v.y, v.z};
}
inline glm::quat value_of(tendril_quatf q) noexcept {
    return {q.w, q.x, q.y, q.z};
}
inline glm::dquat value_of(tendril_quat q) noexcept {
    return {q.w, q.x, q.y, q.z};
}
inline tendril_vec3f value_of(glm::vec3 v) noexcept {
    return {v.x, v.y, v.z};
}
inline tendril_vec3 value_of(glm::dvec3 v) noexcept {
    return {v.x, v.y, v.z};
}
inline tendril_quatf value_of(glm::quat q) noexcept {
    return {q.x, q.y, q.z, q.w};
}
inline tendril_quat value_of(glm::dquat q) noexcept {
    return {q.x, q.y, q.z, q.w};
}

template <class Value>
bool is_empty(const Value& value) noexcept {
    if constexpr (std::is_floating_point_v<Value>)
        return value != value;
    else if constexpr (std::is_integral_v<Value>)
        return value == static_cast<Value>(-1);
    else
        return value.x != value.x;
}
template <class Value>
Value empty() noexcept {
    if constexpr (std::is_floating_point_v<Value>) {
        return std::numeric_limits<Value>::quiet_NaN();
    } else if constexpr (std::is_integral_v<Value>) {
        return static_cast<Value>(-1);
    } else {
        Value value{};
        value.x = std::numeric_limits<decltype(value.x)>::quiet_NaN();
        return value;
    }
}

template <class To, class From>
void copy(const From& from, To& to) noexcept {
    if constexpr (std::is_same_v<To, bool>)
        to = from != 0;
    else if constexpr (std::is_arithmetic_v<To>)
        to = static_cast<To>(from);
    else
        to = value_of(from);
}
template <class To, class From>
void copy(const From& from, std::optional<To>& to) noexcept {
    if (is_empty(from))
        to.reset();
    else
        copy(from, to.emplace());
}
template <class To, class From>
void copy(const std::optional<From>& from, To& to) noexcept {
    if (from)
        copy(*from, to);
    else
        to = empty<To>();
}

/// A member's type in a C struct.
enum class MemberType : std::uint8_t {
    Flag,
    Choice,
    I32,
    U32,
    U64,
    F32,
    F64,
    Vec2,
    Vec3f,
    Vec3,
    Quatf,
    Quat
};

/// A member that tendril_get and tendril_set reach by name.
struct Member {
    std::uint16_t row;  ///< in the struct's table
    std::uint16_t offset;
    MemberType type;
};

/// Describes a C struct: its size, members and table.
struct Kind {
    const char* name;  ///< "tendril_ik_options"
    std::uint32_t size, align;
    bool plain;  ///< has no pointers, so it can be saved
    std::span<const Field> (*table)() noexcept;
    std::span<const Member> members;
    void (*fresh)(void* object) noexcept;                                ///< writes the defaults
    Result (*fits)(const Field& row, const FieldValue& value) noexcept;  ///< checks a value against a row
    void (*check)(Call& call, const void* object);
};
/// Looks up a struct. Null if it does not exist or is a state kept as bytes.
const Kind* kind_of(const tendril_struct& which) noexcept;
inline constexpr std::size_t most_bytes = 1024;  // per C struct

/// Generated: the C++ struct of a C struct, its Kind, and the conversions.
template <class C>
struct Of;
/// Generated: scratch memory for an object's calls.
struct Scratch;

/// The size of the caller's struct; 0, with a refusal, if it cannot be right.
std::uint32_t size_of(Call& call, const Place& place, const void* given, const Kind& kind) noexcept;

/// Reads the caller's struct over the defaults.
template <class C>
void read_struct(Call& call, const Place& place, const C* given, typename Of<C>::Cpp& to, Scratch& scratch) {
    const std::uint32_t size = size_of(call, place, given, Of<C>::kind);
    if (call.refused()) return;
    C known;
    if (size != sizeof known) Of<C>::kind.fresh(&known);
    std::memcpy(static_cast<void*>(&known), given, size);
    Of<C>::read(call, place, known, to, scratch);
}
/// All elements have the first one's size: the caller's version of the struct.
template <class C, class Cpp>
std::span<const Cpp> read_list(Call& call, const Place& place, const C* given, std::size_t count,
                               std::vector<Cpp>& memory, Scratch& scratch) {
    memory.clear();
    list<const C>(call, place, given, count, true);
    if (given == nullptr || count == 0 || call.refused()) return {};
    const std::uint32_t stride = size_of(call, {"", &place, 0}, given, Of<C>::kind);
    for (std::size_t i = 0; i < count && !call.refused(); ++i) {
        const auto* const at =
            reinterpret_cast<const C*>(reinterpret_cast<const std::byte*>(given) + i * stride);
        if (size_of(call, {"", &place, i}, at, Of<C>::kind) != stride)
            call.refuse(TENDRIL_INVALID_ARGUMENT, {"", &place, i}, "has another size than the first");
        read_struct(call, {"", &place, i}, at, memory.emplace_back(), scratch);
    }
    return memory;
}

/// Writes a struct up to the end of the caller's version.
template <class C>
void give(const typename Of<C>::Cpp& value, C* given) noexcept {
    C full;
    Of<C>::write(value, full);
    std::memcpy(&full.size, given, sizeof full.size);
    std::memcpy(static_cast<void*>(given), &full, std::min<std::size_t>(full.size, sizeof full));
}
/// A struct that the library fills; give() copies it to the caller's.
template <class C>
class Out {
  public:
    Out(Call& call, const Place& place, C* given, bool may_be_null = false) noexcept : given_(given) {
        if (given != nullptr || !may_be_null) size_of(call, place, given, Of<C>::kind);
    }
    typename Of<C>::Cpp value{};
    void give() noexcept {
        if (given_ != nullptr) door::give(value, given_);
    }

  private:
    C* given_;
};

/// Checks a struct against its table.
template <class Cpp>
void check(Call& call, const Place& place, const Cpp& value) noexcept {
    if (!call.refused()) call.refuse(check_fields(call.operation(), value, place.name));
}
/// Calls the library and notes its refusal, if any.
template <class Body>
void run(Call& call, Body&& body) {
    if constexpr (std::is_void_v<decltype(body())>)
        body();
    else
        call.refuse(body());
}

template <class C>
const char* choice_name(const C& value, std::span<const char* const> names) noexcept {
    const std::uint32_t number = number_of(value);
    return number < names.size() ? names[number] : "?";
}

/// Generated: tendril_check() for one struct.
template <class C>
void check_struct(Call& call, const void* object);

template <class C>
constexpr Kind kind_of_struct(const char* name, bool plain, std::span<const Member> members) noexcept {
    using Cpp = typename Of<C>::Cpp;
    static_assert(sizeof(C) <= most_bytes && alignof(C) <= 8);
    return {name,
            sizeof(C),
            alignof(C),
            plain,
            fields<Cpp>,
            members,
            [](void* object) noexcept { Of<C>::write(Cpp{}, *static_cast<C*>(object)); },
            [](const Field& row, const FieldValue& value) noexcept {
                Cpp object{};
                row.set(&object, value);
                return check_fields("tendril_set", {&row, 1}, &object);
            },
            check_struct<C>};
}

}  // namespace tendril::door
