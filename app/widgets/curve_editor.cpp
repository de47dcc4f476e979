#include "app/widgets/plot.hpp"

#include <imgui.h>

#include <algorithm>
#include <cmath>

#include "app/widgets/icons.hpp"
#include "app/widgets/tooltip.hpp"

namespace tendril::app {
namespace {

constexpr double min_spacing = 1e-3;  ///< minimum distance of keys in time
constexpr int no_key = -1;

enum class Grip { None, Key, Arrive, Leave };

class Editor {
  public:
    Editor(signal::Curve& curve, glm::vec3 colour, ImVec2 at, ImVec2 size)
        : curve_(curve), list_(ImGui::GetWindowDrawList()), at_(at), size_(size) {
        colour_ = imgui_u32(colour);
        for (const signal::CurveKey& key : curve.keys) {
            left_ = std::min(left_, key.time), right_ = std::max(right_, key.time);
            low_ = std::min(low_, key.value), high_ = std::max(high_, key.value);
        }
        const double margin = 0.08 * (high_ - low_);
        low_ -= margin, high_ += margin;
        const double side = 0.03 * (right_ - left_);
        left_ -= side, right_ += side;
    }

    /// The visible range of time and value. It follows the keys, but is frozen during a drag: otherwise a
    /// position would mean a different value in every frame.
    struct View {
        double left = 0.0, right = 1.0, low = 0.0, high = 1.0;
    };
    View view() const { return {left_, right_, low_, high_}; }
    void show(const View& view) {
        left_ = view.left, right_ = view.right, low_ = view.low, high_ = view.high;
    }

    void draw(int active, double input) {
        list_->AddRectFilled(at_, {at_.x + size_.x, at_.y + size_.y},
                             ImGui::GetColorU32(ImGuiCol_FrameBg, 0.5f));
        list_->PushClipRect(at_, {at_.x + size_.x, at_.y + size_.y}, true);
        const ImU32 dim = ImGui::GetColorU32(ImGuiCol_Border);
        for (const double value : {0.0, 1.0}) {
            list_->AddLine(place(left_, value), place(right_, value), dim);
            list_->AddLine(place(value, low_), place(value, high_), dim);
        }
        constexpr int steps = 160;
        ImVec2 line[steps + 1];
        for (int i = 0; i <= steps; ++i) {
            const double time = left_ + (right_ - left_) * i / steps;
            line[i] = place(time, signal::evaluate_keys(curve_, time));
        }
        list_->AddPolyline(line, steps + 1, colour_, ImDrawFlags_None, 0.13f * ImGui::GetFontSize());
        if (input >= 0.0 && input <= 1.0)
            list_->AddCircleFilled(place(input, signal::evaluate_keys(curve_, input)), 0.35f * unit(),
                                   ImGui::GetColorU32(ImGuiCol_Text));
        for (int i = 0; i < count(); ++i) {
            if (i == active) tangents(i);
            list_->AddCircleFilled(key_place(i), 0.38f * unit(), colour_);
            if (i == active)
                list_->AddCircle(key_place(i), 0.55f * unit(), ImGui::GetColorU32(ImGuiCol_Text));
        }
        list_->PopClipRect();
    }

    struct Hit {
        int key = no_key;
        Grip grip = Grip::None;
    };
    /// The grip under the mouse. Only the active key has tangents.
    Hit hit(ImVec2 mouse, int active) const {
        const auto near = [&](ImVec2 p) { return std::hypot(p.x - mouse.x, p.y - mouse.y) < 0.6f * unit(); };
        for (int i = 0; i < count(); ++i)
            if (near(key_place(i))) return {i, Grip::Key};
        if (active < 0 || active >= count()) return {};
        if (arrives(active) && near(tangent_end(active, -1.0))) return {active, Grip::Arrive};
        if (leaves(active) && near(tangent_end(active, 1.0))) return {active, Grip::Leave};
        return {};
    }

