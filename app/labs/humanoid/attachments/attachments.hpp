// What hangs on a character: ropes, hair and cloth, one rope world for all of them. A value, kept in
// the document.
//
// An attachment is a body of that world. Its pins move with one node of the character, rigidly, from where
// the node rests; the character's capsules and the ground, as far as that is flat, are the world's colliders.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <tendril/humanoid/capsules.hpp>
#include <vector>

#include "app/fields/fields.hpp"
#include "app/labs/humanoid/character/loaded_character.hpp"
#include "app/labs/humanoid/ik/ground.hpp"
#include "app/labs/kit/named_world.hpp"

namespace tendril::app {

enum class AttachmentKind : std::uint8_t { Rope, Hair, Cloth };
inline constexpr EnumNames<AttachmentKind, 3> attachment_kinds{
    "kind of attachment",
    {{"rope", "rope", "One strand, held where it leaves the body: a tail."},
     {"hair", "hair", "Many thin strands that keep their direction at the root: a ponytail."},
     {"cloth", "cloth", "A cloth whose first row is held: on the chest, a cape between both shoulders."}}};

inline constexpr std::size_t max_attachments = 16, max_attached_particles = 4000;
inline constexpr int max_attached_segments = 200, max_attached_strands = 200;
inline constexpr double min_attachment = 0.001, max_attachment = 100.0;  ///< metres

/// Of their world: hair and cloth in air, so that what swings comes to rest within seconds.
inline constexpr rope::Settings attachment_settings{.damping = 1.5f};

/// How it is made. Lengths in metres; points along the axes of the character at rest.
struct AttachmentShape {
    double length = 0.7;
    double width = 0.4;         ///< of a cloth; of the patch that hair grows on. Ropes have none
    double thickness = 0.03;    ///< of the rope, a hair, the cloth
    int segments = 16;          ///< along its length
    int strands = 1;            ///< of hair
    glm::dvec3 offset{0.0};     ///< from the node to where it is held; of a cloth: to its first row's middle
    glm::dvec3 direction{0.0};  ///< of length 1: where it leads to at first
    bool operator==(const AttachmentShape&) const = default;
};

/// Where a node is, and by how much it is turned from its rest.
struct NodeFrame {
    glm::dvec3 position{0.0};
    glm::dquat turn{1.0, 0.0, 0.0, 0.0};
    /// Of a point that moves with it: `offset` is from the node at rest.
    glm::dvec3 apply(const glm::dvec3& offset) const { return position + turn * offset; }
    bool operator==(const NodeFrame&) const = default;
};

struct AttachmentPin {
    std::size_t particle = 0;  ///< of the body
    glm::dvec3 offset{0.0};    ///< from the node at rest
    bool operator==(const AttachmentPin&) const = default;
};

struct Attachment {
    std::string name;  ///< its own, and its body's
    std::string node;  ///< by name
    AttachmentKind kind = AttachmentKind::Rope;
    AttachmentShape shape{};
    std::vector<AttachmentPin> pins{};
    NodeFrame frame{};  ///< where the world has it: time has passed up to there
    bool operator==(const Attachment&) const = default;
};

struct Attachments {
    std::vector<Attachment> list;
    std::shared_ptr<const NamedWorld> world = std::make_shared<const NamedWorld>();  ///< never null

    const Attachment* find(const std::string& name) const;
    bool operator==(const Attachments& other) const;
};

/// The character as far as attachments see it.
struct Wearer {
    const LoadedCharacter& loaded;
    const humanoid::BoneMap& map;
    std::span<const humanoid::BodyCapsule> capsules;  ///< of that map
    std::span<const humanoid::Placement> placed;      ///< as it is shown
    const GroundSetting& ground;

    NodeFrame frame(std::size_t node) const;
};

/// Makes it so many times as large, within the lengths that an attachment may have.
void scale_lengths(AttachmentShape& shape, double by);
/// One that looks as the node asks for: a tail, a ponytail, a cape; else it hangs.
AttachmentShape default_shape(const Wearer& wearer, AttachmentKind kind, std::size_t node);

/// Adds it to the list and its body to the world, where the character is. Throws std::invalid_argument where
/// there are too many, or the name is another's; an empty one becomes "rope", "rope 2", ...
void add_attachment(Attachments& attachments, const Wearer& wearer, Attachment wanted);
/// Throws std::invalid_argument where there is none of that name.
void remove_attachment(Attachments& attachments, const std::string& name);
/// Where its particles are as it is made, from the node at rest.
std::vector<glm::dvec3> made_offsets(const Attachment& attachment, const Wearer& wearer);
/// All of them anew, so many times as large.
Attachments remade(const Attachments& attachments, const Wearer& wearer, double scale);

}  // namespace tendril::app

template <>
std::span<const tendril::Field> tendril::fields<tendril::app::AttachmentShape>() noexcept;
template <>
std::span<const tendril::app::FieldText> tendril::app::field_texts<tendril::app::AttachmentShape>();

namespace tendril::app {

// Where attachments sit on a body, and how large they are.

inline constexpr double flare = 0.7;  ///< by this part of its width a cloth is wider below

std::size_t particles_of(AttachmentKind kind, const AttachmentShape& shape);

/// Whether a ball at a point is in the body at rest, or touches it.
bool is_in_body(const Wearer& wearer, const glm::dvec3& point, double radius);

/// Points of a cloth's first row as the character rests: from side to side, so that its front is seen from
/// behind the character; each brought backwards until it is off the body. `middle`: of the row.
std::vector<glm::dvec3> cloth_row(const Wearer& wearer, const AttachmentShape& shape,
                                  const glm::dvec3& middle);

}  // namespace tendril::app
