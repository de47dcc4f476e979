#include "app/io/character/fbx/animation.hpp"

#include <algorithm>
#include <glm/gtc/quaternion.hpp>
#include <stdexcept>
#include <unordered_map>

namespace tendril::app::fbx {
namespace {

/// A power of a rotation, the short way round.
glm::dquat part_of(const glm::dquat& rotation, double part) {
    return rig::blend({1.0, 0.0, 0.0, 0.0}, rotation, std::clamp(part, 0.0, 1.0));
}

/// Sets the stack's range from its keys if the file does not state it.
void fit_to_keys(Stack& stack) {
    if (stack.end > stack.begin) return;
    double first = 1e300, last = -1e300;
    const auto use = [&](const std::shared_ptr<const Curve>& curve) {
        if (!curve || curve->keys.empty()) return;
        first = std::min(first, curve->keys.front().time());
        last = std::max(last, curve->keys.back().time());
    };
    for (const Layer& layer : stack.layers) {
        for (const auto& entry : layer.nodes)
            for (const auto& property : entry.second)
                if (property) std::ranges::for_each(property->curves, use);
        for (const auto& entry : layer.morphs) std::ranges::for_each(entry.second.curves, use);
    }
    if (first <= last) stack.begin = first, stack.end = last;
}

std::int64_t axis_in(std::string_view property) {
    if (property.ends_with("X") || property.ends_with("DeformPercent")) return 0;
    return property.ends_with("Y") ? 1 : property.ends_with("Z") ? 2 : -1;
}

class StackReader {
  public:
    StackReader(const File& file, const Objects& objects, const std::vector<Node>& nodes,
                std::vector<std::string>& notes)
        : file_(file), objects_(objects), nodes_(nodes), notes_(notes) {
        for (std::size_t i = 0; i < nodes.size(); ++i) node_of_[nodes[i].object] = i;
    }

    std::vector<Stack> read() {
        for (std::size_t i = 0; i < objects_.size(); ++i)
            if (objects_[i].kind == "AnimationStack") stacks_.push_back(read_stack(i));
        if (const Record* takes = file_.root.child("Takes"); takes && file_.version < 7000)
            for (const Record& take : takes->children)
                if (take.name == "Take") stacks_.push_back(read_take(take));
        for (Stack& stack : stacks_) fit_to_keys(stack);
        if (has_odd_)
            notes_.push_back(
                "Some curves have keys out of order, have a velocity, or repeat beyond their keys; that is "
                "not read as written.");
        if (has_solo_) notes_.push_back("Layers on solo are evaluated with the others.");
        return std::move(stacks_);
    }

  private:
    std::shared_ptr<const Curve> counted(Curve curve) {
        keys_ += curve.keys.size();
        if (keys_ > max_keys) throw std::runtime_error("has more than " + std::to_string(max_keys) + " keys");
        has_odd_ = has_odd_ || curve.is_odd;
        return curve.keys.empty() ? nullptr : std::make_shared<const Curve>(std::move(curve));
    }
    std::shared_ptr<const Curve> curve(std::size_t object) {
        const auto [known, is_new] = curves_.emplace(object, nullptr);
        if (is_new) known->second = counted(read_curve(*objects_[object].record));
        return known->second;
    }
    double seconds(std::size_t object, std::string_view name) const {
        return static_cast<double>(objects_.integer(object, name, 0)) / ticks_per_second;
    }

