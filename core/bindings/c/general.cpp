// The general functions of the C interface, which take any struct, and the version.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

#include "checksum.hpp"
#include "handles.hpp"
#include "structs.hpp"
#include "tendril/version.hpp"

using namespace tendril;
using namespace tendril::door;

namespace {

/// Increment it when a change makes older programs misread something; see abi.txt.
constexpr std::uint32_t abi = 0;

const Kind& kind_or_refuse(Call& call, const tendril_struct& which) noexcept {
    static const Kind none{};
    const Kind* const kind = kind_of(which);
    if (kind == nullptr) call.refuse(TENDRIL_INVALID_ARGUMENT, {"kind"}, "is not of a struct with members");
    return kind != nullptr ? *kind : none;
}

template <class Number>
void load(const std::byte* at, int count, double* values) noexcept {
    for (int i = 0; i < count; ++i) {
        Number number;
        std::memcpy(&number, at + static_cast<std::size_t>(i) * sizeof number, sizeof number);
        values[i] = static_cast<double>(number);
    }
}
template <class Number>
void store(std::byte* at, int count, const double* values) noexcept {
    for (int i = 0; i < count; ++i) {
        const auto number = static_cast<Number>(values[i]);
        std::memcpy(at + static_cast<std::size_t>(i) * sizeof number, &number, sizeof number);
    }
}
/// Calls `body` with a number of the member's type and the count of numbers.
template <class Body>
void with_numbers(MemberType type, Body&& body) noexcept {
    switch (type) {
        case MemberType::Flag:
        case MemberType::I32:
            return body(std::int32_t{}, 1);
        case MemberType::Choice:
        case MemberType::U32:
            return body(std::uint32_t{}, 1);
        case MemberType::U64:
            return body(std::uint64_t{}, 1);
        case MemberType::F32:
            return body(float{}, 1);
        case MemberType::F64:
            return body(double{}, 1);
        case MemberType::Vec2:
            return body(double{}, 2);
        case MemberType::Vec3f:
            return body(float{}, 3);
        case MemberType::Vec3:
            return body(double{}, 3);
        case MemberType::Quatf:
            return body(float{}, 4);
        case MemberType::Quat:
            return body(double{}, 4);
    }
}
std::size_t end_of(const Member& member) noexcept {
    std::size_t end = member.offset;
    with_numbers(member.type,
                 [&](auto number, int count) { end += sizeof number * static_cast<unsigned>(count); });
    return end;
}
/// The member with this name, if it lies within the caller's version of the struct.
const Member* find_member(Call& call, const Kind& kind, const void* object, const char* name) noexcept {
    const std::uint32_t size = size_of(call, {"object"}, object, kind);
    if (name == nullptr) call.refuse(TENDRIL_NULL_ARGUMENT, {"name"}, "is NULL");
    if (call.refused()) return nullptr;
    for (const Member& member : kind.members)
        if (std::strcmp(kind.table()[member.row].name, name) == 0 && end_of(member) <= size) return &member;
    call.refuse(TENDRIL_NOT_FOUND, {"name"}, "must be a member of %s that is a number, got %.60s", kind.name,
                name);
    return nullptr;
}
/// Reads a member's numbers. An unset member reads as NaN, even if it is an integer.
void get(const Kind& kind, const Member& member, const void* object, double* values) noexcept {
    const std::byte* const at = static_cast<const std::byte*>(object) + member.offset;
    with_numbers(member.type, [&](auto number, int count) { load<decltype(number)>(at, count, values); });
    const Field& row = kind.table()[member.row];
    if (row.optional && row.whole() && values[0] == -1.0)
        values[0] = std::numeric_limits<double>::quiet_NaN();
}

constexpr std::uint32_t saved_word = 0x4c524454;  // "TDRL" on a little-endian machine
struct SavedHead {
    std::uint32_t word, kind;
    std::uint64_t size, checksum;
};
static_assert(sizeof(SavedHead) == TENDRIL_SAVED_BYTES(0));

/// The struct's number. Refuses one whose states cannot be saved.
std::uint32_t saved_kind(Call& call, const tendril_struct& which) noexcept {
    const std::uint32_t number = number_of(which);
    const Kind* const kind = kind_of(which);
    const bool bytes = kind == nullptr && number == TENDRIL_STRUCT_IK_STATE;
    if (!bytes && (kind == nullptr || !kind->plain))
        call.refuse(TENDRIL_INVALID_ARGUMENT, {"kind"}, "is not of a state that can be saved");
    return number;
}

void refuse_null(Call& call, const char* name, const void* pointer) noexcept {
    if (pointer == nullptr) call.refuse(TENDRIL_NULL_ARGUMENT, {name}, "is NULL");
}

}  // namespace

