// An engine's trace as the Chain lab's past: each frame becomes a moment of the strip, with the incidents
// found in it and Tendril's solve of the same input as a ghost.
#pragma once

#include <glm/vec3.hpp>
#include <string>
#include <vector>

#include "app/document/command.hpp"
#include "app/fields/fields.hpp"
#include "app/io/trace/trace.hpp"
#include "app/labs/chain/chain_part.hpp"
#include "app/labs/kit/panel_rows.hpp"
#include "app/view/draw_list.hpp"
#include "app/widgets/emit.hpp"
#include "app/widgets/more.hpp"

namespace tendril::app {

struct View;

/// The settings of chain.trace: how a trace is read and shown, and how Tendril solves it.
struct TraceView : TraceSolve {
    TraceUp up = TraceUp::Y;
    TraceHand handed = TraceHand::Right;
    TraceUnit unit = TraceUnit::Metres;
    QuaternionOrder rotations = QuaternionOrder::Xyzw;
    int from = 0;  ///< the first frame shown
};

/// The trace on the strip. Not saved.
struct ShownTrace {
    std::string path, text;  ///< the source: a file, or pasted text
    std::string name;        ///< for messages
    ConventionChoice choice;
    TraceView view;
    Conventions conventions;
    std::string chain;
    std::vector<TracedFrame> frames;  ///< as many as the strip holds
    std::uint64_t all = 0;            ///< number of this chain's frames in the trace
    std::vector<TracedIncident> incidents;
    std::vector<std::string> bones, notes;
};

/// The trace frame that the chain shows; null if it shows none.
const TracedPose* traced_pose(const ChainPart& part);
void draw_traced_ghost(const View& view, const ChainPart& part, DrawList& list);
/// The incident of the shown frame, the latest to begin; else the first incident on the strip.
Verdict trace_verdict(const TracedPose& pose);
/// Joints and targets of all shown frames.
std::vector<glm::vec3> traced_points(const TracedPose& pose);
/// The ghost's first pose, and the present target, in the axes and unit of the trace: for export.
ChainPart part_as_written(const ChainPart& part, const TracedPose& pose);
/// Panel: how the trace is read, why, and how Tendril solves it.
void trace_rows(const TracedPose& pose, MoreRows& more, Emit& emit);

void add_trace_commands(CommandTable& table);

}  // namespace tendril::app

template <>
std::span<const tendril::Field> tendril::fields<tendril::app::TraceView>() noexcept;
template <>
std::span<const tendril::app::FieldText> tendril::app::field_texts<tendril::app::TraceView>();
