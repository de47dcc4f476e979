// The Humanoid lab's part of the document: a character, its bone map, the playback of its clip, and how it is
// displayed. The displayed pose is a function of the part; see shown_pose.hpp.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <memory>
#include <optional>
#include <string>
#include <tendril/humanoid/skeleton.hpp>
#include <tendril/rig/transform.hpp>
#include <vector>

#include "app/document/followed.hpp"
#include "app/document/workspace.hpp"
#include "app/fields/fields.hpp"
#include "app/io/names.hpp"
#include "app/labs/humanoid/attachments/attachments.hpp"
#include "app/labs/humanoid/character/loaded_character.hpp"
#include "app/labs/humanoid/curves/curves.hpp"
#include "app/labs/humanoid/ik/ik_settings.hpp"
#include "app/labs/humanoid/springs/springs.hpp"
#include "app/labs/kit/flips.hpp"
#include "app/labs/kit/selection.hpp"

namespace tendril::app {

// Playback of a clip: its current moment, and how that advances.
//
// A looping clip continues where the previous round ended: each round moves the hips on the ground and turns
// them about the vertical by the difference between the clip's first and last moment. Played in place, the
// hips stay above their starting point. A clip recorded in place can be made to travel.

inline constexpr double fastest_clip = 10.0, longest_playback = 1e6;  ///< seconds
inline constexpr std::int64_t max_rounds = 1'000'000;

struct HumanoidPart;

struct Playback {
    std::optional<std::size_t> clip;  ///< in the character's list; none: the rest pose
    bool playing = false;
    double time = 0.0;        ///< seconds into the clip
    std::int64_t rounds = 0;  ///< completed rounds
    double speed = 1.0;       ///< 0 to fastest_clip
    bool loop = true;
    bool in_place = false;
    bool travel = false;         ///< moves a clip that walks in place by `pace`
    bool targets_travel = true;  ///< targets move along with a clip that travels
    glm::dvec3 pace{0.0};        ///< m/s, by measure_pace(); 0 without `travel`
    bool operator==(const Playback&) const = default;
};

/// True if a tick changes anything.
bool goes_on(const Playback& playback, const LoadedCharacter& character);
/// Advances by `seconds`; a clip that does not loop stops at its end.
void advance(Playback& playback, const LoadedCharacter& character, double seconds);
/// Goes to `seconds` after the start of the first round. Beyond the clip's duration, a looping clip is in a
/// later round; any other is at its end.
void go_to(Playback& playback, const LoadedCharacter& character, double seconds);

/// The clip's local pose at that moment, before anything modifies it. `hips`: the node whose motion carries
/// over from round to round; without it each round restarts at the same place. `unfixed`: the clip as read.
std::vector<rig::Transform> animated_pose(const Playback& playback, const LoadedCharacter& character,
                                          std::optional<std::size_t> hips, bool unfixed = false);

/// The speed that fixes the standing feet of a walk in place, m/s; 0 for a clip that travels or stands.
glm::dvec3 pace_of(const HumanoidPart& part, std::size_t clip);
/// Call after a change of clip, bone map or Playback::travel.
void measure_pace(HumanoidPart& part);

/// Moves the targets with the clip since `before`: at the round's average velocity, turning with it, so that
/// the clip meets them in the same way in every round.
void carry_targets(HumanoidPart& part, const Playback& before);

/// True if the strip shows Motion lint's marks on the clip.
bool shows_lint_marks(const Workspace& workspace);

/// The hips' ground velocity that playing in place removes at that moment, m/s at the recorded speed; with
/// `travel`, plus the pace.
glm::dvec3 missing_velocity(const Playback& playback, const LoadedCharacter& character,
                            std::optional<std::size_t> hips);

/// Clips of other files, played on this character (humanoid::retarget). The result is a clip like its own.
struct PlayedMotion {
    SharedCharacter loaded;  ///< the part's character, with the new clip last
    std::string text;        ///< for the user: the clip's name, and which parts were not retargeted
};

/// Retargets the clip of that name (empty: the first one) of another character, with its fixes. Throws
/// std::runtime_error that begins with the name of its file.
PlayedMotion with_motion(const HumanoidPart& part, const HumanoidPart& source, const std::string& clip);
/// Chooses the last clip, and plays it.
void play_last_clip(HumanoidPart& part);

/// The motion that made this clip; null for a clip of the character's own.
const LoadedMotion* motion_of(const LoadedCharacter& character, std::size_t clip);

inline constexpr const char* humanoid_lab = "humanoid";
/// Metres per unit of a file.
inline constexpr double min_unit = 1e-6, max_unit = 1e6;

/// How the skin is drawn: not at all, opaque, or so that bones show through.
enum class SkinLook : std::uint8_t { None, Solid, Transparent };

inline constexpr EnumNames<SkinLook, 3> skin_looks{
    "skin", {{"none", "none"}, {"solid", "solid"}, {"transparent", "transparent"}}};

/// How the skin follows the joints: linear blending, optionally with the twist of the arms spread.
enum class Skinning : std::uint8_t { Linear, TwistSpread };

inline constexpr EnumNames<Skinning, 2> skinnings{"skinning",
                                                  {{"linear", "linear"}, {"twist_spread", "twist spread"}}};

/// Which joints show their limits. Joints stopped by their limits always show them, except with None.
enum class LimitsShown : std::uint8_t { None, Selected, All };

inline constexpr EnumNames<LimitsShown, 3> limits_shown{
    "limits", {{"none", "no joint"}, {"selected", "selected joints"}, {"all", "all joints"}}};

/// The object of Motion lint: the clip as read, or the result that is shown and exported.
enum class JudgedClip : std::uint8_t { Clip, Result };

inline constexpr EnumNames<JudgedClip, 2> judged_clips{"judged",
                                                       {{"clip", "the clip"}, {"result", "the result"}}};

struct HumanoidView {
    SkinLook skin = SkinLook::Transparent;
    Skinning skinning = Skinning::TwistSpread;
    bool ghost = true;   ///< draws the pose before any modification
    bool follow = true;  ///< the camera follows a character that walks
    LimitsShown limits = LimitsShown::Selected;
    JudgedClip judged = JudgedClip::Clip;
    bool operator==(const HumanoidView&) const = default;
};

struct HumanoidPart final : Part, Followed {
    HumanoidPart();  ///< the stick figure
    explicit HumanoidPart(SharedCharacter loaded);