    Stack read_stack(std::size_t object) {
        Stack stack{.name = std::string(objects_[object].name)};
        stack.begin = seconds(object, "LocalStart");
        stack.end = seconds(object, "LocalStop");
        if (!(stack.end > stack.begin)) {
            stack.begin = seconds(object, "ReferenceStart");
            stack.end = seconds(object, "ReferenceStop");
        }
        for (const Connection& each : objects_.children(object)) {
            if (objects_[each.object].kind != "AnimationLayer") continue;
            if (objects_.integer(each.object, "Mute", 0) != 0) continue;
            has_solo_ = has_solo_ || objects_.integer(each.object, "Solo", 0) != 0;
            stack.layers.push_back(read_layer(each.object));
        }
        return stack;
    }
    Layer read_layer(std::size_t object) {
        Layer layer;
        layer.blend =
            objects_.integer(object, "BlendMode", 0) == 0 ? Layer::Blend::Additive : Layer::Blend::Override;
        layer.turns_by_axis = objects_.integer(object, "RotationAccumulationMode", 0) != 0;
        layer.scales_by_sum = objects_.integer(object, "ScaleAccumulationMode", 0) != 0;
        layer.weight.constant.x = objects_.number(object, "Weight", 100.0);
        for (const Connection& each : objects_.children(object)) {
            const std::string_view kind = objects_[each.object].kind;
            if (kind == "AnimationCurveNode" && each.property.empty())
                read_curve_node(each.object, layer);
            else if (each.property == "Weight")
                layer.weight = vector_curves(each.object, layer.weight.constant);
        }
        return layer;
    }
    VectorCurves vector_curves(std::size_t object, glm::dvec3 constant) {
        VectorCurves result;
        if (objects_[object].kind == "AnimationCurve") {
            result.constant = constant;
            result.curves[0] = curve(object);
            return result;
        }
        constant.x = objects_.number(object, "d|X", constant.x);
        constant.x =
            objects_.number(object, "d|DeformPercent", objects_.number(object, "d|Weight", constant.x));
        constant.y = objects_.number(object, "d|Y", constant.y);
        constant.z = objects_.number(object, "d|Z", constant.z);
        result.constant = constant;
        for (const Connection& each : objects_.children(object)) {
            if (objects_[each.object].kind != "AnimationCurve") continue;
            std::int64_t axis = axis_in(each.property);
            if (axis < 0 && each.property.ends_with("Weight")) axis = 0;
            if (axis < 0 || result.curves[static_cast<std::size_t>(axis)]) continue;
            result.curves[static_cast<std::size_t>(axis)] = curve(each.object);
        }
        return result;
    }
    void read_curve_node(std::size_t object, Layer& layer) {
        for (const Connection& each : objects_.parents(object)) {
            if (each.property == "DeformPercent") {
                layer.morphs[each.object] = vector_curves(object, glm::dvec3(0.0));
                continue;
            }
            const auto node = node_of_.find(each.object);
            if (node == node_of_.end()) continue;
            const Node& of = nodes_[node->second];
            auto& properties = layer.nodes[node->second];
            if (each.property == "Lcl Translation")
                properties[0] = vector_curves(object, of.translation);
            else if (each.property == "Lcl Rotation")
                properties[1] = vector_curves(object, of.euler);
            else if (each.property == "Lcl Scaling")
                properties[2] = vector_curves(object, of.scale);
        }
    }

    Stack read_take(const Record& take) {
        Stack stack{.name = std::string(take.text(0))};
        for (const char* name : {"LocalTime", "ReferenceTime"}) {
            const Record* range = take.child(name);
            if (!range || stack.end > stack.begin) continue;
            stack.begin = static_cast<double>(range->integer(0)) / ticks_per_second;
            stack.end = static_cast<double>(range->integer(1)) / ticks_per_second;
        }
        Layer layer;
        layer.weight.constant.x = 100.0;
        for (const Record& model : take.children) {
            const std::int64_t object = model.name == "Model" ? objects_.find(model.text(0)) : -1;
            if (object < 0) continue;
            const auto node = node_of_.find(static_cast<std::size_t>(object));
            if (node == node_of_.end()) continue;
            for (const Record& channel : model.children)
                if (channel.name == "Channel" && channel.text(0) == "Transform")
                    read_old_channels(channel, nodes_[node->second], layer.nodes[node->second]);
        }
        stack.layers.push_back(std::move(layer));
        return stack;
    }
    void read_old_channels(const Record& transform, const Node& node,
                           std::array<std::optional<VectorCurves>, 3>& properties) {
        const std::array<glm::dvec3, 3> rest{node.translation, node.euler, node.scale};
        for (const Record& channel : transform.children) {
            const std::size_t which = channel.text(0) == "T"   ? 0
                                      : channel.text(0) == "R" ? 1
                                      : channel.text(0) == "S" ? 2
                                                               : 3;
            if (channel.name != "Channel" || which == 3) continue;
            VectorCurves curves{.constant = rest[which]};
            for (const Record& each : channel.children) {
                const std::int64_t axis = each.name == "Channel" ? axis_in(each.text(0)) : -1;
                if (axis < 0) continue;
                if (const Record* constant = each.child("Default"))
                    curves.constant[static_cast<int>(axis)] = constant->number(0);
                curves.curves[static_cast<std::size_t>(axis)] = counted(read_old_curve(each));
            }
            properties[which] = std::move(curves);
        }
    }

