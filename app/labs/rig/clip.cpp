#include "app/labs/rig/clip.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <stdexcept>
#include <tendril/rig/backward.hpp>
#include <tendril/signal/run.hpp>

#include "app/io/text.hpp"
#include "app/labs/rig/rig_edit.hpp"
#include "app/labs/rig/rig_runtime.hpp"
#include "app/labs/rig/take.hpp"

namespace tendril::app {
namespace {

// Limits in Rig::work's steps, of about 30 ns each.
constexpr std::uint64_t max_record_work = 40'000'000, max_frame_work = 20'000'000,
                        clip_work_per_tick = 300'000;
constexpr std::size_t max_frames_per_tick = 16;
constexpr double max_stored = 1e9;

/// A bone of the rig, in clip order.
struct ClipBone {
    std::size_t element = 0;
    rig::ElementId id, parent;  ///< `parent` is the nearest bone above
};

std::vector<ClipBone> clip_bones(const rig::Rig& rig, const rig::Hierarchy& tree) {
    std::vector<ClipBone> bones;
    for (const std::size_t i : from_the_roots(rig, tree)) {
        if (rig.definition().elements[i].kind != rig::ElementKind::Bone) continue;
        rig::ElementId above = tree.parent(rig.id(i));
        while (above && tree.kind(above) != rig::ElementKind::Bone) above = tree.parent(above);
        bones.push_back({i, rig.id(i), above});
    }
    return bones;
}

/// The bones of the clip, which must be the rig's.
std::vector<ClipBone> recorded_bones(const RigPart& part) {
    if (!part.clip) throw std::invalid_argument("there is no clip; rig.clip.record makes one");
    std::vector<ClipBone> bones = clip_bones(part.rig, part.state->elements);
    if (!std::ranges::equal(bones, part.clip->bones, {}, [&](const ClipBone& bone) {
            return part.rig.definition().elements[bone.element].name;
        }))
        throw std::invalid_argument(
            "the rig's bones have changed since the clip was recorded; record it again");
    return bones;
}

rig::Transform widened(const ClipPose& pose) {
    return {glm::dvec3(pose.translation), rig::normalised(glm::dquat(pose.rotation)), glm::dvec3(pose.scale)};
}

/// Clamps the poses to the limits. Returns the first bone beyond them; null if there is none.
const ClipBone* append_frame(std::vector<ClipPose>& poses, const std::vector<ClipBone>& bones,
                             rig::Hierarchy tree) {
    const ClipBone* over = nullptr;
    for (const ClipBone& bone : bones) {
        const rig::Transform global = tree.get(bone.id, rig::Space::Global);
        rig::Transform within =
            bone.parent ? rig::relative(tree.get(bone.parent, rig::Space::Global), global) : global;
        for (glm::dvec3* const each : {&within.translation, &within.scale}) {
            const glm::dvec3 was = std::exchange(*each, glm::clamp(*each, -max_stored, max_stored));
            if (over == nullptr && *each != was) over = &bone;
        }
        poses.push_back({glm::vec3(within.translation), glm::quat(within.rotation), glm::vec3(within.scale)});
    }
    return over;
}

/// Poses the bones; parents come first, so each bone's parent is already posed.
void pose_bones(const ClipPose* frame, const std::vector<ClipBone>& bones, rig::Hierarchy& tree) {
    for (std::size_t i = 0; i < bones.size(); ++i) {
        const rig::Transform within = widened(frame[i]);
        tree.put(
            bones[i].id, rig::Space::Global,
            bones[i].parent ? rig::compose(tree.get(bones[i].parent, rig::Space::Global), within) : within);
    }
}

std::uint64_t numbers_in_controls(const rig::Definition& definition) {
    constexpr std::uint64_t numbers[] = {9, 3, 3, 2, 2, 2};
    std::uint64_t count = 0;
    for (const rig::Element& element : definition.elements)
        if (element.control) count += numbers[static_cast<std::size_t>(element.control->kind)];
    return count;
}

/// The work of one frame: a few descents of a few steps, each with one forward solve per number.
std::uint64_t frame_work(const RigPart& part) {
    const std::uint64_t numbers = numbers_in_controls(part.rig.definition()) + 1;
    return numbers * (8 * part.rig.work() + numbers * part.clip->bones.size() / 8);
}

FrameLeft left_of(const rig::BackwardReport& report, const std::vector<ClipBone>& bones) {
    FrameLeft left;
    left.stopped = report.stopped;
    for (std::size_t i = 0; i < bones.size(); ++i) {
        if (report.worst != bones[i].element) continue;
        const rig::Residual& most = report.elements[bones[i].element];
        left.mm = static_cast<float>(std::min(1000.0 * most.metres, max_stored));
        left.degrees = static_cast<float>(glm::degrees(most.radians));
        left.scale = static_cast<float>(std::min(most.scale, max_stored));
        left.bone = static_cast<std::uint32_t>(i);
    }
    return left;
}

}  // namespace

std::string seconds_text(std::size_t ticks) {
    return fixed_text(static_cast<double>(ticks) * tick_seconds, 1) + " s";
}

std::size_t clip_room(const RigPart& part) {
    const std::size_t bones = clip_bones(part.rig, part.state->elements).size();
    const std::size_t solves =
        std::max<std::size_t>(max_record_work / std::max<std::uint64_t>(part.rig.work(), 1), 1);
    return bones == 0 ? 0 : std::min({max_clip_frames, max_clip_poses / bones - 1, solves});
}

void check_records(const RigPart& part) {
    if (clip_room(part) == 0) throw std::invalid_argument("the rig has no bones to record");
}

std::string keep_clip(RigPart& part, RigPart played, std::size_t ticks, RigRuntime& runtime) {
    check_records(played);
    const std::vector<ClipBone> bones = clip_bones(played.rig, played.state->elements);
    const std::size_t frames = std::min(ticks, clip_room(played));
    std::string lacks;
    if (frames < ticks)
        lacks = "it holds only the last " + seconds_text(frames) + " of " + seconds_text(ticks);
    go_to(played, static_cast<std::uint32_t>(ticks - frames), runtime);
    RigClip clip{.bones = {}, .poses = {}, .began = played.take.now()};
    for (const ClipBone& bone : bones)
        clip.bones.push_back(played.rig.definition().elements[bone.element].name);
    clip.poses.reserve((frames + 1) * bones.size());
    bool over = false;
    for (std::size_t i = 0; i <= frames; ++i) {
        if (i > 0) go_to(played, played.take.tick + 1, runtime);
        const ClipBone* const far = append_frame(clip.poses, bones, played.state->elements);
        if (far == nullptr || std::exchange(over, true)) continue;
        if (!lacks.empty()) lacks += "; ";
        lacks += "from " + seconds_text(i) + " on, " +
                 clip.bones[static_cast<std::size_t>(far - bones.data())] +
                 " is held within 1e9 m and 1e9 times its size";
    }
    part.clip = std::make_shared<const RigClip>(std::move(clip));
    part.clip_left.reset();
    part.take.recording = false;
    return lacks;
}

Character clip_character(const RigPart& part) {
    const std::vector<ClipBone> bones = recorded_bones(part);
    rig::Hierarchy tree = part.state->elements;
    const auto rest = [&](rig::ElementId id) { return tree.get(id, rig::Space::Global, rig::Pose::Initial); };
    std::vector<humanoid::Node> nodes;
    humanoid::Clip clip{.name = "take", .rate = 1.0 / tick_seconds};
    for (std::size_t i = 0; i < bones.size(); ++i) {
        const auto parent = std::ranges::find(bones, bones[i].parent, &ClipBone::id) - bones.begin();
        const bool is_root = !bones[i].parent;
        nodes.push_back(
            {.name = part.clip->bones[i],
             .parent = is_root ? -1 : static_cast<std::int32_t>(parent),
             .rest = is_root ? rest(bones[i].id) : rig::relative(rest(bones[i].parent), rest(bones[i].id))});
        humanoid::Channel& channel = clip.channels.emplace_back(humanoid::Channel{.node = i});
        for (std::size_t frame = 0; frame < part.clip->frames(); ++frame) {
            const rig::Transform pose = widened(part.clip->poses[frame * bones.size() + i]);
            channel.translation.times.push_back(static_cast<double>(frame) * tick_seconds);
            channel.translation.values.push_back(pose.translation);
            channel.rotation.values.push_back(pose.rotation);
            channel.scale.values.push_back(pose.scale);
        }
        channel.rotation.times = channel.scale.times = channel.translation.times;
        clip.duration = channel.translation.times.back();
    }
    Character character{.skeleton = skeleton_of(std::move(nodes))};
    character.clips.push_back(std::move(clip));
    return character;
}

std::string sheared_text(const Character& character) {
    const humanoid::Skeleton& skeleton = character.skeleton;
    const humanoid::Clip& clip = character.clips.front();
    std::vector<rig::Transform> pose(skeleton.size()), composed(skeleton.size());
    std::vector<humanoid::Placement> placed(skeleton.size());
    constexpr double enough = 1e-4;  // metres, above the rounding of stored poses
    double most = enough;
    std::string text;
    for (const double time : clip.channels.front().translation.times) {
        sample(clip, skeleton, time, pose);
        place(skeleton, pose, placed);
        for (std::size_t i = 0; i < skeleton.size(); ++i) {
            const std::int32_t parent = skeleton[i].parent;  // before i
            composed[i] =
                parent < 0 ? pose[i] : rig::compose(composed[static_cast<std::size_t>(parent)], pose[i]);
            const double off = glm::distance(composed[i].translation, placed[i].position);
            if (!(off > most)) continue;
            most = off;
            text = "; bones scaled unequally: " + skeleton[i].name + " is " + length_text(off) + " off";
        }
    }
    return text;
}

void check_clip_solve(const RigPart& part) {
    recorded_bones(part);
    if (frame_work(part) > max_frame_work)
        throw std::invalid_argument("the rig is so large that a frame of the clip would take too long");
}

void start_clip_solve(RigPart& part) {
    check_clip_solve(part);
    part.clip_left = std::make_shared<const ClipSolve>(
        ClipSolve{.running = true, .left = {}, .controls = part.state->controls});
}

void continue_clip_solve(RigPart& part, rig::Workspace& scratch) {
    if (!part.clip || !part.clip_left || !part.clip_left->running) return;
    ClipSolve solve = *part.clip_left;
    rig::State state = part.state;
    state.controls = solve.controls;
    const std::vector<ClipBone> bones = clip_bones(part.rig, state.elements);
    const std::size_t frames =
        std::clamp<std::size_t>(clip_work_per_tick / frame_work(part), 1, max_frames_per_tick);
    for (std::size_t i = 0; i < frames && solve.done() < part.clip->frames(); ++i) {
        pose_bones(&part.clip->poses[solve.done() * bones.size()], bones, state.elements);
        solve.left.push_back(
            left_of(rig::solve_backward(part.rig, state, scratch, {.max_work = max_frame_work}), bones));
    }
    solve.controls = std::move(state.controls);
    solve.running = solve.done() < part.clip->frames();
    part.clip_left = std::make_shared<const ClipSolve>(std::move(solve));
}

double amount(const FrameLeft& left) {
    return amount(rig::Residual{1e-3 * static_cast<double>(left.mm),
                                glm::radians(static_cast<double>(left.degrees)),
                                static_cast<double>(left.scale)});
}

std::string left_text(double mm, double degrees, double scale) {
    std::string text = length_text(1e-3 * mm) + ", " + fixed_text(degrees, 1) + "\u00b0";
    if (scale >= min_shown_scale) text += ", scale " + fixed_text(scale, 3);
    return text;
}

std::vector<LeftRun> left_runs(const ClipSolve& solve) {
    std::vector<LeftRun> runs;
    for (std::size_t i = 0; i < solve.left.size(); ++i) {
        if (solve.left[i].expressed()) continue;
        if (runs.empty() || runs.back().last + 1 != i) runs.push_back({i, i, i});
        LeftRun& run = runs.back();
        run.last = i;
        if (amount(solve.left[i]) > amount(solve.left[run.worst])) run.worst = i;
    }
    return runs;
}

std::optional<std::size_t> worst_frame(const ClipSolve& solve) {
    if (solve.left.empty()) return std::nullopt;
    const auto worst =
        std::ranges::max_element(solve.left, {}, [](const FrameLeft& each) { return amount(each); });
    return static_cast<std::size_t>(worst - solve.left.begin());
}

namespace {

constexpr std::uint64_t max_work = 20'000'000, rates_work_per_tick = 300'000;  ///< in steps of about 30 ns
constexpr double rounding = 1e-9;

/// The take at one frame rate. Stops at the end of each frame of the slowest rate.
class RateTake {
  public:
    RateTake(const RigPart& part, rig::Workspace& scratch, const std::vector<double>& ends)
        : runner_(part, scratch), ends_(ends) {}
    void run_to(double end) {
        for (; next_ < ends_.size() && ends_[next_] <= end + rounding; ++next_) {
            runner_.frame(ends_[next_] - now_, ends_[next_] / tick_seconds);
            now_ = ends_[next_];
        }
    }
    rig::State& state() { return runner_.state(); }

