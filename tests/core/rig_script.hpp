// A small interpreter of the Rig lab's commands, as far as the reference files use them: elements, sets, and
// three units that run in order.
#pragma once

#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "rig_support.hpp"
#include "tendril/rig/collect.hpp"
#include "tendril/rig/parent_constraint.hpp"
#include "tendril/rig/transform_units.hpp"

namespace tendril::test {

using Json = nlohmann::json;

inline glm::dvec3 vector_of(const Json& json) {
    return {json.at(0).get<double>(), json.at(1).get<double>(), json.at(2).get<double>()};
}
inline rig::Transform transform_of(const Json& json) {
    const Json& q = json.at("rotation");  // [x, y, z, w]
    return {vector_of(json.at("translation")),
            {q.at(3).get<double>(), q.at(0).get<double>(), q.at(1).get<double>(), q.at(2).get<double>()},
            vector_of(json.at("scale"))};
}

class RigScript {
  public:
    Result command(const Json& json) {
        const std::string name = json.at("command");
        if (name == "rig.element.add") return add(json);
        if (name == "rig.element.set") return set(json);
        if (name == "rig.unit.add") {
            units_.push_back(json);
            return {};
        }
        if (name == "rig.solve") {
            put_back();
            for (const Json& unit : units_) solve(unit, {});
            return {};
        }
        return {ErrorCode::NotFound, "no command is called " + name};
    }
    rig::Transform transform(const std::string& name, const std::string& space) {
        return tree_.get(elements_.at(name), space == "local" ? rig::Space::Local : rig::Space::Global);
    }

  private:
    Result add(const Json& json) {
        const std::string kind = json.at("kind");
        const rig::ElementId parent =
            json.contains("parent") ? elements_.at(json["parent"].get<std::string>()) : rig::ElementId{};
        const auto id = tree_.add(kind == "bone"      ? rig::ElementKind::Bone
                                  : kind == "control" ? rig::ElementKind::Control
                                                      : rig::ElementKind::Null,
                                  parent, transform_of(json.at("local")));
        if (id) elements_[json.at("name")] = *id;
        return id.error();
    }
    Result set(const Json& json) {
        const bool local = json.at("space") == "local", propagate = json.at("propagate");
        return tree_.set(elements_.at(json.at("name").get<std::string>()),
                         local ? rig::Space::Local : rig::Space::Global, transform_of(json.at("transform")),
                         propagate ? rig::Propagate::Yes : rig::Propagate::No);
    }
    /// Solving twice equals solving once: the first solve saves the input pose.
    void put_back() {
        if (!input_) input_ = tree_;
        tree_ = *input_;
    }
    void solve(const Json& unit, rig::ElementId each) {
        const std::string name = unit.at("unit");
        if (name == "for_each") return for_each(unit);
        const rig::ElementId item =
            unit.at("item").is_string() ? elements_.at(unit["item"].get<std::string>()) : each;
        if (name == "offset_transform") {
            const rig::Transform now = tree_.get(item, rig::Space::Global);
            tree_.put(item, rig::Space::Global, rig::offset_transform(now, transform_of(unit.at("offset"))),
                      unit.at("propagate").get<bool>() ? rig::Propagate::Yes : rig::Propagate::No);
        } else if (name == "parent_constraint") {
            constrain(unit, item);
        } else {
            ADD_FAILURE() << "no unit is called " << name;
        }
    }
    void for_each(const Json& unit) {
        for (const std::string root : unit.at("roots")) {
            std::vector<rig::ElementId> items;
            EXPECT_TRUE(rig::collect_children(tree_, elements_.at(root),
                                              {unit.at("include_parent"), unit.at("recursive")}, items)
                            .ok());
            for (const rig::ElementId each : items)
                for (const Json& inner : unit.at("body")) solve(inner, each);
        }
    }
    void constrain(const Json& unit, rig::ElementId item) {
        using enum rig::Space;
        rig::ParentConstraintOptions options{.maintain_offset = unit.at("maintain_offset")};
        const Json filter = unit.value("filter", Json::object());
        for (std::size_t axis = 0; axis < 3; ++axis) {
            if (filter.contains("translation"))
                options.filter.translation[axis] = filter["translation"][axis];
            if (filter.contains("rotation")) options.filter.rotation[axis] = filter["rotation"][axis];
            if (filter.contains("scale")) options.filter.scale[axis] = filter["scale"][axis];
        }
        std::vector<rig::ConstraintParent> parents;
        for (const Json& parent : unit.at("parents")) {
            const rig::ElementId id = elements_.at(parent.at("item").get<std::string>());
            parents.push_back(
                {tree_.get(id, Global), tree_.get(id, Global, rig::Pose::Initial), parent.at("weight")});
        }
        const rig::ElementId above = tree_.parent(item);
        const rig::ConstraintChild child{tree_.get(item, Global), tree_.get(item, Global, rig::Pose::Initial),
                                         above ? tree_.get(above, Global) : rig::Transform{}};
        tree_.put(item, Global, rig::parent_constraint(child, parents, options));
    }

    rig::Hierarchy tree_;
    std::optional<rig::Hierarchy> input_;
    std::map<std::string, rig::ElementId> elements_;
    std::vector<Json> units_;
};

}  // namespace tendril::test
