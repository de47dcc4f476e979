#include "app/document/workspace.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "app/document/followed.hpp"
#include "app/io/text.hpp"

namespace tendril::app {

int Clock::whole_ticks() const {
    constexpr double rounding = 1e-6;  // the speed is a float: ten steps of a tenth must make a whole tick
    const double after = passed + static_cast<double>(speed);
    return static_cast<int>(std::floor(after + rounding) - std::floor(passed + rounding));
}

namespace {

/// Memory for the last ten seconds of all closed labs together: as much as the open one may have.
constexpr std::size_t max_closed_bytes = 64u << 20;

/// Drops the last ten seconds of closed labs, the largest first, until the rest fit.
void trim(std::map<std::string, Workspace::Past>& pasts) {
    const auto bytes = [](const auto& each) { return each.second.rewind.bytes(); };
    for (;;) {
        std::size_t sum = 0;
        for (const auto& each : pasts) sum += bytes(each);
        if (sum <= max_closed_bytes) return;
        std::ranges::max_element(pasts, {}, bytes)->second.rewind.clear();
    }
}

/// The card's key in Settings::choices.
std::string card_key(const std::string& lab) {
    return "card_" + lab;
}

}  // namespace

void Workspace::open_lab(const std::string& name) {
    if (name == lab) return;
    pass_change();
    cameras[lab] = camera;
    if (clock.playing)
        clock.held = clock.looks_back = false;
    else if (!clock.looks_back)
        clock.held = true;
    pasts[lab] = {std::move(rewind), moment, document.parts().at(lab), clock.looks_back};
    lab = name;
    Past past = std::exchange(pasts[name], Past());
    trim(pasts);
    if (past.left != document.parts().at(name)) past = Past();
    rewind = std::move(past.rewind);
    moment = past.moment;
    discarded.reset();
    clock.looks_back = past.looks_back;
    clock.playing = !clock.held && !clock.looks_back;
    const auto seen = cameras.find(name);
    camera = seen != cameras.end() ? seen->second : first_view_of(name);
    ui.incident.reset();
    clock.replaying = false;
}

Outputs& Workspace::writes() {
    outputs.in_use.clear();
    for (const auto& [name, part] : document.parts()) {
        const std::vector<std::filesystem::path> files = part->files();
        outputs.in_use.insert(outputs.in_use.end(), files.begin(), files.end());
    }
    return outputs;
}

void Workspace::start_anew() {
    openings.clear();
    recovered.clear();
    ++beginnings;
    clock.replaying = false;
    clock.tick = 0;
    clock.passed = 0.0;
    forget_pasts();
    cameras.clear();
}

void Workspace::close_file_dialog() {
    ui.file_dialog = UiState::FileDialog::None;
    ui.file_question = {};
    if (std::exchange(ui.plays_after_dialog, false)) clock.playing = true;
}

void Workspace::forget_pasts() {
    moment = 0;
    rewind.clear();
    discarded.reset();
    pasts.clear();
    ui.incident.reset();
    const auto parts = document.parts();
    for (const auto& [name, part] : parts)
        if (const std::shared_ptr<const Part> rest = part->without_past()) {
            if (saved.parts().contains(name) && saved.parts().at(name) == part) saved.set(name, rest);
            document.set(name, rest);
        }
}

void Workspace::pass_change() {
    if (!rewind.changed()) return;
    rewind.remember_change(moment, clock.tick);
    ++moment;
}

void Workspace::discard_later(const std::shared_ptr<const Part>& part) {
    if (later_ticks() > 0) discarded = {rewind, part, moment_id()};
    rewind.forget_from(moment);
}

bool Workspace::restore_later(const std::shared_ptr<const Part>& part) {
    if (!discarded || discarded->part != part) return false;
    rewind = std::move(discarded->rewind);
    moment = discarded->moment.tick;
    edition = discarded->moment.edition;
    discarded.reset();
    if (const Rewind::Moment* const now = rewind.find(moment_id())) clock.tick = now->clock;
    return true;
}

void Workspace::set_openings(std::set<std::string> labs) {
    for (const auto* each : {&openings, &labs})
        for (const std::string& name : *each) saved.set(name, document.parts().at(name));
    openings = std::move(labs);
}

Workspace::BeforeAndAfter Workspace::around(const Incident& incident) const {
    if (rewind.empty() || incident.tick < rewind.oldest() || incident.tick > rewind.newest()) return {};
    const std::uint64_t back = rewind.newest() - incident.tick;
    // The document itself follows the newest moment.
    return {rewind.at(back).part, back > 0 ? rewind.at(back - 1).part : document.parts().at(lab)};
}

glm::vec3 followed_at(const Workspace& workspace) {
    const auto* part = dynamic_cast<const Followed*>(workspace.document.parts().at(workspace.lab).get());
    return part != nullptr ? part->stands_at(workspace) : glm::vec3(0.0f);
}

void Workspace::go_to_moment(std::uint64_t ticks_back) {
    const bool was_modified = modified();
    if (moment > rewind.newest()) remember_moment();
    const Rewind::Moment& newest = rewind.at(0);
    const Rewind::Moment& then = rewind.at(ticks_back);
    if (clock.playing) clock.looks_back = true, clock.held = false;
    clock.playing = false;
    if (then.tick == moment) return;
    const CameraPose seen = camera;
    const glm::vec3 stood = followed_at(*this);
    document.set(lab, document.parts().at(lab)->at_moment(then.part));
    camera.target += followed_at(*this) - stood;
    Document latest;
    latest.set(lab, newest.part);
    if (edition == newest.edition && then.edition != newest.edition) {
        Place from = place(), to = place();
        from.camera = seen;
        from.moment = MomentId{newest.tick, newest.edition};
        to.moment = MomentId{then.tick, then.edition};
        if (!history.leads_to(latest)) history.push(latest, "time.seek", 0, from, to);
    } else if (then.edition == newest.edition) {
        // Back at the starting moment: the time.seek entry has nothing to undo.
        if (history.undo_label() == "time.seek" && history.leads_to(latest)) history.forget_last();
    }
    const bool over_a_change = edition != then.edition;
    moment = then.tick;
    clock.tick = then.clock;
    edition = then.edition;
    if (!was_modified && !over_a_change) saved = document;
}

const CameraPose& Workspace::first_view_of(const std::string& name) const {
    const auto own = first_views.find(name);
    return own != first_views.end() ? own->second : first_view;
}

void Workspace::toast(std::string text, ToastKind kind) {
    constexpr std::size_t most = 4;
    constexpr double info_seconds = 4.0, refusal_seconds = 7.0;
    text = message(text);
    const int ticks =
        static_cast<int>((kind == ToastKind::Info ? info_seconds : refusal_seconds) / tick_seconds);

    // A repeated text moves to the end and starts anew: a drag against a limit must not fill the window.
    auto& toasts = ui.toasts;
    std::erase_if(toasts, [&](const Toast& toast) { return toast.text == text; });
    toasts.push_back({std::move(text), kind, ticks});
    if (toasts.size() > most) toasts.erase(toasts.begin());
}

bool card_shown(const Settings& settings, const std::string& lab) {
    const auto found = settings.choices.find(card_key(lab));
    return found != settings.choices.end() && found->second == "shown";
}

void show_card(Settings& settings, const std::string& lab, bool shown) {
    settings.choices[card_key(lab)] = shown ? "shown" : "put_away";
}

bool card_known(const Settings& settings, const std::string& lab) {
    return settings.choices.contains(card_key(lab));
}

}  // namespace tendril::app
