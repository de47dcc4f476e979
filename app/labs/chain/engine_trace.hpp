// A trace from an engine as the Chain lab's past: each frame becomes a moment of the strip, with what was
// found in it, and beside it as a ghost what Tendril's solver makes of the same input.
#pragma once

#include <glm/vec3.hpp>
#include <memory>
#include <string>
#include <string_view>
#include <tendril/ik/method.hpp>
#include <vector>

#include "app/document/command.hpp"
#include "app/fields/fields.hpp"
#include "app/io/trace/trace.hpp"
#include "app/labs/chain/chain_part.hpp"
#include "app/view/draw_list.hpp"
#include "app/widgets/emit.hpp"
#include "app/widgets/more.hpp"

namespace tendril::app {

struct View;

/// How a trace is read and shown: what chain.trace sets.
struct TraceView {
    TraceUp up = TraceUp::Y;
    TraceHand handed = TraceHand::Right;
    TraceUnit unit = TraceUnit::Metres;
    QuaternionOrder rotations = QuaternionOrder::Xyzw;
    int from = 0;  ///< the first frame shown
    // Tendril's solve:
    ik::Method solver = ik::Method::Fabrik;
    float soft_zone = 0.0f;
    glm::vec3 pole_by{0.0f};
    int hinge = 0;

    TraceSolve solve() const {
        return {.method = solver, .soft_zone = soft_zone, .pole_by = pole_by, .hinge = hinge};
    }
};

/// A trace while it is on the strip. Not saved.
struct ShownTrace {
    std::string path, text;  ///< where it comes from: a file, or pasted text
    std::string name;        ///< for messages
    ConventionChoice choice;
    TraceView view;
    Conventions conventions;
    std::string chain;
    std::vector<TracedFrame> frames;  ///< those that the strip can hold
    std::uint64_t all = 0;            ///< frames of this chain
    std::vector<TracedIncident> incidents;
    std::vector<std::string> bones, notes;
};

/// The trace's frame, while the chain shows it; else null.
const TracedPose* traced_pose(const ChainPart& part);
/// The method of the ghost.
ik::Method traced_method(const TracedPose& pose);
void draw_traced_ghost(const View& view, const ChainPart& part, DrawList& list);
/// Panel: how the trace is read, and why, and how Tendril solves it.
void trace_rows(const TracedPose& pose, MoreRows& more, Emit& emit);

void add_trace_commands(CommandTable& table);

}  // namespace tendril::app

template <>
std::span<const tendril::Field> tendril::fields<tendril::app::TraceView>() noexcept;
template <>
std::span<const tendril::app::FieldText> tendril::app::field_texts<tendril::app::TraceView>();
