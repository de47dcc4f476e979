// Several joints of a chain that trails, pulled at once.
#include <algorithm>
#include <glm/geometric.hpp>
#include <utility>

#include "app/labs/chain/reach_drag.hpp"

namespace tendril::app {
namespace {

constexpr FixedOptions between_joints{.iterations = 100, .tolerance = 1e-5f};

/// The least rotation that takes one direction to the other.
glm::quat turn_of(glm::vec3 from, glm::vec3 to) {
    const float a = glm::length(from), b = glm::length(to);
    return a > 1e-6f && b > 1e-6f ? least_rotation(from / a, to / b) : glm::quat(1, 0, 0, 0);
}

/// Some joints in a row, as a chain of their own; `back`: the last one first.
Expected<Chain> part_of(const Chain& chain, std::size_t first, std::size_t last, bool back = false) {
    std::vector<Segment> segments;
    for (std::size_t i = 0; i <= last - first; ++i) {
        const std::size_t at = back ? last - i : first + i;
        segments.push_back({chain.position(at), i == 0 ? 0.0f : chain.length(back ? at + 1 : at)});
    }
    return Chain::from_segments(std::move(segments), chain.default_direction());
}

}  // namespace

Result trail_joints(Chain& chain, std::span<const JointPull> pulls) {
    if (pulls.size() == 1) return chain.with_index(pulls.front().joint, pulls.front().to);
    std::vector<glm::vec3> joints = positions(chain);
    const auto put = [&](const Chain& part, std::size_t first, bool back) {
        for (std::size_t i = 0; i < part.size(); ++i)
            joints[back ? first + part.size() - 1 - i : first + i] = part.position(i);
    };
    const auto [first, to] = pulls.front();
    Expected<Chain> before = part_of(chain, 0, first);
    if (const Result pulled = before->backward(to); !pulled) return pulled;
    put(*before, 0, false);
    std::size_t last = first;
    for (const JointPull& pull : pulls.subspan(1)) {
        // From where it would be if it had only gone along and turned with its ends.
        Expected<Chain> between = part_of(chain, last, pull.joint, true);
        const glm::vec3 from = chain.position(last), at = joints[last];
        std::vector<glm::vec3> moved = positions(*between);
        const glm::quat turn = turn_of(moved.front() - from, pull.to - at);
        for (glm::vec3& joint : moved) joint = at + turn * (joint - from);
        if (const Result set = between->set_positions(moved); !set) return set;
        if (const FixedResult pulled = between->fixed(pull.to, between_joints); !pulled.outcome)
            return pulled.outcome;
        put(*between, last, true);
        last = pull.joint;
    }
    Expected<Chain> beyond = part_of(chain, last, chain.size() - 1);
    if (const Result pulled = beyond->forward(joints[last]); !pulled) return pulled;
    put(*beyond, last, false);
    return chain.set_positions(joints);
}

}  // namespace tendril::app
