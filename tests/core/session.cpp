#include "session.hpp"

#include "fnv.hpp"
#include "random.hpp"
#include "rope_named.hpp"
#include "tendril/chain/chain.hpp"
#include "tendril/ik/curve.hpp"
#include "tendril/ik/mechanisms.hpp"
#include "tendril/ik/solver.hpp"

namespace tendril::test {
namespace {

float some_length(Random& random) {
    constexpr float lengths[] = {0.0f, 0.25f, 0.7f, 1.0f, 1.3f, 3.0f, 17.0f};
    return random.chance(100) ? 1e6f : lengths[random.below(7)];
}

glm::vec3 some_point(const Chain& chain, Random& random) {
    if (!chain.empty() && random.chance(8)) return chain.position(random.below(chain.size()));
    return random.point(random.chance(50) ? 1048576.0f : 16.0f);
}

Result edit(Chain& chain, Random& random) {
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

Result reach(Chain& chain, Random& random) {
    const glm::vec3 target = some_point(chain, random);
    switch (random.below(4)) {
        case 0:
            return chain.forward(target);
        case 1:
            return chain.backward(target);
        case 2:
            return chain.fixed(target, {.iterations = 3}).accepted;
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
    options.rotations = true;
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

rope::Shape some_collider(Random& random) {
    const glm::vec3 at = random.point(1.0f);
    const float size = 0.125f + 0.0625f * static_cast<float>(random.below(5));
    switch (random.below(3)) {
        case 0:
            return rope::Sphere{at, size};
        case 1:
            return rope::Capsule{at, at + random.point(0.5f), size};
        default:
            return rope::Box{at, {size, 0.25f, size}, glm::quat(0.5f, 0.5f, -0.5f, 0.5f)};
    }
}

/// A world of ropes of two lengths, some whipping, a cloth that tears, and hair on a ball.
test::World some_world(int number, Random& random) {
    rope::Settings settings;
    settings.solver = static_cast<rope::Solver>(number % 3);
    settings.iterations = 2 + static_cast<int>(random.below(15));
    settings.substep = random.chance(3) ? 1.0 / 64.0 : 1.0 / 256.0;
    settings.friction = 0.25f * static_cast<float>(random.below(5));
    if (random.chance(3)) settings.compliance = 0.0078125f;
    test::World world;
    world.set_settings(settings);
    world.add_collider("ground", rope::Plane{{0, -1, 0}, {0.25f, 1, 0}});
    world.add_collider("ball", rope::Sphere{random.point(0.5f), 0.25f});
    for (const char* name : {"one", "two"}) world.add_collider(name, some_collider(random));
    for (int i = 0; i < 5; ++i) {
        const glm::vec3 from = random.point(1.0f), to = from + random.point(1.0f);
        world.add_rope({.from = from,
                        .to = to,
                        .segments = i < 3 ? 12 : 7,
                        .length = 1.5f,
                        .radius = 0.015625f,
                        .pin_start = random.chance(2),
                        .pin_end = random.chance(4)});
    }
    if (random.chance(2))
        world.add_cloth({.corner = random.point(1.0f),
                         .columns = 5,
                         .rows = 4,
                         .tear = random.chance(2) ? 0.0625f : 0.0f,
                         .pins = rope::ClothShape::Pins::Corners});
    const glm::vec3 root = centre(world.find_collider("ball")->shape) + glm::vec3(0, 0.25f, 0);
    world.add_hair({.roots = {{root, {0, 1, 0}}, {root, {1, 1, 0}}}, .segments = 5}, "ball");
    return world;
}

void disturb(test::World& world, Random& random) {
    const std::size_t particle = random.below(world.size());
    switch (random.below(5)) {
        case 0:
            return world.pin(particle, random.point(1.0f), 0.125);
        case 1:
            if (world.pinned(particle)) world.unpin(particle);
            return;
        case 2:
            if (world.find("rope 2")->count > 2) world.cut("rope 2", 1);
            return;
        case 3:
            return world.move_collider("one", random.point(1.0f), 0.25);
        default:
            return world.move_collider("ball", random.point(0.5f), 0.125);
    }
}

}  // namespace

std::uint64_t session_hash() {
    Random random(20260101);
    Fnv hash;
    Chain chain;
    for (int i = 0; i < 20'000; ++i) {
        if (i % 1000 == 0) {
            chain = Chain();
            require(chain.set_default_direction(i % 2000 == 0 ? glm::vec3(1, 0, 0) : glm::vec3(0, -1, 0)));
        }
        require(random.chance(2) ? edit(chain, random) : reach(chain, random));
        for (const Segment& segment : chain.segments()) hash.add(segment.position);
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
        ik::Solver solver = ik::Solver::make(lengths).value();
        ik::State state = solver.initial_state();
        for (int turn = 0; turn < 10; ++turn) {
            const glm::vec3 target = joints.front() + random.point(random.chance(4) ? 16.0f : 4.0f);
            const ik::Report report =
                solver.solve(method, joints, state, target, some_options(limits, random));
            hash.add(report.residual);
            hash.add(static_cast<float>(report.iterations));
            hash.add(static_cast<float>(report.status));
            for (const glm::vec3& joint : joints) hash.add(joint);
        }
    }
    return hash.value();
}

std::uint64_t curve_hash() {
    Random random(20260104);
    Fnv hash;
    for (int i = 0; i < 400; ++i) {
        std::vector<glm::vec3> points(2 + random.below(9)), joints(2 + random.below(20));
        for (glm::vec3& each : points) each = random.point(4.0f);
        const std::vector<float> lengths(joints.size() - 1, 0.125f * float(1 + random.below(8)));
        for (std::size_t bone = 0; bone < lengths.size(); ++bone)
            joints[bone + 1] = joints[bone] + glm::vec3(lengths[bone], 0.0f, 0.0f);
        ik::State state(lengths.size());
        ik::CurveMemory memory(lengths.size());
        ik::CurveOptions options{.kind = random.chance(2) ? ik::CurveKind::BSpline : ik::CurveKind::Hermite,
                                 .fit = random.chance(3),
                                 .roll_end = random.around(4.0f),
                                 .weight = random.chance(3) ? 0.5f : 1.0f};
        for (int turn = 0; turn < 4; ++turn) {
            points[random.below(points.size())] = random.point(4.0f);
            const ik::CurveReport report =
                ik::place_along(points, {lengths, {}}, joints, state, memory, options);
            hash.add(report.factor);
            hash.add(static_cast<float>(report.bones_past_end));
            for (const glm::vec3& joint : joints) hash.add(joint);
            for (const glm::quat& each : state.rotations) hash.add({each.x, each.y, each.z});
        }
    }
    return hash.value();
}

std::uint64_t linkage_hash() {
    Random random(20261127);
    Fnv hash;
    const Expected<ik::Linkage> linkages[] = {ik::linkage_from(*ik::four_bar()),
                                              ik::linkage_from(*ik::slider_crank({1.0, 2.5, 0.25})),
                                              ik::linkage_from(*ik::jansen()),
                                              ik::linkage_from(*ik::pantograph()),
                                              ik::delta(),
                                              ik::stewart()};
    for (const Expected<ik::Linkage>& linkage : linkages) {
        ik::LinkageSolver solver = std::move(*ik::LinkageSolver::make(*linkage));
        ik::LinkageState state = solver.initial_state();
        for (int i = 0; i < 60; ++i) {
            const std::size_t link = random.below(linkage->links.size());
            const ik::LinkDriver driver{link,
                                        state.joints[link].value + static_cast<double>(random.around(0.5f))};
            const ik::LinkTarget target{random.below(linkage->points.size()),
                                        solver.size() * glm::dvec3(random.point(1.0f)), 1.0,
                                        random.chance(2)};
            const bool drives = linkage->links[link].joint != ik::LinkJoint::Ball && random.chance(2);
            const ik::LinkageReport report =
                solver.solve(state, {{&driver, drives ? 1u : 0u}, {&target, drives ? 0u : 1u}});
            hash.add(static_cast<float>(report.iterations));
            hash.add(report.residual);
            for (const ik::JointPlace& each : state.joints) {
                hash.add(each.value);
                hash.add(each.turn.x);
            }
            for (std::size_t k = 0; k < linkage->points.size(); ++k)
                for (int axis = 0; axis < 3; ++axis) hash.add(solver.point(k)[axis]);
        }
    }
    return hash.value();
}

std::uint64_t rope_hash() {
    Random random(20260103);
    Fnv hash;
    for (int i = 0; i < 60; ++i) {
        test::World world = some_world(i, random);
        for (int turn = 0; turn < 12; ++turn) {
            disturb(world, random);
            world.advance(0.0625);
            for (const glm::dvec3& point : world.state().position)
                for (int axis = 0; axis < 3; ++axis) hash.add(point[axis]);
            for (const rope::Link& link : world.state().links) hash.add(link.tension);
            for (const rope::Body& body : world.state().bodies) hash.add(body.stretch);
        }
    }
    return hash.value();
}

}  // namespace tendril::test