    void drag(const Hit& hit, ImVec2 mouse) {
        signal::CurveKey& key = curve_.keys[static_cast<std::size_t>(hit.key)];
        const double time = time_at(mouse.x), value = value_at(mouse.y);
        if (hit.grip == Grip::Key) {
            const double low = hit.key > 0 ? key_at(hit.key - 1).time + min_spacing : -1e9;
            const double high = hit.key + 1 < count() ? key_at(hit.key + 1).time - min_spacing : 1e9;
            key.time = std::clamp(time, std::min(low, high), high);
            key.value = std::clamp(value, -1e6, 1e6);
            return;
        }
        const double side = hit.grip == Grip::Leave ? 1.0 : -1.0;
        const double away = std::max(side * (time - key.time), 0.01 * (right_ - left_));
        const double slope = std::clamp(side * (value - key.value) / away, -1e4, 1e4);
        (hit.grip == Grip::Leave ? key.leave : key.arrive) = slope;
    }

    /// Returns the new key's index, or no_key if another key is too close.
    int add(ImVec2 mouse) {
        const double time = time_at(mouse.x);
        auto at = curve_.keys.begin();
        while (at != curve_.keys.end() && at->time < time) ++at;
        if (at != curve_.keys.end() && at->time - time < min_spacing) return no_key;
        if (at != curve_.keys.begin() && time - (at - 1)->time < min_spacing) return no_key;
        const signal::Piece piece = at == curve_.keys.begin() ? signal::Piece::Linear : (at - 1)->piece;
        const auto added = curve_.keys.insert(at, {.time = time, .value = value_at(mouse.y), .piece = piece});
        return static_cast<int>(added - curve_.keys.begin());
    }

  private:
    int count() const { return static_cast<int>(curve_.keys.size()); }
    const signal::CurveKey& key_at(int i) const { return curve_.keys[static_cast<std::size_t>(i)]; }
    static float unit() { return ImGui::GetFontSize(); }
    ImVec2 place(double time, double value) const {
        const double x = (time - left_) / (right_ - left_), y = (value - low_) / (high_ - low_);
        return {at_.x + size_.x * static_cast<float>(x), at_.y + size_.y * (1.0f - static_cast<float>(y))};
    }
    double time_at(float x) const {
        return left_ + (right_ - left_) * static_cast<double>((x - at_.x) / size_.x);
    }
    double value_at(float y) const {
        return low_ + (high_ - low_) * (1.0 - static_cast<double>((y - at_.y) / size_.y));
    }
    ImVec2 key_place(int i) const { return place(key_at(i).time, key_at(i).value); }
    bool leaves(int i) const { return key_at(i).piece == signal::Piece::Cubic && i + 1 < count(); }
    bool arrives(int i) const { return i > 0 && key_at(i - 1).piece == signal::Piece::Cubic; }
    /// At a fixed distance from its key, whatever the slope.
    ImVec2 tangent_end(int i, double side) const {
        const signal::CurveKey& key = key_at(i);
        const double slope = side > 0.0 ? key.leave : key.arrive;
        const ImVec2 from = key_place(i), to = place(key.time + side, key.value + side * slope);
        const float length = std::max(std::hypot(to.x - from.x, to.y - from.y), 1e-3f);
        const float scale = 2.6f * unit() / length;
        return {from.x + scale * (to.x - from.x), from.y + scale * (to.y - from.y)};
    }
    void tangents(int i) {
        const ImU32 grey = ImGui::GetColorU32(ImGuiCol_TextDisabled);
        const auto one = [&](double side) {
            list_->AddLine(key_place(i), tangent_end(i, side), grey);
            list_->AddCircleFilled(tangent_end(i, side), 0.25f * unit(), grey);
        };
        if (arrives(i)) one(-1.0);
        if (leaves(i)) one(1.0);
    }

