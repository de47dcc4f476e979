// Preset chains.
#pragma once

#include <cstdint>
#include <string>
#include <tendril/chain/chain.hpp>
#include <vector>

namespace tendril::app {

struct Preset {
    const char* name;
    const char* title;
    std::size_t count;  ///< segments unless told otherwise
};

const std::vector<Preset>& presets();

/// Throws std::invalid_argument for an unknown name. `seed` matters to "random" alone.
Chain make_preset(const std::string& name, std::size_t count, std::uint32_t seed);

}  // namespace tendril::app
