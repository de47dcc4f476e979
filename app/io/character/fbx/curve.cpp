#include "app/io/character/fbx/animation.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <stdexcept>

namespace tendril::app::fbx {
namespace {

using Shape = CurveKey::Shape;

// Flags of a key, by the names of Autodesk's FbxAnimCurveDef.
constexpr std::int64_t constant_flag = 0x2, linear_flag = 0x4;
constexpr std::int64_t constant_next = 0x100;
constexpr std::int64_t tangent_tcb = 0x200, tangent_user = 0x400;
constexpr std::int64_t generic_break = 0x800, generic_clamp = 0x1000, time_independent = 0x2000;
constexpr std::int64_t clamp_progressive = 0x4000;
constexpr std::int64_t weighted_right = 0x1000000, weighted_next_left = 0x2000000;
constexpr std::int64_t any_velocity = 0x30000000;
constexpr double usual_weight = 1.0 / 3.0;

/// A key's tangent settings.
struct Tangents {
    std::int64_t flags = 0;
    std::array<double, 3> data{};  ///< slopes, or tension, continuity and bias
    double right_weight = usual_weight, next_left_weight = usual_weight;
    bool is_user() const { return (flags & tangent_user) != 0; }
    bool is_broken() const { return is_user() && (flags & generic_break) != 0; }
    bool is_tcb() const { return !is_user() && (flags & tangent_tcb) != 0; }
};

/// The secants before and after a key; 0 where there is none.
struct Secants {
    double before = 0.0, after = 0.0;
    double whole = 0.0;  ///< from neighbour to neighbour; at an end, the only one
    bool at_end = true;
};
Secants secants_at(const std::vector<CurveKey>& keys, std::size_t i) {
    const auto between = [&](std::size_t a, std::size_t b) {
        return a == b ? 0.0 : (keys[b].value - keys[a].value) / (keys[b].time() - keys[a].time());
    };
    const std::size_t previous = i > 0 ? i - 1 : i, next = std::min(i + 1, keys.size() - 1);
    return {between(previous, i), between(i, next), between(previous, next), previous == i || next == i};
}

// Slopes that the file leaves to its readers, named as in Autodesk's documentation of FbxAnimCurveDef, which
// has no formulas; ufbx (github.com/ufbx/ufbx) found these by comparison with MotionBuilder.

/// A bias in percent moves the slope from the mean of both secants towards one of them; the excess over 500
/// steepens it without bound. Only time-dependent keys have a bias.
double biased(double slope, const Secants& at, double bias) {
    const double part = std::abs(bias) / 100.0, toward = bias > 0.0 ? at.after : at.before;
    const double way = at.at_end ? 0.0 : toward - slope;
    const double excess = std::max(part - 5.0, 0.0), sign = std::abs(way) > 1e-5 ? way : bias;
    return slope + way * part + std::copysign(40.0 * excess * excess, sign);
}
/// The slope of an automatic key. A clamped key is level if a neighbour has the same value; a progressively
/// clamped key is level at the ends, and its tangents' control points stay within the neighbours' values.
double automatic(const Secants& at, std::int64_t flags, double bias, double left_weight,
                 double right_weight) {
    const bool is_progressive = (flags & clamp_progressive) != 0;
    if (is_progressive && (at.at_end || at.before * at.after <= 0.0)) return 0.0;
    if ((flags & generic_clamp) != 0 && !at.at_end && at.before * at.after == 0.0) return 0.0;
    double slope = at.whole;
    if ((flags & time_independent) == 0)
        slope = biased(at.at_end ? at.whole : 0.5 * (at.before + at.after), at, bias);
    if (!is_progressive) return slope;
    const double limit = std::min(std::abs(at.before) / left_weight, std::abs(at.after) / right_weight);
    return slope * at.before <= 0.0 ? 0.0 : std::copysign(std::min(std::abs(slope), limit), slope);
}
/// D. Kochanek, R. Bartels, "Interpolating splines with local tension, continuity, and bias control",
/// SIGGRAPH 1984. At an end the only secant counts twice.
double kochanek(const Secants& at, const Tangents& key, bool leaving) {
    const double tension = key.data[0], bias = key.data[2];
    const double continuity = leaving ? key.data[1] : -key.data[1];
    return (at.at_end ? 1.0 : 0.5) * (1.0 - tension) *
           ((1.0 + bias) * (1.0 + continuity) * at.before + (1.0 - bias) * (1.0 - continuity) * at.after);
}

/// Converts the keys' settings into slopes between them.
void set_slopes(std::vector<CurveKey>& keys, const std::vector<Tangents>& tangents) {
    // A key has its own slope or bias to the right, and the next key's to the left.
    const auto slope = [&](std::size_t i, bool leaving) {
        const Tangents& key = tangents[i];
        const Tangents before = i > 0 ? tangents[i - 1] : Tangents();
        const double left = before.is_tcb() ? 0.0 : before.data[1];
        if (keys[i].shape != Shape::Cubic) return left;
        if (key.is_user()) return leaving || !(before.is_user() || key.is_broken()) ? key.data[0] : left;
        const Secants at = secants_at(keys, i);
        if (key.is_tcb()) return kochanek(at, key, leaving);
        return automatic(at, key.flags, leaving ? key.data[0] : -left, before.next_left_weight,
                         key.right_weight);
    };
    for (std::size_t i = 0; i + 1 < keys.size(); ++i) {
        if (keys[i].shape != Shape::Cubic) continue;
        keys[i].leaving = slope(i, true);
        keys[i].arriving = slope(i + 1, false);
        keys[i].leaving_weight = tangents[i].right_weight;
        keys[i].arriving_weight = tangents[i].next_left_weight;
    }
}

/// Keys in order of time. Among equal times the last key wins; keys that go back in time are dropped.
class KeyList {
  public:
    void add(const CurveKey& key, const Tangents& tangents) {
        std::vector<CurveKey>& keys = curve_.keys;
        const bool is_bad = !(std::abs(key.value) <= 1e9);
        if (is_bad || (!keys.empty() && key.ticks < keys.back().ticks)) {
            curve_.is_odd = true;
            return;
        }
        if (!keys.empty() && key.ticks == keys.back().ticks) keys.pop_back(), tangents_.pop_back();
        keys.push_back(key);
        tangents_.push_back(tangents);
    }
    void set_odd() { curve_.is_odd = true; }
    Curve finish() {
        set_slopes(curve_.keys, tangents_);
        return std::move(curve_);
    }

