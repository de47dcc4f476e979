// Labs that re-read files when a scene is opened: which faults are the scene's, and which the file's.
#include <glm/trigonometric.hpp>

#include "app/labs/kit/limit_shape.hpp"
#include "app/labs/kit/part_cache.hpp"
#include "app/labs/kit/past.hpp"
#include "app/system/atomic_file.hpp"
#include "tests/app/labs/lab_support.hpp"
#include "tests/app/labs/spring/spring_lab.hpp"
#include "tests/app/support/full_scenes.hpp"
#include "tests/app/support/random_numbers.hpp"
#include "tests/labels.hpp"

namespace tendril::app {
namespace {

struct Reader {
    const char* lab;
    const char* command;
    const char* number;  ///< in the lab's JSON
    const char* name;    ///< name of an object in the file
};

class ReadsAFile : public LabTest, public testing::WithParamInterface<Reader> {
  protected:
    ReadsAFile() : LabTest(GetParam().lab) {
        std::filesystem::copy_file(test::source_path("tests/app/golden/faulty_walk.bvh"), file_);
        run(GetParam().command, {{"path", file_.string()}});
        saved_ = save_scene(workspace)["labs"][GetParam().lab];
    }
    std::string opened() const { return opened_with("", saved_); }
    const std::filesystem::path file_ = folder_ / "walk.bvh";
    Json saved_;
};

TEST_P(ReadsAFile, AnInvalidValueIsRefusedAndABadFileLeavesTheLabBlank) {
    const Reader& of = GetParam();
    EXPECT_EQ(opened(), "");
    for (const char* pointer : {of.number, of.name}) {
        std::string place = std::string("labs.") + of.lab + pointer;
        std::ranges::replace(place, '/', '.');
        const std::string why = opened_with(pointer, pointer == of.number ? Json(-1e9) : Json("wing"));
        EXPECT_TRUE(why.starts_with(place + ": ")) << why;
        EXPECT_TRUE(test::says(why, pointer == of.number ? "-1000000000.0" : "wing"));
    }
    test::write(file_, "HIERARCHY\nROOT");
    EXPECT_TRUE(opened().starts_with("blank: walk.bvh, line 2: ")) << opened();
    std::filesystem::remove(file_);
    EXPECT_TRUE(test::says(opened(), "blank: walk.bvh is missing, at " + shown_path(file_)));
}

INSTANTIATE_TEST_SUITE_P(
    OfEachKind, ReadsAFile,
    testing::Values(Reader{"humanoid", "humanoid.load", "/ik/foot_ik/enter_speed", "/bones/Hips"},
                    Reader{"humanoid", "humanoid.motion.load", "/edits/0/scale", "/edits/0/clip"},
                    Reader{"rope", "rope.character", "/character/began", "/character/clip"}));

// Shared code for the last ten seconds: rotations as swing and twist, cached values, and which moments are
// shown as ghosts.

std::shared_ptr<const Part> some_part() {
    return std::make_shared<test::SpringPart>();
}

class Turns : public testing::Test, protected test::RandomNumbers {
  protected:
    Turns() : RandomNumbers(5) {}
};

TEST_F(Turns, AreSplitIntoSwingAndTwist) {
    for (int i = 0; i < 1000; ++i) {
        const glm::dvec3 along = direction();
        const glm::dvec3 across = glm::normalize(glm::cross(along, direction()));
        const double swing = uniform(0.0, 179.0), twist = uniform(-179.9, 179.9);
        const glm::dquat turn =
            glm::angleAxis(glm::radians(swing), across) * glm::angleAxis(glm::radians(twist), along);
        const double length = uniform(0.1, 5.0), scale = uniform(0.5, 2.0);
        const JointTurn told = joint_turn((i % 2 == 0 ? 1.0 : -1.0) * scale * turn, length * along);
        EXPECT_NEAR(told.swing, swing, 1e-6);
        EXPECT_NEAR(told.twist, twist, 1e-5);
        EXPECT_NEAR(told.angle, 2.0 * glm::degrees(std::acos(std::min(1.0, std::abs(turn.w)))), 1e-5);
    }
    const JointTurn rest = joint_turn(glm::dquat(1, 0, 0, 0), {0, 1, 0});
    EXPECT_EQ(rest.swing, 0.0);
    EXPECT_EQ(rest.twist, 0.0);
    const JointTurn opposite = joint_turn(glm::dquat(0, 1, 0, 0), {0, 1, 0});
    EXPECT_EQ(opposite.swing, 180.0);
    EXPECT_EQ(opposite.twist, 0.0);
}

TEST(PartCaches, ComputeAPartOnceAndDropForgottenMoments) {
    PartCache<int> cache;
    Rewind past;
    int made = 0;
    const auto ask = [&](const std::shared_ptr<const Part>& part) {
        return cache.of(part, [&] { return ++made; });
    };
    for (std::uint64_t tick = 0; tick < 2000; ++tick) {
        const auto part = some_part();
        past.remember(tick, 0, part);
        EXPECT_EQ(ask(part), static_cast<int>(tick) + 1);
        cache.trim(past);
        EXPECT_LE(cache.size(), 2 * past.size() + 64);
        EXPECT_TRUE(cache.has(past.moments().front().part)) << "it is still remembered";
    }
    for (const Rewind::Moment& moment : past.moments()) EXPECT_TRUE(cache.has(moment.part));
    EXPECT_EQ(made, 2000) << "none was worked out twice";
    std::weak_ptr<const Part> gone;
    {
        const auto part = some_part();
        gone = part;
        ask(part);
    }
    EXPECT_TRUE(gone.expired()) << "it keeps no part alive";
    EXPECT_EQ(ask(some_part()), 2002) << "another part, though it may lie at the same place";
}

TEST(PartCaches, DropTheOldestResultsBeyondTheirBound) {
    const std::size_t bound = 100'000;
    PartCache<std::vector<double>> cache(bound);
    std::vector<std::shared_ptr<const Part>> parts;
    for (std::size_t i = 0; i < 300; ++i) {
        parts.push_back(some_part());
        const std::size_t size = (37 * i) % 200;
        EXPECT_EQ(cache.of(parts.back(), [&] { return std::vector<double>(size, 0.5); }).size(), size);
        EXPECT_LE(cache.bytes(), bound);
        EXPECT_TRUE(cache.has(parts.back()));
    }
    EXPECT_FALSE(cache.has(parts.front()));
    EXPECT_GT(cache.size(), 50u) << "there is space for so many";
    for (std::size_t i = 0; i < 300; ++i) EXPECT_EQ(cache.has(parts[i]), i >= 300 - cache.size()) << i;
    const std::vector<double>& large = cache.of(some_part(), [] { return std::vector<double>(20'000, 1.0); });
    EXPECT_EQ(large.back(), 1.0) << "one that is too large by itself is there until the next";
    EXPECT_EQ(cache.size(), 1u);
    cache.clear();
    EXPECT_EQ(cache.bytes(), 0u);
}

TEST(PartCaches, CountTheirBytesWhenResultsAreDropped) {
    PartCache<std::vector<double>> cache;
    for (int round = 0; round < 3; ++round) {
        Rewind past;
        for (std::uint64_t tick = 0; tick < 1500; ++tick) {
            const auto part = some_part();
            past.remember(tick, 0, part);
            static_cast<void>(cache.of(part, [] { return std::vector<double>(10); }));
            cache.trim(past);
        }
        EXPECT_EQ(cache.bytes() % cache.size(), 0u) << "each is as large as any other";
        EXPECT_LT(cache.bytes() / cache.size(), 200u);
    }
}

class Ghosts : public LabTest {
  protected:
    Ghosts() : LabTest("chain") {}
    std::vector<const Rewind::Moment*> shown() const {
        return ghost_moments(workspace, {.lab = "chain",
                                         .what = "chain",
                                         .probes = {},
                                         .plot_help = "",
                                         .ghosts_help = "",
                                         .pose = nullptr});
    }
};

LABEL(slow, "Ghosts.AreHalfASecondApartHoweverFewMomentsAreKept");

TEST_F(Ghosts, AreHalfASecondApartHoweverFewMomentsAreKept) {
    for (const std::uint64_t stride : {1u, 2u, 4u, 8u, 16u}) {
        workspace.rewind.clear();
        for (std::uint64_t tick = 3 * stride; tick < 900; tick += stride)
            workspace.rewind.remember(tick, 0, some_part());
        const auto moments = shown();
        ASSERT_GE(moments.size(), 19u) << stride;
        EXPECT_LE(moments.size(), 21u) << stride;
        for (std::size_t i = 0; i < moments.size(); ++i) {
            EXPECT_LT(moments[i]->tick % 30, stride) << "as near to the half second as there is one";
            if (i > 0) {
                EXPECT_EQ(moments[i]->tick / 30, moments[i - 1]->tick / 30 + 1);
            }
        }
    }
    workspace.rewind.clear();
    EXPECT_TRUE(shown().empty());
}

TEST(Pasts, AreInTheStateOfEveryLabThatHasOne) {
    const Labs labs;
    const CommandTable table = make_command_table(labs);
    std::size_t plotted = 0;
    for (const auto& lab : labs.all()) {
        const Past* const past = lab->past();
        if (!past) continue;
        Workspace workspace = make_blank_workspace(labs);
        workspace.lab = lab->name();
        const test::TestScene scene = test::test_scenes(*lab).front();
        for (const CommandCall& call : scene.commands)
            table.run(workspace, call.name, to_json(call.arguments));
        workspace.remember_moment();
        ++workspace.moment;
        const Json none{{"plot", nullptr}, {"ghosts", Json::array()}};
        EXPECT_EQ(lab->state(workspace)["past"], none) << past->lab;
        table.run(workspace, past->ghosts().command, {{"of", "past"}});
        for (const Probe& each : past->probes) {
            table.run(workspace, past->plot().command, {{"of", each.name}});
            const Json told = lab->state(workspace)["past"];
            EXPECT_EQ(told["plot"]["of"], each.name) << past->lab;
            EXPECT_EQ(told["plot"]["name"], past->curve(workspace)->name) << past->lab;
            EXPECT_EQ(told["ghosts"], Json::array({0})) << past->lab;
            plotted += told["plot"]["values"].size() == 2u;
        }
        EXPECT_THROW(table.run(workspace, past->plot().command, {{"of", "colour"}}), Refused) << past->lab;
    }
    EXPECT_GE(plotted, 8u) << "of the moment and of the present";
}

}  // namespace
}  // namespace tendril::app
