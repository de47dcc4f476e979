#include <imgui.h>

#include <glm/vec2.hpp>
#include <vector>

#include "app/labs/chain/panels.hpp"

namespace tendril::app {
namespace {

/// What a mode does, in a box of 3 by 1: the joints from head to tail, the one that goes to the target, and
/// the one that stays, if any.
struct ModePicture {
    std::vector<glm::vec2> joints;
    std::size_t at_target = 0;
    int stays = -1;
};

ModePicture picture_of(ChainMode mode) {
    switch (mode) {
        case ChainMode::Forward:
            return {{{2.7f, 0.25f}, {1.9f, 0.45f}, {1.1f, 0.6f}, {0.3f, 0.65f}}, 0};
        case ChainMode::Backward:
            return {{{0.3f, 0.65f}, {1.1f, 0.6f}, {1.9f, 0.45f}, {2.7f, 0.25f}}, 3};
        case ChainMode::Fixed:
            return {{{2.6f, 0.45f}, {1.9f, 0.1f}, {1.1f, 0.25f}, {0.5f, 0.8f}}, 0, 3};
        case ChainMode::WithIndex:
            return {{{0.4f, 0.85f}, {0.9f, 0.45f}, {1.5f, 0.15f}, {2.1f, 0.45f}, {2.6f, 0.85f}}, 2};
        case ChainMode::Reach:
            break;
    }
    return {{{0.5f, 0.8f}, {1.1f, 0.25f}, {1.9f, 0.1f}, {2.6f, 0.45f}}, 3, 0};
}

}  // namespace

void draw_mode(ChainMode mode, const Palette& colours) {
    const float high = ImGui::GetTextLineHeight(), wide = 3.0f * high;
    const ImVec2 low = ImGui::GetItemRectMin(), top = ImGui::GetItemRectMax();
    const float right = ImGui::GetWindowPos().x + ImGui::GetWindowContentRegionMax().x;
    if (right - wide < top.x + 0.5f * high) return;  // the words come first
    const ImVec2 corner{right - wide, 0.5f * (low.y + top.y) - 0.5f * high};
    const auto at = [&](glm::vec2 place) {
        return ImVec2(corner.x + place.x * high, corner.y + place.y * high);
    };
    const auto ink = [](glm::vec3 colour) {
        return ImGui::ColorConvertFloat4ToU32({colour.r, colour.g, colour.b, 1.0f});
    };
    const ModePicture picture = picture_of(mode);
    ImDrawList* list = ImGui::GetWindowDrawList();
    const float unit = high / 15.0f;
    for (std::size_t i = 1; i < picture.joints.size(); ++i)
        list->AddLine(at(picture.joints[i - 1]), at(picture.joints[i]), ink(colours.neutral), 1.5f * unit);
    for (std::size_t i = 0; i < picture.joints.size(); ++i) {
        const bool head = i == 0, tail = i + 1 == picture.joints.size();
        const glm::vec3 colour = head ? colours.head : tail ? colours.tail : colours.joint;
        list->AddCircleFilled(at(picture.joints[i]), (head || tail ? 2.6f : 2.0f) * unit, ink(colour), 12);
    }
    list->AddCircle(at(picture.joints[picture.at_target]), 4.8f * unit, ink(colours.target), 16, 1.5f * unit);
    if (picture.stays < 0) return;
    const ImVec2 foot = at(picture.joints[static_cast<std::size_t>(picture.stays)]);
    list->AddLine({foot.x - 5.0f * unit, foot.y + 4.0f * unit}, {foot.x + 5.0f * unit, foot.y + 4.0f * unit},
                  ink(colours.text_dim), 1.5f * unit);
}

}  // namespace tendril::app
