// The one interface between the frame and a lab. A lab keeps nothing of its own: what it shows is in the
// workspace, what it changes it changes by commands, so undo, scripts and recordings hold for every lab
// alike. Solvers and other scratch memory it keeps in its runtime (runtime.hpp), which the workspace holds.
#pragma once

#include <glm/vec3.hpp>
#include <memory>
#include <string>
#include <vector>

#include "app/document/command.hpp"
#include "app/view/camera.hpp"
#include "app/view/draw_list.hpp"
#include "app/view/palette.hpp"
#include "app/widgets/emit.hpp"

namespace tendril::app {

/// What a lab may look at to draw itself.
struct View {
    const Workspace& workspace;
    const Camera& camera;
    const Palette& palette;
    PickId hovered = no_pick;
    PickId dragged = no_pick;
    float scale = 1.0f;  ///< of everything measured in pixels
};

/// A place in the scene that a person can take hold of.
struct Handle {
    std::string name;  ///< as --state has it: "target", "segment.3"
    glm::vec3 position{0.0f};
};

/// A sphere around what should be in view.
struct Bounds {
    glm::vec3 centre{0.0f};
    float radius = 1.0f;
};

/// What a colour of the picture means here.
struct LegendRow {
    std::string name;
    glm::vec3 colour{1.0f};
    bool ring = false;
};

class Lab {
  public:
    virtual ~Lab() = default;

    virtual std::string name() const = 0;   ///< "chain"
    virtual std::string title() const = 0;  ///< "Chain"
    virtual std::shared_ptr<Part> blank() const = 0;
    virtual CameraPose first_view() const = 0;
    /// What to try first: "Drag the orange ball."
    virtual const char* invitation() const = 0;
    virtual void add_commands(CommandTable& table) const = 0;

    /// Whether time changes anything here now; a lab at rest lets the window idle.
    virtual bool moving(const Workspace& workspace) const = 0;
    /// One tick of tick_seconds, in which clock.speed times as much passes in the lab.
    virtual void step(Workspace& workspace) const = 0;
    /// What the clock in the top bar shows: seconds that have passed in the lab.
    virtual double seconds(const Workspace& workspace) const {
        return static_cast<double>(workspace.clock.tick) * tick_seconds;
    }
    /// Whether its last seconds are remembered, to go back in time.
    virtual bool rewinds() const { return false; }

    virtual void draw(const View& view, DrawList& list) const = 0;

    virtual std::vector<LegendRow> legend(const Workspace& workspace) const = 0;

    virtual std::vector<Handle> handles(const Workspace& workspace) const = 0;
    virtual glm::vec3 position_of(const Workspace& workspace, PickId pick) const = 0;
    /// The handle is dragged to a point; called each time the pointer moves.
    virtual void drag(const Workspace& workspace, PickId pick, glm::vec3 to, Emit& emit) const = 0;
    /// The handle that was dragged is let go, wherever it is now.
    virtual void drop(const Workspace&, PickId, Emit&) const {}
    /// The handle, or with no_pick the empty room, is clicked.
    virtual void click(const Workspace& workspace, PickId pick, Emit& emit) const = 0;
    /// What the mouse would do there, for the status line.
    virtual std::string hint(const Workspace& workspace, PickId pick) const = 0;

    virtual Bounds bounds(const Workspace& workspace, bool selection_only) const = 0;

    virtual void panel(const Workspace& workspace, Emit& emit) const = 0;
    virtual void inspector(const Workspace& workspace, Emit& emit) const = 0;
    /// The strip of time below the scene; shown while has_timeline().
    virtual bool has_timeline(const Workspace&) const { return false; }
    virtual void timeline(const Workspace&, Emit&) const {}

    /// What *copy as C++* puts on the clipboard, a whole program; empty where the lab has none.
    virtual std::string code(const Workspace&) const { return {}; }
    /// What --state writes, without handles and camera.
    virtual Json state(const Workspace& workspace) const = 0;
};

}  // namespace tendril::app
