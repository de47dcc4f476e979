#include "tests/app/support/layout_faults.hpp"

#include <imgui_internal.h>

#include <algorithm>
#include <glm/common.hpp>

#include "app/widgets/fonts.hpp"

namespace tendril::test {
namespace {

using app::Rect;

constexpr float slack = 1.5f;  ///< pixels: positions are rounded

Rect shared(const Rect& a, const Rect& b) {
    return {glm::max(a.min, b.min), glm::min(a.max, b.max)};
}
bool seen(const Rect& box) {
    return box.size().x > slack && box.size().y > slack;
}
bool inside(const Rect& box, const Rect& room) {
    return box.min.x >= room.min.x - slack && box.min.y >= room.min.y - slack &&
           box.max.x <= room.max.x + slack && box.max.y <= room.max.y + slack;
}
/// Letters are lower than their lines, so lines may touch.
bool collide(const Rect& a, const Rect& b) {
    const glm::vec2 both = shared(a, b).size();
    return both.x > slack && both.y > 0.3f * std::min(a.size().y, b.size().y);
}

Rect rect_of(const ImRect& rect) {
    return {{rect.Min.x, rect.Min.y}, {rect.Max.x, rect.Max.y}};
}

/// Whether nothing of it is drawn, as with a popup that only measures itself.
bool hidden(const ImGuiWindow* window) {
    return window != nullptr && (!window->Active || window->Hidden || window->SkipItems);
}

/// The window that scrolls the content of `window` vertically, itself or an ancestor; null if none does.
const ImGuiWindow* scroller_of(const ImGuiWindow* window) {
    while (window != nullptr && window->ScrollMax.y <= 0.0f)
        window = (window->Flags & ImGuiWindowFlags_ChildWindow) != 0 ? window->ParentWindow : nullptr;
    return window;
}

/// Whether it is cut off by an edge beyond which the user can scroll.
bool can_be_scrolled_to(const DrawnText& text) {
    for (const ImGuiWindow* window = scroller_of(text.window); window != nullptr;
         window = scroller_of(window->ParentWindow)) {
        const Rect room = rect_of(window->InnerClipRect);
        // A table keeps its title row at its upper edge.
        const float titles = window->Scroll.y > 0.0f ? 2.0f * text.box.size().y : 0.0f;
        const bool above =
            text.box.min.y < room.min.y + titles + slack && text.clip.min.y >= room.min.y - slack;
        const bool below = text.box.max.y > room.max.y - slack && text.clip.max.y <= room.max.y + slack;
        if (above || below) return true;
    }
    return false;
}

/// The close button of a sheet is in its title bar, under which nothing scrolls.
bool in_title_bar(const DrawnItem& item) {
    return (item.window->Flags & ImGuiWindowFlags_NoTitleBar) == 0 &&
           inside(item.box, rect_of(item.window->TitleBarRect()));
}

/// Text in an input field scrolls within it.
bool is_typed(const FrameRecord& frame, const DrawnText& text) {
    return std::any_of(frame.items.begin(), frame.items.end(), [&](const DrawnItem& item) {
        return item.kind == DrawnItem::Kind::Text && inside(text.clip, item.box) && seen(text.clip);
    });
}

/// The visible part of an item.
Rect seen_of(const DrawnItem& item) {
    return shared(item.box, rect_of(item.window->InnerClipRect));
}

LayoutFault fault(const std::string& what, const DrawnText& text) {
    return {what, window_name(text.window), text.text};
}

/// The text that names an item: inside its box, or else nearest on its left.
std::string name_of(const FrameRecord& frame, const DrawnItem& item) {
    const DrawnText* best = nullptr;
    float nearest = 1e9f;
    for (const DrawnText& text : frame.texts) {
        if (text.window != item.window) continue;
        const glm::vec2 away =
            glm::max(glm::max(item.box.min - text.box.max, text.box.min - item.box.max), 0.0f);
        const float distance = away.x + 3.0f * away.y;
        if (distance < nearest) nearest = distance, best = &text;
    }
    return best != nullptr ? best->text : "item " + std::to_string(item.id);
}

}  // namespace

std::string window_name(const ImGuiWindow* window) {
    if (window == nullptr) return "scene";
    std::string name = window->Name;
    for (std::size_t at = name.find('_'); at != name.npos; at = name.find('_', at)) {
        const std::size_t end = std::min(name.find('/', at), name.size());
        const bool hash = end - at == 9 && name.find_first_not_of("0123456789ABCDEF", at + 1) >= end;
        hash ? static_cast<void>(name.erase(at, end - at)) : static_cast<void>(++at);
    }
    return name;
}

std::vector<LayoutFault> cut_texts(const FrameRecord& frame) {
    std::vector<LayoutFault> found;
    for (const DrawnText& text : frame.texts) {
        if (hidden(text.window)) continue;
        if (text.wrap > 0.0f && text.widest_word > text.wrap + slack)
            found.push_back(fault("wraps within a word", text));
        if (can_be_scrolled_to(text) || is_typed(frame, text)) continue;
        const Rect &box = text.box, &clip = text.clip;
        if (box.max.x > clip.max.x + slack) {
            found.push_back(fault("is cut at the right", text));
        } else if (box.min.x < clip.min.x - slack) {
            found.push_back(fault("is cut at the left", text));
        } else if (box.max.y > clip.max.y + 2.0f * slack || box.min.y < clip.min.y - 2.0f * slack) {
            found.push_back(fault("is cut at the top or the bottom", text));
        }
    }
    return found;
}

std::vector<LayoutFault> elided_texts(const FrameRecord& frame,
                                      const std::function<bool(const std::string&)>& means_dots,
                                      std::vector<const DrawnText*>& others) {
    std::vector<LayoutFault> found;
    for (const DrawnText& text : frame.texts) {
        if (hidden(text.window) || !text.text.ends_with("...") || means_dots(text.text)) continue;
        const auto button = [&](const DrawnItem& item) {
            return item.kind == DrawnItem::Kind::Button && item.window == text.window &&
                   inside(text.box, item.box);
        };
        if (std::any_of(frame.items.begin(), frame.items.end(), button)) {
            found.push_back(fault("is cut short on a button", text));
        } else if (text.font == app::heading_font() || text.font == app::verdict_font()) {
            found.push_back(fault("is cut short in a heading", text));
        } else if (seen(shared(text.box, text.clip))) {
            others.push_back(&text);
        }
    }
    return found;
}

std::vector<LayoutFault> overlaps(const FrameRecord& frame) {
    std::vector<LayoutFault> found;
    for (std::size_t i = 0; i < frame.texts.size(); ++i) {
        const DrawnText& text = frame.texts[i];
        const Rect box = shared(text.box, text.clip);
        if (hidden(text.window) || !seen(box)) continue;
        for (std::size_t j = 0; j < i; ++j) {
            const DrawnText& other = frame.texts[j];
            if (other.window == text.window && text.window != nullptr &&
                collide(box, shared(other.box, other.clip)))
                found.push_back(fault("lies on \"" + other.text + "\"", text));
        }
        for (const DrawnItem& item : frame.items)
            if (item.window == text.window && collide(box, item.box) &&
                (box.min.x < item.box.min.x - slack || box.max.x > item.box.max.x + slack))
                found.push_back(fault("lies half on what can be clicked", text));
    }
    for (std::size_t i = 0; i < frame.items.size(); ++i) {
        const DrawnItem& item = frame.items[i];
        if (hidden(item.window) || in_title_bar(item)) continue;
        for (std::size_t j = 0; j < i; ++j) {
            const DrawnItem& other = frame.items[j];
            const bool same = other.window == item.window && other.id != item.id && !in_title_bar(other);
            const bool both = seen(seen_of(item)) && seen(seen_of(other));
            if (same && both && other.kind != DrawnItem::Kind::Row && collide(item.box, other.box))
                found.push_back({"lies on what is named \"" + name_of(frame, other) + "\"",
                                 window_name(item.window), name_of(frame, item)});
        }
    }
    return found;
}

std::vector<LayoutFault> tight_buttons(const FrameRecord& frame) {
    std::vector<LayoutFault> found;
    for (const DrawnItem& item : frame.items) {
        if (hidden(item.window) || item.kind != DrawnItem::Kind::Button) continue;
        for (const DrawnText& text : frame.texts) {
            if (text.window != item.window || !inside(text.box, item.box)) continue;
            const float left = text.box.min.x - item.box.min.x, right = item.box.max.x - text.box.max.x;
            const float line = text.box.size().y;
            const bool choice = left > 1.5f * line;  // a circle is before its title, and nothing after it
            if (std::min(left, right) < 0.25f * line && !choice)
                found.push_back(fault("touches its button's edge", text));
        }
    }
    return found;
}

std::vector<LayoutFault> out_of_reach(const FrameRecord& frame, glm::vec2 screen) {
    std::vector<LayoutFault> found;
    for (const DrawnItem& item : frame.items) {
        if (hidden(item.window) || in_title_bar(item)) continue;
        const auto add = [&](const std::string& what) {
            found.push_back({what, window_name(item.window), name_of(frame, item)});
        };
        const glm::vec2 size = item.box.size();
        if (size.x < 3.0f || size.y < 3.0f) add("is too small to be clicked");
        Rect room = rect_of(item.window->InnerRect);
        // A row of a list is larger by half of the spacing around it.
        const ImVec2 space = ImGui::GetStyle().ItemSpacing;
        const glm::vec2 edge{0.5f * space.x + slack, 0.5f * space.y + 2.0f * slack};
        if (item.box.min.x < room.min.x - edge.x || item.box.max.x > room.max.x + edge.x)
            add("begins or ends beside its window");
        if (const ImGuiWindow* const window = scroller_of(item.window)) {
            room = rect_of(window->InnerRect);
            room.min.y -= window->Scroll.y;
            room.max.y += window->ScrollMax.y - window->Scroll.y;
        }
        if (item.box.min.y < room.min.y - edge.y || item.box.max.y > room.max.y + edge.y)
            add("begins or ends above or below its window");
    }
    for (const ImGuiWindow* window : ImGui::GetCurrentContext()->Windows) {
        if (hidden(window) || window->IsFallbackWindow) continue;
        const auto add = [&](const std::string& what) { found.push_back({what, window_name(window), ""}); };
        const bool child = (window->Flags & ImGuiWindowFlags_ChildWindow) != 0;  // its parent may scroll it
        if (!child && !inside(rect_of(window->Rect()), {{0.0f, 0.0f}, screen}))
            add("is partly beyond the screen");
        const bool bar = (window->Flags & ImGuiWindowFlags_NoScrollbar) != 0;
        if (bar && window->ScrollMax.y > slack) add("has more in it than there is room for");
    }
    return found;
}

std::vector<LayoutFault> covered(const std::vector<ShellPart>& parts) {
    std::vector<LayoutFault> found;
    for (std::size_t i = 0; i < parts.size(); ++i)
        for (std::size_t j = 0; j < i; ++j)
            if (seen(shared(parts[i].box, parts[j].box)))
                found.push_back({"covers the " + parts[j].name, "window", parts[i].name});
    return found;
}

}  // namespace tendril::test
