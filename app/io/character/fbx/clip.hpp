// The clips of an FBX file, from its curves.
//
// A track keeps the keys of its curves. It is linear if all its curves are, a step track if they all step,
// and cubic otherwise, with the curves' own slopes; if even a cubic is off by more than the tolerance (a
// rotation by Euler angles far apart), keys are added in between.
#pragma once

#include <tendril/humanoid/clip.hpp>

#include "app/io/character/fbx/body.hpp"

namespace tendril::app::fbx {

/// The maximum deviation of a track from its curves: `length` in the file's unit, per node.
struct Tolerance {
    double length = 1e-3;
    std::vector<double> levers{};  ///< per bone, the distance at which its rotation moves nodes
};

class ClipWriter {
  public:
    /// Throws std::runtime_error beyond `max_clip_keys` keys in all clips together.
    ClipWriter(const Body& body, double metres, std::size_t max_clip_keys);
    /// In the file's unit and axes.
    humanoid::Clip clip(const Stack& stack);
    /// The weight of a blend shape channel over the stack's time, in percent in x; empty: not animated.
    humanoid::Track<glm::dvec3> morph(const Stack& stack, std::size_t object, double percent);

  private:
    using Sources = std::vector<std::pair<std::size_t, Animated>>;
    void add_channel(const Stack& stack, std::size_t bone, humanoid::Clip& clip);
    template <class T, class Value, class Error>
    humanoid::Track<T> track(const Stack& stack, const std::vector<const Curve*>& curves, const Value& value,
                             const Error& error, bool is_set);
    Sources translation_sources(std::size_t bone) const;
    Sources scale_sources(std::size_t bone) const;

    const Body& body_;
    Tolerance tolerance_;
    std::size_t keys_left_;
};

}  // namespace tendril::app::fbx