  private:
    TakeRunner runner_;
    const std::vector<double>& ends_;
    std::size_t next_ = 0;
    double now_ = 0.0;
};

std::string name_of(const signal::FrameRate& rate) {
    return std::to_string(std::lround(rate.hz)) + (rate.jittered ? " Hz uneven" : " Hz");
}

/// Updates `most` and `farthest`. Returns whether a bone is farther apart than ever before.
bool compare(const rig::Rig& rig, rig::State& a, rig::State& b, double seconds, RateDifference& most,
             double& farthest) {
    bool farther = false;
    const std::vector<rig::Residual> apart = rig::residuals(rig, a, b);
    for (std::size_t i = 0; i < apart.size(); ++i) {
        const rig::Element& element = rig.definition().elements[i];
        if (element.kind != rig::ElementKind::Bone) continue;
        most.mm = std::max(most.mm, 1000.0 * apart[i].metres);
        most.degrees = std::max(most.degrees, glm::degrees(apart[i].radians));
        most.scale = std::max(most.scale, apart[i].scale);
        if (const double all = amount(apart[i]); most.bone.empty() || all > farthest) {
            farthest = all;
            most.bone = element.name;
            most.seconds = seconds;
            farther = true;
        }
    }
    return farther;
}

signal::RateComparison runs_over(std::uint32_t ticks) {
    const std::vector<signal::Sample> samples(ticks, {tick_seconds, 0.0});
    return signal::compare_rates({}, samples);
}

std::uint64_t solves_of(const signal::RateComparison& rates) {
    std::uint64_t solves = 0;
    for (const signal::RateRun& run : rates.runs) solves += run.time.size();
    return solves;
}

}  // namespace

void start_rates(RigPart& part, std::uint32_t ticks) {
    const signal::RateComparison rates = runs_over(ticks);
    if (solves_of(rates) * part.rig.work() > max_work)
        throw std::invalid_argument("the rig is so large that this would take too long");
    RateDifference begun;
    begun.ticks = static_cast<double>(ticks);
    begun.frames = rates.runs.empty() ? 0 : rates.runs.front().time.size();
    begun.running = begun.frames > 0;
    part.rates = begun;
}

float rates_done(const RateDifference& rates) {
    return rates.frames == 0 ? 1.0f : static_cast<float>(rates.done) / static_cast<float>(rates.frames);
}

/// Works on a copy of the part: any change to the take that matters ends the comparison.
struct RatesWork::Takes {
    explicit Takes(const RigPart& now)
        : part(now), scratch(part.rig), rates(runs_over(static_cast<std::uint32_t>(now.rates->ticks))) {
        takes.reserve(rates.runs.size());
        for (const signal::RateRun& run : rates.runs) takes.emplace_back(part, scratch, run.time);
    }

