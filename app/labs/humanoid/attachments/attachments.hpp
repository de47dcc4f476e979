// Attachments of a character: ropes, hair and cloth, all in one rope world. A value, stored in the document.
//
// An attachment is a body of that world. Its pins move rigidly with one node of the character, relative to
// the node's rest pose. The world's colliders are the character's capsules, what its hands hold, and the
// ground, if that is flat.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <tendril/humanoid/capsules.hpp>
#include <vector>

#include "app/fields/fields.hpp"
#include "app/labs/humanoid/character/loaded_character.hpp"
#include "app/labs/humanoid/ik/ik_settings.hpp"
#include "app/labs/kit/named_world.hpp"

namespace tendril::app {

enum class AttachmentKind : std::uint8_t { Rope, Hair, Cloth };
inline constexpr EnumNames<AttachmentKind, 3> attachment_kinds{
    "kind of attachment",
    {{"rope", "tail (rope)", "One strand, held where it leaves the body: a tail."},
     {"hair", "ponytail (hair)", "Many thin strands that keep their direction at the root: a ponytail."},
     {"cloth", "cape (cloth)",
      "A cloth whose first row is held: on the chest, a cape between both shoulders."}}};

inline constexpr std::size_t max_attachments = 16, max_attached_particles = 4000;
inline constexpr int max_attached_segments = 200, max_attached_strands = 200;
inline constexpr double min_attachment = 0.001, max_attachment = 100.0;  ///< metres

/// Settings of their world. Hair and cloth are damped by air, so they come to rest within seconds.
inline constexpr rope::Settings attachment_settings{.damping = 1.5f};

/// How an attachment is made. Lengths in metres; points along the axes of the character at rest.
struct AttachmentShape {
    double length = 0.7;
    double width = 0.4;         ///< of a cloth, or of the patch that hair grows on; not used by ropes
    double thickness = 0.03;    ///< of the rope, a hair or the cloth
    int segments = 16;          ///< along its length
    int strands = 1;            ///< of hair
    glm::dvec3 offset{0.0};     ///< from the node to the root, or to the middle of a cloth's first row
    glm::dvec3 direction{0.0};  ///< unit vector: the initial direction
    bool operator==(const AttachmentShape&) const = default;
};

/// A node's position, and its rotation from rest.
struct NodeFrame {
    glm::dvec3 position{0.0};
    glm::dquat turn{1.0, 0.0, 0.0, 0.0};
    /// A point that moves with the node; `offset` is from the node at rest.
    glm::dvec3 apply(const glm::dvec3& offset) const { return position + turn * offset; }
    bool operator==(const NodeFrame&) const = default;
};

struct AttachmentPin {
    std::size_t particle = 0;  ///< of the body
    glm::dvec3 offset{0.0};    ///< from the node at rest
    bool operator==(const AttachmentPin&) const = default;
};

struct Attachment {
    std::string name;  ///< also the name of its body
    std::string node;  ///< by name
    AttachmentKind kind = AttachmentKind::Rope;
    AttachmentShape shape{};
    std::vector<AttachmentPin> pins{};
    NodeFrame frame{};  ///< the node's, at the last simulated moment
    bool operator==(const Attachment&) const = default;
};

/// A world without bodies. Its wind stays as in `settings`.
std::shared_ptr<const NamedWorld> empty_world(rope::Settings settings = attachment_settings);

struct Attachments {
    std::vector<Attachment> list;
    std::shared_ptr<const NamedWorld> world = empty_world();  ///< never null; its settings have the wind

    const Attachment* find(const std::string& name) const;
    bool operator==(const Attachments& other) const;
};

/// The character's data that attachments need.
struct Wearer {
    const LoadedCharacter& loaded;
    const humanoid::BoneMap& map;
    std::span<const humanoid::BodyCapsule> capsules;  ///< of `map`
    std::span<const humanoid::Placement> placed;      ///< the displayed pose
    const GroundSetting& ground;
    std::vector<humanoid::PlacedCapsule> held{};  ///< the object in its hands

    NodeFrame frame(std::size_t node) const;
};

/// Scales the lengths, clamped to their range.
void scale_lengths(AttachmentShape& shape, double by);
/// A shape that suits the node: a tail, a ponytail, a cape; elsewhere it hangs straight down.
AttachmentShape default_shape(const Wearer& wearer, AttachmentKind kind, std::size_t node);

/// Adds the attachment to the list, and its body to the world at the character's current pose. Throws
/// std::invalid_argument if there are too many or the name is taken. An empty name becomes "rope", "rope 2".
void add_attachment(Attachments& attachments, const Wearer& wearer, Attachment wanted);
/// Throws std::invalid_argument if there is none of that name.
void remove_attachment(Attachments& attachments, const std::string& name);
/// The initial positions of its particles, relative to the node at rest.
std::vector<glm::dvec3> made_offsets(const Attachment& attachment, const Wearer& wearer);
/// An edge is torn if it is longer than its rest length by more than this fraction. Walking and punching at
/// double speed stretch none by over 8 %.
inline constexpr double torn_strain = 0.25;
/// How many edges of an attachment are torn.
std::size_t torn_edges(const Attachments& attachments, const Attachment& attachment);
/// All attachments, recreated at `scale` times their size.
Attachments remade(const Attachments& attachments, const Wearer& wearer, double scale);

}  // namespace tendril::app

template <>
std::span<const tendril::Field> tendril::fields<tendril::app::AttachmentShape>() noexcept;
template <>
std::span<const tendril::Field> tendril::fields<tendril::app::NodeFrame>() noexcept;
template <>
std::span<const tendril::Field> tendril::fields<tendril::app::AttachmentPin>() noexcept;
template <>
std::span<const tendril::Field> tendril::fields<tendril::app::Attachment>() noexcept;
/// Excludes their world.
template <>
std::span<const tendril::Field> tendril::fields<tendril::app::Attachments>() noexcept;
template <>
std::span<const tendril::app::FieldText> tendril::app::field_texts<tendril::app::AttachmentShape>();

namespace tendril::app {

// Placing attachments on a body.

inline constexpr double flare = 0.7;  ///< a cloth widens by this fraction of its width towards the bottom

std::size_t particles_of(AttachmentKind kind, const AttachmentShape& shape);

/// True if a ball at that point touches or intersects the body at rest.
bool is_in_body(const Wearer& wearer, const glm::dvec3& point, double radius);

/// The first row of a cloth on the character at rest, centred at `middle` and ordered so that the front of
/// the cloth faces backwards. Each point is moved backwards until it clears the body.
std::vector<glm::dvec3> cloth_row(const Wearer& wearer, const AttachmentShape& shape,
                                  const glm::dvec3& middle);

}  // namespace tendril::app
