#include "app/labs/rig/clip_json.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <tendril/rig/control.hpp>

#include "app/document/json_complete.hpp"
#include "app/labs/rig/clip.hpp"
#include "app/labs/rig/value_json.hpp"

namespace tendril::app {
namespace {

constexpr std::uint64_t max_clip_tick = 1'000'000'000'000;  ///< ticks

using Numbers = std::vector<float>;

/// One of the three of a bone over all frames, one after the other.
template <class Of>
Numbers track(const RigClip& clip, std::size_t bone, Of of) {
    Numbers numbers;
    for (std::size_t frame = 0; frame < clip.frames(); ++frame)
        of(clip.poses[frame * clip.bones.size() + bone], numbers);
    return numbers;
}
void translation_of(const ClipPose& pose, Numbers& to) {
    to.insert(to.end(), {pose.translation.x, pose.translation.y, pose.translation.z});
}
void rotation_of(const ClipPose& pose, Numbers& to) {
    to.insert(to.end(), {pose.rotation.x, pose.rotation.y, pose.rotation.z, pose.rotation.w});
}
void scale_of(const ClipPose& pose, Numbers& to) {
    to.insert(to.end(), {pose.scale.x, pose.scale.y, pose.scale.z});
}

Json track_json(const Numbers& numbers, std::size_t size) {
    bool still = true;
    for (std::size_t i = size; i < numbers.size() && still; ++i) still = numbers[i] == numbers[i - size];
    Json json = Json::array();
    for (std::size_t i = 0; i < (still ? size : numbers.size()); ++i) json.push_back(number(numbers[i]));
    return json;
}

/// `size` numbers a frame.
Numbers read_track(const JsonPlace& place, std::size_t size, std::size_t frames) {
    Numbers numbers;
    place.for_each("numbers", size * frames,
                   [&](const JsonPlace& each) { numbers.push_back(each.number()); });
    if (numbers.size() == size)
        for (std::size_t i = 0; i < size * (frames - 1); ++i) numbers.push_back(numbers[i]);
    if (numbers.size() != size * frames)
        place.fail("expected " + std::to_string(size) + " numbers, or as many a frame");
    return numbers;
}

void read_bone(const JsonPlace& place, RigClip& clip, std::size_t bone, std::size_t frames) {
    check_members(place, {"translation", "rotation", "scale"});
    const Numbers move = read_track(place["translation"], 3, frames);
    const Numbers turn = read_track(place["rotation"], 4, frames);
    const auto stored = place.optional("scale");
    const Numbers grow = stored ? read_track(*stored, 3, frames) : Numbers(3 * frames, 1.0f);
    for (std::size_t i = 0; i < frames; ++i) {
        const glm::quat rotation(turn[4 * i + 3], turn[4 * i], turn[4 * i + 1], turn[4 * i + 2]);
        if (!(std::abs(glm::length(rotation) - 1.0f) < 1e-3f))
            place["rotation"].fail("expected rotations of unit length");
        clip.poses[i * clip.bones.size() + bone] = {{move[3 * i], move[3 * i + 1], move[3 * i + 2]},
                                                    rotation,
                                                    {grow[3 * i], grow[3 * i + 1], grow[3 * i + 2]}};
    }
}

Json solve_json(const RigPart& part) {
    const ClipSolve& solve = *part.clip_left;
    Json left = Json::array(), controls = Json::object();
    for (const FrameLeft& each : solve.left)
        left.push_back({number(each.mm), number(each.degrees), each.bone, number(each.scale), each.stopped});
    if (solve.running)
        for (std::size_t i = 0; i < solve.controls.size(); ++i)
            if (const rig::Element& element = part.rig.definition().elements[i]; element.control)
                controls[element.name] = control_value_json(element.control->kind, solve.controls[i]);
    return {{"running", solve.running}, {"left", std::move(left)}, {"controls", std::move(controls)}};
}

ClipSolve read_solve(const JsonPlace& place, const RigPart& part) {
    check_members(place, {"running", "left", "controls"});
    ClipSolve solve{.running = place["running"].flag(), .left = {}, .controls = {}};
    place["left"].for_each("frames", part.clip->frames(), [&](const JsonPlace& each) {
        const bool older = each.json().is_array() && each.json().size() == 3;  // it had no more
        if (!older) each.check_size(5, "values: millimetres, degrees, bone, scale, stopped");
        FrameLeft left{each.element(0).number(0.0f, 1e9f), each.element(1).number(0.0f, 360.0f),
                       static_cast<std::uint32_t>(each.element(2).index(part.clip->bones.size() - 1))};
        if (!older) {
            left.scale = each.element(3).number(0.0f, 1e9f);
            left.stopped = each.element(4).flag();
        }
        solve.left.push_back(left);
    });
    if (!solve.running) return solve;
    try {
        check_clip_solve(part);
    } catch (const std::invalid_argument& error) {
        place.fail(error.what());
    }
    if (solve.done() == part.clip->frames()) place["running"].fail("all frames are solved");
    solve.controls = part.state.controls;
    for (std::size_t i = 0; i < solve.controls.size(); ++i) {
        const rig::Element& element = part.rig.definition().elements[i];
        if (!element.control) continue;
        const JsonPlace stored = place["controls"][element.name.c_str()];
        const rig::Value value =
            read_control_value(stored, element.control->kind, solve.controls[i], max_reached);
        check_unit(stored, value);
        solve.controls[i] = rig::clamped(*element.control, value);
    }
    return solve;
}

}  // namespace

Json clip_json(const RigPart& part) {
    const RigClip& clip = *part.clip;
    Json bones = Json::object();
    for (std::size_t i = 0; i < clip.bones.size(); ++i) {
        Json& bone = bones[clip.bones[i]] = {{"translation", track_json(track(clip, i, translation_of), 3)},
                                             {"rotation", track_json(track(clip, i, rotation_of), 4)}};
        const Numbers scale = track(clip, i, scale_of);
        if (std::ranges::any_of(scale, [](float each) { return each != 1.0f; }))
            bone["scale"] = track_json(scale, 3);
    }
    Json json{{"began", clip.began}, {"frames", clip.frames()}, {"bones", std::move(bones)}};
    if (part.clip_left) json["solve"] = solve_json(part);
    return json;
}

void load_clip(const JsonPlace& place, RigPart& part) {
    check_members(place, {"began", "frames", "bones", "solve"});
    RigClip clip{.bones = {}, .poses = {}, .began = place["began"].count(max_clip_tick)};
    const std::size_t frames = place["frames"].index(max_clip_frames + 1);
    const JsonPlace bones = place["bones"];
    if (!bones.json().is_object() || bones.json().empty()) bones.fail("expected an object of bones");
    if (frames == 0) place["frames"].fail("expected a frame or more");
    for (const auto& [name, stored] : bones.json().items()) clip.bones.push_back(name);
    if (frames * clip.bones.size() > max_clip_poses)
        place.fail("the clip has more poses than the most, " + std::to_string(max_clip_poses));
    clip.poses.resize(frames * clip.bones.size());
    for (std::size_t i = 0; i < clip.bones.size(); ++i)
        read_bone(bones[clip.bones[i].c_str()], clip, i, frames);
    part.clip = std::make_shared<const RigClip>(std::move(clip));
    if (const auto solve = place.optional("solve"))
        part.clip_left = std::make_shared<const ClipSolve>(read_solve(*solve, part));
}

}  // namespace tendril::app
