// The interface between the frame and a lab. A lab has no state: it shows what is in the workspace and
// changes it by commands, so undo, scripts and recordings work in every lab. Solvers and other scratch memory
// live in its runtime (runtime.hpp), which the workspace owns.
#pragma once

#include <cstdint>
#include <functional>
#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "app/document/argument_list.hpp"
#include "app/document/workspace.hpp"
#include "app/labs/kit/setting.hpp"
#include "app/view/camera.hpp"
#include "app/view/draw_list.hpp"
#include "app/view/gizmo.hpp"
#include "app/view/palette.hpp"
#include "app/view/panes.hpp"
#include "app/widgets/emit.hpp"

namespace tendril::app {

class CommandTable;
struct Past;

/// Everything a lab needs to draw itself.
struct View {
    const Workspace& workspace;
    const Camera& camera;
    const Palette& palette;
    PickId hovered = no_pick;
    PickId dragged = no_pick;
    float scale = 1.0f;    ///< multiplies every size in pixels
    std::size_t pane = 0;  ///< index into Lab::panes()
    bool handles = true;   ///< whether to show handles and the selection; pictures leave them out
};

/// A frame that can be grabbed. Dragging it moves it in the view plane or along a held axis, if `drag` allows
/// that; other changes are made with its gizmo, if shown.
struct Handle {
    using Frame = HandleFrame;
    std::string name;       ///< as in --state: "target", "segment.3"
    PickId pick = no_pick;  ///< the pick of the strokes drawn at the frame
    Frame frame;
    Drag drag = Drag::Position;
    /// Dragging it acts as this part of a gizmo: a knob on its rail, a ring that is always shown.
    std::optional<GizmoPart> part{};
};

/// The handles that one drag of the gizmo moves when several things are selected.
struct Together {
    std::vector<Handle> handles;
    std::string staying;  ///< selected things that do not move, and why; empty if none
};

/// How a lab takes text from the clipboard.
struct TakenText {
    std::optional<CommandCall> command;
    std::string what;  ///< with a command: the contents, "points"; without: the reason for refusing
};

/// A sphere that should be in view.
struct Bounds {
    glm::vec3 centre{0.0f};
    float radius = 1.0f;
};

/// The sphere around an axis-aligned box; its radius is at least `smallest` metres.
Bounds bounds_of(glm::vec3 low, glm::vec3 high, float smallest = 0.5f);

/// Frames `bounds` in the open lab's view, unless they are in view and large enough to be seen.
void frame_unless_seen(Workspace& workspace, const Bounds& bounds);

/// A colour in the scene, and its meaning.
struct LegendRow {
    std::string name;
    glm::vec3 colour{1.0f};
    bool ring = false;
    std::vector<std::string> numbers{};  ///< shown beside it in columns, if there is room
    /// The widest text of each number: its column keeps that width while the numbers change.
    std::vector<std::string> widest{};
    bool handle = false;  ///< of handles or the selection, which pictures leave out
};

/// A kind of file that a lab reads, as a row of Lab::files().
struct FileKind {
    std::string plural;                ///< "characters"
    std::vector<std::string> endings;  ///< in lower case: ".bvh"
    std::string command;               ///< opens such a file, given as `path`
    ArgumentList arguments{};          ///< further arguments
    /// True if a file's text begins like this kind. Decides if several kinds share the extension, or if no
    /// kind has it. Null: the extension alone decides.
    bool (*begins)(std::string_view text) = nullptr;
};

/// Only the first functions must be overridden: names, blank part, commands, drawing.
class Lab {
  public:
    virtual ~Lab() = default;

    virtual std::string name() const = 0;   ///< in files and commands
    virtual std::string title() const = 0;  ///< shown on its tab
    virtual std::shared_ptr<Part> blank() const = 0;
    virtual void add_commands(CommandTable& table) const = 0;
    virtual void draw(const View& view, DrawList& list) const = 0;