    bool of(const RigPart& now) const {
        return &part.rig.definition() == &now.rig.definition() && part.take.began == now.take.began &&
               part.take.keys == now.take.keys && part.walks == now.walks && starts_as(now) &&
               part.rates->ticks == now.rates->ticks && done == now.rates->done;
    }
    /// A take without a start begins with the current state: no tick has passed yet.
    bool starts_as(const RigPart& now) const {
        if (part.take.start) return part.take.start == now.take.start;
        return part.state == (now.take.start ? *now.take.start : *now.state);
    }

    /// Advances by one frame of the slowest rate.
    void frame() {
        const double end = rates.runs.front().time[done++];
        for (RateTake& take : takes) take.run_to(end);
        for (std::size_t a = 0; a < takes.size(); ++a)
            for (std::size_t b = a + 1; b < takes.size(); ++b)
                if (compare(part.rig, takes[a].state(), takes[b].state(), end, most, farthest))
                    most.between = name_of(rates.runs[a].rate) + " and " + name_of(rates.runs[b].rate);
    }

    const RigPart part;
    rig::Workspace scratch;
    signal::RateComparison rates;
    std::vector<RateTake> takes;
    RateDifference most;
    double farthest = 0.0;  ///< as amount() measures it
    std::size_t done = 0;
};

RatesWork::RatesWork() = default;
RatesWork::~RatesWork() = default;

void RatesWork::advance(RigPart& part) {
    if (!part.rates || !part.rates->running) return;
    if (!takes_ || !takes_->of(part)) {
        takes_ = std::make_unique<Takes>(part);
        while (takes_->done < part.rates->done) takes_->frame();
    }
    const std::size_t frames = part.rates->frames;
    const std::uint64_t each = std::max<std::uint64_t>(solves_of(takes_->rates) / frames, 1);
    const std::uint64_t work = each * std::max<std::uint64_t>(part.rig.work(), 1);
    for (std::uint64_t spent = 0; spent < rates_work_per_tick && takes_->done < frames; spent += work)
        takes_->frame();
    const RateDifference& most = takes_->most;
    RateDifference now = most;
    now.ticks = part.rates->ticks;
    now.frames = frames;
    now.done = takes_->done;
    now.running = now.done < frames;
    part.rates = now;
    if (!now.running) takes_.reset();
}

}  // namespace tendril::app
