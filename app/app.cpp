#include "app/app.hpp"

#include <imgui.h>

#include <algorithm>
#include <tendril/version.hpp>
#include <utility>

#include "app/document/command.hpp"
#include "app/document/scene_file.hpp"
#include "app/io/json_complete.hpp"
#include "app/io/text.hpp"
#include "app/labs/kit/past.hpp"
#include "app/shell/card_watch.hpp"
#include "app/shell/gizmo_view.hpp"
#include "app/shell/ui.hpp"
#include "app/system/atomic_file.hpp"
#include "app/video_take.hpp"
#include "app/view/picture.hpp"

namespace tendril::app {
namespace {

constexpr int settling_ticks = 3;  ///< Dear ImGui sizes some windows by their contents in the last frame
/// Ticks must continue after a click until a second one is no longer a double click.
constexpr int double_click_ticks = 20;

/// True if the key types or deletes a character of a number.
bool in_number(Key key) {
    return (key >= Key::Num0 && key <= Key::Num9) || key == Key::Period || key == Key::Comma ||
           key == Key::Minus || key == Key::Delete || key == Key::Backspace;
}

Cursor wanted_cursor(const Ui& ui, const Pointer& pointer) {
    if (!ui.wants_mouse()) return pointer.cursor();
    switch (ImGui::GetMouseCursor()) {
        case ImGuiMouseCursor_TextInput:
            return Cursor::Text;
        case ImGuiMouseCursor_ResizeEW:
            return Cursor::ResizeColumn;
        case ImGuiMouseCursor_Hand:
            return Cursor::Hand;
        default:
            return Cursor::Arrow;
    }
}

}  // namespace

App::App(Window& window, bool complain, Labs labs)
    : window_(window),
      complain_(complain),
      labs_(std::move(labs)),
      commands_(std::make_unique<CommandTable>(make_command_table(labs_))),
      shortcuts_(labs_, *commands_),
      cards_(labs_),
      workspace_(make_blank_workspace(labs_)) {
    ImGui::GetIO().SetClipboardTextFn = [](void* data, const char* text) {
        static_cast<Window*>(data)->set_clipboard(text);
    };
    ImGui::GetIO().ClipboardUserData = &window_;
    // Pasting is an event (the loop converts it to text), so that a recording includes it.
    ImGui::GetIO().GetClipboardTextFn = [](void*) { return ""; };
    size_ = window_.size();
    base_scale_ = window_.content_scale();
    for (int i = 0; i < settling_ticks; ++i) compose(nullptr, Pass::Settle);
}

App::~App() = default;

void App::start_from(const RecordingStart& start) {
    replays_ = start.live;
    for (const LabNote& each : load_scene(workspace_, start.scene))
        if (!each.whole) throw std::runtime_error(each.text);
    if (labs_.find(start.lab) == nullptr)
        throw std::runtime_error("lab: there is no lab \"" + start.lab + "\"");
    workspace_.open_lab(start.lab);
    std::vector<std::string> complaints;
    workspace_.settings = load_settings(start.settings, complaints);
    if (!complaints.empty()) throw std::runtime_error("settings: " + complaints.front());
    workspace_.path = start.path;
    workspace_.saved = start.modified ? Document() : workspace_.document;
    workspace_.history.clear();
    base_scale_ = start.scale;
    window_.resize(start.size);
    size_ = start.size;
    settle();
}

void App::settle() {
    for (int i = 0; i < settling_ticks; ++i) compose(nullptr, Pass::Settle);
}

void App::start_recording(bool live) {
    // A player has no past to rewind to, and only the saved state of the open lab: start from the same.
    const std::shared_ptr<const Part> part = workspace_.document.parts().at(workspace_.lab);
    if (part != workspace_.blank.parts().at(workspace_.lab)) {
        const bool modified = workspace_.modified();
        const std::shared_ptr<Part> again = part->load(part->save(), workspace_.lab);
        again->unread = part->unread;
        again->unread_why = part->unread_why;
        again->replaces_unread = part->replaces_unread;
        again->unread_stand_in = part->unread_stand_in;
        workspace_.document.set(workspace_.lab, again);
        if (!modified) workspace_.saved = workspace_.document;
    }
    workspace_.forget_pasts();
    workspace_.openings.clear();  // the opening's motion is part of the recorded scene
    Json scene = save_scene(workspace_);
    if (const auto edited = scene.find("stand_ins"); edited != scene.end()) {
        scene["labs"].update(*edited);  // keep the labs as they were on the screen
        scene.erase(edited);
    }
    recorder_.emplace(RecordingStart{.version = version_string,
                                     .size = size_,
                                     .lab = workspace_.lab,
                                     .scene = std::move(scene),
                                     .settings = save_settings(workspace_.settings),
                                     .path = workspace_.path.string(),
                                     .modified = workspace_.modified(),
                                     .scale = base_scale_,
                                     .live = live || replays_});
}

void App::tick(const Event* event) {
    if (recorder_) event != nullptr ? recorder_->event(*event) : recorder_->idle_tick();
    input_.take(event);
    const bool active = lab().working(workspace_) || moves();
    compose(event, Pass::Tick);
    note_typing(event);
    input_.end_tap();
    // A window that the event opened gets the keyboard only in a second pass; run it before the next event.
    if (event != nullptr && !std::holds_alternative<MouseMove>(*event)) compose(nullptr, Pass::Settle);
    const bool pressed = event != nullptr && std::holds_alternative<MousePress>(*event);
    settling_ = pressed ? double_click_ticks : std::max(event != nullptr ? settling_ticks : 0, settling_ - 1);
    if (active) settling_ = std::max(settling_, 1);  // the panels must still show the end of work or motion
    update_window();
}

/// After a click beside a field, or when a field vanishes while it has the keyboard, typed numbers are
/// ignored until the next press or the next key that does not belong to a number.
void App::note_typing(const Event* event) {
    const auto* press = event != nullptr ? std::get_if<MousePress>(event) : nullptr;
    const bool types = ui_.wants_text(), typed = std::exchange(was_typing_, types);
    const Key key = input_.pressed().key;
    const bool panel = layout_.left.contains(input_.mouse()) || layout_.right.contains(input_.mouse());
    if (press != nullptr && press->down)
        types_nowhere_ = panel && !workspace_.ui.covered() && !ImGui::IsAnyItemHovered();
    else if (types || (key != Key::Unknown && !in_number(key)))
        types_nowhere_ = false;
    else if (typed && press == nullptr)
        types_nowhere_ = true;
}

void App::compose(const Event* event, Pass pass) {
    const bool in_tick = pass == Pass::Tick;
    layout_ = lay_out(size_, ui_scale(), workspace_.settings, lab().timeline_height(workspace_),
                      lab().canvas_share(workspace_));
    divide_view();
    Emit emit;
    if (in_tick && event != nullptr) take_event(*event, emit);
    ui_.begin({size_, window_.framebuffer_size(), layout_.scale}, workspace_.settings.theme, input_, event,
              pass != Pass::Picture);
    if (in_tick) {
        take_shortcut(emit);
        const Pane& pane = pane_at_hand();
        const Camera camera = pane.camera(workspace_.camera);
        pointer_.take(event, input_, pointed_at(pane, camera), emit);
        run_emitted(emit, From::View);
    }

    pointer_.forget_missing(workspace_, lab());
    std::string hint =
        lab().hint(workspace_, pointer_.dragged() != no_pick ? pointer_.dragged() : pointer_.hovered());
    const Camera seen = pane_at_hand().camera(workspace_.camera);
    if (const std::string bound = constraint_hint(lab(), workspace_, seen, pointer_, input_); !bound.empty())
        hint = bound;
    if (const std::string by_part = gizmo_hint(lab(), workspace_, pointer_); !by_part.empty()) hint = by_part;
    if (hint.empty()) hint = discards_text(workspace_);
    if (workspace_.ui.asks_to_quit && !workspace_.modified()) workspace_.ui.asks_to_quit = false;
    shell_.frame({workspace_, labs_, lab(), *commands_, shortcuts_, layout_, hint, input_.by_finger(),
                  shown_card(), cards_.of(workspace_.lab), panes_.front().drawn.strokes},
                 emit);
    if (const std::string why = std::exchange(ui_.numbers().refused, {}); !why.empty()) {
        refuse(why);
        note_refusal(why);
    }
    // Each typed number is a separate change, as each drag is.
    if (std::exchange(ui_.numbers().entered, false)) ++gesture_;
    if (pass == Pass::Picture) emit.take();
    run_emitted(emit, From::Panel);
    if (in_tick) advance_time();

    divide_view();
    draw_panes();
    ui_.end();
}

Pointer::Scene App::pointed_at(const Pane& pane, const Camera& camera) const {
    return {workspace_, lab(), camera, pane.drawn, ui_.wants_mouse(), layout_.scale, pane_};
}

void App::take_event(const Event& event, Emit& emit) {
    if (const auto* press = std::get_if<MousePress>(&event)) {
        if (press->down) ++gesture_;
        const HeldKeys held{.shift = input_.shift(), .ctrl = input_.ctrl(), .alt = input_.alt()};
        const bool takes = press->down && press->button == MouseButton::Left &&
                           !mouse_action(mouse_preset(workspace_.settings), press->button, held);
        if (takes && pointer_.hovered() != no_pick && !ui_.wants_mouse()) {
            end_opening();
            workspace_.ui.hidden_gizmo.clear();
        }
    } else if (const auto* resize = std::get_if<Resize>(&event)) {
        size_ = resize->size;
        if (window_.size() != size_) window_.resize(size_);
        layout_ = lay_out(size_, ui_scale(), workspace_.settings, lab().timeline_height(workspace_),
                          lab().canvas_share(workspace_));
    } else if (const auto* drop = std::get_if<Drop>(&event)) {
        if (!drop->paths.empty()) emit("file.open", {{"path", drop->paths.front()}, {"ask", true}});
    } else if (const auto* text = std::get_if<TextInput>(&event)) {
        // Only pasting sends text while Ctrl is held without Alt (AltGr types characters as both).
        if (input_.ctrl() && !input_.alt()) take_paste(text->utf8, emit);
    } else if (std::holds_alternative<VideoEnd>(event)) {
        pass_video(true);
    } else if (std::holds_alternative<CloseRequest>(event)) {
        emit("quit", {{"unsaved", "ask"}});
    }
}

void App::take_paste(const std::string& text, Emit& emit) {
    if (workspace_.ui.covered() || ui_.wants_text() || busy()) return;
    if (text.empty()) return workspace_.toast("The clipboard holds no text.");
    const TakenText here = lab().takes_text(text);
    if (here.command) return emit(here.command->name, here.command->arguments);
    for (const auto& other : labs_.all()) {
        const TakenText there = other->takes_text(text);
        if (!there.command) continue;
        return workspace_.toast("The clipboard holds " + there.what + ". Open the " + other->title() +
                                " lab and paste them there.");
    }
    if (!here.what.empty()) refuse(here.what);
}

void App::refuse(const std::string& why) {
    workspace_.toast(why, ToastKind::Refusal);
    if (complain_) complain(why);
}

void App::take_shortcut(Emit& emit) {
    const Chord chord = input_.pressed();
    if (chord.key == Key::Unknown) return;
    if (chord.key == Key::Escape && (pointer_.dragged() != no_pick || pointer_.box() || pointer_.stroke())) {
        const Pane& pane = pane_at_hand();
        const Camera camera = pane.camera(workspace_.camera);
        pointer_.release(pointed_at(pane, camera), emit);  // a cancelled drag leaves no trace
        if (workspace_.history.is_open(gesture_)) emit("undo");
        return;
    }
    // Esc cancels the video only if it has no other use.
    const bool taken = workspace_.ui.covered() || ui_.wants_text() || ImGui::IsAnyItemActive() ||
                       ImGui::IsPopupOpen(nullptr, ImGuiPopupFlags_AnyPopup);
    if (chord.key == Key::Escape && video_ && !taken) return emit("view.end_video");
    // In a field, a menu or a drag Esc only ends that, and keeps the selection or the dialog.
    const bool typing_number = ui_.numbers().id != 0;
    if (chord.key == Key::Escape && (workspace_.ui.covered() ? typing_number : taken || busy())) return;
    // Ignore numbers typed beside a field, or into one that has vanished.
    if (types_nowhere_ && !chord.ctrl && !chord.alt && in_number(chord.key))
        return workspace_.toast("No field has the keyboard. Click one, or click the view to use shortcuts.");
    const Shortcut* shortcut = shortcuts_.find(chord, workspace_.lab);
    // An open popup handles its own keys.
    if (!chord.ctrl && ImGui::IsPopupOpen(nullptr, ImGuiPopupFlags_AnyPopup)) return;
    // A held key repeats stepwise commands, but no toggles.
    if (shortcut != nullptr && input_.repeated() && !shortcut->repeats) return;
    if (shortcut == nullptr || (ui_.wants_text() && !shortcut->while_typing)) return;
    // Keys do not edit the scene during a drag: Delete would remove the dragged object.
    if (busy() && commands_->find(shortcut->command)->effect == Effect::Edit) return;
    emit(shortcut->command, shortcut->arguments);
}

void App::run_emitted(Emit& emit, From from) {
    for (Emitted& command : emit.take()) {
        try {
            run_command(command.name, command.arguments, command.continuous ? gesture_ : 0, from);
            take_pictures();
            if (command.continuous && pointer_.dragged() != no_pick) workspace_.settings.hint_seen = true;
        } catch (const Refused& refusal) {
            if (command.name == "undo" ||
                command.name == "redo") {  // nothing to undo or redo is not an error
                workspace_.toast(capitalised(refusal.reason()) + ".");
                continue;
            }
            refuse(refusal.reason());
            // Only the lab's own refusals become incidents.
            if (command.name.starts_with(workspace_.lab + ".")) note_refusal(refusal.what());
        }
    }
}

/// Also notes the incidents of an edit.
void App::run_command(const std::string& name, const Json& arguments, Gesture gesture, From from) {
    const std::string open = workspace_.lab;
    const Command* const command = commands_->find(name);
    std::optional<Opening> ended;
    if (command != nullptr && command->effect == Effect::Edit && command->lab == open) ended = end_opening();
    const auto openings = workspace_.openings;
    const auto all = workspace_.document.parts();
    const std::shared_ptr<const Part>& before = all.at(open);
    const std::uint64_t beginnings = workspace_.beginnings, moment = workspace_.moment;
    try {
        commands_->run(workspace_, name, arguments, gesture);
    } catch (...) {
        if (ended) resume(std::move(*ended));
        throw;
    }
    // A changed lab is no longer an opening, even if it was not open, unless undo made it one again.
    if (workspace_.openings == openings)
        std::erase_if(workspace_.openings, [&](const std::string& lab) {
            return workspace_.document.parts().at(lab) != all.at(lab);
        });
    divide_view();  // the next command, such as framing everything, uses the new panes
    const bool same_scene = workspace_.lab == open && workspace_.beginnings == beginnings;
    const Effect effect = commands_->find(name)->effect;
    if (same_scene && workspace_.document.parts().at(open) != before) drop_incidents(*before);
    if (same_scene && effect == Effect::Edit) review(before, workspace_.moment);
    if (name == open + ".select") workspace_.ui.hidden_gizmo.clear();
    // A new selection is shown from its top, unless it was chosen in the inspector itself.
    if (name == open + ".select" && !arguments.empty() && workspace_.document.parts().at(open) != before &&
        !layout_.right.contains(input_.mouse()))
        shell_.show_top(open);
    if (const Card* const card = shown_card(); card != nullptr && workspace_.lab == open)
        note_command(workspace_.ui.cards[open], *card, name, arguments, effect != Effect::Look, moment,
                     from == From::Panel);
}

void App::run(const RunCommand& command) {
    try {
        run_command(command.name, command.arguments, 0, From::View);
        workspace_.pass_change();
        if (const auto& finish = commands_->find(command.name)->finish) finish(workspace_);
        take_pictures();
        while (video_) write_video(true);
        if (recorder_) recorder_->command(command.name, command.arguments, false);
    } catch (const Refused& refusal) {
        if (recorder_) recorder_->command(command.name, command.arguments, true);
        workspace_.toast(refusal.what(), ToastKind::Refusal);
        settling_ = settling_ticks;
        throw;
    }
    settling_ = settling_ticks;
    while (workspace_.clock.steps_due > 0) step_lab();
    for (int i = 0; i < 2; ++i)
        compose(nullptr, Pass::Settle);  // the next event must find the new state ready
}

void App::update_window() {
    if (auto& copied = workspace_.ui.copied) {
        window_.set_clipboard(*copied);
        copied.reset();
    }
    if (workspace_.ui.file_dialog == UiState::FileDialog::Open && window_.choose_file())
        workspace_.ui.file_dialog = UiState::FileDialog::None;
    window_.set_cursor(wanted_cursor(ui_, pointer_));
    std::string title = "Tendril";
    if (!workspace_.path.empty()) title = workspace_.path.filename().string() + " - " + title;
    if (workspace_.modified()) title = "\u2022 " + title;
    if (title != title_) window_.set_title(title_ = title);
}

void App::draw(bool dither) {
    const glm::ivec2 pixels = window_.framebuffer_size();
    renderer_.draw(
        panes_, workspace_.camera, palette(workspace_.settings.theme),
        {.framebuffer = window_.framebuffer(),
         .framebuffer_size = pixels,
         .pixel_ratio = static_cast<float>(pixels.x) / static_cast<float>(std::max(1, window_.size().x)),
         .dither = dither});
    ui_.draw();
}

Image App::screenshot() {
    // As off screen: independent of the machine's speed, with all panels settled.
    const bool measured = std::exchange(workspace_.clock.measured, false);
    for (int i = 0; i < settling_ticks; ++i) compose(nullptr, Pass::Picture);
    workspace_.clock.measured = measured;
    draw(false);
    return read_framebuffer(window_.framebuffer(), window_.framebuffer_size());
}

void App::write_screenshot(const std::string& path) {
    workspace_.writes().write(path, OutputKind::Picture, encode_png(screenshot()), true);
}

void App::write_state(const std::string& path) {
    workspace_.writes().write(path, OutputKind::State, state().dump(2) + "\n", true);
}

Json App::lab_state() const {
    Json state = lab().state(workspace_);
    state["camera"] = save_camera(workspace_.camera);
    const Clock& clock = workspace_.clock;
    state["time"] = {{"playing", clock.playing},
                     {"tick", clock.tick},
                     {"speed", number(clock.speed)},
                     {"seconds", lab().seconds(workspace_)}};
    state["events"] = Json::array();
    for (const Incident& incident : workspace_.rewind.incidents()) {
        Json event{{"tick", incident.tick},
                   {"joint", incident.joint == no_joint ? Json(nullptr) : Json(incident.joint)},
                   {"kind", name(incident.kind)},
                   {"degrees", number(incident.degrees)},
                   {"cause", incident.cause}};
        if (!incident.name.empty()) event["name"] = incident.name;
        if (!incident.title.empty()) event["title"] = incident.title;
        state["events"].push_back(std::move(event));
    }
    // Before the first tick the past is only reported while looking back.
    const bool looks_back = !workspace_.rewind.empty() && workspace_.moment < workspace_.rewind.newest();
    if (looks_back || (!workspace_.rewind.empty() && clock.tick > 0)) {
        const std::uint64_t newest = std::max(workspace_.rewind.newest(), workspace_.moment);
        state["time"]["moment"] = workspace_.moment;  // as events count
        state["time"]["ticks_back"] = newest - workspace_.moment;
        state["time"]["remembered"] = newest - workspace_.rewind.oldest();
    }
    return state;
}

Json App::state() {
    const Pane& first = panes_.front();
    const Camera camera = first.camera(workspace_.camera);
    Json state = lab_state();
    Json handles = Json::array();
    for (const Handle& handle : lab().handles(workspace_)) {
        const auto at = camera.project(handle.frame.position);
        handles.push_back({{"name", handle.name}, {"pixel", at ? pixel(*at) : Json(nullptr)}});
    }
    for (const NamedGrip& grip : gizmo_grips(first.drawn, lab(), workspace_, camera, layout_.scale))
        handles.push_back({{"name", grip.name}, {"pixel", pixel(grip.pixel)}});
    state["handles"] = std::move(handles);
    for (const auto& [name, rect] :
         {std::pair{"view", layout_.view}, {"canvas", layout_.canvas}, {"strip", layout_.timeline}})
        state["layout"][name] = {{"min", pixel(rect.min)}, {"max", pixel(rect.max)}};
    if (panes_.size() > 1) state["panes"] = panes_state();
    if (shown_card() != nullptr) state["card"] = card_state();
    if (const std::string why =
            stand_in_note(workspace_.lab, *workspace_.document.parts().at(workspace_.lab));
        !why.empty())
        state["unread"] = why;
    return state;
}

bool App::busy() const {
    return pointer_.busy() || ImGui::IsAnyItemActive();
}

bool App::moves() const {
    return workspace_.clock.playing && lab().moving(workspace_);
}

bool App::needs_ticks() const {
    return moves() || workspace_.clock.replaying || card_is_due() || lab().working(workspace_) || video_ ||
           settling_ > 0 || !workspace_.ui.toasts.empty();
}

}  // namespace tendril::app
