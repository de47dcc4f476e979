#include "app/io/character/gltf_skin.hpp"

#include <algorithm>
#include <cmath>
#include <glm/vec2.hpp>
#include <map>
#include <set>
#include <stdexcept>
#include <string_view>

#include "app/io/character/gltf_bytes.hpp"
#include "app/io/text.hpp"
#include "tendril/elementary.hpp"

namespace tendril::app {
namespace {

using humanoid::Placement;
using Values = std::vector<double>;

std::string indexed(const char* list, std::size_t index) {
    return std::string(list) + '[' + std::to_string(index) + ']';
}
template <class T>
const T* at(const std::vector<T>& list, int index) {
    return index >= 0 && static_cast<std::size_t>(index) < list.size()
               ? &list[static_cast<std::size_t>(index)]
               : nullptr;
}

std::vector<glm::vec3> vectors(const Values& rows) {
    std::vector<glm::vec3> result(rows.size() / 3);
    for (std::size_t i = 0; i < result.size(); ++i)
        result[i] = glm::vec3(rows[3 * i], rows[3 * i + 1], rows[3 * i + 2]);
    return result;
}

/// Shown in place of a picture that cannot be read.
constexpr float missing_picture_grey = 0.55f;

/// KHR_texture_transform (Khronos): the texture coordinates of a texture, and their transform.
struct TextureTransform {
    int set = 0;  ///< TEXCOORD_0
    glm::dvec2 offset{0.0}, scale{1.0};
    double rotation = 0.0;  ///< radians

    explicit TextureTransform(const tinygltf::TextureInfo& texture) : set(texture.texCoord) {
        const auto found = texture.extensions.find("KHR_texture_transform");
        if (found == texture.extensions.end() || !found->second.IsObject()) return;
        const tinygltf::Value& given = found->second;
        const auto number = [](const tinygltf::Value& value, double& to) {
            if (value.IsNumber() && std::abs(value.GetNumberAsDouble()) <= 1e6)
                to = value.GetNumberAsDouble();
        };
        for (int i = 0; i < 2; ++i) {
            if (given.Has("offset") && given.Get("offset").IsArray())
                number(given.Get("offset").Get(i), offset[i]);
            if (given.Has("scale") && given.Get("scale").IsArray())
                number(given.Get("scale").Get(i), scale[i]);
        }
        if (given.Has("rotation")) number(given.Get("rotation"), rotation);
        if (given.Has("texCoord") && given.Get("texCoord").IsInt())
            set = given.Get("texCoord").GetNumberAsInt();
    }
    /// Counterclockwise as seen in the picture, where v points down.
    glm::dvec2 applied(double u, double v) const {
        const double c = math::cosine(rotation), s = math::sine(rotation), x = scale.x * u, y = scale.y * v;
        return {offset.x + c * x + s * y, offset.y - s * x + c * y};
    }
};

class GltfSkinReader {
  public:
    GltfSkinReader(const tinygltf::Model& model, const GltfNodes& nodes, const std::vector<Placement>& local,
                   DroppedKeys& dropped, std::vector<std::string>& notes)
        : model_(model), nodes_(nodes), local_(local), dropped_(dropped), notes_(notes) {}

    Skin read() {
        for (std::size_t i = 0; i < model_.nodes.size(); ++i)
            if (model_.nodes[i].mesh >= 0) add_node(i);
        Skin skin = builder_.finish();
        if (skin.mesh)
            for (std::size_t i = 0; i < model_.animations.size(); ++i)
                skin.morph_clips.push_back(morph_clip(i));
        for (const std::string& extension : packed_)
            notes_.push_back("Meshes compressed with " + extension + " cannot be read and are left out.");
        if (!lost_.empty()) notes_.push_back(lost_text());
        return skin;
    }

  private:
    /// The joints that move a mesh: those of its skin, from `first` in the builder's list, or a single one.
    struct Binding {
        std::size_t first = 0, count = 1;
    };

