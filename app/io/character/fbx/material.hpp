// The materials of an FBX file: a colour, or a picture that is embedded in the file.
#pragma once

#include <map>
#include <set>

#include "app/io/character/fbx/objects.hpp"
#include "app/io/character/skin.hpp"

namespace tendril::app::fbx {

class Materials {
  public:
    /// Pictures are added to `builder`.
    Materials(const Objects& objects, SkinBuilder& builder) : objects_(objects), builder_(builder) {}

    /// The materials of a model, in the order in which its polygons count them.
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

}  // namespace tendril::app::fbx
