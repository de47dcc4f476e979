#include "session.hpp"

#include <bit>
#include <vector>

#include "random.hpp"
#include "tendril/chain/chain.hpp"
#include "tendril/ik/solver.hpp"

namespace tendril::test {
namespace {

class Fnv {
  public:
    void add(float value) {
        const auto bits = std::bit_cast<std::uint32_t>(value);
        for (int shift = 0; shift < 32; shift += 8) {
            hash_ = (hash_ ^ ((bits >> shift) & 0xffu)) * 0x100000001b3u;
        }
    }
    void add(const glm::vec3& point) {
        for (int axis = 0; axis < 3; ++axis) add(point[axis]);
    }
    std::uint64_t value() const { return hash_; }

  private:
    std::uint64_t hash_ = 0xcbf29ce484222325u;
};

float some_length(Random& random) {
    constexpr float lengths[] = {0.0f, 0.25f, 0.7f, 1.0f, 1.3f, 3.0f, 17.0f};
    return random.chance(100) ? 1e6f : lengths[random.below(7)];
}

glm::vec3 some_point(const Chain& chain, Random& random) {
    if (!chain.empty() && random.chance(8)) return chain.position(random.below(chain.size()));
    return random.point(random.chance(50) ? 1048576.0f : 16.0f);
}

void edit(Chain& chain, Random& random) {
    const std::size_t index = chain.empty() ? 0 : random.below(chain.size());
    const bool full = chain.size() >= 48;
    switch (random.below(chain.empty() ? 2 : 6)) {
        case 0:
            return full ? chain.remove(index) : chain.add(some_length(random));
        case 1: {
            const glm::vec3 position = some_point(chain, random);
            return full ? chain.remove(index) : chain.add(Segment{position, some_length(random)});
        }
        case 2:
            return chain.insert(index, some_length(random));
        case 3: {
            const glm::vec3 position = some_point(chain, random);
            return chain.insert(index, Segment{position, some_length(random)});
        }
        case 4:
            return chain.set_length(index, some_length(random));
        default:
            return chain.remove(index);
    }
}

void reach(Chain& chain, Random& random) {
    const glm::vec3 target = some_point(chain, random);
    switch (random.below(4)) {
        case 0:
            return chain.forward(target);
        case 1:
            return chain.backward(target);
        case 2:
            chain.fixed(target, {.iterations = 3});
            return;
        default:
            return chain.with_index(chain.empty() ? 0 : random.below(chain.size()), target);
    }
}

ik::Limit some_limit(Random& random) {
    switch (random.below(4)) {
        case 0:
            return ik::Limit::hinge({0, 0, 1}, -0.5f, 2.0f);
        case 1:
            return ik::Limit::of(ik::JointKind::BallAndSocket);
        case 2:
            return ik::Limit::of(ik::JointKind::Gliding);
        default:
            return {};
    }
}

ik::Options some_options(const std::vector<ik::Limit>& limits, Random& random) {
    ik::Options options;
    options.max_iterations = 1 + static_cast<int>(random.below(40));
    if (random.chance(3)) options.pole = random.point(4.0f);
    if (random.chance(2)) options.pole_turn = ik::PoleTurn::EachJoint;
    if (random.chance(4)) options.limits = limits;
    if (random.chance(4)) options.snap_back = 0.25f;
    if (random.chance(4)) options.soft_zone = 0.125f;
    if (random.chance(6)) options.tip_orientation = glm::quat(0.5f, 0.5f, -0.5f, 0.5f);
    if (random.chance(3)) options.max_stretch_scale = 1.5f;
    return options;
}

}  // namespace

std::uint64_t session_hash() {
    Random random(20260101);
    Fnv hash;
    Chain chain;
    for (int i = 0; i < 20'000; ++i) {
        if (i % 1000 == 0) chain = Chain(i % 2000 == 0 ? glm::vec3(1, 0, 0) : glm::vec3(0, -1, 0));
        random.chance(2) ? edit(chain, random) : reach(chain, random);
        for (const Segment& segment : chain.segments()) {
            hash.add(segment.position);
        }
    }
    return hash.value();
}

std::uint64_t solve_hash() {
    Random random(20260102);
    Fnv hash;
    for (int i = 0; i < 400; ++i) {
        const ik::Method method = ik::all_methods[random.below(ik::all_methods.size())];
        std::vector<float> lengths(method == ik::Method::TwoBone ? 2 : 1 + random.below(12));
        for (float& length : lengths)
            length = random.chance(10) ? 0.0f : 0.25f + 0.125f * float(random.below(9));
        std::vector<ik::Limit> limits(lengths.size());
        for (ik::Limit& limit : limits) limit = some_limit(random);
        std::vector<glm::vec3> joints{random.point(2.0f)};
        for (const float length : lengths) joints.push_back(joints.back() + glm::vec3(length, 0.0f, 0.0f));
        ik::Solver solver(lengths);
        for (int turn = 0; turn < 10; ++turn) {
            const glm::vec3 target = joints.front() + random.point(random.chance(4) ? 16.0f : 4.0f);
            const ik::Report report = solver.solve(method, joints, target, some_options(limits, random));
            hash.add(report.residual);
            hash.add(static_cast<float>(report.iterations));
            hash.add(static_cast<float>(report.status));
            for (const glm::vec3& joint : joints) hash.add(joint);
        }
    }
    return hash.value();
}

}  // namespace tendril::test