    void add_node(std::size_t index) {
        const tinygltf::Node& node = model_.nodes[index];
        const std::string what = indexed("nodes", index);
        const tinygltf::Mesh* mesh = at(model_.meshes, node.mesh);
        if (!mesh) throw std::runtime_error(what + ": there is no mesh " + std::to_string(node.mesh));
        std::vector<std::size_t> readable;
        for (std::size_t i = 0; i < mesh->primitives.size(); ++i) {
            if (const char* extension = compression_of(mesh->primitives[i]))
                packed_.insert(extension);
            else
                readable.push_back(i);
        }
        if (readable.empty()) return;
        Binding binding;
        if (node.skin >= 0)
            binding = skin_binding(node.skin, what);
        else if (!rigid_binding(index, binding))
            return;
        for (const std::size_t i : readable) {
            const std::string place =
                indexed("meshes", static_cast<std::size_t>(node.mesh)) + '.' + indexed("primitives", i);
            const std::size_t morphs = add_primitive(mesh->primitives[i], binding, node.skin >= 0, place);
            add_morphs(*mesh, mesh->primitives[i], node, index, morphs, place);
        }
    }
    /// The extension that compresses the primitive, if it has no plain copy; else null.
    const char* compression_of(const tinygltf::Primitive& primitive) const {
        constexpr const char* draco = "KHR_draco_mesh_compression";
        if (primitive.extensions.count(draco))
            if (const int* position = attribute(primitive.attributes, "POSITION");
                position && at(model_.accessors, *position) &&
                at(model_.accessors, *position)->bufferView < 0)
                return draco;
        if (const char* name = compression(model_, primitive.indices)) return name;
        for (const auto& [name, accessor] : primitive.attributes)
            if (const char* extension = compression(model_, accessor)) return extension;
        for (const auto& target : primitive.targets)
            for (const auto& [name, accessor] : target)
                if (const char* extension = compression(model_, accessor)) return extension;
        return nullptr;
    }
    Binding skin_binding(int index, const std::string& what) {
        if (const auto known = skins_.find(index); known != skins_.end()) return known->second;
        const tinygltf::Skin* skin = at(model_.skins, index);
        if (!skin) throw std::runtime_error(what + ": there is no skin " + std::to_string(index));
        const std::string place = indexed("skins", static_cast<std::size_t>(index));
        Values matrices;
        if (skin->inverseBindMatrices >= 0) {
            matrices = accessor_rows(model_, skin->inverseBindMatrices, 16, place + ".inverseBindMatrices");
            if (matrices.size() < 16 * skin->joints.size())
                throw std::runtime_error(place + ": " + std::to_string(skin->joints.size()) +
                                         " joints but fewer inverse bind matrices");
        }
        Binding binding{0, skin->joints.size()};
        if (skin->joints.empty()) throw std::runtime_error(place + " has no joints");
        for (std::size_t i = 0; i < skin->joints.size(); ++i) {
            Placement inverse;
            for (std::size_t c = 0; !matrices.empty() && c < 4; ++c)
                for (std::size_t r = 0; r < 3; ++r) {
                    const double value = matrices[16 * i + 4 * c + r];
                    if (!(std::abs(value) <= 1e9))
                        throw std::runtime_error(place + ".inverseBindMatrices, row " + std::to_string(i) +
                                                 ": a number that is not finite or over 1e9");
                    const auto row = static_cast<int>(r);
                    (c < 3 ? inverse.axes[static_cast<int>(c)][row] : inverse.position[row]) = value;
                }
            const auto joint = static_cast<std::size_t>(skin->joints[i]);  // Reader::choose() checked it
            const std::size_t added =
                builder_.add_joint(static_cast<std::size_t>(nodes_.place[joint]), inverse);
            if (i == 0) binding.first = added;
        }
        skins_[index] = binding;
        return binding;
    }
    /// Binds to the nearest ancestor in the skeleton. False if there is none: the mesh is not part of the
    /// character.
    bool rigid_binding(std::size_t index, Binding& binding) {
        Placement from_bind;
        std::size_t node = index, steps = 0;
        while (nodes_.place[node] < 0) {
            if (++steps > nodes_.place.size())
                throw std::runtime_error(indexed("nodes", index) + " is below itself");
            from_bind = local_[node] * from_bind;
            if (nodes_.parents[node] < 0) return false;
            node = static_cast<std::size_t>(nodes_.parents[node]);
        }
        binding.first = builder_.add_joint(static_cast<std::size_t>(nodes_.place[node]), from_bind);
        return true;
    }

