// The animation of an FBX file: stacks (version 6: takes) of layers, which hold curves for the nodes'
// properties.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/io/character/fbx/node.hpp"
#include "app/io/character/fbx/record.hpp"

namespace tendril::app::fbx {

// An animation curve of an FBX file: a number over time, interpolated as its keys specify.

constexpr double ticks_per_second = 46'186'158'000.0;
constexpr std::size_t max_keys = 20'000'000;  ///< in all curves together

struct CurveKey {
    enum class Shape : std::uint8_t { Constant, ConstantNext, Linear, Cubic };
    std::int64_t ticks = 0;
    double value = 0.0;
    Shape shape = Shape::Linear;                         ///< from this key to the next
    double leaving = 0.0, arriving = 0.0;                ///< slopes per second: at this key and at the next
    double leaving_weight = 0.0, arriving_weight = 0.0;  ///< tangent lengths in parts of the interval
    double time() const { return static_cast<double>(ticks) / ticks_per_second; }
};

struct Curve {
    std::vector<CurveKey> keys{};  ///< times increase
    bool is_odd = false;           ///< some keys are not fully understood

    /// Outside its keys the curve holds the first or last value.
    double at(double time) const;
};

/// Reads an AnimationCurve of version 7. Throws std::runtime_error if the numbers of times and values differ.
Curve read_curve(const Record& record);
/// Reads a channel of a version 6 take: its record Key.
Curve read_old_curve(const Record& channel);

/// A vector's curves; an axis without one keeps its constant.
struct VectorCurves {
    std::array<std::shared_ptr<const Curve>, 3> curves{};
    glm::dvec3 constant{0.0};
    glm::dvec3 at(double time) const;
};

/// The node properties that a layer can animate, in the order of the arrays in Layer::nodes.
enum class Animated : std::uint8_t { Translation, Rotation, Scale };

struct Layer {
    enum class Blend : std::uint8_t { Additive, Override };
    Blend blend = Blend::Additive;
    bool turns_by_axis = false;  ///< additive Euler angles add up by axis, not as rotations
    bool scales_by_sum = false;  ///< additive scales add up instead of multiplying
    VectorCurves weight{};       ///< x: percent
    std::map<std::size_t, std::array<std::optional<VectorCurves>, 3>> nodes{};
    std::map<std::size_t, VectorCurves> morphs{};  ///< x: percent, by the blend shape channel's object
};

struct Stack {
    std::string name{};
    double begin = 0.0, end = 0.0;  ///< seconds
    std::vector<Layer> layers{};    ///< the first layer sets, the others add or override

    /// A node's values at a time.
    Values at(const Node& node, std::size_t index, double time) const;
    double morph_at(std::size_t object, double percent, double time) const;
    /// Calls `use` with every curve that moves this property of the node.
    template <class Use>
    void each_curve(std::size_t node, Animated which, const Use& use) const;
};

/// Stacks in the file's order. Appends sentences to `notes`. Throws std::runtime_error.
std::vector<Stack> read_stacks(const File& file, const Objects& objects, const std::vector<Node>& nodes,
                               std::vector<std::string>& notes);

template <class Use>
void Stack::each_curve(std::size_t node, Animated which, const Use& use) const {
    for (const Layer& layer : layers) {
        const auto found = layer.nodes.find(node);
        if (found == layer.nodes.end()) continue;
        const auto& property = found->second[static_cast<std::size_t>(which)];
        if (!property) continue;
        for (const auto& curve : property->curves)
            if (curve) use(*curve);
        for (const auto& curve : layer.weight.curves)
            if (curve) use(*curve);
    }
}

}  // namespace tendril::app::fbx
