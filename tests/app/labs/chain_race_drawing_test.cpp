// Chains of a race that would overlap are drawn apart.
#include <algorithm>
#include <glm/geometric.hpp>
#include <map>
#include <string>

#include "app/labs/chain/draw.hpp"
#include "tests/app/labs/chain_support.hpp"

namespace tendril::app {
namespace {

class RaceDrawingTest : public ChainTest {
  protected:
    const Camera camera_{CameraPose{.yaw = 0.4f, .pitch = 0.3f, .distance = 12.0f}, {{0, 0}, {800, 600}}};
    const Palette& colours_ = palette(Theme::Dark);

    std::shared_ptr<const Race> race() const { return shown_chain(workspace).race; }

    DrawList drawing(const Camera& camera, std::size_t pane = 0) const {
        DrawList list;
        lab().draw({workspace, camera, colours_, no_pick, no_pick, 1.0f, pane}, list);
        return list;
    }
    /// The lines in a solver's colour, in order: one for each of its bones.
    std::map<ik::Method, std::vector<Stroke>> bones(std::size_t pane = 0) const {
        std::map<ik::Method, std::vector<Stroke>> found;
        for (const Stroke& stroke : drawing(camera_, pane).strokes)
            for (const Racer& racer : race()->racers)
                if (stroke.a != stroke.b && stroke.shadow &&
                    glm::vec3(stroke.colour) == solver_colour(colours_, racer.method))
                    found[racer.method].push_back(stroke);
        return found;
    }
    glm::vec2 seen(glm::vec3 at) const { return *camera_.project(at); }
    /// Lateral distance between a bone and its drawn line, at its middle, pixels.
    float aside(const Stroke& drawn, glm::vec3 from, glm::vec3 to) const {
        const glm::vec2 along = glm::normalize(seen(to) - seen(from));
        const glm::vec2 off = seen(0.5f * (drawn.a + drawn.b)) - seen(0.5f * (from + to));
        return glm::abs(along.x * off.y - along.y * off.x);
    }
};

TEST_F(RaceDrawingTest, EqualChainsRunAlongLikeStrands) {
    reach_with(6);
    // Already on the target: every solver keeps its starting pose.
    run("chain.target", {{"to", Json::array({6, 0, 0})}});
    run("race.open", {{"start", "here"}});
    for (const ik::Method method : ik::all_methods)
        if (method != ik::Method::TwoBone) run("race.solver", {{"name", ik::name(method)}, {"on", true}});
    const auto drawn = bones();
    ASSERT_EQ(drawn.size(), race()->racers.size());
    ASSERT_GE(drawn.size(), 4u);
    for (std::size_t bone = 0; bone < 6; ++bone) {
        std::vector<glm::vec2> middles;
        for (const auto& [method, lines] : drawn) {
            ASSERT_EQ(lines.size(), 6u) << ik::name(method);
            middles.push_back(seen(0.5f * (lines[bone].a + lines[bone].b)));
        }
        for (std::size_t i = 0; i < middles.size(); ++i)
            for (std::size_t j = 0; j < i; ++j)
                EXPECT_GT(glm::distance(middles[i], middles[j]), 3.0f) << bone;
    }
}

/// Solvers that share a tip share a label: all of them do before the first iteration.
TEST_F(RaceDrawingTest, EveryTipHasTheNameOfItsSolver) {
    reach_with(6);
    run("race.open", {{"start", "straight"}});
    run("chain.target", {{"to", Json::array({3, 3, 1})}});
    for (const std::size_t iteration : {0u, 2u}) {
        run("race.show", {{"iteration", iteration}});
        const DrawList list = drawing(camera_);
        std::size_t most = 0;
        for (const Racer& racer : race()->racers) {
            const std::string name = solver_title(racer.method);
            const glm::vec3 tip = racer_at(racer, iteration).joints.back();
            std::size_t named = 0;
            for (const Label& each : list.labels) {
                if (('\n' + each.text + '\n').find('\n' + name + '\n') == std::string::npos) continue;
                ++named;
                most = std::max(most, static_cast<std::size_t>(std::ranges::count(each.text, '\n')) + 1);
                EXPECT_LT(glm::distance(seen(each.at), seen(tip)), 4.0f) << name;
            }
            EXPECT_EQ(named, 1u) << name << " at iteration " << iteration;
        }
        if (iteration == 0) {
            EXPECT_EQ(most, race()->racers.size()) << "one label has all names";
        }
    }
}

/// At a bend, strands meet at their corners and keep their distance.
TEST_F(RaceDrawingTest, StrandsMeetAtTheCorners) {
    reach_with(6);
    run("chain.target", {{"to", Json::array({2.5, 2.5, 0.5})}});  // already there: all keep the pose
    run("race.open", {{"start", "here"}});
    const auto drawn = bones();
    int corners = 0;
    std::map<ik::Method, std::vector<glm::vec3>> poses;
    for (const Racer& racer : race()->racers) poses[racer.method] = racer.joints;
    for (const auto& [method, lines] : drawn) {
        ASSERT_EQ(lines.size(), 6u);
        for (std::size_t bone = 1; bone < 6; ++bone) {
            const glm::vec2 end = seen(lines[bone - 1].b), next = seen(lines[bone].a);
            EXPECT_LT(glm::distance(end, next), 0.6f) << ik::name(method) << " joint " << bone;
            ++corners;
        }
        for (std::size_t bone = 0; bone < 6; ++bone) {
            const float off = aside(lines[bone], poses[method][bone], poses[method][bone + 1]);
            EXPECT_LT(off, 9.5f) << ik::name(method) << " bone " << bone;
        }
    }
    EXPECT_GT(corners, 15);
    // Some of them are actually apart.
    const auto middle = [&](ik::Method method) {
        const Stroke& line = drawn.at(method)[3];
        return seen(0.5f * (line.a + line.b));
    };
    EXPECT_GT(glm::distance(middle(race()->racers[0].method), middle(race()->racers[1].method)), 3.0f);
}

TEST_F(RaceDrawingTest, ChainsThatAreApartAreDrawnInPlace) {
    reach_with(6);
    run("race.open", {{"start", "straight"}});
    run("chain.target", {{"to", {2, 2.5, 1}}});
    const auto drawn = bones();
    int apart = 0;
    for (const Racer& racer : race()->racers) {
        const auto& lines = drawn.at(racer.method);
        ASSERT_EQ(lines.size(), 6u);
        for (std::size_t bone = 1; bone <= 6; ++bone) {
            float nearest_pixels = 1e9f;
            for (const Racer& other : race()->racers) {
                if (other.method == racer.method) continue;
                nearest_pixels = std::min(
                    nearest_pixels,
                    std::max(glm::distance(seen(other.joints[bone]), seen(racer.joints[bone])),
                             glm::distance(seen(other.joints[bone - 1]), seen(racer.joints[bone - 1]))));
            }
            const float off = aside(lines[bone - 1], racer.joints[bone - 1], racer.joints[bone]);
            if (nearest_pixels > 3.1f) {
                EXPECT_LT(off, 0.05f) << ik::name(racer.method) << " bone " << bone;
                ++apart;
            }
            EXPECT_LT(off, 12.0f) << ik::name(racer.method) << " bone " << bone;
        }
    }
    EXPECT_GT(apart, 8);
}

TEST_F(RaceDrawingTest, SideBySideEachPaneHasOneChainInPlace) {
    reach_with(4);
    run("chain.target", {{"to", {4, 0, 0}}});
    run("race.open", {{"start", "here"}});
    run("race.side_by_side", {{"on", true}});
    ASSERT_EQ(lab().panes(workspace).size(), race()->racers.size());
    for (std::size_t pane = 0; pane < race()->racers.size(); ++pane) {
        const auto drawn = bones(pane);
        ASSERT_EQ(drawn.size(), 1u);
        const Racer& racer = race()->racers[pane];
        ASSERT_EQ(drawn.begin()->first, racer.method);
        for (std::size_t bone = 1; bone <= 4; ++bone) {
            EXPECT_EQ(drawn.begin()->second[bone - 1].a, racer.joints[bone - 1]);
            EXPECT_EQ(drawn.begin()->second[bone - 1].b, racer.joints[bone]);
        }
    }
}

TEST_F(RaceDrawingTest, ChainsSeenEndOnAreStillDrawn) {
    reach_with(3);
    run("chain.target", {{"to", {3, 0, 0}}});
    run("race.open", {{"start", "here"}});
    const Camera along({.yaw = glm::radians(90.0f), .pitch = 0.0f, .distance = 12.0f}, {{0, 0}, {800, 600}});
    for (const Stroke& stroke : drawing(along).strokes)
        EXPECT_TRUE(is_finite_point(stroke.a) && is_finite_point(stroke.b));
}

}  // namespace
}  // namespace tendril::app