  private:
    Curve curve_{};
    std::vector<Tangents> tangents_{};
};

Shape shape_of(std::int64_t flags) {
    if ((flags & constant_flag) != 0)
        return (flags & constant_next) != 0 ? Shape::ConstantNext : Shape::Constant;
    return (flags & linear_flag) != 0 ? Shape::Linear : Shape::Cubic;
}

/// Two weights in the bits of one float, in ten-thousandths; text files may write the bits as an integer.
std::uint32_t packed_bits(double value) {
    if (std::abs(value) >= 1.0)
        return static_cast<std::uint32_t>(
            static_cast<std::int64_t>(std::clamp(value, -2147483648.0, 4294967295.0)));
    return std::bit_cast<std::uint32_t>(static_cast<float>(value));
}
double weight_in(std::uint32_t bits) {
    return std::clamp(static_cast<double>(bits & 0xffff) / 10000.0, 0.0001, 1.0);
}

Tangents tangents_of(std::int64_t flags, const double* data) {
    Tangents result{.flags = flags};
    for (std::size_t i = 0; i < 3; ++i)
        if (std::abs(data[i]) <= 1e9) result.data[i] = data[i];
    if (result.is_tcb()) return result;
    const std::uint32_t weights = packed_bits(data[2]);
    if ((flags & weighted_right) != 0) result.right_weight = weight_in(weights);
    if ((flags & weighted_next_left) != 0) result.next_left_weight = weight_in(weights >> 16);
    return result;
}

double cubic(double a, double b, double c, double d, double u) {
    const double v = 1.0 - u;
    return v * v * v * a + 3.0 * v * v * u * b + 3.0 * v * u * u * c + u * u * u * d;
}

/// The parameter at which a Bezier curve with ends 0 and 1 and these inner points reaches `x`; it never turns
/// back, so bisection cannot fail.
double parameter_at(double x, double first, double second) {
    double low = 0.0, high = 1.0, u = x;
    for (int i = 0; i < 100 && high - low > 1e-15; ++i) {
        const double over = cubic(0.0, first, second, 1.0, u) - x;
        (over > 0.0 ? high : low) = u;
        const double v = 1.0 - u;
        const double slope = 3.0 * (v * v * first + 2.0 * v * u * (second - first) + u * u * (1.0 - second));
        const double next = u - over / slope;
        if (std::abs(over) < 1e-15) break;
        u = slope > 1e-9 && next > low && next < high ? next : 0.5 * (low + high);
    }
    return u;
}

bool is_word(const Record& record, std::size_t at) {
    const std::string_view text = record.text(at);
    return !text.empty() && ((text[0] >= 'a' && text[0] <= 'z') || (text[0] >= 'A' && text[0] <= 'Z'));
}

/// Parses the keys of version 6: time, value, a letter for the shape, and its data.
class OldKeys {
  public:
    explicit OldKeys(const Record& record) : record_(record) {}

    /// Reads no keys if one of them is not understood, since the next one's start is then unknown.
    Curve read() {
        while (at_ < record_.properties.size() && !is_lost_) read_key();
        if (is_lost_) return {.is_odd = true};
        return keys_.finish();
    }

