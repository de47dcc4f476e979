// Shared by the chain's tests: the invariant as chain.hpp states it, and bitwise equality.
#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>

#include "tendril/chain/chain.hpp"
#include "tests/says.hpp"

namespace tendril::test {

inline constexpr float nan = std::numeric_limits<float>::quiet_NaN();
inline constexpr float infinity = std::numeric_limits<float>::infinity();

inline void expect_ok(const Result& result) {
    EXPECT_TRUE(result) << result.message();
}

inline bool same_bits(glm::vec3 a, glm::vec3 b) {
    return std::memcmp(&a, &b, sizeof a) == 0;
}

inline bool same_bits(const Segment& a, const Segment& b) {
    return same_bits(a.position, b.position) &&
           std::bit_cast<std::uint32_t>(a.length) == std::bit_cast<std::uint32_t>(b.length);
}

inline bool same_bits(const Chain& a, const Chain& b) {
    const auto x = a.segments(), y = b.segments();
    return same_bits(a.default_direction(), b.default_direction()) &&
           std::equal(x.begin(), x.end(), y.begin(), y.end(),
                      [](const Segment& s, const Segment& t) { return same_bits(s, t); });
}

inline double distance(glm::vec3 a, glm::vec3 b) {
    return std::hypot(static_cast<double>(a.x) - static_cast<double>(b.x),
                      static_cast<double>(a.y) - static_cast<double>(b.y),
                      static_cast<double>(a.z) - static_cast<double>(b.z));
}

inline bool lies_within(const Chain& chain, double range) {
    const auto segments = chain.segments();
    return std::all_of(segments.begin(), segments.end(), [&](const Segment& segment) {
        return distance(segment.position, glm::vec3(0.0f)) <= range;
    });
}

/// Empty if the invariant holds, otherwise the fault. Bone lengths are checked exactly within 1e3 m of the
/// origin, and to the spacing of floats beyond.
inline std::string broken(const Chain& chain) {
    const auto segments = chain.segments();
    const bool near = lies_within(chain, 1e3);
    for (std::size_t i = 0; i < segments.size(); ++i) {
        const glm::vec3 p = segments[i].position;
        if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z))
            return "position " + std::to_string(i) + " is not finite";
        if (i == 0) continue;
        const glm::vec3 q = segments[i - 1].position;
        const double length = segments[i].length;
        double allowed = 1e-4 * std::max(1.0, length);
        if (!near) {
            const float far = std::max(
                {std::abs(p.x), std::abs(p.y), std::abs(p.z), std::abs(q.x), std::abs(q.y), std::abs(q.z)});
            allowed += static_cast<double>(std::nextafter(far, infinity) - far);
        }
        const double error = std::abs(distance(p, q) - length);
        if (!(error <= allowed))
            return "link " + std::to_string(i) + " of length " + std::to_string(length) + " is off by " +
                   std::to_string(error);
    }
    return {};
}

inline ::testing::AssertionResult Holds(const Chain& chain) {
    const std::string what = broken(chain);
    if (what.empty()) return ::testing::AssertionSuccess();
    return ::testing::AssertionFailure() << what;
}

inline void expect_positions(const Chain& chain, const std::vector<glm::vec3>& expected,
                             double tolerance = 1e-5) {
    ASSERT_EQ(chain.size(), expected.size());
    for (std::size_t i = 0; i < expected.size(); ++i) {
        const glm::vec3 p = chain.position(i);
        EXPECT_LE(distance(p, expected[i]), tolerance)
            << "segment " << i << " is at " << p.x << ' ' << p.y << ' ' << p.z << ", expected "
            << expected[i].x << ' ' << expected[i].y << ' ' << expected[i].z;
    }
    EXPECT_TRUE(Holds(chain));
}

/// An empty chain with this default direction.
inline Chain along(glm::vec3 default_direction) {
    return *Chain::from_segments({}, default_direction);
}

/// A chain of `count` segments of `length`, straight along +X from the origin.
inline Chain straight(std::size_t count, float length = 1.0f) {
    Chain chain;
    for (std::size_t i = 0; i < count; ++i) expect_ok(chain.add(length));
    return chain;
}

/// The message with which `call` throws `Error`; fails if it does not. For code that throws.
template <class Error, class Call>
std::string message_of(Call call) {
    try {
        call();
    } catch (const Error& error) {
        return error.what();
    }
    ADD_FAILURE() << "nothing was thrown";
    return {};
}

}  // namespace tendril::test