const char* tendril_version(void) {
    return version_string;
}

uint32_t tendril_abi(void) {
    return abi;
}

const char* tendril_code_name(tendril_code code) {
    constexpr const char* names[] = {"TENDRIL_OK",
                                     "TENDRIL_INVALID_ARGUMENT",
                                     "TENDRIL_OUT_OF_RANGE",
                                     "TENDRIL_NOT_FOUND",
                                     "TENDRIL_ALREADY_EXISTS",
                                     "TENDRIL_NO_MEMORY",
                                     "TENDRIL_STALE_HANDLE",
                                     "TENDRIL_BUSY",
                                     "TENDRIL_SHORT_BUFFER",
                                     "TENDRIL_NULL_ARGUMENT"};
    return choice_name(code, names);
}

size_t tendril_live_objects(void) {
    return live_objects;
}

tendril_code tendril_set_allocator(const tendril_allocator* allocator, tendril_error* error) {
    return call("set_allocator", error, [&](Call& call) { set_allocator(call, allocator); });
}

void tendril_default(tendril_struct kind, void* object, size_t size) {
    const Kind* const known = kind_of(kind);
    if (object == nullptr) return;
    std::memset(object, 0, size);
    if (known == nullptr || size < sizeof(std::uint32_t)) return;
    alignas(8) std::byte full[most_bytes];
    known->fresh(full);
    // A larger struct comes from a newer program. It keeps its size, so that its first use is refused.
    const auto given = static_cast<std::uint32_t>(size);
    std::memcpy(full, &given, sizeof given);
    std::memcpy(object, full, std::min<std::size_t>(size, known->size));
}

size_t tendril_struct_size(tendril_struct kind) {
    const Kind* const known = kind_of(kind);
    return known != nullptr ? known->size : 0;
}

size_t tendril_field_count(tendril_struct kind) {
    const Kind* const known = kind_of(kind);
    return known != nullptr ? known->members.size() : 0;
}

tendril_code tendril_field_at(tendril_struct kind, size_t index, tendril_field* out, tendril_error* error) {
    return call("field_at", error, [&](Call& call) {
        const Kind& of = kind_or_refuse(call, kind);
        refuse_null(call, "out", out);
        if (index >= of.members.size())
            call.refuse(TENDRIL_OUT_OF_RANGE, {"index"}, "must be under %zu, got %zu", of.members.size(),
                        index);
        if (call.refused()) return;
        const Field& row = of.table()[of.members[index].row];
        *out = {row.size(),         row.name,
                row.unit,           row.choices.empty() ? nullptr : row.choices.data(),
                row.choices.size(), row.range.low,
                row.range.high,     {},
                row.over_low,       row.whole(),
                row.optional};
        alignas(8) std::byte fresh[most_bytes];
        of.fresh(fresh);
        get(of, of.members[index], fresh, out->fresh);
    });
}

tendril_code tendril_get(tendril_struct kind, const void* object, const char* name, double values[4],
                         tendril_error* error) {
    return call("get", error, [&](Call& call) {
        const Kind& of = kind_or_refuse(call, kind);
        refuse_null(call, "values", values);
        if (call.refused()) return;
        if (const Member* const member = find_member(call, of, object, name))
            get(of, *member, object, values);
    });
}

