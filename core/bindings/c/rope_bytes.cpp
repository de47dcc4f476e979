// A rope world's state as bytes: a word for the format, its version, the size, a checksum, then every member
// of the state in order. Numbers are in this machine's byte order.
#include <type_traits>
#include <utility>

#include "checksum.hpp"
#include "rope.hpp"

namespace tendril::door {

namespace {

constexpr std::uint32_t word = 0x50525454;  // "TTRP" on a little-endian machine
/// Increment it when a member of the state is added, removed or moved.
constexpr std::uint32_t version = 1;

struct Head {
    std::uint32_t word, version;
    std::uint64_t size, checksum;
};

/// Counts the bytes, and writes them if there is room for them.
class Writer {
  public:
    static constexpr bool reads = false;
    explicit Writer(std::byte* at) noexcept : at_(at) {}
    void raw(const void* from, std::size_t size) noexcept {
        if (at_ != nullptr) std::memcpy(at_ + size_, from, size);
        size_ += size;
    }
    std::size_t size() const noexcept { return size_; }

  private:
    std::byte* at_;
    std::size_t size_ = 0;
};

class Reader {
  public:
    static constexpr bool reads = true;
    explicit Reader(std::span<const std::byte> bytes) noexcept : left_(bytes) {}
    void raw(void* to, std::size_t size) noexcept {
        good_ = good_ && size <= left_.size();
        if (!good_) return;
        std::memcpy(to, left_.data(), size);
        left_ = left_.subspan(size);
    }
    /// Whether a list of so many elements can be here. A struct takes at least a quarter of its size in
    /// memory.
    bool holds(std::uint64_t count, std::size_t element) noexcept {
        return good_ = good_ && count <= 4 * left_.size() / element;
    }
    void fail() noexcept { good_ = false; }
    bool good() const noexcept { return good_; }
    bool at_end() const noexcept { return good_ && left_.empty(); }

