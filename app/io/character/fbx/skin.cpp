#include "app/io/character/fbx/surface.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <stdexcept>

namespace tendril::app::fbx {
namespace {

using humanoid::Placement;

/// Limit for all lists of weights and shapes together: one can belong to many meshes.
constexpr std::size_t max_deformed = 100'000'000;

Placement placement_in(const std::vector<double>& m) {
    Placement result;
    for (int c = 0; c < 3; ++c)
        for (int r = 0; r < 3; ++r) result.axes[c][r] = m[static_cast<std::size_t>(4 * c + r)];
    result.position = {m[12], m[13], m[14]};
    return result;
}
bool is_usable(const Placement& placement) {
    const auto fits = [](const glm::dvec3& v) {
        return std::abs(v.x) <= 1e9 && std::abs(v.y) <= 1e9 && std::abs(v.z) <= 1e9;
    };
    return fits(placement.axes[0]) && fits(placement.axes[1]) && fits(placement.axes[2]) &&
           fits(placement.position);
}
Placement inverse(const Placement& placement) {
    const glm::dmat3 axes = glm::inverse(placement.axes);
    return {axes, -(axes * placement.position)};
}

class SkinReader {
  public:
    SkinReader(const Objects& objects, const Body& body, double scale, std::vector<std::string>& notes)
        : objects_(objects), body_(body), scale_(scale), notes_(notes), materials_(objects, builder_) {
        std::vector<rig::Transform> locals;
        for (const Node& node : body.nodes) locals.push_back(local_of(node, node.rest()));
        for (const Place& each : places(body.nodes, locals)) rest_.push_back(each.placement());
        node_of_.assign(objects.size(), -1);
        for (std::size_t i = 0; i < body.nodes.size(); ++i)
            node_of_[body.nodes[i].object] = static_cast<std::int32_t>(i);
    }

    SkinOfFile read() {
        for (std::size_t i = 0; i < objects_.size(); ++i) {
            if (!objects_[i].record->child("PolygonVertexIndex")) continue;
            // Version 6 has the mesh in its model, version 7 in a geometry that models can share.
            std::vector<std::size_t> models;
            if (node_of_[i] >= 0) models.push_back(static_cast<std::size_t>(node_of_[i]));
            for (const Connection& each : objects_.parents(i))
                if (objects_[i].kind == "Geometry" && node_of_[each.object] >= 0)
                    models.push_back(static_cast<std::size_t>(node_of_[each.object]));
            if (models.empty()) continue;
            const Mesh mesh = read_mesh(*objects_[i].record);
            for (const std::size_t model : models) add_mesh(mesh, i, model);
        }
        for (const std::string& name : materials_.missing())
            notes_.push_back("The texture " + name +
                             " is not in the file as PNG or JPEG, so a plain colour is drawn.");
        if (builder_.pictures_are_full())
            notes_.push_back("The file has too many pictures; the last ones are drawn as a plain colour.");
        result_.skin = builder_.finish();
        return std::move(result_);
    }

  private:
    using Influences = std::vector<std::vector<std::pair<std::size_t, double>>>;

    void count(std::size_t numbers) {
        deformed_ += numbers;
        if (deformed_ > max_deformed) throw std::runtime_error("its skins have too many weights");
    }
    std::size_t add_joint(std::int32_t bone, Placement from_bind) {
        from_bind.axes *= scale_;
        from_bind.position *= scale_;
        return builder_.add_joint(static_cast<std::size_t>(bone), from_bind);
    }

