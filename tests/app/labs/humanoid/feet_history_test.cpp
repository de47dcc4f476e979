// A moment of a clip with foot IK looks the same whether it is played, scrubbed to or exported.

#include "app/labs/humanoid/humanoid_runtime.hpp"
#include "humanoid_support.hpp"
#include "tests/app/support/temp_folder.hpp"
#include "tests/labels.hpp"

namespace tendril::app {
namespace {

constexpr double tenth_of_a_millimetre = 1e-4;

class HumanoidFeetHistory : public HumanoidTest {
  protected:
    std::vector<humanoid::Placement> shown() const { return shown_pose(workspace).placed; }
    double seconds() const {
        const Playback& playback = part().playback;
        return static_cast<double>(playback.rounds) * part().clip()->duration + playback.time;
    }
    static double apart(const std::vector<humanoid::Placement>& a,
                        const std::vector<humanoid::Placement>& b) {
        double most = a.size() == b.size() ? 0.0 : 1e9;
        for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i)
            most = std::max(most, glm::distance(a[i].position, b[i].position));
        return most;
    }
    /// The poses drawn at moments of the clip while it plays.
    std::vector<std::pair<double, std::vector<humanoid::Placement>>> played(int ticks) {
        std::vector<std::pair<double, std::vector<humanoid::Placement>>> moments;
        for (int i = 0; i < ticks; ++i) {
            tick();
            moments.emplace_back(seconds(), shown());
        }
        return moments;
    }
    void put_on(const Json& ground, const char* clip, double speed, bool in_place = false) {
        run("humanoid.load");
        run("humanoid.ground", ground);
        run("humanoid.foot_ik", {{"on", true}});
        run("humanoid.clip",
            {{"name", clip}, {"time", 0}, {"speed", speed}, {"in_place", in_place}, {"play", true}});
    }
    const std::vector<Json> grounds{{{"kind", "stairs"}, {"step_height", 0.16}, {"step_depth", 0.36}},
                                    {{"kind", "slope"}, {"angle_deg", 18}},
                                    {{"kind", "slope"}, {"angle_deg", -15}},
                                    {{"kind", "terrain"}}};
};

LABEL(slow, "HumanoidFeetHistory.IsTheSameAfterMinutes");

TEST_F(HumanoidFeetHistory, LooksScrubbedAsItWasPlayed) {
    for (const Json& ground : grounds)
        for (const char* clip : {"walk", "punch"})
            for (const double speed : {0.37, 1.7}) {
                put_on(ground, clip, speed);
                const auto moments = played(200);
                for (std::size_t i = 0; i < moments.size(); i += 7) {
                    // Out of order, as when scrubbing by hand.
                    const auto& [time, pose] = moments[(i * 61) % moments.size()];
                    run("humanoid.clip", {{"time", time}, {"play", false}});
                    EXPECT_LT(apart(shown(), pose), tenth_of_a_millimetre)
                        << ground << ' ' << clip << " at " << time << " s, speed " << speed;
                }
            }
}

TEST_F(HumanoidFeetHistory, LooksTheSameInPlace) {
    put_on({{"kind", "flat"}}, "walk", 0.8, true);
    const auto moments = played(300);
    for (std::size_t i = 0; i < moments.size(); i += 11) {
        run("humanoid.clip", {{"time", moments[i].first}, {"play", false}});
        EXPECT_LT(apart(shown(), moments[i].second), tenth_of_a_millimetre) << moments[i].first;
    }
}

TEST_F(HumanoidFeetHistory, IsExportedAsItIsShown) {
    const test::TempFolder folder;
    const std::string file = (folder / "out.glb").string();
    for (const Json& ground : grounds)
        for (const char* clip : {"walk", "punch"})
            for (const double fps : {60.0, 24.0}) {
                put_on(ground, clip, 1.0);
                run("humanoid.export", {{"path", file}, {"fps", fps}});
                const SharedCharacter read = load_character(file);
                const humanoid::Clip& written = read->clips().front();
                for (int i = 0; i / fps <= written.duration; i += 3) {
                    const double time = i / fps;
                    run("humanoid.clip", {{"time", time}, {"play", false}});
                    std::vector<rig::Transform> pose(read->skeleton().size());
                    humanoid::sample(written, read->skeleton(), time, pose);
                    std::vector<humanoid::Placement> placed(pose.size());
                    humanoid::place(read->skeleton(), pose, placed);
                    for (std::size_t node = 0; node < part().skeleton().size(); ++node) {
                        const std::string& name = part().skeleton()[node].name;
                        EXPECT_LT(glm::distance(placed[*read->skeleton().find(name)].position,
                                                shown()[node].position),
                                  tenth_of_a_millimetre)
                            << ground << ' ' << clip << ' ' << name << " at " << time << " s, " << fps;
                    }
                }
            }
}

/// The past is bounded: a moment after minutes costs at most two blocks, and looks as it did when played.
TEST_F(HumanoidFeetHistory, IsTheSameAfterMinutes) {
    put_on({{"kind", "flat"}}, "walk", 10.0);
    const auto moments = played(900);  // two and a half minutes of the clip
    ASSERT_GT(moments.back().first, 4.0 * FeetHistory::block_ticks * tick_seconds);
    for (std::size_t i = 0; i < moments.size(); i += 97) {
        run("humanoid.clip", {{"time", moments[i].first}, {"play", false}});
        EXPECT_LT(apart(shown(), moments[i].second), tenth_of_a_millimetre) << moments[i].first;
        EXPECT_LT(apart(shown_pose(reopened()).placed, moments[i].second), tenth_of_a_millimetre);
    }
}

}  // namespace
}  // namespace tendril::app