    const int* attribute(const std::map<std::string, int>& attributes, const std::string& name) const {
        const auto found = attributes.find(name);
        return found == attributes.end() ? nullptr : &found->second;
    }
    Values rows(const std::map<std::string, int>& attributes, const std::string& name, int components,
                std::size_t count, const std::string& what) const {
        const int* accessor = attribute(attributes, name);
        if (!accessor) return {};
        check_size(*accessor, what + '.' + name);
        Values result = accessor_rows(model_, *accessor, components, what + '.' + name);
        if (count > 0 && result.size() != count * static_cast<std::size_t>(components))
            throw std::runtime_error(what + '.' + name + ": " +
                                     std::to_string(result.size() / static_cast<std::size_t>(components)) +
                                     " rows, POSITION has " + std::to_string(count));
        return result;
    }
    /// Checks the size before allocating memory.
    void check_size(int accessor, const std::string& what) const {
        if (accessor_count(model_, accessor, what) > SkinBuilder::max_corners)
            throw std::runtime_error(what + ": more than " + std::to_string(SkinBuilder::max_corners) +
                                     " rows");
    }

    /// Returns the number of morphs before this primitive's.
    std::size_t add_primitive(const tinygltf::Primitive& primitive, const Binding& binding, bool is_skinned,
                              const std::string& what) {
        SkinBuilder::Corners corners;
        corners.positions = vectors(rows(primitive.attributes, "POSITION", 3, 0, what));
        const std::size_t count = corners.positions.size();
        std::vector<std::uint32_t> indices = triangles(primitive, count, what);
        corners.normals = vectors(rows(primitive.attributes, "NORMAL", 3, count, what));
        corners.tints = tints(primitive, count, what);
        corners.only_joint = binding.first;
        if (is_skinned) read_influences(primitive, binding, count, what, corners);
        SkinPart part = material(primitive.material, primitive, count, what, corners);
        builder_.add_part(what, std::move(corners), std::move(indices), part);
        return morphs_;
    }
    std::vector<std::uint32_t> triangles(const tinygltf::Primitive& primitive, std::size_t corners,
                                         const std::string& what) const {
        std::vector<std::uint32_t> list, result;
        if (primitive.indices >= 0) {
            if (accessor_count(model_, primitive.indices, what + ".indices") > SkinBuilder::max_indices)
                throw std::runtime_error(what + ".indices: too many");
            for (const double each : accessor_rows(model_, primitive.indices, 1, what + ".indices")) {
                if (!(each >= 0.0 && each < static_cast<double>(corners)))
                    throw std::runtime_error(what + ".indices: there is no vertex " + std::to_string(each) +
                                             ", it has " + std::to_string(corners));
                list.push_back(static_cast<std::uint32_t>(each));
            }
        } else {
            for (std::size_t i = 0; i < corners; ++i) list.push_back(static_cast<std::uint32_t>(i));
        }
        const bool strip = primitive.mode == TINYGLTF_MODE_TRIANGLE_STRIP;
        const bool fan = primitive.mode == TINYGLTF_MODE_TRIANGLE_FAN;
        if (!strip && !fan) {
            if (primitive.mode != TINYGLTF_MODE_TRIANGLES) return {};
            list.resize(list.size() / 3 * 3);
            return list;
        }
        for (std::size_t i = 2; i < list.size(); ++i) {
            const std::size_t a = fan ? 0 : i - 2 + i % 2, b = fan ? i - 1 : i - 1 - i % 2;
            result.insert(result.end(), {list[a], list[b], list[i]});
        }
        return result;
    }
    std::vector<glm::u8vec4> tints(const tinygltf::Primitive& primitive, std::size_t count,
                                   const std::string& what) const {
        const int* accessor = attribute(primitive.attributes, "COLOR_0");
        if (!accessor || !at(model_.accessors, *accessor)) return {};
        const bool has_alpha = at(model_.accessors, *accessor)->type == TINYGLTF_TYPE_VEC4;
        const std::size_t width = has_alpha ? 4 : 3;
        const Values values = rows(primitive.attributes, "COLOR_0", static_cast<int>(width), count, what);
        std::vector<glm::u8vec4> result(count);
        for (std::size_t i = 0; i < count; ++i) {
            const double* row = &values[i * width];
            const glm::vec3 shown = shown_colour(glm::vec3(row[0], row[1], row[2]));
            const double alpha = has_alpha ? std::clamp(row[3], 0.0, 1.0) : 1.0;
            result[i] = glm::u8vec4(glm::vec4(shown, alpha) * 255.0f + 0.5f);
        }
        return result;
    }
    void read_influences(const tinygltf::Primitive& primitive, const Binding& binding, std::size_t count,
                         const std::string& what, SkinBuilder::Corners& corners) const {
        corners.influences.resize(count);
        for (int set = 0; attribute(primitive.attributes, "JOINTS_" + std::to_string(set)); ++set) {
            const std::string number = std::to_string(set);
            const Values joints = rows(primitive.attributes, "JOINTS_" + number, 4, count, what);
            const Values weights = rows(primitive.attributes, "WEIGHTS_" + number, 4, count, what);
            if (weights.empty()) throw std::runtime_error(what + ": JOINTS_" + number + " without WEIGHTS");
            for (std::size_t i = 0; i < 4 * count; ++i) {
                if (!(weights[i] > 0.0)) continue;
                if (!(joints[i] < static_cast<double>(binding.count)))
                    throw std::runtime_error(what + ".JOINTS_" + number + ": there is no joint " +
                                             std::to_string(static_cast<long long>(joints[i])) +
                                             ", the skin has " + std::to_string(binding.count));
                corners.influences[i / 4].push_back(
                    {binding.first + static_cast<std::size_t>(joints[i]), std::min(weights[i], 1e6)});
            }
        }
    }

