// The one interface between the frame and a lab. A lab keeps nothing of its own: what it shows is in the
// workspace, what it changes it changes by commands, so undo, scripts and recordings hold for every lab
// alike. Solvers and other scratch memory it keeps in its runtime (runtime.hpp), which the workspace holds.
#pragma once

#include <cstdint>
#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/document/workspace.hpp"
#include "app/labs/kit/setting.hpp"
#include "app/labs/kit/shortcut.hpp"
#include "app/view/camera.hpp"
#include "app/view/draw_list.hpp"
#include "app/view/gizmo.hpp"
#include "app/view/palette.hpp"
#include "app/view/panes.hpp"
#include "app/widgets/emit.hpp"

namespace tendril::app {

class CommandTable;

/// What a lab may look at to draw itself.
struct View {
    const Workspace& workspace;
    const Camera& camera;
    const Palette& palette;
    PickId hovered = no_pick;
    PickId dragged = no_pick;
    float scale = 1.0f;    ///< of everything measured in pixels
    std::size_t pane = 0;  ///< of Lab::panes()
};

/// A frame that a person can take hold of. Dragged by what is drawn there it moves in the plane of the view
/// or along a held axis, if it may move; its gizmo, where one is shown, has a part for all else.
struct Handle {
    using Frame = HandleFrame;
    std::string name;       ///< as --state has it: "target", "segment.3"
    PickId pick = no_pick;  ///< of what is drawn there
    Frame frame;
    Drag drag = Drag::Position;
    /// Dragging it is dragging this part of a gizmo: a knob on its rail, a ring that is always there.
    std::optional<GizmoPart> part{};
};

/// What one gizmo drags where several are selected.
struct Together {
    std::vector<Handle> handles;
    std::string staying;  ///< which of those selected stay, and why; empty where none does
};

/// A sphere around what should be in view.
struct Bounds {
    glm::vec3 centre{0.0f};
    float radius = 1.0f;
};

/// Around a box along the axes, of a radius of `smallest` metres or more.
Bounds bounds_of(glm::vec3 low, glm::vec3 high, float smallest = 0.5f);

/// What a colour of the picture means here.
struct LegendRow {
    std::string name;
    glm::vec3 colour{1.0f};
    bool ring = false;
};

/// A scene that the tests which run over every lab begin with: random events and commands are let loose on
/// it, and it has to come out the same when it is played again. The fuzzer's scene files begin with it too,
/// where it is small.
struct TestScene {
    std::string name;
    std::vector<CommandCall> commands;  ///< that set it up, from a blank document
    std::vector<std::string>
        words;        ///< what commands may find here where they take any text: names of things
    int ticks = 120;  ///< to let pass where its state is compared
};

/// What a lab must say has no default: what it is called, what it saves, which commands change that, and how
/// it looks. All else a lab adds as it needs it.
class Lab {
  public:
    virtual ~Lab() = default;

    virtual std::string name() const = 0;   ///< in files and commands
    virtual std::string title() const = 0;  ///< on its tab
    virtual std::shared_ptr<Part> blank() const = 0;
    virtual void add_commands(CommandTable& table) const = 0;
    virtual void draw(const View& view, DrawList& list) const = 0;

    /// Where several things are compared side by side: the views that the scene is divided into, all with one
    /// camera. Each is drawn by itself (View::pane), and the mouse works in each. Empty: one view.
    virtual std::vector<PaneTitle> panes(const Workspace&) const { return {}; }

    // what is first seen
    virtual CameraPose first_view() const { return {}; }
    /// What to try first: "Drag the orange ball." Empty: nothing is said.
    virtual const char* invitation() const { return ""; }

    /// The scene that a window opens on where nothing else is asked for: commands, from the blank document.
    /// One that makes a setting counts only where the person has not chosen yet.
    virtual std::vector<CommandCall> opening() const { return {}; }

    // time
    /// Whether time changes anything here now; a lab at rest lets the window idle.
    virtual bool moving(const Workspace&) const { return false; }
    /// One tick of tick_seconds, in which clock.speed times as much passes in the lab.
    virtual void step(Workspace&) const {}
    /// Elementary steps that a tick would take, roughly; 0: too few to count. Who runs through millions of
    /// scenes leaves out those that take long.
    virtual std::uint64_t tick_work(const Workspace&) const { return 0; }
    /// What the clock in the top bar shows: seconds that have passed in the lab.
    virtual double seconds(const Workspace& workspace) const {
        return static_cast<double>(workspace.clock.tick) * tick_seconds;
    }
    /// What a person may ask about that came of a change or a tick: a joint that jumped. Parts of this lab;
    /// the workspace is for what is worked out of them. The ticks are filled in by who asks.
    virtual std::vector<Incident> review(const Workspace&, const Part& /*before*/,
                                         const Part& /*after*/) const {
        return {};
    }
    /// Whether something long is being worked out, a share of it in every tick, paused or not.
    virtual bool working(const Workspace&) const { return false; }
    virtual void work(Workspace&) const {}
    /// The strip of time below the scene: how high it is, in pixels at scale 1. 0: there is none.
    static constexpr float strip_height = 46.0f;
    virtual float timeline_height(const Workspace&) const { return 0.0f; }
    virtual void timeline(const Workspace&, Emit&) const {}