  private:
    std::span<const std::byte> left_;
    bool good_ = true;
};

template <class Io, class... Values>
void all(Io& io, Values&... values);

template <class Io, class Value>
requires(std::is_arithmetic_v<Value> || std::is_enum_v<Value>) void one(Io& io, Value& value) {
    if constexpr (std::is_same_v<std::remove_const_t<Value>, bool>) {
        std::uint8_t byte = Io::reads ? 0 : value;
        io.raw(&byte, 1);
        if constexpr (Io::reads) value = byte != 0;
    } else {
        io.raw(&value, sizeof value);
    }
}
template <class Io, class Value>
requires(std::is_same_v<std::remove_const_t<Value>, glm::vec3> ||
         std::is_same_v<std::remove_const_t<Value>, glm::dvec3>) void one(Io& io, Value& v) {
    all(io, v.x, v.y, v.z);
}
template <class Io, class Value>
requires(std::is_same_v<std::remove_const_t<Value>, glm::quat>) void one(Io& io, Value& q) {
    all(io, q.x, q.y, q.z, q.w);
}
template <class Io, class Optional>
requires requires(Optional& value) {
    value.has_value();
}
void one(Io& io, Optional& value) {
    bool has = value.has_value();
    one(io, has);
    if constexpr (Io::reads) {
        if (has)
            value.emplace();
        else
            value.reset();
    }
    if (has) one(io, *value);
}
template <class Io, class Struct>
requires requires(Struct& value) {
    value.generation;
}
void one(Io& io, Struct& handle) {
    all(io, handle.index, handle.generation);
}
template <class Io, class List>
requires requires(List& value) {
    value.capacity();
}
void one(Io& io, List& list) {
    std::uint64_t count = list.size();
    one(io, count);
    if constexpr (Io::reads) {
        if (!io.holds(count, sizeof(typename List::value_type))) return;
        list.resize(count);
    }
    for (auto& each : list) one(io, each);
}

template <class Io, class Shape>
void shape(Io& io, Shape& value) {
    auto kind = static_cast<std::uint8_t>(value.index());
    one(io, kind);
    if constexpr (Io::reads) {
        if (kind == 0) value.template emplace<0>();
        if (kind == 1) value.template emplace<1>();
        if (kind == 2) value.template emplace<2>();
        if (kind == 3) value.template emplace<3>();
        if (kind > 3) return io.fail();
    }
    if (auto* const sphere = std::get_if<rope::Sphere>(&value)) all(io, sphere->centre, sphere->radius);
    if (auto* const capsule = std::get_if<rope::Capsule>(&value))
        all(io, capsule->a, capsule->b, capsule->radius);
    if (auto* const plane = std::get_if<rope::Plane>(&value)) all(io, plane->point, plane->normal);
    if (auto* const box = std::get_if<rope::Box>(&value))
        all(io, box->centre, box->half_extents, box->rotation);
}

template <class Value, class Struct>
concept Is = std::is_same_v<std::remove_const_t<Value>, Struct>;

template <class Io>
void one(Io& io, Is<rope::Settings> auto& s) {
    all(io, s.substep, s.iterations, s.solver, s.damping, s.gravity, s.gravity_scale, s.external, s.wind,
        s.gusts, s.still_air, s.compliance, s.friction, s.longest_frame);
}
template <class Io>
void one(Io& io, Is<rope::Body> auto& body) {
    all(io, body.id, body.kind, body.first, body.count, body.row, body.cells, body.radius, body.tear,
        body.bending, body.friction, body.stretch);
}
template <class Io>
void one(Io& io, Is<rope::Link> auto& link) {
    all(io, link.a, link.b, link.rest, link.kind, link.compliance, link.tension);
}
template <class Io>
void one(Io& io, Is<rope::Pin> auto& pin) {
    all(io, pin.particle, pin.goal, pin.seconds, pin.collider);
}
template <class Io>
void one(Io& io, Is<rope::Collider> auto& collider) {
    one(io, collider.id);
    shape(io, collider.shape);
    all(io, collider.goal, collider.seconds, collider.half_goal, collider.drive.velocity, collider.drive.axis,
        collider.drive.spin);
}
template <class Io>
void one(Io& io, Is<rope::Tie> auto& tie) {
    all(io, tie.id, tie.a, tie.b, tie.length, tie.strength, tie.now, tie.tension);
}
template <class Io>
void one(Io& io, Is<rope::Collision> auto& collision) {
    all(io, collision.a, collision.b);
}
template <class Io>
void one(Io& io, Is<rope::BodyContact> auto& contact) {
    all(io, contact.a, contact.b, contact.force);
}
template <class Io>
void one(Io& io, Is<rope::State> auto& s) {
    all(io, s.settings, s.bodies, s.links, s.position, s.displacement, s.mass, s.pins, s.colliders,
        s.body_slots, s.collider_slots, s.ties, s.tie_slots, s.collisions, s.contacts, s.remainder,
        s.displaced_in, s.substeps, s.dropped, s.drift);
}

template <class Io, class... Values>
void all(Io& io, Values&... values) {
    (one(io, values), ...);
}

Result refused(const char* why) noexcept {
    char text[Result::max_message];
    std::snprintf(text, sizeof text, "rope_load: bytes %s", why);
    return {ErrorCode::InvalidArgument, text};
}

}  // namespace

std::size_t saved_bytes(const rope::World& world) noexcept {
    Writer counts(nullptr);
    one(counts, world.state());
    return sizeof(Head) + counts.size();
}

void save(Call& call, const rope::World& world, std::span<std::byte> bytes, std::size_t& used) noexcept {
    used = saved_bytes(world);
    if (bytes.size() < used)
        return call.refuse(TENDRIL_SHORT_BUFFER, {"bytes"}, "has %zu bytes; it takes %zu", bytes.size(),
                           used);
    Writer write(bytes.data() + sizeof(Head));
    one(write, world.state());
    const Head head{word, version, write.size(),
                    checksum(bytes.data() + sizeof(Head), write.size(), version)};
    std::memcpy(bytes.data(), &head, sizeof head);
}

Result load(RopeWorld& world, std::span<const std::byte> bytes) {
    Head head;
    if (bytes.size() < sizeof head) return refused("end early");
    std::memcpy(&head, bytes.data(), sizeof head);
    if (head.word != word) return refused("are not a saved rope world");
    if (head.version != version) return refused("are of another version of the format");
    const auto body = bytes.subspan(sizeof head);
    if (head.size > body.size()) return refused("end early");
    const auto state_bytes = body.first(static_cast<std::size_t>(head.size));
    if (checksum(state_bytes.data(), state_bytes.size(), version) != head.checksum)
        return refused("are damaged: their checksum differs");
    Reader read(state_bytes);
    rope::State state;
    one(read, state);
    if (!read.at_end()) return refused("do not hold a rope world's state");
    const Result done = into(rope::World::from_state(std::move(state)), world.world);
    if (done) world.last = {};
    return done;
}

}  // namespace tendril::door
