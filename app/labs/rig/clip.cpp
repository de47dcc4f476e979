#include "app/labs/rig/clip.hpp"

#include <algorithm>
#include <cmath>
#include <glm/trigonometric.hpp>
#include <stdexcept>
#include <tendril/rig/backward.hpp>

#include "app/document/units.hpp"
#include "app/labs/rig/rig_edit.hpp"
#include "app/labs/rig/take.hpp"

namespace tendril::app {
namespace {

// Steps of some 30 ns, as Rig::work counts them.
constexpr std::uint64_t max_record_work = 40'000'000, max_frame_work = 20'000'000,
                        clip_work_per_tick = 300'000;
constexpr std::size_t max_frames_per_tick = 16;
constexpr double farthest = 1e9;

/// A bone of the rig, in the order of a clip.
struct ClipBone {
    std::size_t element = 0;
    rig::ElementId id, parent;  ///< the nearest bone above
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

ClipPose narrowed(const rig::Transform& pose) {
    return {glm::vec3(pose.translation), glm::quat(pose.rotation), glm::vec3(pose.scale)};
}
rig::Transform widened(const ClipPose& pose) {
    return {glm::dvec3(pose.translation), rig::normalised(glm::dquat(pose.rotation)), glm::dvec3(pose.scale)};
}

void append_frame(std::vector<ClipPose>& poses, const std::vector<ClipBone>& bones, rig::Hierarchy& tree) {
    for (const ClipBone& bone : bones) {
        const rig::Transform global = tree.get(bone.id, rig::Space::Global);
        const rig::Transform within =
            bone.parent ? rig::relative(tree.get(bone.parent, rig::Space::Global), global) : global;
        for (int axis = 0; axis < 3; ++axis)
            if (!(std::abs(within.translation[axis]) <= farthest && std::abs(within.scale[axis]) <= farthest))
                throw std::invalid_argument(
                    "a bone goes farther than 1e9 m, or grows larger: no clip holds it");
        poses.push_back(narrowed(within));
    }
}

/// Parents come first, so that each goes where its clip has it.
void pose_bones(const ClipPose* frame, const std::vector<ClipBone>& bones, rig::Hierarchy& tree) {
    for (std::size_t i = 0; i < bones.size(); ++i) {
        const rig::Transform within = widened(frame[i]);
        tree.put(
            bones[i].id, rig::Space::Global,
            bones[i].parent ? rig::compose(tree.get(bones[i].parent, rig::Space::Global), within) : within);
    }
}

std::uint64_t numbers_in_controls(const rig::Definition& definition) {
    std::uint64_t count = 0;
    for (const rig::Element& element : definition.elements) {
        if (!element.control) continue;
        switch (element.control->kind) {
            case rig::ControlKind::Transform:
                count += 9;
                break;
            case rig::ControlKind::Position:
            case rig::ControlKind::Rotation:
                count += 3;
                break;
            default:
                count += 2;
        }
    }
    return count;
}

/// Of a frame: a few descents of some steps, each with a forward solve a number.
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
        left.mm = static_cast<float>(std::min(1000.0 * most.metres, farthest));
        left.degrees = static_cast<float>(glm::degrees(most.radians));
        left.scale = static_cast<float>(std::min(most.scale, farthest));
        left.bone = static_cast<std::uint32_t>(i);
    }
    return left;
}

}  // namespace

RigClip record_clip(const RigPart& part, std::size_t frames, rig::Workspace& scratch) {
    TakeRunner take(part, scratch);
    const std::vector<ClipBone> bones = clip_bones(part.rig, take.state().elements);
    if (bones.empty()) throw std::invalid_argument("the rig has no bones to record");
    if (frames > max_clip_frames || (frames + 1) * bones.size() > max_clip_poses)
        throw std::invalid_argument("a clip of " + std::to_string(frames) + " frames of " +
                                    std::to_string(bones.size()) + " bones is larger than the most, " +
                                    std::to_string(max_clip_frames) + " frames and " +
                                    std::to_string(max_clip_poses) + " poses");
    if (frames * part.rig.work() > max_record_work)
        throw std::invalid_argument("a clip of " + std::to_string(frames) +
                                    " frames of so large a rig would take too long to record");
    RigClip clip{.bones = {}, .poses = {}, .began = part.take.began};
    for (const ClipBone& bone : bones)
        clip.bones.push_back(part.rig.definition().elements[bone.element].name);
    clip.poses.reserve((frames + 1) * bones.size());
    append_frame(clip.poses, bones, take.state().elements);
    for (std::size_t i = 0; i < frames; ++i) {
        take.tick();
        append_frame(clip.poses, bones, take.state().elements);
    }
    return clip;
}

void check_clip_solve(const RigPart& part) {
    if (!part.clip) throw std::invalid_argument("there is no clip; rig.clip.record makes one");
    std::vector<std::string> bones;
    for (const ClipBone& bone : clip_bones(part.rig, part.state.elements))
        bones.push_back(part.rig.definition().elements[bone.element].name);
    if (bones != part.clip->bones)
        throw std::invalid_argument("the clip is of other bones than the rig has now; record it anew");
    if (frame_work(part) > max_frame_work)
        throw std::invalid_argument("the rig is so large that a frame of the clip would take too long");
}

void start_clip_solve(RigPart& part) {
    check_clip_solve(part);
    part.clip_left = std::make_shared<const ClipSolve>(
        ClipSolve{.running = true, .left = {}, .controls = part.state.controls});
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
    std::string text = fixed_text(mm, 1) + " mm, " + fixed_text(degrees, 1) + "\u00b0";
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

}  // namespace tendril::app
