// The filters of the fixed session.
#include "fnv.hpp"
#include "random.hpp"
#include "session.hpp"
#include "tendril/signal/batch.hpp"
#include "tendril/signal/measure.hpp"

namespace tendril::test {
namespace {

using signal::Filter;
using signal::Spring;
using signal::SpringState;

double around(Random& random, float range) {
    return static_cast<double>(random.around(range));
}
/// A time from 1/256 to 8 s, exact in a float.
double some_dt(Random& random) {
    const int power = static_cast<int>(random.below(12)) - 8;
    return std::ldexp(1.0, power);
}

/// A filter with parameters from 0 to 4 that are exact in a float.
Filter some_filter(const signal::Kind& kind, Random& random) {
    for (;;) {
        Filter filter = kind.blank();
        for (const Field& field : kind.table()) {
            if (field.count != nullptr) continue;
            const bool is_flag = field.type == FieldType::Flag;
            for (int i = 0; i < field.size(); ++i) {
                const double value = static_cast<double>(random.below(is_flag ? 2 : 256));
                field.set_number(signal::fields_in(filter), value / (is_flag ? 1.0 : 64.0), i);
            }
        }
        if (auto* const curve = std::get_if<signal::Curve>(&filter)) {
            curve->keys[0].piece = signal::Piece::Cubic;
            curve->keys[0].leave = around(random, 4.0f);
        }
        if (signal::check(filter)) return filter;
    }
}

void add_filters(Fnv& hash, Random& random) {
    for (int round = 0; round < 40; ++round) {
        std::vector<Filter> chain;
        std::vector<signal::Sample> samples;
        for (int i = 0; i < 60; ++i) {
            const double dt = some_dt(random) / 16.0, input = around(random, 2.0f);
            samples.push_back({dt, input});
        }
        for (const signal::Kind& kind : signal::kinds()) {
            const Filter filter = some_filter(kind, random);
            for (const double output : signal::run({&filter, 1}, samples)) hash.add(output);
            if (random.chance(4)) chain.push_back(filter);
        }
        const signal::Measures measures = signal::measure(chain, samples);
        hash.add(measures.lag.value_or(0.0));
        hash.add(measures.jitter.value_or(0.0));
        hash.add(measures.rate_difference);
    }
}

void add_springs(Fnv& hash, Random& random) {
    for (int round = 0; round < 60; ++round) {
        const double strength = 4.0 + around(random, 4.0f);
        const double damping = round % 3 == 0 ? 1.0 : 1.0 + around(random, 1.0f);
        const Spring<glm::vec3> spring{strength, damping, random.point(8.0f), 0.25};
        const Spring<glm::quat> turning{strength, damping, random.point(8.0f), 0.25};
        SpringState<glm::vec3> state;
        SpringState<glm::quat> rotation;
        glm::quat eased(1, 0, 0, 0);
        for (int i = 0; i < 30; ++i) {
            const double dt = some_dt(random);
            const glm::vec3 target = random.point(4.0f), axis = random.point(1.0f);
            hash.add(signal::step(spring, state, target, dt));
            const glm::quat to(1.0f, axis.x, axis.y, axis.z);
            const glm::quat turned = signal::step(turning, rotation, to, dt);
            eased = signal::interp_to(eased, to, dt, 2.0);
            for (const glm::quat& each : {turned, eased}) {
                hash.add(glm::vec3(each.x, each.y, each.z));
                hash.add(each.w);
            }
        }
    }
}

void add_batch(Fnv& hash, Random& random) {
    constexpr std::size_t count = 501;
    std::vector<float> strength, damping, force, amount, target(count), value(count), velocity(count),
        previous(count);
    for (std::size_t i = 0; i < count; ++i) {
        strength.push_back(4.0f + random.around(4.0f));
        damping.push_back(i % 3 == 0 ? 1.0f : 1.0f + random.around(1.0f));
        force.push_back(random.around(8.0f));
        amount.push_back(0.5f + random.around(0.5f));
    }
    const signal::SpringArrays springs{strength, damping, force, amount, target, value, velocity, previous};
    require(signal::start_springs(springs));
    std::vector<float> eased(count);
    for (int turn = 0; turn < 60; ++turn) {
        for (float& each : target) each = random.around(4.0f);
        const double dt = some_dt(random);
        require(signal::step_springs(springs, dt));
        require(signal::interp_to_exact(eased, target, strength, dt));
        for (const float each : value) hash.add(each);
        for (const float each : velocity) hash.add(each);
        for (const float each : eased) hash.add(each);
    }
}

}  // namespace

std::uint64_t signal_hash() {
    Random random(20260104);
    Fnv hash;
    add_filters(hash, random);
    add_springs(hash, random);
    add_batch(hash, random);
    return hash.value();
}

}  // namespace tendril::test