    /// Splits the scene into views side by side that share one camera. Each is drawn on its own (View::pane)
    /// and takes the mouse. Empty: one view.
    virtual std::vector<PaneTitle> panes(const Workspace&) const { return {}; }

    // opening
    virtual CameraPose first_view() const { return {}; }
    /// The first thing to try: "Drag the orange ball." Empty: none.
    virtual std::string invitation(const Workspace&) const { return {}; }

    /// Commands that turn the blank part into the scene of a new window, preferably one that moves by itself.
    /// Those that change a setting are skipped if the user has already chosen it.
    virtual std::vector<CommandCall> opening() const { return {}; }
    /// Commands that stop motions of the opening that would disturb the user. Run once, before the first
    /// change in the lab or the first press on something in it; not an undo step.
    virtual std::vector<CommandCall> calm() const { return {}; }

    // time
    /// Whether a tick would change anything; a lab at rest lets the window idle.
    virtual bool moving(const Workspace&) const { return false; }
    /// One tick: clock.speed * tick_seconds pass in the lab.
    virtual void step(Workspace&) const {}
    /// Rough number of elementary steps in a tick; 0: negligible. The fuzzer skips slow scenes.
    virtual std::uint64_t tick_work(const Workspace&) const { return 0; }
    /// Seconds that have passed in the lab, for the clock in the top bar.
    virtual double seconds(const Workspace& workspace) const {
        return static_cast<double>(workspace.clock.tick) * tick_seconds;
    }
    /// The table of the lab's last ten seconds (app/labs/kit/past.hpp); null: nothing is plotted or
    /// explained.
    virtual const Past* past() const { return nullptr; }
    /// Its incidents in a change or a tick: `before` and `after` are parts of this lab; the workspace gives
    /// access to its runtime. The caller sets the ticks.
    std::vector<Incident> review(const Workspace& workspace, const Part& before, const Part& after) const;
    /// True if incidents in `before` still apply to `after`: the joints are the same. Others are dropped.
    bool same_joints(const Part& before, const Part& after) const;
    /// True if a long computation is running; work() does a part of it each tick, even while paused.
    virtual bool working(const Workspace&) const { return false; }
    virtual void work(Workspace&) const {}
    /// How many of the last ticks make one cycle that ends as it began; 0: none.
    virtual int loop_ticks(const Workspace&) const { return 0; }
    /// Height of the timeline below the scene, in pixels at scale 1; 0: none.
    static constexpr float strip_height = 46.0f;
    virtual float timeline_height(const Workspace&) const;
    virtual void timeline(const Workspace&, Emit&) const;

    // plots beside the scene
    /// Fraction of the window's middle, from the left, that they take from the 3D view: 0 to 1.
    virtual float canvas_share(const Workspace&) const { return 0.0f; }
    virtual void canvas(const Workspace&, Emit&) const {}

