#include "app/io/character/fbx/body.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <stdexcept>
#include <unordered_set>

namespace tendril::app::fbx {
namespace {

class BodyChooser {
  public:
    BodyChooser(const Objects& objects, std::vector<Node> nodes, const std::vector<Stack>& stacks)
        : objects_(objects), stacks_(stacks) {
        body_.nodes = std::move(nodes);
        order_ = parents_first(body_.nodes);
    }

    Body choose() {
        find_what_is_no_body();
        find_bones();
        find_wanted();
        leave_out_small_trees();
        if (std::ranges::find(wanted_, true) == wanted_.end())
            throw std::runtime_error(
                "has no skeleton: no mesh has bones, no node is a joint, and none is animated");
        add_what_hangs_on_it();
        find_split();
        collect();
        return std::move(body_);
    }

  private:
    std::int32_t parent_of(std::size_t node) const { return body_.nodes[node].parent; }

    void find_what_is_no_body() {
        no_body_.assign(body_.nodes.size(), false);
        std::unordered_set<std::string> targets;
        for (const Node& node : body_.nodes)
            if (is_view(node)) targets.insert(node.name + ".Target");
        for (const std::size_t i : order_) {
            const std::int32_t parent = parent_of(i);
            no_body_[i] = is_view(body_.nodes[i]) || targets.count(body_.nodes[i].name) ||
                          (parent >= 0 && no_body_[static_cast<std::size_t>(parent)]);
        }
    }
    static bool is_view(const Node& node) {
        return node.subtype == "Camera" || node.subtype == "CameraSwitcher" || node.subtype == "Light";
    }
    /// Nodes linked to clusters; if there are none, limbs and animated nodes.
    void find_bones() {
        is_bone_.assign(body_.nodes.size(), false);
        std::vector<std::int32_t> node_of(objects_.size(), -1);
        for (std::size_t i = 0; i < body_.nodes.size(); ++i)
            node_of[body_.nodes[i].object] = static_cast<std::int32_t>(i);
        bool any = false;
        for (std::size_t i = 0; i < objects_.size(); ++i) {
            if (objects_[i].kind != "Deformer" || objects_[i].subtype != "Cluster") continue;
            for (const Connection& each : objects_.children(i))
                if (node_of[each.object] >= 0)
                    is_bone_[static_cast<std::size_t>(node_of[each.object])] = any = true;
        }
        if (any) return;
        for (std::size_t i = 0; i < body_.nodes.size(); ++i) {
            const Node& node = body_.nodes[i];
            is_bone_[i] = !node.has_mesh &&
                          (node.subtype == "LimbNode" || node.subtype == "Limb" || node.subtype == "Root");
        }
        for (const Stack& stack : stacks_)
            for (const Layer& layer : stack.layers)
                for (const auto& entry : layer.nodes)
                    if (!body_.nodes[entry.first].has_mesh) is_bone_[entry.first] = true;
    }
    /// Finds the bones and their ancestors.
    void find_wanted() {
        wanted_.assign(body_.nodes.size(), false);
        for (auto i = order_.rbegin(); i != order_.rend(); ++i) {
            if (no_body_[*i]) continue;
            wanted_[*i] = wanted_[*i] || is_bone_[*i];
            if (wanted_[*i] && parent_of(*i) >= 0) wanted_[static_cast<std::size_t>(parent_of(*i))] = true;
        }
    }
    /// A rotating sky dome is not a skeleton: drops top-level trees with less than a tenth of the nodes of
    /// the largest.
    void leave_out_small_trees() {
        std::vector<std::size_t> tree(body_.nodes.size()), counts(body_.nodes.size());
        for (const std::size_t i : order_) {
            tree[i] = parent_of(i) < 0 ? i : tree[static_cast<std::size_t>(parent_of(i))];
            if (wanted_[i]) ++counts[tree[i]];
        }
        const std::size_t most = *std::ranges::max_element(counts);
        for (const std::size_t i : order_)
            if (10 * counts[tree[i]] < most) wanted_[i] = false;
    }
    void add_what_hangs_on_it() {
        for (const std::size_t i : order_)
            if (parent_of(i) >= 0 && wanted_[static_cast<std::size_t>(parent_of(i))] && !no_body_[i] &&
                !body_.nodes[i].has_mesh)
                wanted_[i] = true;
    }