    const File& file_;
    const Objects& objects_;
    const std::vector<Node>& nodes_;
    std::vector<std::string>& notes_;
    std::unordered_map<std::size_t, std::size_t> node_of_{};
    std::unordered_map<std::size_t, std::shared_ptr<const Curve>> curves_{};
    std::vector<Stack> stacks_{};
    std::size_t keys_ = 0;
    bool has_odd_ = false, has_solo_ = false;
};

/// A rotation under construction: Euler angles while only such are added, then rotations after them.
struct Turning {
    glm::dvec3 euler;
    glm::dquat after{1.0, 0.0, 0.0, 0.0};
    glm::dquat rotation(int order) const { return from_euler(euler, order) * after; }
};

}  // namespace

glm::dvec3 VectorCurves::at(double time) const {
    glm::dvec3 value = constant;
    for (int axis = 0; axis < 3; ++axis)
        if (const auto& curve = curves[static_cast<std::size_t>(axis)]) value[axis] = curve->at(time);
    return value;
}

Values Stack::at(const Node& node, std::size_t index, double time) const {
    glm::dvec3 translation = node.translation, scale = node.scale;
    Turning turning{.euler = node.euler};
    for (const Layer& layer : layers) {
        const auto found = layer.nodes.find(index);
        if (found == layer.nodes.end()) continue;
        const auto& [t, r, s] = found->second;
        const bool is_base = &layer == &layers.front();
        const double weight = is_base ? 1.0 : std::clamp(0.01 * layer.weight.at(time).x, 0.0, 1.0);
        const bool adds = !is_base && layer.blend == Layer::Blend::Additive;
        if (t) translation = (adds ? translation : translation * (1.0 - weight)) + weight * t->at(time);
        if (s) {
            const glm::dvec3 value = s->at(time);
            if (!adds)
                scale = glm::mix(scale, value, weight);
            else if (layer.scales_by_sum)
                scale += weight * value;
            else
                scale *= glm::mix(glm::dvec3(1.0), value, weight);
        }
        if (!r) continue;
        const glm::dvec3 value = r->at(time);
        if (is_base || (!adds && weight == 1.0)) {
            turning = {.euler = value};
        } else if (adds && layer.turns_by_axis) {
            turning.euler += weight * value;
        } else if (adds) {
            turning.after = turning.after * part_of(from_euler(value, node.order), weight);
        } else if (layer.turns_by_axis) {
            turning.euler = glm::mix(turning.euler, value, weight);
            turning.after = part_of(turning.after, 1.0 - weight);
        } else {
            const glm::dquat from = turning.rotation(node.order), to = from_euler(value, node.order);
            turning.after =
                glm::conjugate(from_euler(turning.euler, node.order)) * rig::blend(from, to, weight);
        }
    }
    return {translation, turning.rotation(node.order), scale};
}

double Stack::morph_at(std::size_t object, double percent, double time) const {
    for (const Layer& layer : layers) {
        const auto found = layer.morphs.find(object);
        if (found == layer.morphs.end()) continue;
        const double value = found->second.at(time).x;
        const bool is_base = &layer == &layers.front();
        const double weight = is_base ? 1.0 : std::clamp(0.01 * layer.weight.at(time).x, 0.0, 1.0);
        percent = !is_base && layer.blend == Layer::Blend::Additive ? percent + weight * value
                                                                    : percent + weight * (value - percent);
    }
    return percent;
}

std::vector<Stack> read_stacks(const File& file, const Objects& objects, const std::vector<Node>& nodes,
                               std::vector<std::string>& notes) {
    return StackReader(file, objects, nodes, notes).read();
}

}  // namespace tendril::app::fbx
