// The Chain lab's share of the document.
#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <tendril/chain/chain.hpp>

#include "app/document/document.hpp"
#include "app/labs/chain/reach.hpp"
#include "app/labs/chain/study.hpp"
#include "app/labs/kit/flips.hpp"
#include "app/labs/kit/motion.hpp"
#include "app/labs/kit/selection.hpp"

namespace tendril::app {

inline constexpr const char* chain_lab = "chain";
inline constexpr std::size_t max_segments = 500'000;          ///< a scene of more would be too large a file
inline constexpr std::size_t max_limited_segments = 100'000;  ///< of a chain with limits, for the same reason

/// How the chain follows its target: the library's four modes, and Reach, which pins the head and iterates.
enum class ChainMode { Forward, Backward, Fixed, WithIndex, Reach };

/// What can be selected beside joints.
enum class ChainPoint { Target, Pole };
inline constexpr EnumNames<ChainPoint, 2> chain_points{
    "point",
    {{"target", "Target", "What the chain follows."}, {"pole", "Pole target", "What it bends towards."}}};

inline constexpr FlipWords chain_flip_words{"chain.flips", "target", "the target, as the root sees it,",
                                            "reach", "the chain's reach"};

struct ChainPart final : Part {
    Chain chain;
    ChainMode mode = ChainMode::Backward;
    std::size_t index = 0;                      ///< which segment WithIndex pulls
    std::array<int, 4> iterations{1, 1, 1, 1};  ///< each pull mode's own; Fixed is the one that repeats
    float tolerance = 1e-4f;                    ///< metres, of Fixed
    glm::vec3 target{0.0f};
    Selection selection;                     ///< of joints
    std::optional<ChainPoint> chosen_point;  ///< instead of joints
    Motion motion;
    ReachSettings reach;
    std::optional<ReachResult> result;  ///< of the last solve; none once the chain was moved otherwise
    Study study;
    FlipRule flips;

    std::shared_ptr<Part> clone() const override { return std::make_shared<ChainPart>(*this); }
    Json save() const override;
    std::shared_ptr<Part> load(const Json& json, const std::string& where) const override;
    void upgrade(Json& json, int version) const override;
    std::shared_ptr<const Part> at_moment(std::shared_ptr<const Part> then) const override;
    std::size_t bytes() const override;
};

/// What the lab starts with: eight segments of a metre along +X, the target on the tail.
ChainPart first_chain();

/// Every mode, in the order of the panel.
inline constexpr EnumNames<ChainMode, 5> chain_modes{
    "mode",
    {{"forward", "Forward", "Pulls by the head: it goes to the target, the rest trails."},
     {"backward", "Backward", "Pulls by the tail: it goes to the target, the rest trails."},
     {"fixed", "Fixed", "The head reaches for the target; the tail stays where it is."},
     {"with_index", "With index", "Pulls by one segment; both sides trail."},
     {"reach", "Reach", "The root stays; the tip reaches for the target."}}};
/// Each mode has its own number of iterations.
int& iterations_of(ChainPart& part, ChainMode mode);
int iterations_of(const ChainPart& part, ChainMode mode);

bool operator==(const ChainPart& a, const ChainPart& b);

/// Throws std::invalid_argument where a point has left the range that a scene file can hold: a saved chain
/// must always open again.
void check_range(const ChainPart& part);

/// Moves the target and applies the mode once. While something is studied, Reach solves from where that
/// began.
void reach_for(ChainPart& part, glm::vec3 target, ChainRuntime& runtime);

/// Keeps the step under the microscope within the solve that it now shows.
void keep_step(ChainPart& part, ChainRuntime& runtime);

/// How far bone `index` is from its length, in metres; 0 for the head.
float length_error(const Chain& chain, std::size_t index);

}  // namespace tendril::app
