// The visible contents of an FBX file: its meshes as triangles, their materials, and their deformation by
// bones and blend shapes.
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "app/io/character/fbx/body.hpp"
#include "app/io/character/fbx/record.hpp"
#include "app/io/character/skin.hpp"

namespace tendril::app::fbx {

/// Triangles with one material. Corners with the same point, normal and texture coordinate are merged.
struct MeshPart {
    std::int64_t material = 0;                      ///< index among the model's
    std::vector<std::uint32_t> points{};            ///< for each corner, the geometry's point
    std::vector<glm::vec3> positions{}, normals{};  ///< one per corner; normals may be empty
    std::vector<glm::vec2> uvs{};                   ///< one per corner, v from the bottom; or empty
    std::vector<std::uint32_t> indices{};
};

struct Mesh {
    std::size_t points = 0;
    std::vector<MeshPart> parts{};
};

/// `geometry` has the records Vertices and PolygonVertexIndex. Throws std::runtime_error for a polygon with
/// points that do not exist; layers that do not fit are left out.
Mesh read_mesh(const Record& geometry);

/// The materials of a file: a colour, or a picture that is embedded in the file.
class Materials {
  public:
    /// Pictures are added to `builder`.
    Materials(const Objects& objects, SkinBuilder& builder) : objects_(objects), builder_(builder) {}

    /// The materials of a model, in the order in which its polygons index them.
    std::vector<std::size_t> of(std::size_t model) const;
    SkinPart look(std::size_t material);
    /// A picture on the model itself, as in version 6; -1: none.
    std::int32_t picture_on(std::size_t model);
    /// Names of pictures that are not in the file, or neither PNG nor JPEG.
    const std::set<std::string>& missing() const { return missing_; }

  private:
    std::int32_t picture(std::size_t texture);

    const Objects& objects_;
    SkinBuilder& builder_;
    std::map<std::size_t, SkinPart> looks_{};
    std::map<std::size_t, std::int32_t> pictures_{};
    std::set<std::string> missing_{};
};

/// A blend shape channel and its morph in the skin; one for each material of its mesh.
struct MorphChannel {
    std::size_t object = 0;
    double percent = 0.0;  ///< if not animated
    std::size_t morph = 0;
};

struct SkinOfFile {
    Skin skin{};
    std::vector<MorphChannel> morphs{};
};

/// `scale` is metres per unit of the file. Meshes without a skin follow the nearest ancestor in the skeleton;
/// those without one are omitted. Appends sentences to `notes`. Throws std::runtime_error.
SkinOfFile read_skin(const Objects& objects, const Body& body, double scale, std::vector<std::string>& notes);

}  // namespace tendril::app::fbx