    SkinPart material(int index, const tinygltf::Primitive& primitive, std::size_t count,
                      const std::string& what, SkinBuilder::Corners& corners) {
        SkinPart part;
        const tinygltf::Material* material = at(model_.materials, index);
        if (!material) return part;
        const auto& base = material->pbrMetallicRoughness;
        if (base.baseColorFactor.size() == 4) {
            const auto& c = base.baseColorFactor;
            part.colour = glm::vec4(shown_colour(glm::vec3(c[0], c[1], c[2])), 1.0f);
        }
        if (material->alphaMode == "MASK") part.cutoff = static_cast<float>(material->alphaCutoff);
        if (material->alphaMode == "BLEND") part.cutoff = 0.3f;
        if (!at(model_.textures, base.baseColorTexture.index)) return part;
        part.picture = picture(base.baseColorTexture.index);
        if (part.picture < 0) {
            part.colour = glm::vec4(missing_picture_grey, missing_picture_grey, missing_picture_grey, 1.0f);
            return part;
        }
        const TextureTransform transform(base.baseColorTexture);
        const Values values =
            rows(primitive.attributes, "TEXCOORD_" + std::to_string(transform.set), 2, count, what);
        for (std::size_t i = 0; i + 1 < values.size(); i += 2)
            corners.uvs.push_back(glm::vec2(transform.applied(values[i], values[i + 1])));
        if (values.empty()) part.picture = -1;
        return part;
    }
    /// Index of a texture's picture; -1 if it cannot be read.
    std::int32_t picture(int index) {
        const tinygltf::Texture& texture = model_.textures[static_cast<std::size_t>(index)];
        const int source = source_of(texture);
        const auto [known, is_new] = pictures_.emplace(source, -1);
        if (!is_new) return known->second;
        const tinygltf::Image* image = at(model_.images, source);
        const std::string_view bytes = image ? picture_bytes(model_, *image) : std::string_view();
        known->second = builder_.add_picture(bytes);
        if (known->second < 0) lost_.push_back(lost_picture(image, source, bytes));
        return known->second;
    }
    /// The texture's image or, if it has none, an extension's, as with KTX2 and WebP.
    static int source_of(const tinygltf::Texture& texture) {
        if (texture.source >= 0) return texture.source;
        for (const auto& [name, value] : texture.extensions)
            if (value.Has("source") && value.Get("source").IsInt())
                return value.Get("source").GetNumberAsInt();
        return -1;
    }
    /// "skin.ktx2 (KTX2)", "skin.png (missing)", "skin.png (PNG, one picture too many)"
    std::string lost_picture(const tinygltf::Image* image, int index, std::string_view bytes) const {
        const std::string name = !image ? std::string() : !image->uri.empty() ? image->uri : image->name;
        const std::string_view kind = picture_kind(bytes);
        const std::string why = bytes.empty() ? "missing" : kind.empty() ? "unknown kind" : std::string(kind);
        return printable(name.empty() ? indexed("images", static_cast<std::size_t>(std::max(index, 0)))
                                      : name.substr(0, 60)) +
               " (" + why +
               (kind != "PNG" && kind != "JPEG" ? ""
                : builder_.pictures_are_full()  ? ", one picture too many"
                                                : ", broken") +
               ')';
    }
    std::string lost_text() const {
        std::string text = "Gray, because a picture cannot be read: ";
        constexpr std::size_t named = 3;
        for (std::size_t i = 0; i < std::min(lost_.size(), named); ++i)
            text += (i > 0 ? ", " : "") + lost_[i];
        if (lost_.size() > named) text += " and " + std::to_string(lost_.size() - named) + " more";
        return text + '.';
    }

