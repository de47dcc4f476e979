// The Signal lab, its commands, presets and C++: the user builds a chain of filters and chooses its input;
// the output is shown as curves, as a moving ball, and as numbers.
#pragma once

#include <string>
#include <vector>

#include "app/document/command.hpp"
#include "app/labs/kit/arguments.hpp"
#include "app/labs/lab.hpp"
#include "app/labs/signal/signal_part.hpp"

namespace tendril::app {

class SignalLab final : public Lab {
  public:
    std::string name() const override { return signal_lab; }
    std::string title() const override { return "Signal"; }
    std::shared_ptr<Part> blank() const override;
    CameraPose first_view() const override;
    std::string invitation(const Workspace&) const override { return "Drag the orange ball."; }
    void add_commands(CommandTable& table) const override;

    bool moving(const Workspace& workspace) const override;
    void step(Workspace& workspace) const override;
    double seconds(const Workspace& workspace) const override { return signal_part(workspace).time; }
    bool working(const Workspace& workspace) const override {
        return signal_part(workspace).fitting.has_value();
    }
    void work(Workspace& workspace) const override;

    float timeline_height(const Workspace&) const override { return strip_height; }
    void timeline(const Workspace& workspace, Emit& emit) const override;

    void draw(const View& view, DrawList& list) const override;
    std::vector<LegendRow> legend(const Workspace& workspace) const override;
    float canvas_share(const Workspace&) const override { return 0.74f; }
    void canvas(const Workspace& workspace, Emit& emit) const override;

    std::vector<Handle> handles(const Workspace& workspace) const override;
    void drag(const Workspace& workspace, PickId pick, const Handle::Frame& frame, Emit& emit) const override;
    void drop(const Workspace& workspace, PickId pick, Emit& emit) const override;
    void deselect(const Workspace& workspace, Emit& emit) const override {
        if (signal_part(workspace).selected) emit("signal.select");
    }
    std::string hint(const Workspace& workspace, PickId pick) const override;
    Bounds bounds(const Workspace& workspace, bool selection_only) const override;
    std::vector<FileKind> files() const override;

    void panel(const Workspace& workspace, Emit& emit) const override;
    void inspector(const Workspace& workspace, Emit& emit) const override;
    std::vector<Shortcut> shortcuts() const override;
    std::vector<MouseHelp> mouse_help() const override;

    std::string code(const Workspace& workspace) const override;
    Json state(const Workspace& workspace) const override;
};

// The commands of the Signal lab: signal.*.

void add_filter_commands(CommandTable& table);
void add_input_commands(CommandTable& table);
void add_fit_commands(CommandTable& table);

/// Presets: chains of filters, each with an input and plot that show its purpose. Data in presets.json.
struct SignalPreset {
    std::string name, title;
    std::string point;  ///< things to notice and to try
    SignalPart part;
};

/// In the order of the panel. The lab opens with the first one.
const std::vector<SignalPreset>& signal_presets();

}  // namespace tendril::app