    /// The weights of all clusters, by point. Empty if none belongs to a node of the skeleton.
    Influences influences(const Mesh& mesh, std::size_t geometry, std::size_t model, std::size_t& joint) {
        Influences result;
        for (const Connection& skin : objects_.children(geometry)) {
            if (objects_[skin.object].kind != "Deformer" || objects_[skin.object].subtype != "Skin") continue;
            for (const Connection& cluster : objects_.children(skin.object))
                if (objects_[cluster.object].subtype == "Cluster")
                    add_cluster(cluster.object, mesh, model, joint, result);
        }
        return result;
    }
    void add_cluster(std::size_t object, const Mesh& mesh, std::size_t model, std::size_t& joint,
                     Influences& result) {
        std::int32_t bone = -1;
        for (const Connection& each : objects_.children(object))
            if (const std::int32_t node = node_of_[each.object]; node >= 0 && bone < 0)
                bone = body_.bone_of[static_cast<std::size_t>(node)];
        if (bone < 0) return;
        const Record& record = *objects_[object].record;
        const std::vector<double> bind = record.numbers_of("Transform"),
                                  at = record.numbers_of("TransformLink");
        Placement from_bind;
        if (bind.size() == 16)
            from_bind = placement_in(bind);
        else if (at.size() == 16)
            from_bind = inverse(placement_in(at)) * rest_[model];
        else
            from_bind = inverse(rest_[body_.bones[static_cast<std::size_t>(bone)].node]) * rest_[model];
        from_bind = from_bind * body_.nodes[model].geometry;
        if (!is_usable(from_bind)) {
            notes_.push_back("The skin of node " + body_.nodes[model].name + " has a singular matrix for " +
                             std::string(objects_[object].name) + ", which is left out.");
            return;
        }
        const std::vector<std::int64_t> points = record.integers_of("Indexes");
        const std::vector<double> weights = record.numbers_of("Weights");
        count(points.size() + weights.size() + mesh.points);
        const std::size_t added = add_joint(bone, from_bind);
        if (result.empty()) joint = added;
        result.resize(mesh.points);
        for (std::size_t i = 0; i < std::min(points.size(), weights.size()); ++i) {
            if (points[i] < 0 || points[i] >= static_cast<std::int64_t>(mesh.points))
                throw std::runtime_error("mesh " + body_.nodes[model].name + ": there is no vertex " +
                                         std::to_string(points[i]));
            if (weights[i] > 0.0 && weights[i] <= 1e6)
                result[static_cast<std::size_t>(points[i])].push_back({added, weights[i]});
        }
    }
    bool rigid_joint(std::size_t model, std::size_t& joint) {
        std::int32_t node = static_cast<std::int32_t>(model);
        while (node >= 0 && body_.bone_of[static_cast<std::size_t>(node)] < 0)
            node = body_.nodes[static_cast<std::size_t>(node)].parent;
        if (node < 0) return false;
        const auto above = static_cast<std::size_t>(node);
        const Placement from_bind = inverse(rest_[above]) * rest_[model] * body_.nodes[model].geometry;
        if (!is_usable(from_bind)) return false;
        joint = add_joint(body_.bone_of[above], from_bind);
        return true;
    }

    void add_mesh(const Mesh& mesh, std::size_t geometry, std::size_t model) {
        std::size_t joint = 0;
        const Influences by_point = influences(mesh, geometry, model, joint);
        if (by_point.empty() && !rigid_joint(model, joint)) return;
        const std::string what = "mesh " + body_.nodes[model].name;
        const std::vector<std::size_t> materials = materials_.of(body_.nodes[model].object);
        for (const MeshPart& part : mesh.parts) {
            if (part.indices.empty()) continue;
            SkinBuilder::Corners corners;
            corners.only_joint = joint;
            corners.positions = part.positions;
            corners.normals = part.normals;
            if (!by_point.empty())
                for (const std::uint32_t point : part.points) corners.influences.push_back(by_point[point]);
            const auto number = static_cast<std::size_t>(std::max<std::int64_t>(part.material, 0));
            SkinPart drawn = number < materials.size() ? materials_.look(materials[number]) : SkinPart();
            if (drawn.picture < 0) drawn.picture = materials_.picture_on(body_.nodes[model].object);
            if (drawn.picture >= 0 && part.uvs.empty()) drawn.picture = -1;
            if (drawn.picture >= 0)
                for (const glm::vec2& uv : part.uvs) corners.uvs.push_back({uv.x, 1.0f - uv.y});
            builder_.add_part(what, std::move(corners), part.indices, drawn);
            add_morphs(mesh, part, geometry, what);
        }
    }

