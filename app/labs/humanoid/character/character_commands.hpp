// Bone maps that a person has corrected, kept in the config folder: offered again for a character of the same
// node names, and never taken without being asked for.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "app/io/character/map_file.hpp"
#include "app/labs/humanoid/humanoid_part.hpp"

namespace tendril::app {

/// What is kept for the lab's character: looked for once for each.
class KeptMaps {
  public:
    /// Null where there is none, or it would change nothing.
    const SavedMap* offered(const Workspace& workspace);
    /// Null where there is none.
    const SavedMap* kept(const Workspace& workspace);
    /// Why the file that is there is left out; empty where it is not.
    const std::string& refused(const Workspace& workspace);
    /// Looks again the next time.
    void forget() { of_ = nullptr; }

  private:
    void look(const Workspace& workspace);

    SharedCharacter of_;
    std::filesystem::path folder_;
    std::optional<SavedMap> kept_;
    std::string refused_;
};

/// The bones for which a map says another node than the character has now.
std::vector<humanoid::Bone> bones_that_differ(const SavedMap& map, const HumanoidPart& part);
/// As if each bone were picked by hand.
void take_map(HumanoidPart& part, const humanoid::BoneMap& wanted);
/// Keeps what a person has just corrected, where the window keeps things. What goes wrong is told, no more.
void keep_correction(Workspace& workspace);

}  // namespace tendril::app
