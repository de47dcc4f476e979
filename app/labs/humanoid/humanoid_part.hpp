// The Humanoid lab's share of the document: a character, which of its nodes are which bones, and what is
// shown of it. What is drawn follows from it alone (shown_pose.hpp).
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <tendril/humanoid/skeleton.hpp>
#include <vector>

#include "app/document/document.hpp"
#include "app/document/names.hpp"
#include "app/document/workspace.hpp"
#include "app/fields/fields.hpp"
#include "app/labs/humanoid/attachments/attachments.hpp"
#include "app/labs/humanoid/clip/playback.hpp"
#include "app/labs/humanoid/ik/ik_settings.hpp"
#include "app/labs/humanoid/springs/springs.hpp"
#include "app/labs/kit/flips.hpp"
#include "app/labs/kit/selection.hpp"

namespace tendril::app {

inline constexpr const char* humanoid_lab = "humanoid";
/// Metres of a unit of a file.
inline constexpr double min_unit = 1e-6, max_unit = 1e6;

/// What a character wears: not drawn, drawn as it is, or so that its bones show through.
enum class SkinLook : std::uint8_t { None, Solid, Transparent };

inline constexpr EnumNames<SkinLook, 3> skin_looks{
    "skin", {{"none", "none"}, {"solid", "solid"}, {"transparent", "transparent"}}};

/// How a skin follows its joints: by linear blending, or with the twist of the arms spread along their bones.
enum class Skinning : std::uint8_t { Linear, TwistSpread };

inline constexpr EnumNames<Skinning, 2> skinnings{"skinning",
                                                  {{"linear", "linear"}, {"twist_spread", "twist spread"}}};

/// Of which joints the limits are drawn. Those that hold the body back now are drawn with either of the last.
enum class LimitsShown : std::uint8_t { None, Selected, All };

inline constexpr EnumNames<LimitsShown, 3> limits_shown{
    "limits", {{"none", "no joint"}, {"selected", "selected joints"}, {"all", "all joints"}}};

struct HumanoidView {
    SkinLook skin = SkinLook::Transparent;
    Skinning skinning = Skinning::TwistSpread;
    bool ghost = true;   ///< of the pose before anything changed it
    bool follow = true;  ///< the camera goes along with a character that walks
    LimitsShown limits = LimitsShown::Selected;
    bool operator==(const HumanoidView&) const = default;
};

struct HumanoidPart final : Part {
    HumanoidPart();  ///< the stick figure
    explicit HumanoidPart(SharedCharacter loaded);

    SharedCharacter loaded;                        ///< never null
    std::shared_ptr<const humanoid::BoneMap> map;  ///< as matched, or as a person has corrected it
    Playback playback;
    bool t_pose = false;  ///< the rest pose is shown as a T
    IkSettings ik;
    std::vector<SpringSetting> springs;
    IkState ik_state;
    Attachments attachments;
    int quiet_ticks = 0;  ///< since anything was set or swung: springs come to rest meanwhile
    Selection selection;  ///< of nodes
    HumanoidView view;
    FlipRule flips;

    const humanoid::Skeleton& skeleton() const { return loaded->skeleton(); }
    const humanoid::Clip* clip() const;  ///< null where none is chosen
    std::optional<std::size_t> node_of(humanoid::Bone bone) const;
    std::optional<humanoid::Bone> bone_of(std::size_t node) const;

    std::shared_ptr<Part> clone() const override { return std::make_shared<HumanoidPart>(*this); }
    Json save() const override;
    std::shared_ptr<Part> load(const Json& json, const std::string& where) const override;
    std::shared_ptr<const Part> at_moment(std::shared_ptr<const Part> then) const override;
    std::size_t bytes() const override;
    bool operator==(const HumanoidPart& other) const;
};

inline constexpr FlipWords humanoid_flip_words{"humanoid.flips", "target", "the target, as the bone sees it,",
                                               "height", "the character's height"};

/// Makes a node the bone, or none; a node is one bone at most, and where it was another that one has none
/// then.
void set_bone(HumanoidPart& part, humanoid::Bone bone, std::optional<std::size_t> node);
/// After set_bone(): throws std::invalid_argument where the bones no longer hang on each other as a body's
/// do. A file whose own map is so is not held to it.
void check_bones(const HumanoidPart& part);

/// What is saved of IK.
Json ik_json(const HumanoidPart& part);
/// Throws std::runtime_error that begins with the place of what is wrong.
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
std::span<const tendril::Field> tendril::fields<tendril::app::HumanoidView>() noexcept;
template <>
std::span<const tendril::app::FieldText> tendril::app::field_texts<tendril::app::HumanoidView>();

namespace tendril::app {

// Which nodes of a skeleton are selected. Files and commands have them by name: another skeleton may have the
// same.

/// Of all that are selected, in the skeleton's order.
std::vector<std::string> names_of(const Selection& selection, const humanoid::Skeleton& skeleton);
/// Of the active one; empty: nothing is selected.
std::string active_name(const Selection& selection, const humanoid::Skeleton& skeleton);

/// The nodes of the same names; what has none is not selected.
Selection selection_in(const humanoid::Skeleton& skeleton, const Selection& selection,
                       const humanoid::Skeleton& before);

/// A name, empty where nothing is selected, or {"active", "all"}.
Json save_selection(const Selection& selection, const humanoid::Skeleton& skeleton);
/// Without nodes that the skeleton does not have. Throws std::runtime_error that begins with the place.
Selection load_selection(const JsonPlace& place, const humanoid::Skeleton& skeleton);

}  // namespace tendril::app
