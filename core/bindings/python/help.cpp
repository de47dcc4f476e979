// Written by core/bindings/generate from the comments of the public headers, tables.json and stubs/*.pyi. Edit those.
#include "help.hpp"

#include <algorithm>
#include <iterator>

namespace tendril::python {

namespace {

struct Help {
    std::string_view name;
    const char* text;
};
constexpr Help helps[] = {
    {"ActiveLimit",
     "The joint that stops the tip, and by how much."},
    {"Batch",
     "Chains with the same number of bones, solved together by vector units. `lengths`: (bones,)"
     " for all of `chains`, or\n(chains, bones), metres. A solve uses at most `threads`. `limits`"
     ": one per bone, the same for all chains. Make one per\ncrowd and keep it."},
    {"Batch.__init__",
     "__init__($self, lengths, chains=None, *, threads=1, limits=(), rest_directions=None)\n--\n\n"},
    {"Batch.bones",
     "Bones per chain."},
    {"Batch.chains",
     "Number of chains."},
    {"Batch.rotations",
     "rotations($self, given)\n--\n\n"},
    {"Batch.solve",
     "solve($self, joints, targets, *, options=None, out=None, **fields)\n--\n\nMoves all joints bu"
     "t the roots, (chains, bones + 1, 3), so that every tip reaches its target, (chains, 3), an"
     "d\nreturns them with a report. With `out=joints` it works in place, without a copy. Other P"
     "ython threads run\nmeanwhile."},
    {"Limit",
     "How far a joint may swing and twist; all angles in radians."},
    {"Limit.hinge",
     "hinge(axis, min, max)\n--\n\nA hinge about `axis`, a world axis at rest, from `min` to `max` "
     "radians."},
    {"Limit.of",
     "of(kind)\n--\n\nA limit of this kind with typical human angles, to be adjusted."},
    {"ManyReport",
     "How each chain of a batch ended, as arrays of shape (chains,)."},
    {"ManyReport.converged",
     "Whether each tip is within tolerance of its target."},
    {"ManyReport.invalid",
     "How many chains were refused: they keep their pose."},
    {"ManyReport.iterations",
     "Iterations of each chain."},
    {"ManyReport.residual",
     "Metres from each tip to its target; infinite if the chain was refused."},
    {"ManyReport.scalar_fallback",
     "Whether the scalar solver took the chain."},
    {"ManyReport.status",
     "Index of each chain's Status: list(Status)[report.status[i]]."},
    {"Options",
     "Options of a solve."},
    {"Plane",
     "Keeps a chain in a plane through its root."},
    {"Solver",
     "One chain: the root stays, the tip moves to a target. Holds the bones' lengths and scratch"
     " memory, so make one per\nchain and keep it; one per thread, too. `lengths`: one per bone, "
     "metres. `rest_directions`: where each bone points at\nrest, unit vectors, (bones, 3); None "
     "for all along +X."},
    {"Solver.__init__",
     "__init__($self, lengths, rest_directions=None)\n--\n\n"},
    {"Solver.bones",
     "Number of bones; a chain has a joint more."},
    {"Solver.explain",
     "explain($self, joints, target, *, state=None, options=None, **fields)\n--\n\nAfter a solve th"
     "at ended Limited: the joint that stops the tip, from joints and state as the solve left th"
     "em.\nNone if freeing no single joint brings the tip nearer."},
    {"Solver.initial_state",
     "initial_state($self)\n--\n\nA state for this chain: at rest, with no memory."},
    {"Solver.lengths",
     "A copy of the lengths, metres."},
    {"Solver.reach",
     "Sum of the lengths, metres."},
    {"Solver.rest_joints",
     "rest_joints($self, root=None)\n--\n\nThe joints of the chain at rest, (bones + 1, 3), metres;"
     " its root at the origin unless given."},
    {"Solver.solve",
     "solve($self, joints, target, *, method='fabrik', state=None, options=None, out=None, **fie"
     "lds)\n--\n\nMoves all joints but the root, (bones + 1, 3), so that the tip reaches the target"
     ", and returns them with a report.\n`joints` stay as they are unless they are `out` too. Pas"
     "s the same `state` from solve to solve, and it is kept up\nto date: a chain that follows a "
     "target then moves smoothly. The members of Options may be given by name:\npole=(0, -1, 0). "
     "Other Python threads run meanwhile. A report that says Stretched, TooClose or Limited is n"
     "o\nerror."},
    {"State",
     "What a chain remembers from solve to solve: rotations, the pole's plane, the side of a pla"
     "ne. A plain value: keep it\nwith the joints, copy it, pickle it. With the same joints and s"
     "tate a solve gives the same bits."},
    {"State.__init__",
     "__init__($self, bones)\n--\n\n"},
    {"State.bones",
     "Number of bones."},
    {"State.copy",
     "copy($self)\n--\n\nA copy."},
    {"State.limits",
     "A copy of how the last solve within limits went."},
    {"State.local_rotations",
     "Each bone's rotation relative to its parent bone, as engines store it: (bones, 4)."},
    {"State.pole",
     "A copy of how the last solve with a pole left the chain."},
    {"State.reset",
     "reset($self)\n--\n\nBack to the initial state."},
    {"State.rotations",
     "A copy of each bone's rotation from rest, in the world: unit quaternions, (bones, 4)."},
    {"State.side",
     "The side on which the last solve left a chain in a plane."},
    {"Struct",
     "A struct of the library: keyword arguments, properties that check their ranges, ==, copy a"
     "nd pickle. Its repr says\nwhat differs from the default."},
    {"Struct.copy",
     "copy($self)\n--\n\nA copy that shares nothing with this one, not even nested structs."},
    {"TwoBoneOptions",
     "Options of two_bone()."},
    {"TwoBoneResult",
     "Where two_bone() puts the limb."},
    {"ik::ActiveLimit",
     "The joint that stops the tip, and by how much."},
    {"ik::ActiveLimit.bound",
     "Bound [default max]."},
    {"ik::ActiveLimit.enough",
     "Whether freeing this joint alone lets the tip reach the target [default False]."},
    {"ik::ActiveLimit.joint",
     "Index of the limited joint: the start of the limit's bone [0 to 1e6, default 0]."},
    {"ik::ActiveLimit.kind",
     "Kind [default free]."},
    {"ik::ActiveLimit.limit",
     "The angle at which the joint stops, radians, with the sign of the limit's field (down and "
     "right are positive) [rad, -10 to 10, default 0]."},
    {"ik::ActiveLimit.needed",
     "The angle that would reach the target if only this joint were free, radians; if none does,"
     " the angle that brings the tip nearest [rad, -10 to 10, default 0]."},
    {"ik::AngleFrom",
     "The direction from which a bone's angle is measured."},
    {"ik::AngleLimit",
     "The range of a bone's angle: radians, positive to the left. -pi <= min <= max <= pi; a ful"
     "l turn is no limit."},
    {"ik::AngleLimit.from",
     "From [default bone]."},
    {"ik::AngleLimit.max",
     "Max [rad, -pi to pi, default pi]."},
    {"ik::AngleLimit.min",
     "Min [rad, -pi to pi, default -pi]."},
    {"ik::Bound",
     "One bound of a limit."},
    {"ik::JointKind",
     "Choices of `JointKind`."},
    {"ik::Limit",
     "How far a joint may swing and twist; all angles in radians."},
    {"ik::Limit.axis",
     "World axis at rest, longer than 1e-6 [-1e9 to 1e9, default 0 0 1]."},
    {"ik::Limit.down",
     "All other kinds: half-angles of the cone, 0 to pi; each pair of neighbours spans an ellipt"
     "ic quadrant [rad, 0 to pi, default 0]."},
    {"ik::Limit.kind",
     "Kind [default free]."},
    {"ik::Limit.left",
     "All other kinds: half-angles of the cone, 0 to pi; each pair of neighbours spans an ellipt"
     "ic quadrant [rad, 0 to pi, default 0]."},
    {"ik::Limit.max",
     "Hinge: the angle about axis, -pi <= min <= max <= pi [rad, -pi to pi, default 0]."},
    {"ik::Limit.min",
     "Hinge: the angle about axis, -pi <= min <= max <= pi [rad, -pi to pi, default 0]."},
    {"ik::Limit.right",
     "All other kinds: half-angles of the cone, 0 to pi; each pair of neighbours spans an ellipt"
     "ic quadrant [rad, 0 to pi, default 0]."},
    {"ik::Limit.stiffness",
     "How much the joint resists turning, compared with the other joints of the chain [0 to 0.99"
     ", default 0]."},
    {"ik::Limit.twist_max",
     "All other kinds: -pi <= twist_min <= twist_max <= pi [rad, -pi to pi, default 0]."},
    {"ik::Limit.twist_min",
     "All other kinds: -pi <= twist_min <= twist_max <= pi [rad, -pi to pi, default 0]."},
    {"ik::Limit.up",
     "All other kinds: half-angles of the cone, 0 to pi; each pair of neighbours spans an ellipt"
     "ic quadrant [rad, 0 to pi, default 0]."},
    {"ik::LimitMemory",
     "How the last solve by Method.Fabrik within limits went, so that the next one can continue "
     "from there while the target is dragged (Options.restarts)."},
    {"ik::LimitMemory.damping",
     "Damping of its last least-squares step, in squares of the reach; 0 to 100."},
    {"ik::LimitMemory.limited",
     "Ended Limited or Stalled; the next stops at a step without gain."},
    {"ik::LimitMemory.target",
     "Metres from the root [m]."},
    {"ik::ManyOptions",
     "The subset of Options that a batch supports: same names, ranges and defaults."},
    {"ik::ManyOptions.every_iteration",
     "Runs all max_iterations even after converging; for measuring and for comparing solvers [de"
     "fault False]."},
    {"ik::ManyOptions.max_iterations",
     "Max iterations [1 to 1e6, default 100]."},
    {"ik::ManyOptions.plane",
     "Keeps every chain in a plane of this normal through its own root, as Options.plane."},
    {"ik::ManyOptions.restarts",
     "As Options.restarts, for the scalar solver within limits [0 to 1000, default None]."},
    {"ik::ManyOptions.tolerance",
     "By default 1e-3 of each chain's own reach [m, 0 to 1e9, default None]."},
    {"ik::Method",
     "Choices of `Method`."},
    {"ik::Options",
     "Options of a solve."},
    {"ik::Options.damping",
     "Damping of the two damped solvers as a fraction of the reach [over 0 to 10, default 0.1]."},
    {"ik::Options.every_iteration",
     "Runs all max_iterations even after converging; for measuring and for comparing solvers. (A"
     " target out of reach or too close still takes no iterations.) [default False]."},
    {"ik::Options.limits",
     "One per bone, at the joint where the bone starts; or empty."},
    {"ik::Options.max_iterations",
     "Max iterations [1 to 1e6, default 100]."},
    {"ik::Options.max_stretch_scale",
     "Max stretch scale [1 to 100, default 1]."},
    {"ik::Options.plane",
     "Keeps the chain in a plane."},
    {"ik::Options.pole",
     "Pole target, metres: the point that the elbow or knee faces [m, -1e9 to 1e9, default None]"
     "."},
    {"ik::Options.pole_turn",
     "Pole turn [default whole_chain]."},
    {"ik::Options.restarts",
     "Within limits, if descent ends short of the target: how many other poses to restart from, "
     "as far as max_iterations allows [0 to 1000, default None]."},
    {"ik::Options.rotations",
     "Keeps the state's rotations up to date in every solve [default False]."},
    {"ik::Options.snap_back",
     "Before iterating, blends each bone this far towards its rest direction [0 to 1, default 0]"
     "."},
    {"ik::Options.soft_zone",
     "Within this zone before full reach the chain eases off instead of snapping straight [0 to "
     "1, default 0]."},
    {"ik::Options.start_stretch_ratio",
     "Two-bone only: the fraction of the reach from which the bones lengthen, and their maximum "
     "scale, 1 to 100 [over 0 to 1, default 1]."},
    {"ik::Options.tip_orientation",
     "Unit quaternion: the final rotation of the last bone from its rest direction [unit length,"
     " default None]."},
    {"ik::Options.tolerance",
     "By default 1e-3 of the reach [m, 0 to 1e9, default None]."},
    {"ik::Options.twist",
     "Two-bone only: rotates the bend about the line from root to tip, radians [rad, -1e9 to 1e9"
     ", default 0]."},
    {"ik::Options.weight",
     "Blends from the given pose (after enforcing lengths or limits) to the solved one [0 to 1, "
     "default 1]."},
    {"ik::Plane",
     "Keeps a chain in a plane through its root."},
    {"ik::Plane.bend",
     "The side to bend to [default free]."},
    {"ik::Plane.limits",
     "One per bone, or empty."},
    {"ik::Plane.normal",
     "Longer than 1e-6, coordinates at most 1e9; need not be a unit vector [-1e9 to 1e9, default"
     " 0 0 1]."},
    {"ik::PoleMemory",
     "How the last solve with a pole left the chain, so that the next one can limit how fast the"
     " chain turns."},
    {"ik::PoleMemory.joints",
     "Metres, bones + 1: where the solve left them [m]."},
    {"ik::PoleMemory.pole",
     "Metres [m]."},
    {"ik::PoleMemory.target",
     "Metres [m]."},
    {"ik::PoleMemory.turn",
     "How the chain was turned to face it."},
    {"ik::PoleMemory.twist",
     "Radians; Method.TwoBone only [rad]."},
    {"ik::PoleTurn",
     "How a chain is turned to face its pole."},
    {"ik::Report",
     "How a solve ended, and what it did."},
    {"ik::Report.closed_form",
     "The result, or the start of the iterations, was found in closed form: two bones, or a targ"
     "et out of reach or too close."},
    {"ik::Report.iterations",
     "Iterations."},
    {"ik::Report.least_squares_steps",
     "Iterations within limits that took such a step."},
    {"ik::Report.off_plane",
     "Metres from the target to the plane of the chain, if it has one [m]."},
    {"ik::Report.perturbations",
     "Times the chain was perturbed to leave a stalled or collinear pose."},
    {"ik::Report.residual",
     "Metres from the tip to the target; infinite if the input was refused [m]."},
    {"ik::Report.restarts",
     "Restarts from other poses."},
    {"ik::Report.status",
     "Status."},
    {"ik::Side",
     "Choices of `Side`."},
    {"ik::Status",
     "How a solve ended."},
    {"ik::TwoBoneOptions",
     "Options of two_bone()."},
    {"ik::TwoBoneOptions.max_stretch_scale",
     "Max stretch scale [1 to 100, default 1]."},
    {"ik::TwoBoneOptions.pole",
     "Pole target, metres: the point that the middle joint faces [m, -1e9 to 1e9, default None]."},
    {"ik::TwoBoneOptions.start_stretch_ratio",
     "The fraction of the reach from which the bones lengthen, and their maximum scale, 1 to 100"
     " [over 0 to 1, default 1]."},
    {"ik::TwoBoneOptions.twist",
     "Rotates the bend about the line from root to target, right-handed, radians, starting at th"
     "e pole; without a pole at the current side, so every solve rotates it further [rad, -1e9 t"
     "o 1e9, default 0]."},
    {"ik::TwoBoneResult",
     "Where two_bone() puts the limb."},
    {"ik::TwoBoneResult.mid",
     "Mid [m]."},
    {"ik::TwoBoneResult.residual",
     "Metres from the tip to the target; infinite if the input was refused [m]."},
    {"ik::TwoBoneResult.scale",
     "Scale of both bones."},
    {"ik::TwoBoneResult.status",
     "Or Stretched, TooClose, InvalidInput (limb unchanged)."},
    {"ik::TwoBoneResult.tip",
     "Tip [m]."},
    {"signal",
     "Filters and springs over whole arrays.\n\n    smooth = signal.run(signal.OneEuro(min_cutoff="
     "2, beta=0.05), recorded, dt=1 / 60)\n\nA filter is a struct of parameters. run() starts afre"
     "sh; a Chain remembers, for input that arrives frame by frame."},
    {"signal.Chain",
     "Filters one after the other that remember their states, with one of its own for each chann"
     "el."},
    {"signal.Chain.__init__",
     "__init__($self, filters)\n--\n\n"},
    {"signal.Chain.copy",
     "copy($self)\n--\n\nA copy with its states."},
    {"signal.Chain.reset",
     "reset($self)\n--\n\nForgets all states: the next row is the first."},
    {"signal.Chain.run",
     "run($self, values, dt)\n--\n\nThe output after each row of `values`, (n,) or (n, channels). `"
     "dt`: the seconds that pass before each row, (n,) or\none number for all. Goes on from the l"
     "ast call; if a value is refused, nothing changes. Other Python threads run\nmeanwhile."},
    {"signal.Chain.step",
     "step($self, value, dt)\n--\n\nOne row: a number, or one per channel."},
    {"signal.Inertialize",
     "Passes its input on, and blends each jump of it away."},
    {"signal.InterpToExact",
     "As InterpTo, but exact: the same at any frame rate."},
    {"signal.Measures",
     "How filters follow an input. A measure that the input does not determine is None. `followi"
     "ng`: \"unknown\", \"follows\",\n\"does_not_follow\" or \"unstable\"; lag and settling time in secon"
     "ds; overshoot relative to the step; jitter relative to\nthe input's; rate_difference: the l"
     "argest difference between frame rates."},
    {"signal.Spring",
     "A damped spring that follows its input, exact at any frame time."},
    {"signal.measure",
     "measure(filters, values, dt)\n--\n\nLag, overshoot, settling time, jitter and dependence on t"
     "he frame rate of filters on one input, (n,)."},
    {"signal.run",
     "run(filters, values, dt)\n--\n\nThe output of filters, one after the other, after each row of"
     " `values`, (n,) or (n, channels), from fresh states. `dt`:\nseconds, one number for all row"
     "s or one per row."},
    {"signal::DeadZone",
     "0 within width of 0, sign(x) (|x| - width) outside."},
    {"signal::DeadZone.width",
     "Width [0 to 1e9, default 0.1]."},
    {"signal::ExponentialDecay",
     "X += (input - x) (1 - 2^(-dt / halflife)): the remaining distance halves every halflife se"
     "conds, at any frame rate."},
    {"signal::ExponentialDecay.halflife",
     "S, 0 (no smoothing) to 1e4 [s, 0 to 1e4, default 0.1]."},
    {"signal::Hysteresis",
     "1 from high up, 0 from low down, unchanged in between, and 0 at first: a switch that does "
     "not flicker."},
    {"signal::Hysteresis.high",
     "-1e9 to 1e9 [-1e9 to 1e9, default 0.6]."},
    {"signal::Hysteresis.low",
     "-1e9 to 1e9 [-1e9 to 1e9, default 0.4]."},
    {"signal::Inertialize",
     "Passes its input on, and blends each jump of it away."},
    {"signal::Inertialize.halflife",
     "S, 0 (jumps pass) to 1e4 [s, 0 to 1e4, default 0.1]."},
    {"signal::Inertialize.threshold",
     "A larger change in one step is a jump [0 to 1e9, default 0.5]."},
    {"signal::InterpTo",
     "The same as filters: the state is the current value."},
    {"signal::InterpTo.speed",
     "1/s [1/s, -1e6 to 1e6, default 10]."},
    {"signal::InterpToExact",
     "As InterpTo, but exact: the same at any frame rate."},
    {"signal::InterpToExact.speed",
     "1/s [1/s, -1e6 to 1e6, default 10]."},
    {"signal::MovingAverage",
     "The mean of the last window seconds, each sample weighted by the dt of its own step, the o"
     "ldest in part."},
    {"signal::MovingAverage.window",
     "S, 0 (no smoothing) to 3600 [s, 0 to 3600, default 0.2]."},
    {"signal::OneEuro",
     "The 1 Euro filter (G. Casiez, N. Roussel, D. Vogel, CHI 2012): a low pass whose cutoff ris"
     "es with speed, so that a hand at rest is steady and a hand that moves has little lag."},
    {"signal::OneEuro.beta",
     "Hz per 1/s [0 to 1e6, default 0.1]."},
    {"signal::OneEuro.derivative_cutoff",
     "Derivative cutoff [Hz, 0 to 1e6, default 1]."},
    {"signal::OneEuro.min_cutoff",
     "Min cutoff [Hz, 0 to 1e6, default 1]."},
    {"signal::OneEuro.reset_jump",
     "Restart if input and output are farther apart, 0 to 1e9; 0: never [0 to 1e9, default 0]."},
    {"signal::RateLimit",
     "Limits the speed, separately up and down."},
    {"signal::RateLimit.fall",
     "1/s [1/s, 0 to 1e9, default 1]."},
    {"signal::RateLimit.rise",
     "1/s [1/s, 0 to 1e9, default 1]."},
    {"signal::ScaleBiasClamp",
     "Numbers from -1e9 to 1e9, speeds from -1e6 to 1e6."},
    {"signal::ScaleBiasClamp.bias",
     "Bias [-1e9 to 1e9, default 0]."},
    {"signal::ScaleBiasClamp.clamp",
     "3 [default False]."},
    {"signal::ScaleBiasClamp.clamp_max",
     "Clamp max [-1e9 to 1e9, default 1]."},
    {"signal::ScaleBiasClamp.clamp_min",
     "Clamp min [-1e9 to 1e9, default 0]."},
    {"signal::ScaleBiasClamp.in_range",
     "In range [-1e9 to 1e9, default 0 1]."},
    {"signal::ScaleBiasClamp.interp",
     "Interp [default False]."},
    {"signal::ScaleBiasClamp.map_range",
     "1 [default False]."},
    {"signal::ScaleBiasClamp.out_range",
     "Out range [-1e9 to 1e9, default 0 1]."},
    {"signal::ScaleBiasClamp.scale",
     "2 [-1e9 to 1e9, default 1]."},
    {"signal::ScaleBiasClamp.speed_decreasing",
     "Speed decreasing [1/s, -1e6 to 1e6, default 10]."},
    {"signal::ScaleBiasClamp.speed_increasing",
     "Speed increasing [1/s, -1e6 to 1e6, default 10]."},
    {"signal::SmoothDamp",
     "Unity's Mathf.SmoothDamp (T. Lowe, \"Critically Damped Ease-In/Ease-Out Smoothing\", Game Pr"
     "ogramming Gems 4, 2004): a critically damped spring with 1 / (1 + x + 0.48 x^2 + 0.235 x^3"
     ") for exp(-x), x = 2 dt / smooth_time, and the distance clamped to max_speed * smooth_time"
     "."},
    {"signal::SmoothDamp.max_speed",
     "1/s [1/s, 0 to 1e9, default 1e6]."},
    {"signal::SmoothDamp.smooth_time",
     "S, 0 to 1e4; under 1e-4 counts as 1e-4 [s, 0 to 1e4, default 0.1]."},
    {"signal::Spring<double>",
     "A damped spring that follows its input, exact at any frame time."},
    {"signal::Spring<double>.critical_damping",
     "Damping ratio, 0 to 1e3: 0 oscillates for ever, 1 is the fastest without overshoot [0 to 1"
     "000, default 1]."},
    {"signal::Spring<double>.force",
     "Force on a mass of 1, at most 1e9: shifts the target by force / w^2 [1/s^2, -1e9 to 1e9, d"
     "efault 0]."},
    {"signal::Spring<double>.strength",
     "Undamped frequency in Hz [Hz, 0 to 1e4, default 4]."},
    {"signal::Spring<double>.target_velocity_amount",
     "How much of the target's velocity is anticipated: at 1 the spring follows steady motion wi"
     "thout lag, but overshoots jumps [0 to 1, default 0]."},
    {"signal::SpringSemiImplicit",
     "The spring found in most games: velocity first, then position (semi-implicit Euler)."},
    {"signal::SpringSemiImplicit.critical_damping",
     "Critical damping [0 to 1000, default 1]."},
    {"signal::SpringSemiImplicit.strength",
     "Strength [Hz, 0 to 1e4, default 4]."},
    {"solve_many",
     "solve_many(lengths, joints, targets, *, threads=1, limits=(), rest_directions=None, option"
     "s=None, out=None, **fields)\n--\n\nA Batch for one solve: the same arguments as Batch() and i"
     "ts solve()."},
    {"tendril",
     "Chains that reach, filters, ropes and linkages: the library Tendril.\n\n    arm = tendril.So"
     "lver([0.4, 0.35, 0.1])\n    joints, report = arm.solve(arm.rest_joints(), (0.3, 0.4, 0.1), "
     "pole=(0, -1, 0))\n\nUnits are metres, seconds and radians; rotations are [x, y, z, w]. Array"
     "s are NumPy's: float32 and in C order they are\nused where they lie, other numbers are conv"
     "erted. A refused argument raises ValueError or TypeError, and nothing changes."},
    {"two_bone",
     "two_bone(root, mid, tip, target, *, lengths, options=None, **fields)\n--\n\nAn arm or leg in "
     "closed form, without a solver. `lengths`: of both bones, unstretched."},
};

}  // namespace

const char* help(std::string_view name) noexcept {
    const Help* const found = std::lower_bound(std::begin(helps), std::end(helps), name,
        [](const Help& each, std::string_view wanted) { return each.name < wanted; });
    return found != std::end(helps) && found->name == name ? found->text : "";
}

}  // namespace tendril::python