    void add_morphs(const Mesh& mesh, const MeshPart& part, std::size_t geometry, const std::string& what) {
        for (const Connection& shapes : objects_.children(geometry)) {
            if (objects_[shapes.object].subtype != "BlendShape") continue;
            for (const Connection& channel : objects_.children(shapes.object))
                if (objects_[channel.object].subtype == "BlendShapeChannel")
                    add_channel(channel.object, mesh, part, what);
        }
        for (const Record& shape : objects_[geometry].record->children)
            if (shape.name == "Shape")
                add_morph(shape, std::string(plain_name(shape.text(0))), 0.0, mesh, part, what);
    }
    void add_channel(std::size_t channel, const Mesh& mesh, const MeshPart& part, const std::string& what) {
        std::vector<std::size_t> targets;
        for (const Connection& each : objects_.children(channel))
            if (objects_[each.object].kind == "Geometry") targets.push_back(each.object);
        if (targets.empty()) return;
        if (targets.size() > 1 && in_between_.insert(channel).second)
            notes_.push_back("Blend shape " + std::string(objects_[channel].name) +
                             " has shapes in between; only the last is used.");
        const Object& target = objects_[targets.back()];
        const double percent = objects_.number(channel, "DeformPercent", 0.0);
        const std::string name(target.name.empty() ? objects_[channel].name : target.name);
        result_.morphs.push_back(
            {channel, percent, add_morph(*target.record, name, 0.01 * percent, mesh, part, what)});
    }
    std::size_t add_morph(const Record& shape, std::string name, double weight, const Mesh& mesh,
                          const MeshPart& part, const std::string& what) {
        const std::vector<std::int64_t> points = shape.integers_of("Indexes");
        const std::vector<double> moves = shape.numbers_of("Vertices"), turns = shape.numbers_of("Normals");
        count(points.size() + moves.size() + turns.size() + mesh.points + part.points.size());
        std::vector<std::int64_t> row(mesh.points, -1);
        for (std::size_t i = 0; i < std::min(points.size(), moves.size() / 3); ++i)
            if (points[i] >= 0 && points[i] < static_cast<std::int64_t>(mesh.points))
                row[static_cast<std::size_t>(points[i])] = static_cast<std::int64_t>(i);
        const auto listed = [&](const std::vector<double>& from) {
            std::vector<glm::vec3> result(part.points.size(), glm::vec3(0.0f));
            for (std::size_t i = 0; i < result.size(); ++i) {
                const std::int64_t at = row[part.points[i]];
                if (at < 0 || 3 * static_cast<std::size_t>(at) + 2 >= from.size()) continue;
                for (int k = 0; k < 3; ++k)
                    result[i][k] = static_cast<float>(
                        from[3 * static_cast<std::size_t>(at) + static_cast<std::size_t>(k)]);
            }
            return result;
        };
        return builder_.add_morph(what, std::move(name), std::abs(weight) <= 1e3 ? weight : 0.0,
                                  listed(moves), turns.empty() ? std::vector<glm::vec3>() : listed(turns));
    }

    const Objects& objects_;
    const Body& body_;
    double scale_;
    std::vector<std::string>& notes_;
    SkinBuilder builder_{};
    Materials materials_;
    SkinOfFile result_{};
    std::vector<Placement> rest_{};
    std::vector<std::int32_t> node_of_{};
    std::set<std::size_t> in_between_{};
    std::size_t deformed_ = 0;
};

}  // namespace

SkinOfFile read_skin(const Objects& objects, const Body& body, double scale,
                     std::vector<std::string>& notes) {
    return SkinReader(objects, body, scale, notes).read();
}

}  // namespace tendril::app::fbx
