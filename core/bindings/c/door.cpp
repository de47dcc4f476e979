#include "door.hpp"

#include "tendril/version.hpp"

namespace tendril::door {

std::uint32_t size_of(Call& call, const Place& place, const void* given, const Kind& kind) noexcept {
    if (given == nullptr) {
        call.refuse(TENDRIL_NULL_ARGUMENT, place, "is NULL");
        return 0;
    }
    std::uint32_t size;
    std::memcpy(&size, given, sizeof size);
    // The size of an older version is a multiple of its alignment: it does not end inside a pointer.
    if (size >= sizeof size && size <= kind.size && size % kind.align == 0) return size;
    if (size == 0)
        call.refuse(TENDRIL_INVALID_ARGUMENT, place, "has size 0; make it by %s_default()", kind.name);
    else if (size > kind.size && size <= most_bytes && size % kind.align == 0)
        call.refuse(TENDRIL_INVALID_ARGUMENT, place,
                    "has %u bytes, but %u in this library: the program was compiled for one newer than %s",
                    size, kind.size, version_string);
    else
        call.refuse(TENDRIL_INVALID_ARGUMENT, place, "has size %u; a %s has %u bytes", size, kind.name,
                    kind.size);
    return 0;
}

Result solve(ik::Solver& solver, ik::Method method, std::span<glm::vec3> joints, ik::State& state,
             glm::vec3 target, const ik::Options& options, ik::Report& report) noexcept {
    report = solver.solve(method, joints, state, target, options);
    return report.accepted;
}

Result explain(ik::Solver& solver, std::span<const glm::vec3> joints, const ik::State& state,
               glm::vec3 target, const ik::Options& options, ik::ActiveLimit& limit, int& found) {
    const std::optional<ik::ActiveLimit> active = solver.explain(joints, state, target, options);
    found = active ? 1 : 0;
    if (active) {
        limit = *active;
        return {};
    }
    // No limit is to blame, or the input is invalid: a solve reports which.
    std::vector<glm::vec3> moved(joints.begin(), joints.end());
    ik::State changed = state;
    return solver.solve(ik::Method::Fabrik, moved, changed, target, options).accepted;
}

Result rotations(const ik::State& state, std::span<glm::quat> world, std::span<glm::quat> local) noexcept {
    if (const Result bad = ik::check(state, state.bones()); !bad) return bad;
    if (!world.empty() && world.size() != state.bones())
        return {ErrorCode::InvalidArgument, "ik_state_rotations: world must have one element per bone"};
    if (!local.empty())
        if (const Result bad = ik::local_rotations(state, local); !bad) return bad;
    std::copy(state.rotations.begin(), state.rotations.begin() + static_cast<std::ptrdiff_t>(world.size()),
              world.begin());
    return {};
}

Result two_bone(const ik::TwoBone& limb, glm::vec3 target, const ik::TwoBoneOptions& options,
                ik::TwoBoneResult& result) noexcept {
    result = ik::two_bone(limb, target, options);
    return result.accepted;
}

// ---- ik::State as bytes: a word that identifies the format, the number of bones, numbers, flags.

namespace {

constexpr std::uint32_t state_word = 0x534b4954;  // "TIKS" on a little-endian machine

class Writer {
  public:
    explicit Writer(std::byte* at) noexcept : at_(at) {}
    template <class Value>
    void operator()(const Value& value) noexcept {
        std::memcpy(at_, &value, sizeof value);
        at_ += sizeof value;
    }
    template <class Value>
    void all(const std::vector<Value>& values) noexcept {
        for (const Value& value : values) (*this)(value);
    }

  private:
    std::byte* at_;
};

class Reader {
  public:
    explicit Reader(const std::byte* at) noexcept : at_(at) {}
    template <class Value>
    void operator()(Value& value) noexcept {
        std::memcpy(&value, at_, sizeof value);
        at_ += sizeof value;
    }
    void flag(bool& value) noexcept { value = *at_++ != std::byte{0}; }
    /// False for a number that is none of the enumeration's values.
    template <class Choice>
    bool choice(Choice& value, Choice last) noexcept {
        value = static_cast<Choice>(*at_++);
        return value <= last;
    }
    template <class Value>
    void all(std::vector<Value>& values) noexcept {
        for (Value& value : values) (*this)(value);
    }

  private:
    const std::byte* at_;
};

}  // namespace

std::size_t bytes_of(const ik::State&, std::size_t bones) noexcept {
    return TENDRIL_IK_STATE_BYTES(bones);
}

void write_bytes(const ik::State& state, std::byte* bytes) noexcept {
    Writer write(bytes);
    write(state_word);
    write(static_cast<std::uint32_t>(state.bones()));
    write.all(state.rotations);
    write.all(state.pole.joints);
    write(state.pole.pole);
    write(state.pole.target);
    write(state.pole.twist);
    write(state.limits.target);
    write(state.limits.damping);
    for (const int byte : {static_cast<int>(state.pole.valid), static_cast<int>(state.pole.turn),
                           static_cast<int>(state.limits.valid), static_cast<int>(state.limits.limited),
                           static_cast<int>(state.side), 0, 0, 0})
        write(static_cast<std::uint8_t>(byte));
}

bool read_bytes(const std::byte* bytes, std::size_t bones, ik::State& state) {
    Reader read(bytes);
    std::uint32_t word = 0, count = 0;
    read(word);
    read(count);
    if (word != state_word || count != bones) return false;
    if (state.bones() != bones || state.pole.joints.size() != bones + 1) state = ik::State(bones);
    read.all(state.rotations);
    read.all(state.pole.joints);
    read(state.pole.pole);
    read(state.pole.target);
    read(state.pole.twist);
    read(state.limits.target);
    read(state.limits.damping);
    read.flag(state.pole.valid);
    const bool turn = read.choice(state.pole.turn, ik::PoleTurn::EachJoint);
    read.flag(state.limits.valid);
    read.flag(state.limits.limited);
    return read.choice(state.side, ik::Side::Right) && turn;
}

}  // namespace tendril::door