    // the mouse
    virtual std::vector<Handle> handles(const Workspace&) const { return {}; }
    /// The handle with that pick, if any. By default, searches handles().
    virtual std::optional<Handle> handle(const Workspace& workspace, PickId pick) const;
    /// The handle whose gizmo is shown; --state names its parts "head.move_x". Its drags go to drag() with
    /// the handle's pick.
    virtual std::optional<Handle> gizmo(const Workspace&) const { return std::nullopt; }
    /// gizmo(), unless Escape hid it.
    std::optional<Handle> shown_gizmo(const Workspace& workspace) const {
        auto handle = gizmo(workspace);
        return handle && handle->name == workspace.ui.hidden_gizmo ? std::nullopt : handle;
    }
    /// Drags a handle to a frame; called each time the pointer moves.
    virtual void drag(const Workspace&, PickId, const Handle::Frame&, Emit&) const {}
    /// The handles that an arrow (Drag::Position) or a ring (Drag::Rotation) of the gizmo drags when several
    /// are selected. No handles: only the gizmo's own.
    virtual Together together(const Workspace&, Drag) const { return {}; }
    /// Drags each of these to its frame.
    virtual void drag_together(const Workspace&, const std::vector<Handle>&, Emit&) const {}
    /// Ends the drag of a handle.
    virtual void drop(const Workspace&, PickId, Emit&) const {}
    /// A click on a handle; no_pick: on empty space.
    virtual void click(const Workspace&, PickId, Emit&) const {}
    /// Clears the selection: Esc, if nothing else takes it.
    virtual void deselect(const Workspace& workspace, Emit& emit) const { click(workspace, no_pick, emit); }
    /// Shift and a click: toggles whether the handle is selected.
    virtual void click_more(const Workspace& workspace, PickId pick, Emit& emit) const {
        click(workspace, pick, emit);
    }
    /// True if Ctrl and a drag on empty space selects by a box.
    virtual bool selects_by_box() const { return false; }
    /// Handles that a box in a pane can select, by their positions there.
    virtual std::vector<Handle> selectable(const Workspace& workspace, std::size_t /*pane*/) const {
        return handles(workspace);
    }
    /// Selects the handles in the box; `add` keeps the previous selection. Some may be selected already.
    virtual void select(const Workspace&, const std::vector<PickId>&, bool /*add*/, Emit&) const {}
    /// True if a drag, wherever it begins, draws a straight stroke across the scene instead of its usual
    /// effect.
    virtual bool takes_strokes(const Workspace&) const { return false; }
    /// The stroke in a pane, in the camera's pixels; its commands are emitted continuously, as one step to
    /// undo. A click on empty space is a stroke of no length.
    virtual void stroke(const Workspace&, std::size_t /*pane*/, const Camera&, glm::vec2 /*from*/,
                        glm::vec2 /*to*/, Emit&) const {}
    /// The second click on a handle; the first one called click().
    virtual void double_click(const Workspace& workspace, PickId pick, Emit& emit) const {
        click(workspace, pick, emit);
    }
    /// The mouse's effect at that pick, for the status line.
    virtual std::string hint(const Workspace&, PickId) const { return {}; }
    /// True if pictures and videos have labels and a legend by default.
    virtual bool labels_pictures(const Workspace&) const { return false; }
    /// Draws the plot that stands in a corner of pictures with labels; null: none.
    virtual std::function<void()> picture_plot(const Workspace&, const Palette&) const { return {}; }
    /// The sphere that the camera frames: around all handles by default.
    virtual Bounds bounds(const Workspace& workspace, bool selection_only) const;

    /// The files that the lab reads, besides scenes. Opening one, in whichever way, opens the lab too.
    virtual std::vector<FileKind> files() const { return {}; }

    /// If this file can be opened in several ways now: all of them. file.open with `ask` lets the user
    /// choose.
    virtual std::vector<FileWay> file_ways(const Workspace&, const std::filesystem::path&) const {
        return {};
    }

    /// The command that Ctrl+V over the view runs for this text. By default the lab takes no text and gives
    /// no reason.
    virtual TakenText takes_text(const std::string& /*text*/) const { return {}; }

    // the panels
    virtual void panel(const Workspace&, Emit&) const {}
    virtual void inspector(const Workspace&, Emit&) const {}
    /// True if the inspector shows an analysis, which needs the card's room.
    virtual bool analyses(const Workspace&) const { return false; }
    virtual std::vector<LegendRow> legend(const Workspace&) const { return {}; }

    // for the shell's tables
    virtual std::vector<Shortcut> shortcuts() const { return {}; }
    virtual std::vector<LabSetting> settings() const { return {}; }
    /// Including those of its past.
    std::vector<LabSetting> all_settings() const;
    /// Mouse gestures of this lab, beyond those of every lab.
    virtual std::vector<MouseHelp> mouse_help() const { return {}; }

    // output
    /// The program that *Copy as C++* puts on the clipboard; empty if the lab has none.
    virtual std::string code(const Workspace&) const { return {}; }
    /// The JSON that --state writes, without handles and camera: save() by default.
    virtual Json state(const Workspace& workspace) const;
};

}  // namespace tendril::app
