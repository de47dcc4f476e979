// The Chain lab's share of the document.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <tendril/chain/chain.hpp>

#include "app/document/document.hpp"

namespace tendril::app {

inline constexpr const char* chain_lab = "chain";
inline constexpr std::size_t max_segments = 500'000;  ///< a scene of more would be too large a file
inline constexpr int max_iterations = 10'000;

/// A path that the target follows by itself, so that time means something here: a student watches what a mode
/// makes of a steady movement, and can pause and step it.
struct Motion {
    enum class Path { Still, Circle, FigureEight, Sweep } path = Path::Still;
    glm::vec3 centre{0.0f};
    float radius = 2.0f;      ///< metres
    float period = 4.0f;      ///< seconds a round
    std::uint32_t ticks = 0;  ///< since it was set going
    bool operator==(const Motion&) const = default;
};

/// Where the path is after so many ticks; starts at its centre's right, or wherever the path has its first
/// point.
glm::vec3 motion_point(const Motion& motion, std::uint32_t ticks);
std::uint32_t ticks_per_round(const Motion& motion);

struct ChainPart final : Part {
    Chain chain;
    Mode mode = Mode::Backward;
    std::size_t index = 0;                      ///< which segment WithIndex pulls
    std::array<int, 4> iterations{1, 1, 1, 1};  ///< each mode's own; Fixed is the one that repeats
    float tolerance = 1e-4f;                    ///< metres
    glm::vec3 target{0.0f};
    std::optional<std::size_t> selected;
    Motion motion;

    std::shared_ptr<Part> clone() const override { return std::make_shared<ChainPart>(*this); }
    Json save() const override;
    std::shared_ptr<Part> load(const Json& json, const std::string& where) const override;
    std::size_t bytes() const override { return sizeof(*this) + chain.size() * sizeof(Segment); }
};

/// What the lab starts with: eight segments of a metre along +X, the target on the tail.
ChainPart first_chain();

/// "forward", "with_index": the mode as commands and files name it, and as people read it.
const char* mode_name(Mode mode);
const char* mode_title(Mode mode);
const char* mode_help(Mode mode);
/// Every mode, in the order of the panel.
inline constexpr std::array all_modes{Mode::Forward, Mode::Backward, Mode::Fixed, Mode::WithIndex};
/// Throws std::invalid_argument for an unknown name.
Mode mode_from_name(const std::string& name);

const char* motion_name(Motion::Path path);
Motion::Path motion_from_name(const std::string& name);
inline constexpr std::array all_motions{Motion::Path::Still, Motion::Path::Circle, Motion::Path::FigureEight,
                                        Motion::Path::Sweep};

/// Whether the two hold the same.
bool same(const ChainPart& a, const ChainPart& b);

/// Throws std::invalid_argument where a point has left the range that a scene file can hold: a saved chain
/// must always open again.
void check_range(const ChainPart& part);

/// Moves the target and applies the mode once.
void reach_for(ChainPart& part, glm::vec3 target);

/// How far link `index` is from its length, in metres; 0 for the head.
float length_error(const Chain& chain, std::size_t index);

}  // namespace tendril::app