tendril_code tendril_set(tendril_struct kind, void* object, const char* name, const double values[4],
                         tendril_error* error) {
    return call("set", error, [&](Call& call) {
        const Kind& of = kind_or_refuse(call, kind);
        refuse_null(call, "values", values);
        if (call.refused()) return;
        const Member* const member = find_member(call, of, object, name);
        if (member == nullptr) return;
        const Field& row = of.table()[member->row];
        std::array<double, 4> numbers{};
        std::copy_n(values, row.size(), numbers.begin());
        const bool whole = row.whole() || row.type == FieldType::Flag || row.type == FieldType::Choice;
        const bool unset = row.optional && numbers[0] != numbers[0];
        if (whole && !unset && std::floor(numbers[0]) != numbers[0])
            call.refuse(TENDRIL_INVALID_ARGUMENT, {row.name}, "must be a whole number, got %g", numbers[0]);
        call.refuse(of.fits(row, numbers));
        if (call.refused()) return;
        if (row.whole() && numbers[0] != numbers[0]) numbers[0] = -1.0;
        if (row.type == FieldType::Flag) numbers[0] = numbers[0] != 0.0;
        std::byte* const at = static_cast<std::byte*>(object) + member->offset;
        with_numbers(member->type,
                     [&](auto number, int count) { store<decltype(number)>(at, count, numbers.data()); });
    });
}

tendril_code tendril_check(tendril_struct kind, const void* object, tendril_error* error) {
    return call("check", error, [&](Call& call) {
        const Kind& of = kind_or_refuse(call, kind);
        if (!call.refused()) of.check(call, object);
    });
}

tendril_code tendril_save(tendril_struct kind, const void* state, size_t state_size, void* bytes, size_t size,
                          tendril_error* error) {
    return call("save", error, [&](Call& call) {
        const std::uint32_t number = saved_kind(call, kind);
        refuse_null(call, "state", state);
        refuse_null(call, "bytes", bytes);
        if (size < sizeof(SavedHead) || size - sizeof(SavedHead) < state_size)
            call.refuse(TENDRIL_SHORT_BUFFER, {"bytes"},
                        "has %zu bytes; it takes %zu more than the state's %zu", size, sizeof(SavedHead),
                        state_size);
        if (call.refused()) return;
        const auto* const from = static_cast<const std::byte*>(state);
        const SavedHead head{saved_word, number, state_size, checksum(from, state_size, number)};
        std::memcpy(bytes, &head, sizeof head);
        std::memcpy(static_cast<std::byte*>(bytes) + sizeof head, from, state_size);
    });
}

tendril_code tendril_load(tendril_struct kind, void* state, size_t state_size, const void* bytes, size_t size,
                          tendril_error* error) {
    return call("load", error, [&](Call& call) {
        const std::uint32_t number = saved_kind(call, kind);
        refuse_null(call, "state", state);
        refuse_null(call, "bytes", bytes);
        if (!call.refused() && size < sizeof(SavedHead))
            call.refuse(TENDRIL_INVALID_ARGUMENT, {"bytes"}, "ends early: it has %zu bytes", size);
        if (call.refused()) return;
        SavedHead head;
        std::memcpy(&head, bytes, sizeof head);
        const auto* const from = static_cast<const std::byte*>(bytes) + sizeof head;
        if (head.word != saved_word || head.kind != number)
            return call.refuse(TENDRIL_INVALID_ARGUMENT, {"bytes"}, "is not a saved state of this kind");
        if (head.size > size - sizeof head)
            return call.refuse(TENDRIL_INVALID_ARGUMENT, {"bytes"}, "ends early: it has %zu bytes", size);
        if (head.size > state_size)
            return call.refuse(TENDRIL_SHORT_BUFFER, {"state"}, "has %zu bytes; it takes %zu", state_size,
                               static_cast<std::size_t>(head.size));
        if (checksum(from, head.size, number) != head.checksum)
            return call.refuse(TENDRIL_INVALID_ARGUMENT, {"bytes"}, "is damaged: its checksum differs");
        std::memcpy(state, from, head.size);
    });
}