    void add_morphs(const tinygltf::Mesh& mesh, const tinygltf::Primitive& primitive,
                    const tinygltf::Node& node, std::size_t index, std::size_t first,
                    const std::string& what) {
        for (std::size_t i = 0; i < primitive.targets.size(); ++i) {
            const std::string place = what + '.' + indexed("targets", i);
            const std::vector<double>& own = node.weights.empty() ? mesh.weights : node.weights;
            const double weight = i < own.size() && std::abs(own[i]) <= 1e3 ? own[i] : 0.0;
            std::string name = "morph_" + std::to_string(i);
            if (mesh.extras.IsObject() && mesh.extras.Has("targetNames")) {
                const tinygltf::Value& names = mesh.extras.Get("targetNames");
                const int place_in_list = static_cast<int>(i);
                if (names.IsArray() && i < names.ArrayLen() && names.Get(place_in_list).IsString())
                    name = names.Get(place_in_list).Get<std::string>();
            }
            morph_corners_ += builder_.corners();
            if (morph_corners_ > 20 * SkinBuilder::max_corners)
                throw std::runtime_error(place + ": too many morphs");
            builder_.add_morph(place, name, weight,
                               vectors(rows(primitive.targets[i], "POSITION", 3, 0, place)),
                               vectors(rows(primitive.targets[i], "NORMAL", 3, 0, place)));
            ++morphs_;
        }
        if (!primitive.targets.empty()) morphed_[index].push_back({first, primitive.targets.size()});
    }
    std::vector<MorphTrack> morph_clip(std::size_t index) {
        std::vector<MorphTrack> tracks;
        const tinygltf::Animation& animation = model_.animations[index];
        for (std::size_t i = 0; i < animation.channels.size(); ++i) {
            const tinygltf::AnimationChannel& channel = animation.channels[i];
            if (channel.target_path != "weights" || channel.target_node < 0) continue;
            const std::string what = indexed("animations", index) + '.' + indexed("channels", i);
            const tinygltf::AnimationSampler* sampler = at(animation.samplers, channel.sampler);
            if (!sampler)
                throw std::runtime_error(what + ": there is no sampler " + std::to_string(channel.sampler));
            const auto found = morphed_.find(static_cast<std::size_t>(channel.target_node));
            if (found == morphed_.end()) continue;
            for (const auto& [first, count] : found->second)
                tracks.push_back(morph_track(*sampler, first, count, what));
        }
        return tracks;
    }
    MorphTrack morph_track(const tinygltf::AnimationSampler& sampler, std::size_t first, std::size_t count,
                           const std::string& what) {
        MorphTrack track{.first = first, .count = count};
        if (sampler.interpolation == "STEP") track.interpolation = humanoid::Interpolation::Step;
        if (sampler.interpolation == "CUBICSPLINE") track.interpolation = humanoid::Interpolation::Cubic;
        const std::size_t each = track.interpolation == humanoid::Interpolation::Cubic ? 3 * count : count;
        keys_ += accessor_count(model_, sampler.input, what) + accessor_count(model_, sampler.output, what);
        if (keys_ > 10'000'000) throw std::runtime_error(what + ": too many morph keys");
        track.times = accessor_rows(model_, sampler.input, 1, what + ".input");
        track.values = accessor_rows(model_, sampler.output, 1, what + ".output");
        if (track.times.empty() || track.values.size() != track.times.size() * each)
            throw std::runtime_error(what + ": " + std::to_string(track.times.size()) + " times and " +
                                     std::to_string(track.values.size()) + " weights of " +
                                     std::to_string(count) + " morphs");
        const bool any = dropped_.any();
        drop_bad_keys(
            track.times, track.values, track.interpolation, [](std::size_t) { return false; }, dropped_);
        if (!any) dropped_.first = "the weights of " + what;
        for (std::size_t i = 0; i < track.times.size(); ++i)
            if (!(track.times[i] >= 0.0 && track.times[i] <= 1e9) ||
                (i > 0 && !(track.times[i] > track.times[i - 1])))
                throw std::runtime_error(what + ": time " + std::to_string(i) +
                                         " is not after the one before it");
        for (double& value : track.values)
            if (!(std::abs(value) <= 1e6))
                throw std::runtime_error(what + ": a weight is not finite or over 1e6");
        return track;
    }

    const tinygltf::Model& model_;
    const GltfNodes& nodes_;
    const std::vector<Placement>& local_;
    DroppedKeys& dropped_;
    std::vector<std::string>& notes_;
    SkinBuilder builder_{};
    std::map<int, Binding> skins_{};
    std::map<int, std::int32_t> pictures_{};
    std::map<std::size_t, std::vector<std::pair<std::size_t, std::size_t>>> morphed_{};  // by node
    std::size_t morphs_ = 0, morph_corners_ = 0, keys_ = 0;
    std::set<std::string> packed_{};   // extensions that compress meshes
    std::vector<std::string> lost_{};  // pictures
};

}  // namespace

Skin gltf_skin(const tinygltf::Model& model, const GltfNodes& nodes, const std::vector<Placement>& local,
               DroppedKeys& dropped, std::vector<std::string>& notes) {
    return GltfSkinReader(model, nodes, local, dropped, notes).read();
}

}  // namespace tendril::app