    /// Finds nodes whose scale is ever uneven or nearly 0, and whose children do not inherit it.
    void find_split() {
        body_.is_split.assign(body_.nodes.size(), false);
        for (const std::size_t i : order_)
            if (wanted_[i] && is_apart(body_.nodes[i]))
                body_.is_split[static_cast<std::size_t>(parent_of(i))] = true;
        for (const std::size_t i : order_)
            if (body_.is_split[i]) body_.is_split[i] = has_uneven_scale(i);
    }
    bool has_uneven_scale(std::size_t node) const {
        const std::vector<std::size_t> chain = body_.scale_chain(node);
        const auto is_uneven = [](const glm::dvec3& scale) {
            const double size = std::abs(scale.x);
            return size < 1e-6 || std::abs(scale.y - scale.x) > 1e-6 * size ||
                   std::abs(scale.z - scale.x) > 1e-6 * size;
        };
        for (const std::size_t each : chain) {
            if (is_uneven(body_.nodes[each].scale)) return true;
            for (const Stack& stack : stacks_) {
                std::set<double> times{stack.begin};
                stack.each_curve(each, Animated::Scale, [&](const Curve& curve) {
                    for (std::size_t i = 0; i < curve.keys.size(); ++i) {
                        times.insert(curve.keys[i].time());
                        if (i > 0) times.insert(0.5 * (curve.keys[i - 1].time() + curve.keys[i].time()));
                    }
                });
                for (const double time : times)
                    if (is_uneven(stack.at(body_.nodes[each], each, time).scale)) return true;
            }
        }
        return false;
    }

    void collect() {
        body_.bone_of.assign(body_.nodes.size(), -1);
        std::vector<std::int32_t> first(body_.nodes.size(), -1);  // the first of a split node's two bones
        // Keep the file's order, except that parents come first, so that siblings stay in order.
        for (const std::size_t i : order_) {
            if (!wanted_[i]) continue;
            Bone bone{.node = i};
            if (const std::int32_t parent = parent_of(i); parent >= 0) {
                const auto above = static_cast<std::size_t>(parent);
                bone.parent = is_apart(body_.nodes[i]) ? first[above] : body_.bone_of[above];
            }
            first[i] = body_.bone_of[i] = add(bone);
            if (body_.is_split[i]) body_.bone_of[i] = add({i, first[i], true});
        }
    }
    std::int32_t add(const Bone& bone) {
        if (body_.bones.size() >= humanoid::Skeleton::max_nodes)
            throw std::runtime_error("has more than " + std::to_string(humanoid::Skeleton::max_nodes) +
                                     " nodes");
        body_.bones.push_back(bone);
        return static_cast<std::int32_t>(body_.bones.size()) - 1;
    }

    const Objects& objects_;
    const std::vector<Stack>& stacks_;
    Body body_{};
    std::vector<std::size_t> order_{};
    std::vector<bool> no_body_{}, is_bone_{}, wanted_{};
};

}  // namespace

bool is_apart(const Node& node) {
    return node.parent >= 0 && node.inherit != Inherit::Normal;
}

std::vector<std::size_t> Body::scale_chain(std::size_t node) const {
    std::vector<std::size_t> chain{node};
    while (is_apart(nodes[chain.back()]))
        chain.push_back(static_cast<std::size_t>(nodes[chain.back()].parent));
    return chain;
}

Body choose_body(const Objects& objects, std::vector<Node> nodes, const std::vector<Stack>& stacks) {
    if (nodes.empty()) throw std::runtime_error("has no skeleton");
    return BodyChooser(objects, std::move(nodes), stacks).choose();
}

}  // namespace tendril::app::fbx