  private:
    double number() {
        if (at_ >= record_.properties.size() || is_word(record_, at_)) is_lost_ = true;
        return record_.number(at_++);
    }
    char letter() {
        if (at_ >= record_.properties.size() || !is_word(record_, at_)) {
            is_lost_ = true;
            return 0;
        }
        return record_.text(at_++)[0];
    }
    /// A letter that says for which keys weights or velocities follow: none, right, next left, all.
    void optional_pair(double& right, double& next_left) {
        const char which = letter();
        if (which == 'r' || which == 'a') right = std::clamp(number(), 0.0001, 1.0);
        if (which == 'l' || which == 'a') next_left = std::clamp(number(), 0.0001, 1.0);
        if (which != 'n' && which != 'r' && which != 'l' && which != 'a') is_lost_ = true;
    }
    void read_key() {
        CurveKey key;
        key.ticks = record_.integer(at_);
        number();
        key.value = number();
        Tangents tangents;
        const char shape = letter();
        if (shape == 'C') {
            key.shape = letter() == 'n' ? Shape::ConstantNext : Shape::Constant;
        } else if (shape == 'U') {
            key.shape = Shape::Cubic;
            read_tangents(tangents);
        } else if (shape != 'L') {
            is_lost_ = true;
        }
        keys_.add(key, tangents);
    }
    void read_tangents(Tangents& tangents) {
        const char mode = letter();
        std::size_t count = 0;
        for (; at_ < record_.properties.size() && !is_word(record_, at_); ++count) {
            const double value = number();
            if (count < tangents.data.size()) tangents.data[count] = value;
        }
        if (mode == 's' || mode == 'b') {
            tangents.flags = mode == 'b' ? tangent_user | generic_break : tangent_user;
            if (count != 2) is_lost_ = true;
        } else if (mode == 't') {
            tangents.flags = tangent_tcb;
            if (count != 3) is_lost_ = true;
        } else if (mode == 'p') {
            tangents.flags = clamp_progressive | time_independent;
        } else if (mode != 'a') {
            is_lost_ = true;
        }
        optional_pair(tangents.right_weight, tangents.next_left_weight);
        if (at_ < record_.properties.size() && is_word(record_, at_)) {
            double right = 0.0, left = 0.0;
            optional_pair(right, left);
            if (right != 0.0 || left != 0.0) keys_.set_odd();
        }
    }

    const Record& record_;
    std::size_t at_ = 0;
    bool is_lost_ = false;
    KeyList keys_{};
};

}  // namespace

double Curve::at(double time) const {
    if (keys.empty()) return 0.0;
    const auto after = std::upper_bound(keys.begin(), keys.end(), time,
                                        [](double t, const CurveKey& key) { return t < key.time(); });
    if (after == keys.begin()) return keys.front().value;
    const CurveKey& from = *(after - 1);
    if (after == keys.end()) return from.value;
    const double begin = from.time(), span = after->time() - begin, x = (time - begin) / span;
    switch (from.shape) {
        case Shape::Constant:
            return from.value;
        case Shape::ConstantNext:
            return x > 0.0 ? after->value : from.value;
        case Shape::Linear:
            return from.value + x * (after->value - from.value);
        case Shape::Cubic:
            break;
    }
    const double first = from.leaving_weight, second = 1.0 - from.arriving_weight;
    const bool is_even = first == usual_weight && from.arriving_weight == usual_weight;
    const double u = is_even ? x : parameter_at(x, first, second);
    return cubic(from.value, from.value + from.leaving * span * first,
                 after->value - from.arriving * span * from.arriving_weight, after->value, u);
}

Curve read_curve(const Record& record) {
    const std::vector<std::int64_t> times = record.integers_of("KeyTime");
    const std::vector<double> values = record.numbers_of("KeyValueFloat");
    std::vector<std::int64_t> flags = record.integers_of("KeyAttrFlags");
    const std::vector<std::int64_t> counts = record.integers_of("KeyAttrRefCount");
    const Record* floats = record.child("KeyAttrDataFloat");
    std::vector<double> data = floats ? floats->floats() : std::vector<double>();
    if (times.size() != values.size())
        throw std::runtime_error("a curve of " + std::to_string(times.size()) + " times and " +
                                 std::to_string(values.size()) + " values");
    if (flags.empty()) flags.push_back(linear_flag);
    data.resize(4 * flags.size());
    KeyList keys;
    for (const char* outside : {"Pre-Extrapolation", "Post-Extrapolation"}) {
        const Record* found = record.child(outside);
        const Record* type = found ? found->child("Type") : nullptr;
        if (type && !type->text(0).empty() && type->text(0) != "C") keys.set_odd();
    }
    // Each set of attributes applies to a number of keys; the last one to the rest.
    std::size_t set = 0;
    std::int64_t left = counts.empty() ? 0 : counts[0];
    for (std::size_t i = 0; i < times.size(); ++i, --left) {
        for (; left <= 0 && set + 1 < flags.size(); ++set)
            left = set + 1 < counts.size() ? counts[set + 1] : 0;
        const Shape shape = shape_of(flags[set]);
        if ((flags[set] & any_velocity) != 0 && shape == Shape::Cubic) keys.set_odd();
        keys.add({.ticks = times[i], .value = values[i], .shape = shape},
                 tangents_of(flags[set], &data[4 * set]));
    }
    return keys.finish();
}

Curve read_old_curve(const Record& channel) {
    const Record* keys = channel.child("Key");
    return keys ? OldKeys(*keys).read() : Curve();
}

}  // namespace tendril::app::fbx