    signal::Curve& curve_;
    ImDrawList* list_;
    ImVec2 at_, size_;
    ImU32 colour_ = 0;
    double left_ = 0.0, right_ = 1.0, low_ = 0.0, high_ = 1.0;
};

/// The view; while the mouse button is held on the last item, the view when it went down.
Editor::View view_of_drag(Editor::View view) {
    const bool held = ImGui::IsItemActive() && !ImGui::IsItemActivated();
    ImGuiStorage& kept = *ImGui::GetStateStorage();
    const auto keep = [&](const char* name, double& value) {
        float& before = *kept.GetFloatRef(ImGui::GetID(name), static_cast<float>(value));
        if (held)
            value = static_cast<double>(before);
        else
            before = static_cast<float>(value);
    };
    keep("left", view.left);
    keep("right", view.right);
    keep("low", view.low);
    keep("high", view.high);
    return view;
}

const char* piece_help(signal::Piece piece) {
    switch (piece) {
        case signal::Piece::Constant:
            return "The curve keeps the key's value until the next key.";
        case signal::Piece::Linear:
            return "The curve goes straight to the next key.";
        case signal::Piece::Cubic:
            break;
    }
    return "The curve goes smoothly to the next key, following the slopes of both.";
}

/// The interpolation after the active key.
bool piece_row(signal::CurveKey& key) {
    bool changed = false;
    for (const signal::Piece piece : {signal::Piece::Constant, signal::Piece::Linear, signal::Piece::Cubic}) {
        if (piece != signal::Piece::Constant) ImGui::SameLine();
        if (ImGui::RadioButton(signal::name(piece), key.piece == piece)) key.piece = piece, changed = true;
        if (ImGui::IsItemHovered()) tooltip(piece_help(piece));
    }
    return changed;
}

}  // namespace

bool curve_editor(const char* id, signal::Curve& curve, glm::vec3 colour, float height, double input) {
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const ImVec2 size{std::max(80.0f, ImGui::GetContentRegionAvail().x), height * ImGui::GetFontSize()};
    ImGui::InvisibleButton(id, size, ImGuiButtonFlags_MouseButtonLeft | ImGuiButtonFlags_MouseButtonRight);
    ImGui::PushID(id);
    ImGuiStorage& kept = *ImGui::GetStateStorage();
    // Copies: pointers into the storage are invalidated whenever something is added to it.
    int active = kept.GetInt(ImGui::GetID("active"), no_key);
    int grip = kept.GetInt(ImGui::GetID("grip"), static_cast<int>(Grip::None));
    const int count = static_cast<int>(curve.keys.size());
    if (active >= count) active = no_key;
    Editor editor(curve, colour, at, size);
    editor.show(view_of_drag(editor.view()));
    const ImVec2 mouse = ImGui::GetIO().MousePos;
    bool changed = false;
    const Editor::Hit under = editor.hit(mouse, active);
    if (ImGui::IsItemActivated()) {
        active = under.key;
        grip = static_cast<int>(under.grip);
    }
    if (ImGui::IsItemHovered() && ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left) && under.key == no_key) {
        active = editor.add(mouse);
        grip = static_cast<int>(Grip::Key);
        changed = active != no_key;
    }
    if (ImGui::IsItemHovered() && ImGui::IsMouseClicked(ImGuiMouseButton_Right) && under.key != no_key &&
        count > 1) {
        curve.keys.erase(curve.keys.begin() + under.key);
        active = no_key;
        grip = static_cast<int>(Grip::None);
        changed = true;
    }
    const bool dragging = ImGui::IsItemActive() && ImGui::IsMouseDragging(ImGuiMouseButton_Left, 1.0f);
    if (dragging && active != no_key && grip != static_cast<int>(Grip::None)) {
        editor.drag({active, static_cast<Grip>(grip)}, mouse);
        changed = true;
    }
    if (ImGui::IsItemHovered() && !ImGui::IsItemActive())
        tooltip(
            "Drag a key, or the slope at either side of the one that was clicked.\n"
            "Double-click adds a key, right-click removes it.");
    editor.draw(active, input);
    if (active != no_key && active + 1 < static_cast<int>(curve.keys.size()))
        changed |= piece_row(curve.keys[static_cast<std::size_t>(active)]);
    kept.SetInt(ImGui::GetID("active"), active);
    kept.SetInt(ImGui::GetID("grip"), grip);
    ImGui::PopID();
    return changed;
}

}  // namespace tendril::app
