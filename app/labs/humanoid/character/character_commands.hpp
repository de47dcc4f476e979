// Loading a character and mapping its bones; corrected bone maps, kept in the config folder. They are offered
// again for characters with the same node names, but never applied unasked.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "app/io/character/map_file.hpp"
#include "app/labs/humanoid/humanoid_part.hpp"

namespace tendril::app {

/// The kept map of the lab's character. Reads the folder once per character.
class KeptMaps {
  public:
    /// The kept map; null if there is none, or if it would change nothing.
    const SavedMap* offered(const Workspace& workspace);
    /// Null if there is none.
    const SavedMap* kept(const Workspace& workspace);
    /// Why an existing file was ignored; empty if it was used.
    const std::string& refused(const Workspace& workspace);
    /// Reads the folder again next time.
    void forget() { of_ = nullptr; }

  private:
    void look(const Workspace& workspace);

    SharedCharacter of_;
    std::filesystem::path folder_;
    std::optional<SavedMap> kept_;
    std::string refused_;
};

/// The bones that `map` assigns to other nodes than the character's present map.
std::vector<humanoid::Bone> bones_that_differ(const SavedMap& map, const HumanoidPart& part);

}  // namespace tendril::app