    // a flat picture beside the scene: plots, for a lab that is mostly numbers over time
    /// How much of the middle of the window it takes from the 3D view, from the left: 0 to 1.
    virtual float canvas_share(const Workspace&) const { return 0.0f; }
    virtual void canvas(const Workspace&, Emit&) const {}

    // the mouse
    virtual std::vector<Handle> handles(const Workspace&) const { return {}; }
    /// What is picked, if it is there. Of handles() unless there is more to pick than has a name.
    virtual std::optional<Handle> handle(const Workspace& workspace, PickId pick) const;
    /// The handle whose gizmo is shown, the one that is selected; --state has its parts as "head.move_x".
    /// What it drags comes to drag() with the handle's pick.
    virtual std::optional<Handle> gizmo(const Workspace&) const { return std::nullopt; }
    /// The handle is dragged to a frame; called each time the pointer moves.
    virtual void drag(const Workspace&, PickId, const Handle::Frame&, Emit&) const {}
    /// Where several are selected: what an arrow (Drag::Position) or a ring (Drag::Rotation) of the gizmo
    /// takes along. No handles: the gizmo's own alone is dragged.
    virtual Together together(const Workspace&, Drag) const { return {}; }
    /// All of these are dragged, each to the frame that it has here.
    virtual void drag_together(const Workspace&, const std::vector<Handle>&, Emit&) const {}
    /// The handle that was dragged is let go, wherever it is now.
    virtual void drop(const Workspace&, PickId, Emit&) const {}
    /// The handle, or with no_pick the empty scene, is clicked.
    virtual void click(const Workspace&, PickId, Emit&) const {}
    /// Esc, where nothing else takes it: nothing is selected any more.
    virtual void deselect(const Workspace& workspace, Emit& emit) const { click(workspace, no_pick, emit); }
    /// Clicked with Shift held: adds to what is selected, or takes it out, where several can be selected.
    virtual void click_more(const Workspace& workspace, PickId pick, Emit& emit) const {
        click(workspace, pick, emit);
    }
    /// Whether a box can be drawn that selects: Ctrl and a drag on nothing.
    virtual bool selects_by_box() const { return false; }
    /// What a box selects where its middle is inside.
    virtual std::vector<Handle> selectable(const Workspace& workspace) const { return handles(workspace); }
    /// The handles that are in the box are selected, with `add` beside those that were. One that stays as it
    /// is may be among them.
    virtual void select(const Workspace&, const std::vector<PickId>&, bool /*add*/, Emit&) const {}
    /// The second click on a handle; the first was a click too.
    virtual void double_click(const Workspace& workspace, PickId pick, Emit& emit) const {
        click(workspace, pick, emit);
    }
    /// What the mouse would do there, for the status line.
    virtual std::string hint(const Workspace&, PickId) const { return {}; }
    /// What the camera frames; all handles unless the lab knows better.
    virtual Bounds bounds(const Workspace& workspace, bool selection_only) const;

    /// Takes a file that is dropped on the window, by a command. False where it is none of the lab's: then it
    /// opens as a scene.
    virtual bool take_file(const std::string& /*path*/, Emit&) const { return false; }

    // the panels
    virtual void panel(const Workspace&, Emit&) const {}
    virtual void inspector(const Workspace&, Emit&) const {}
    virtual std::vector<LegendRow> legend(const Workspace&) const { return {}; }

    // what the shell's tables get from it
    virtual std::vector<Shortcut> shortcuts() const { return {}; }
    virtual std::vector<LabSetting> settings() const { return {}; }
    /// What the mouse does here beside what it does in every lab.
    virtual std::vector<MouseHelp> mouse_help() const { return {}; }

    // what goes out
    /// What *copy as C++* puts on the clipboard, a whole program; empty where the lab has none.
    virtual std::string code(const Workspace&) const { return {}; }
    /// What --state writes, without handles and camera; what is saved unless the lab says more.
    virtual Json state(const Workspace& workspace) const;

    virtual std::vector<TestScene> test_scenes() const { return {}; }
};

}  // namespace tendril::app