    SharedCharacter loaded;                        ///< never null
    std::shared_ptr<const humanoid::BoneMap> map;  ///< as matched, or as corrected by the user
    Playback playback;
    bool t_pose = false;  ///< the rest pose is shown as a T
    IkSettings ik;
    std::vector<SpringSetting> springs;
    std::vector<BoneCurve> curves;
    IkState ik_state;
    Attachments attachments;
    int quiet_ticks = 0;  ///< ticks since the last edit or movement; at some number of them the lab rests
    Selection selection;  ///< of nodes
    HumanoidView view;
    FlipRule flips;

    const humanoid::Skeleton& skeleton() const { return loaded->skeleton(); }
    /// Null if no clip is chosen.
    const humanoid::Clip* clip() const { return playback.clip ? &loaded->clips()[*playback.clip] : nullptr; }
    bool shows_fixes() const { return clip() != nullptr && loaded->unfixed.contains(clip()->name); }
    std::optional<std::size_t> node_of(humanoid::Bone bone) const;
    std::optional<humanoid::Bone> bone_of(std::size_t node) const;
    /// A node's name for the user: its bone's name or, without a bone, its own.
    std::string called(std::size_t node) const;
    std::string titled(std::size_t node) const;  ///< "LeftLeg (LeftLowerLeg)"
    std::vector<std::string> unmapped() const;   ///< names of bones

    std::shared_ptr<Part> clone() const override { return std::make_shared<HumanoidPart>(*this); }
    Json save() const override;
    std::shared_ptr<Part> load(const Json& json, const std::string& where) const override;
    std::shared_ptr<const Part> at_moment(std::shared_ptr<const Part> then) const override;
    /// The point below the hips, or below the first node.
    glm::vec3 stands_at(const Workspace& workspace) const override;
    std::size_t bytes() const override;
    std::size_t shared_bytes(const Part& other) const override;
    std::vector<std::filesystem::path> files() const override;
    bool operator==(const HumanoidPart& other) const;
};

/// The bones that `map` assigns to other nodes than the character's own map.
Corrections corrections_of(const humanoid::BoneMap& map, const LoadedCharacter& character);
/// Maps the bones as matched, with these corrections. Throws std::invalid_argument if they no longer form a
/// body's hierarchy, unless the file's own map does not either.
void correct(HumanoidPart& part, const Corrections& corrections);
Reading reading_of(const HumanoidPart& part);

/// The IK settings and state to be saved.
Json ik_json(const HumanoidPart& part);
/// Throws std::runtime_error that begins with the JSON path.
void read_ik(const class JsonPlace& place, HumanoidPart& part);

Json attachments_json(const Attachments& attachments);
/// Throws as read_ik() does.
Attachments read_attachments(const class JsonPlace& place, const humanoid::Skeleton& skeleton);

/// The lab's part of a workspace.
inline const HumanoidPart& humanoid_part(const Workspace& workspace) {
    return workspace.document.get<HumanoidPart>(humanoid_lab);
}

}  // namespace tendril::app

template <>
std::span<const tendril::Field> tendril::fields<tendril::app::FileSpace>() noexcept;
template <>
std::span<const tendril::app::FieldText> tendril::app::field_texts<tendril::app::FileSpace>();
template <>
std::span<const tendril::Field> tendril::fields<tendril::app::HumanoidView>() noexcept;
template <>
std::span<const tendril::app::FieldText> tendril::app::field_texts<tendril::app::HumanoidView>();

namespace tendril::app {

/// Names of the bones whose index satisfies `is`.
std::vector<std::string> bone_names(auto is) {
    std::vector<std::string> names;
    for (std::size_t i = 0; i < humanoid::bone_count; ++i)
        if (is(i)) names.emplace_back(humanoid::name(static_cast<humanoid::Bone>(i)));
    return names;
}

// Selected nodes. Files and commands store names, because another skeleton may have the same ones.

/// The selected names, in skeleton order.
std::vector<std::string> names_of(const Selection& selection, const humanoid::Skeleton& skeleton);
/// ". Left out: cape, rifle", for the message of an export of bones alone; empty if nothing is left out.
std::string left_out_text(const HumanoidPart& part, bool held);
/// The active node's name; empty if nothing is selected.
std::string active_name(const Selection& selection, const humanoid::Skeleton& skeleton);

/// Selects the nodes with the same names; drops the others.
Selection selection_in(const humanoid::Skeleton& skeleton, const Selection& selection,
                       const humanoid::Skeleton& before);

/// A name, empty if nothing is selected, or {"active", "all"}.
Json save_selection(const Selection& selection, const humanoid::Skeleton& skeleton);
/// Drops nodes that the skeleton does not have. Throws std::runtime_error that begins with the JSON path.
Selection load_selection(const JsonPlace& place, const humanoid::Skeleton& skeleton);

}  // namespace tendril::app

template <>
std::span<const tendril::Field> tendril::fields<tendril::app::Playback>() noexcept;
template <>
std::span<const tendril::app::FieldText> tendril::app::field_texts<tendril::app::Playback>();
