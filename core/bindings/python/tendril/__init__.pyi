# Written by core/bindings/generate from stubs/tendril.pyi and the library's tables. Edit those.
"""Chains that reach, characters from files, traces from engines; tendril.linkage has linkages, tendril.signal filters,
tendril.rope ropes and cloth.

    arm = tendril.Solver([0.4, 0.35, 0.1])
    joints, report = arm.solve(arm.rest_joints(), (0.3, 0.4, 0.1), pole=(0, -1, 0))

Units are metres, seconds and radians; rotations are [x, y, z, w]. Arrays are NumPy's: float32 and in C order they are
used where they lie, other numbers are converted. A refused argument raises ValueError or TypeError, and nothing changes."""
import os
from collections.abc import Callable, Iterator, Sequence
from enum import Enum
from pathlib import Path
from typing import Any, TypeVar

import numpy
from numpy.typing import ArrayLike, NDArray

__version__: str
_T = TypeVar("_T", bound="Struct")

class Struct:
    """A struct of the library: keyword arguments, properties that check their ranges, ==, copy and pickle. Its repr says
    what differs from the default."""
    def copy(self: _T) -> _T:
        """A copy that shares nothing with this one, not even nested structs."""
    def __eq__(self, other: object) -> bool: ...
    def __copy__(self: _T) -> _T: ...
    def __deepcopy__(self: _T, memo: dict[int, Any]) -> _T: ...

class GroundKind(str, Enum):
    """Choices of `GroundKind`."""
    NONE = "none"
    FLAT = "flat"
    SLOPE = "slope"
    STAIRS = "stairs"
    TERRAIN = "terrain"
    MESH = "mesh"


class Fault(str, Enum):
    """Choices of `Fault`."""
    SKATING = "skating"
    FLOATING = "floating"
    SINKING = "sinking"
    KNEE_POP = "knee_pop"
    SIGN_FLIP = "sign_flip"
    LIMIT = "limit"
    JUMP = "jump"
    SCALE = "scale"
    AXIS = "axis"


class Method(str, Enum):
    """Choices of `Method`."""
    FABRIK = "fabrik"
    """The default: FABRIK plus a step that removes the bend near full reach."""
    FABRIK_PLAIN = "fabrik_plain"
    """As published by Aristidou and Lasenby in 2011, for study; stalls when collinear."""
    CCD = "ccd"
    """Cyclic coordinate descent (Wang and Chen 1991)."""
    JACOBIAN_TRANSPOSE = "jacobian_transpose"
    """With the optimal step along the gradient (Buss 2004)."""
    DLS = "dls"
    """Damped least squares (Wampler 1986, Nakamura and Hanafusa 1986)."""
    SVD_DLS = "svd_dls"
    """The same, damped singular value by singular value (Maciejewski and Klein 1988)."""
    TWO_BONE = "two_bone"
    """Law of cosines; two bones only."""


class IncidentKind(str, Enum):
    """Choices of `IncidentKind`."""
    FLIP = "flip"
    NAN = "nan"
    """A joint, the target or the pole target is not finite; amount: 0."""
    LENGTH = "length"
    LIMIT = "limit"
    """A joint is beyond its limit; amount: degrees beyond it."""
    MISSED = "missed"
    """The tip does not reach a target within its reach; amount: metres short."""
    LAG = "lag"
    JITTER = "jitter"
    """The tip swings while the target is still; amount: metres to either side."""
    REPEATED = "repeated"
    TARGET_JUMP = "target_jump"
    """Amount: metres."""
    POLE_JUMP = "pole_jump"
    """The pole target jumps to another side of the root-target line; amount: metres."""
    MISPLACED = "misplaced"


class JointKind(str, Enum):
    """Choices of `JointKind`."""
    FREE = "free"
    """No limit."""
    SUTURE = "suture"
    """Skull: almost fixed."""
    HINGE = "hinge"
    """Elbow, knee, finger: one axis, from min to max."""
    GLIDING = "gliding"
    """Wrist, ankle: two axes, small range."""
    SADDLE = "saddle"
    """Thumb: two axes, larger range."""
    PIVOT = "pivot"
    """Neck: twist and a small nod."""
    BALL_AND_SOCKET = "ball_and_socket"
    """Hip, shoulder: an elliptic cone and twist."""


class AngleFrom(str, Enum):
    """The direction from which a bone's angle is measured."""
    BONE = "bone"
    """The bone before, 0 if straight; for the first bone the base direction."""
    BASE = "base"


class Side(str, Enum):
    """Choices of `Side`."""
    FREE = "free"
    """Keeps its side; a straight chain that never had one bends to the left."""
    LEFT = "left"
    RIGHT = "right"


class PoleTurn(str, Enum):
    """How a solve turns a chain to face its pole."""
    WHOLE_CHAIN = "whole_chain"
    """All joints at once about the line from root to tip: smooth."""
    EACH_JOINT = "each_joint"
    """Every middle joint about the line between its neighbours; within limits as WholeChain."""


class Status(str, Enum):
    """How a solve ended."""
    CONVERGED = "Converged"
    """The tip is within tolerance of the target."""
    STRETCHED = "Stretched"
    """The target is out of reach and the chain lies straight towards it; or the soft zone keeps the tip short of it
    by more than the tolerance."""
    TOO_CLOSE = "TooClose"
    """The target is closer than the chain can fold, because of its longest bone."""
    LIMITED = "Limited"
    """The joint limits stop the tip: descent ends short of the target, at limits without which it would continue."""
    STALLED = "Stalled"
    """Further iterations of this method would change nothing, and no limit is to blame."""
    ITERATION_LIMIT = "IterationLimit"
    """Not converged when the iterations were used up."""
    INVALID_INPUT = "InvalidInput"
    """A number is not finite or out of range: nothing was moved."""


class Bound(str, Enum):
    """One bound of a limit."""
    MIN = "min"
    MAX = "max"
    UP = "up"
    DOWN = "down"
    LEFT = "left"
    RIGHT = "right"
    TWIST_MIN = "twist_min"
    TWIST_MAX = "twist_max"


class LintSettings(Struct):
    """LintSettings."""
    rate: float
    """Frames per second, up to 1000; 0: the clip's own [1/s, 0 to 1000, default 0]."""
    skating: float
    """Metres that a standing foot may slide [m, 0 to 1000, default 0.02]."""
    floating: float
    """Metres that a standing foot may be above the floor [m, 0 to 1000, default 0.025]."""
    sinking: float
    """Metres that a foot may be below it [m, 0 to 1000, default 0.02]."""
    knee: float
    """Degrees that a knee may jump, at 60 frames per second [deg, 0 to 180, default 6]."""
    turn: float
    """Maximum jump of any other joint in degrees, at 60 frames per second [deg, 0 to 180, default 15]."""
    shift: float
    """Maximum jump of positions, times the figure's height at rest [0 to 1000, default 0.02]."""
    beyond: float
    """Degrees that a joint may exceed limits [deg, 0 to 180, default 2]."""
    def __init__(
            self, *, rate: float = ..., skating: float = ..., floating: float = ..., sinking: float = ...,
            knee: float = ..., turn: float = ..., shift: float = ..., beyond: float = ...) -> None: ...


class Limit(Struct):
    """How far a joint may swing and twist; all angles in radians."""
    kind: JointKind | str
    """Kind [default free]."""
    axis: Sequence[float]
    """World axis at rest, longer than 1e-6 [-1e9 to 1e9, default 0 0 1]."""
    min: float
    """Hinge: the angle about axis, -pi <= min <= max <= pi [rad, -pi to pi, default 0]."""
    max: float
    """Hinge: the angle about axis, -pi <= min <= max <= pi [rad, -pi to pi, default 0]."""
    up: float
    """All other kinds: half-angles of the cone, 0 to pi; each pair of neighbours spans an elliptic quadrant [rad, 0
    to pi, default 0]."""
    down: float
    """All other kinds: half-angles of the cone, 0 to pi; each pair of neighbours spans an elliptic quadrant [rad, 0
    to pi, default 0]."""
    left: float
    """All other kinds: half-angles of the cone, 0 to pi; each pair of neighbours spans an elliptic quadrant [rad, 0
    to pi, default 0]."""
    right: float
    """All other kinds: half-angles of the cone, 0 to pi; each pair of neighbours spans an elliptic quadrant [rad, 0
    to pi, default 0]."""
    twist_min: float
    """All other kinds: -pi <= twist_min <= twist_max <= pi [rad, -pi to pi, default 0]."""
    twist_max: float
    """All other kinds: -pi <= twist_min <= twist_max <= pi [rad, -pi to pi, default 0]."""
    stiffness: float
    """How much the joint resists turning, compared with the other joints of the chain [0 to 0.99, default 0]."""
    def __init__(
            self, *, kind: JointKind | str = ..., axis: Sequence[float] = ..., min: float = ..., max: float = ...,
            up: float = ..., down: float = ..., left: float = ..., right: float = ..., twist_min: float = ...,
            twist_max: float = ..., stiffness: float = ...) -> None: ...
    @staticmethod
    def of(kind: JointKind | str) -> Limit:
        """A limit of this kind with typical human angles, to be adjusted."""
    @staticmethod
    def hinge(axis: ArrayLike, min: float, max: float) -> Limit:
        """A hinge about `axis`, a world axis at rest, from `min` to `max` radians."""


class AngleLimit(Struct):
    """The range of a bone's angle: radians, positive to the left. -pi <= min <= max <= pi; a full turn is no limit."""
    min: float
    """Min [rad, -pi to pi, default -pi]."""
    max: float
    """Max [rad, -pi to pi, default pi]."""
    from_: AngleFrom | str
    """From [default bone]."""
    def __init__(self, *, min: float = ..., max: float = ..., from_: AngleFrom | str = ...) -> None: ...


class Plane(Struct):
    """Keeps a chain in a plane through its root."""
    normal: Sequence[float]
    """Longer than 1e-6, coordinates at most 1e9; need not be a unit vector [-1e9 to 1e9, default 0 0 1]."""
    bend: Side | str
    """The side to bend to [default free]."""
    limits: Sequence[AngleLimit]
    """One per bone, or empty."""
    def __init__(
            self, *, normal: Sequence[float] = ..., bend: Side | str = ...,
            limits: Sequence[AngleLimit] = ...) -> None: ...


class Options(Struct):
    """Options of a solve."""
    tolerance: float | None
    """By default 1e-3 of the reach [m, 0 to 1e9, default None]."""
    max_iterations: int
    """Max iterations [1 to 1e6, default 100]."""
    every_iteration: bool
    """Runs all max_iterations even after converging; for measuring and for comparing solvers. (A target out of reach
    or too close still takes no iterations.) [default False]."""
    limits: Sequence[Limit]
    """One per bone, at the joint where the bone starts; or empty."""
    plane: Plane | None
    """Keeps the chain in a plane."""
    pole: Sequence[float] | None
    """Pole target, metres: the point that the elbow or knee faces [m, -1e9 to 1e9, default None]."""
    pole_turn: PoleTurn | str
    """Pole turn [default whole_chain]."""
    snap_back: float
    """Before iterating, blends each bone this far towards its rest direction [0 to 1, default 0]."""
    tip_orientation: Sequence[float] | None
    """Unit quaternion: the final rotation of the last bone from its rest direction [unit length, default None]."""
    soft_zone: float
    """Within this zone before full reach the chain eases off instead of snapping straight [0 to 1, default 0]."""
    damping: float
    """Damping of the two damped solvers as a fraction of the reach [over 0 to 10, default 0.1]."""
    start_stretch_ratio: float
    """Two-bone only: the fraction of the reach from which the bones lengthen, and their maximum scale, 1 to 100
    [over 0 to 1, default 1]."""
    max_stretch_scale: float
    """Max stretch scale [1 to 100, default 1]."""
    twist: float
    """Two-bone only: rotates the bend about the line from root to tip, radians [rad, -1e9 to 1e9, default 0]."""
    weight: float
    """Blends from the given pose (after enforcing lengths or limits) to the solved one [0 to 1, default 1]."""
    restarts: int | None
    """Within limits, if descent ends short of the target: how many other poses to restart from, as far as
    max_iterations allows [0 to 1000, default None]."""
    rotations: bool
    """Keeps the state's rotations up to date in every solve [default False]."""
    def __init__(
            self, *, tolerance: float | None = ..., max_iterations: int = ..., every_iteration: bool = ...,
            limits: Sequence[Limit] = ..., plane: Plane | None = ..., pole: Sequence[float] | None = ...,
            pole_turn: PoleTurn | str = ..., snap_back: float = ..., tip_orientation: Sequence[float] | None = ...,
            soft_zone: float = ..., damping: float = ..., start_stretch_ratio: float = ...,
            max_stretch_scale: float = ..., twist: float = ..., weight: float = ..., restarts: int | None = ...,
            rotations: bool = ...) -> None: ...


class Report(Struct):
    """How a solve ended, and what it did."""
    status: Status | str
    """Status."""
    iterations: int
    """Iterations."""
    residual: float
    """Metres from the tip to the target; infinite if the input was refused [m]."""
    closed_form: bool
    """The result, or the start of the iterations, was found in closed form: two bones, or a target out of reach or
    too close."""
    perturbations: int
    """Times the chain was perturbed to leave a stalled or collinear pose."""
    least_squares_steps: int
    """Iterations within limits that took such a step."""
    restarts: int
    """Restarts from other poses."""
    off_plane: float
    """Metres from the target to the plane of the chain, if it has one [m]."""
    def __init__(
            self, *, status: Status | str = ..., iterations: int = ..., residual: float = ..., closed_form: bool = ...,
            perturbations: int = ..., least_squares_steps: int = ..., restarts: int = ...,
            off_plane: float = ...) -> None: ...


class ActiveLimit(Struct):
    """The joint that stops the tip, and by how much."""
    joint: int
    """Index of the limited joint: the start of the limit's bone [0 to 1e6, default 0]."""
    kind: JointKind | str
    """Kind [default free]."""
    bound: Bound | str
    """Bound [default max]."""
    limit: float
    """The angle at which the joint stops, radians, with the sign of the limit's field (down and right are positive)
    [rad, -10 to 10, default 0]."""
    needed: float
    """The angle that would reach the target if only this joint were free, radians; if none does, the angle that
    brings the tip nearest [rad, -10 to 10, default 0]."""
    enough: bool
    """Freeing this joint alone lets the tip reach the target [default False]."""
    def __init__(
            self, *, joint: int = ..., kind: JointKind | str = ..., bound: Bound | str = ..., limit: float = ...,
            needed: float = ..., enough: bool = ...) -> None: ...


class PoleMemory(Struct):
    """Records how the last solve with a pole left the chain, so that the next one can limit how fast it turns."""
    turn: PoleTurn | str
    """How the chain was turned to face it."""
    pole: Sequence[float]
    """Metres [m]."""
    target: Sequence[float]
    """Metres [m]."""
    twist: float
    """Radians; Method.TwoBone only [rad]."""
    joints: Sequence[Sequence[float]]
    """Metres, bones + 1: the joints after that solve [m]."""
    def __init__(
            self, *, turn: PoleTurn | str = ..., pole: Sequence[float] = ..., target: Sequence[float] = ...,
            twist: float = ..., joints: Sequence[Sequence[float]] = ...) -> None: ...


class LimitMemory(Struct):
    """Records how the last solve by Method.Fabrik within limits went, so that the next one can continue from there
    while the target is dragged (Options.restarts)."""
    limited: bool
    """Ended Limited or Stalled; the next stops at a step without gain."""
    target: Sequence[float]
    """Metres from the root [m]."""
    damping: float
    """Damping of its last least-squares step, in squares of the reach; 0 to 100."""
    def __init__(self, *, limited: bool = ..., target: Sequence[float] = ..., damping: float = ...) -> None: ...


class TwoBoneOptions(Struct):
    """Options of two_bone()."""
    pole: Sequence[float] | None
    """Pole target, metres: the point that the middle joint faces [m, -1e9 to 1e9, default None]."""
    start_stretch_ratio: float
    """The fraction of the reach from which the bones lengthen, and their maximum scale, 1 to 100 [over 0 to 1,
    default 1]."""
    max_stretch_scale: float
    """Max stretch scale [1 to 100, default 1]."""
    twist: float
    """Rotates the bend about the line from root to target, right-handed, radians, starting at the pole; without a
    pole at the current side, so every solve rotates it further [rad, -1e9 to 1e9, default 0]."""
    def __init__(
            self, *, pole: Sequence[float] | None = ..., start_stretch_ratio: float = ...,
            max_stretch_scale: float = ..., twist: float = ...) -> None: ...


class TwoBoneResult(Struct):
    """Where two_bone() puts the limb."""
    status: Status | str
    """Or Stretched, TooClose, InvalidInput (limb unchanged)."""
    mid: Sequence[float]
    """Mid [m]."""
    tip: Sequence[float]
    """Tip [m]."""
    scale: float
    """Scale of both bones."""
    residual: float
    """Metres from the tip to the target; infinite if the input was refused [m]."""
    def __init__(
            self, *, status: Status | str = ..., mid: Sequence[float] = ..., tip: Sequence[float] = ...,
            scale: float = ..., residual: float = ...) -> None: ...


class ManyOptions(Struct):
    """The subset of Options that a batch supports: same names, ranges and defaults."""
    tolerance: float | None
    """By default 1e-3 of each chain's own reach [m, 0 to 1e9, default None]."""
    max_iterations: int
    """Max iterations [1 to 1e6, default 100]."""
    every_iteration: bool
    """Runs all max_iterations even after converging; for measuring and for comparing solvers [default False]."""
    restarts: int | None
    """As Options.restarts, for the scalar solver within limits [0 to 1000, default None]."""
    plane: Plane | None
    """Keeps every chain in a plane of this normal through its own root, as Options.plane."""
    def __init__(
            self, *, tolerance: float | None = ..., max_iterations: int = ..., every_iteration: bool = ...,
            restarts: int | None = ..., plane: Plane | None = ...) -> None: ...


class State:
    """What a chain remembers from solve to solve: rotations, the pole's plane, the side of a plane. A plain value: keep it
    with the joints, copy it, pickle it. With the same joints and state a solve gives the same bits."""
    def __init__(self, bones: int) -> None: ...
    @property
    def bones(self) -> int:
        """Number of bones."""
    @property
    def rotations(self) -> NDArray[numpy.float32]:
        """A copy of each bone's rotation from rest, in the world: unit quaternions, (bones, 4)."""
    @property
    def local_rotations(self) -> NDArray[numpy.float32]:
        """Each bone's rotation relative to its parent bone, as engines store it: (bones, 4)."""
    @property
    def pole(self) -> PoleMemory:
        """A copy of how the last solve with a pole left the chain."""
    @property
    def limits(self) -> LimitMemory:
        """A copy of how the last solve within limits went."""
    @property
    def side(self) -> Side:
        """The side on which the last solve left a chain in a plane."""
    def reset(self) -> None:
        """Back to the initial state."""
    def copy(self) -> State:
        """A copy."""
    def __copy__(self) -> State: ...
    def __deepcopy__(self, memo: dict[int, Any]) -> State: ...
    def __eq__(self, other: object) -> bool: ...

class Solver:
    """One chain: the root stays, the tip moves to a target. Holds the bones' lengths and scratch memory, so make one per
    chain and keep it; one per thread, too. `lengths`: one per bone, metres. `rest_directions`: where each bone points at
    rest, unit vectors, (bones, 3); None for all along +X."""
    def __init__(self, lengths: ArrayLike, rest_directions: ArrayLike | None = None) -> None: ...
    @property
    def bones(self) -> int:
        """Number of bones; a chain has a joint more."""
    @property
    def reach(self) -> float:
        """Sum of the lengths, metres."""
    @property
    def lengths(self) -> NDArray[numpy.float32]:
        """A copy of the lengths, metres."""
    def initial_state(self) -> State:
        """A state for this chain: at rest, with no memory."""
    def rest_joints(self, root: ArrayLike | None = None) -> NDArray[numpy.float32]:
        """The joints of the chain at rest, (bones + 1, 3), metres; its root at the origin unless given."""
    def solve(
            self, joints: ArrayLike, target: ArrayLike, *, method: Method | str = "fabrik", state: State | None = None,
            options: Options | None = None, out: NDArray[numpy.float32] | None = None, tolerance: float | None = ...,
            max_iterations: int = ..., every_iteration: bool = ..., limits: Sequence[Limit] = ...,
            plane: Plane | None = ..., pole: Sequence[float] | None = ..., pole_turn: PoleTurn | str = ...,
            snap_back: float = ..., tip_orientation: Sequence[float] | None = ..., soft_zone: float = ...,
            damping: float = ..., start_stretch_ratio: float = ..., max_stretch_scale: float = ..., twist: float = ...,
            weight: float = ..., restarts: int | None = ..., rotations: bool = ...) -> tuple[NDArray[numpy.float32],
            Report]:
        """Moves all joints but the root, (bones + 1, 3), so that the tip reaches the target, and returns them with a report.
        `joints` stay as they are unless they are `out` too. Pass the same `state` from solve to solve, and it is kept up
        to date: a chain that follows a target then moves smoothly. The members of Options may be given by name:
        pole=(0, -1, 0). Other Python threads run meanwhile. A report that says Stretched, TooClose or Limited is no
        error."""
    def explain(
            self, joints: ArrayLike, target: ArrayLike, *, state: State | None = None, options: Options | None = None,
            tolerance: float | None = ..., max_iterations: int = ..., every_iteration: bool = ...,
            limits: Sequence[Limit] = ..., plane: Plane | None = ..., pole: Sequence[float] | None = ...,
            pole_turn: PoleTurn | str = ..., snap_back: float = ..., tip_orientation: Sequence[float] | None = ...,
            soft_zone: float = ..., damping: float = ..., start_stretch_ratio: float = ...,
            max_stretch_scale: float = ..., twist: float = ..., weight: float = ..., restarts: int | None = ...,
            rotations: bool = ...) -> ActiveLimit | None:
        """After a solve that ended Limited: the joint that stops the tip, from joints and state as the solve left them.
        None if freeing no single joint brings the tip nearer."""

def two_bone(
        root: ArrayLike, mid: ArrayLike, tip: ArrayLike, target: ArrayLike, *, lengths: ArrayLike,
        options: TwoBoneOptions | None = None, pole: Sequence[float] | None = ..., start_stretch_ratio: float = ...,
        max_stretch_scale: float = ..., twist: float = ...) -> TwoBoneResult:
    """An arm or leg in closed form, without a solver. `lengths`: of both bones, unstretched."""

class ManyReport:
    """How each chain of a batch ended, as arrays of shape (chains,)."""
    @property
    def status(self) -> NDArray[numpy.uint8]:
        """Index of each chain's Status: list(Status)[report.status[i]]."""
    @property
    def converged(self) -> NDArray[numpy.bool_]:
        """Whether each tip is within tolerance of its target."""
    @property
    def iterations(self) -> NDArray[numpy.int32]:
        """Iterations of each chain."""
    @property
    def residual(self) -> NDArray[numpy.float32]:
        """Metres from each tip to its target; infinite if the chain was refused."""
    @property
    def scalar_fallback(self) -> NDArray[numpy.bool_]:
        """Whether the scalar solver took the chain."""
    @property
    def invalid(self) -> int:
        """How many chains were refused: they keep their pose."""
    def __len__(self) -> int: ...

class Batch:
    """Chains with the same number of bones, solved together by vector units. `lengths`: (bones,) for all of `chains`, or
    (chains, bones), metres. A solve uses at most `threads`. `limits`: one per bone, the same for all chains. Make one per
    crowd and keep it."""
    def __init__(self, lengths: ArrayLike, chains: int | None = None, *, threads: int = 1, limits: Sequence[Limit] = (), rest_directions: ArrayLike | None = None) -> None: ...
    @property
    def chains(self) -> int:
        """Number of chains."""
    @property
    def bones(self) -> int:
        """Bones per chain."""
    @property
    def rotations(self) -> NDArray[numpy.float32]:
        """With limits only: each bone's world rotation, (chains, bones, 4). May be set."""
    @rotations.setter
    def rotations(self, given: ArrayLike) -> None: ...
    def solve(
            self, joints: ArrayLike, targets: ArrayLike, *, options: ManyOptions | None = None,
            out: NDArray[numpy.float32] | None = None, tolerance: float | None = ..., max_iterations: int = ...,
            every_iteration: bool = ..., restarts: int | None = ...,
            plane: Plane | None = ...) -> tuple[NDArray[numpy.float32], ManyReport]:
        """Moves all joints but the roots, (chains, bones + 1, 3), so that every tip reaches its target, (chains, 3), and
        returns them with a report. With `out=joints` it works in place, without a copy. Other Python threads run
        meanwhile."""

def solve_many(
        lengths: ArrayLike, joints: ArrayLike, targets: ArrayLike, *, threads: int = 1, limits: Sequence[Limit] = (),
        rest_directions: ArrayLike | None = None, options: ManyOptions | None = None,
        out: NDArray[numpy.float32] | None = None, tolerance: float | None = ..., max_iterations: int = ...,
        every_iteration: bool = ..., restarts: int | None = ...,
        plane: Plane | None = ...) -> tuple[NDArray[numpy.float32], ManyReport]:
    """A Batch for one solve: the same arguments as Batch() and its solve()."""

class Ground:
    """The ground under a character's feet: Y up, metres. It never changes."""
    @staticmethod
    def flat(height: float = 0.0) -> Ground:
        """Level and without end."""
    @staticmethod
    def slope(angle: float) -> Ground:
        """Rises along +Z from z = 0 on. Radians, -1.5 to 1.5."""
    @staticmethod
    def stairs(step_height: float, step_depth: float) -> Ground:
        """Rise along +Z from z = 0 on. Metres: height -100 to 100, depth 0.01 to 1000."""
    @staticmethod
    def terrain(heights: ArrayLike, cell: float = 0.5, x: float = 0.0, z: float = 0.0) -> Ground:
        """Heights at the corners of squares, (rows, columns): rows along Z, columns along X, bilinear between them. `cell`:
        a square's width; `x`, `z`: the first corner."""
    @staticmethod
    def mesh(vertices: ArrayLike, triangles: ArrayLike) -> Ground:
        """Triangles, (triangles, 3) indices into `vertices`, (vertices, 3), wound either way."""
    @property
    def kind(self) -> GroundKind:
        """The kind of ground."""
    def height(self, x: float, z: float) -> float | None:
        """The highest ground there; None where there is none."""

class Character:
    """A character from a file: skeleton, bones and clips, converted to Y up and metres. It never changes, so that threads
    may share it."""
    @property
    def file(self) -> Path:
        """The path it was read from."""
    @property
    def joints(self) -> list[str]:
        """The joints' names, in the order of all arrays."""
    @property
    def parents(self) -> NDArray[numpy.int32]:
        """The index of each joint's parent; -1 for a root. A parent may come after its children."""
    @property
    def rest_positions(self) -> NDArray[numpy.float64]:
        """(joints, 3), metres, in the character's space."""
    @property
    def rest_rotations(self) -> NDArray[numpy.float64]:
        """(joints, 4), in the character's space."""
    @property
    def bones(self) -> dict[str, str]:
        """The joint of each bone of a human body that was found: {"LeftUpperArm": "mixamorig:LeftArm"}."""
    @property
    def missing(self) -> list[str]:
        """Bones that a body needs and that were not found."""
    @property
    def scale(self) -> float:
        """Metres per unit of the file."""
    @property
    def notes(self) -> list[str]:
        """Sentences: guesses where the file is silent, and parts left out."""
    @property
    def clips(self) -> list[Clip]:
        """All clips, in the file's order; a file may have none."""
    def clip(self, name: str = "") -> Clip:
        """The clip of that name; without one the first. ValueError, with the names that there are, if there is none."""

class Clip:
    """A motion of a character. It never changes; functions return another. Arrays have a row for each frame at `rate`,
    from time 0, and are made anew at each use."""
    @property
    def name(self) -> str:
        """Unique in its file."""
    @property
    def character(self) -> Character:
        """The character that it moves."""
    @property
    def duration(self) -> float:
        """Seconds."""
    @property
    def rate(self) -> float:
        """Frames per second: as the file says, or by the spacing of its keys."""
    @property
    def frames(self) -> int:
        """Number of frames at that rate."""
    @property
    def notes(self) -> list[str]:
        """After retarget(): sentences on bones left out, and guesses."""
    @property
    def positions(self) -> NDArray[numpy.float64]:
        """(frames, joints, 3), metres, in the character's space."""
    @property
    def rotations(self) -> NDArray[numpy.float64]:
        """(frames, joints, 4), in the character's space."""
    @property
    def local_positions(self) -> NDArray[numpy.float64]:
        """(frames, joints, 3), metres, relative to the parent."""
    @property
    def local_rotations(self) -> NDArray[numpy.float64]:
        """(frames, joints, 4), relative to the parent."""
    def with_poses(self, local_rotations: ArrayLike | None = None, local_positions: ArrayLike | None = None) -> Clip:
        """The clip with other poses in its frames, relative to the parents. A joint that they don't change keeps its keys."""

class Finding:
    """A fault of a clip."""
    @property
    def kind(self) -> Fault:
        """The rule that it breaks."""
    @property
    def frame(self) -> int:
        """The worst frame, from 0."""
    @property
    def first_frame(self) -> int:
        """The first frame with the fault."""
    @property
    def last_frame(self) -> int:
        """The last frame with the fault."""
    @property
    def time(self) -> float:
        """Seconds: the worst frame's."""
    @property
    def joint(self) -> str | None:
        """None: the whole figure."""
    @property
    def amount(self) -> float:
        """How much, in `unit`."""
    @property
    def unit(self) -> str:
        """"mm", "deg", "m" or "times"."""
    @property
    def text(self) -> str:
        """All of it as a sentence."""
    @property
    def has_cure(self) -> bool:
        """Whether cure() can mend it."""

class LintReport:
    """The faults of a clip, and the rate and floor by which it was judged."""
    @property
    def findings(self) -> list[Finding]:
        """By frame."""
    @property
    def rate(self) -> float:
        """Frames per second at which it was judged."""
    @property
    def frames(self) -> int:
        """Number of frames judged."""
    @property
    def floor(self) -> float | None:
        """Height of the clip's floor, metres; None if no foot ever stands."""
    @property
    def skating(self) -> float:
        """How far a standing foot slides at most, metres, even if that is tolerated."""

class SaveReport:
    """How well a written file agrees with its clip: it was read back."""
    @property
    def frames(self) -> int:
        """Frames compared."""
    @property
    def worst(self) -> float:
        """The largest distance of a joint from where it was, metres."""
    @property
    def worst_joint(self) -> str:
        """That joint."""
    @property
    def skating_before(self) -> float:
        """How far a standing foot of the original slides at most, metres."""
    @property
    def skating_after(self) -> float:
        """The same in the written clip."""
    @property
    def new_findings(self) -> list[str]:
        """Faults that the original lacks."""
    @property
    def text(self) -> str:
        """All of it as a sentence."""

class Incident:
    """A fault in a chain's recorded motion."""
    @property
    def kind(self) -> IncidentKind:
        """Its kind."""
    @property
    def chain(self) -> str:
        """The chain's name; empty if it has none."""
    @property
    def frame(self) -> int:
        """The first frame, from 0."""
    @property
    def last_frame(self) -> int:
        """The last frame."""
    @property
    def joint(self) -> int | None:
        """From 0 at the root; None: no single joint."""
    @property
    def amount(self) -> float:
        """How much, in `unit`."""
    @property
    def unit(self) -> str:
        """"degrees", "metres", "frames" or empty."""
    @property
    def hertz(self) -> float:
        """A jitter's frequency; new poses a second, if they repeat evenly; else 0."""
    @property
    def cause(self) -> str:
        """Why, as a clause."""
    @property
    def text(self) -> str:
        """All of it as a sentence, lengths in the file's unit."""
    @property
    def flips_in(self) -> Method | None:
        """Flips only: the method of Tendril that flips on the same input; None if none does."""
    @property
    def prevented_by(self) -> list[str]:
        """Flips only: small changes under which Tendril's solver does not flip; each was tried."""

class TraceChain:
    """The recorded motion of one chain: metres, right-handed, Y up."""
    @property
    def name(self) -> str:
        """Empty if it has none."""
    @property
    def frames(self) -> int:
        """Number of frames."""
    @property
    def joints(self) -> NDArray[numpy.float32]:
        """(frames, joints, 3)."""
    @property
    def targets(self) -> NDArray[numpy.float32]:
        """(frames, 3); NaN where there is none."""
    @property
    def poles(self) -> NDArray[numpy.float32]:
        """(frames, 3); NaN where there is none."""
    @property
    def end_effector(self) -> int:
        """The joint that reaches for the target."""
    @property
    def left_off(self) -> int:
        """Further incidents, which are not listed."""

class Trace:
    """An engine's log of its chains, and the faults in it."""
    @property
    def file(self) -> Path:
        """The path it was read from."""
    @property
    def fps(self) -> float:
        """Frames per second."""
    @property
    def fps_known(self) -> bool:
        """Given, or by the times in the file; else it is a guess."""
    @property
    def conventions(self) -> str:
        """Up axis, hand and unit of the file, and how they are known."""
    @property
    def bones(self) -> list[str]:
        """The bones' names, if the file has them."""
    @property
    def notes(self) -> list[str]:
        """Sentences: lines left out, where reading stopped."""
    @property
    def chains(self) -> list[TraceChain]:
        """Each chain's frames."""
    @property
    def incidents(self) -> list[Incident]:
        """Everything that was found, chain by chain."""

def load_character(path: str | os.PathLike[str], *, progress: Callable[[float], object] | None = None) -> Character:
    """Reads a .gltf, .glb, .vrm, .vrma, .fbx or .bvh file. A damaged one is a ValueError that begins with its name and says
    the place: "walk.bvh, line 12: expected CHANNELS". `progress` is called with the part read, 0 to 1, up to 20 times a
    second and at the end; an exception from it, or Ctrl+C, ends the reading. Other Python threads run meanwhile, here and
    in all functions of characters and traces."""
def lint(
        clip: Clip, *, settings: LintSettings | None = None, ground: Ground | None = None, rate: float = ...,
        skating: float = ..., floating: float = ..., sinking: float = ..., knee: float = ..., turn: float = ...,
        shift: float = ..., beyond: float = ...) -> LintReport:
    """Finds the faults of a clip: feet that skate, float and sink, knees that pop, joints that jump. Heights are from
    `ground`, or from a level floor found in the clip."""
def cure(
        clip: Clip, finding: Finding, *, settings: LintSettings | None = None, ground: Ground | None = None,
        rate: float = ..., skating: float = ..., floating: float = ..., sinking: float = ..., knee: float = ...,
        turn: float = ..., shift: float = ..., beyond: float = ...) -> Clip:
    """The clip without that fault and with no new one. ValueError for a fault that has no cure, or one of another clip."""
def plant_feet(clip: Clip, ground: Ground | None = None, *, rate: float | None = None) -> Clip:
    """The clip with its feet on the ground, by default level at height 0. Needs two legs. `rate`: frames per second."""
def travel(clip: Clip, *, rate: float | None = None) -> Clip:
    """A clip that walks in place goes along, at the speed of its standing foot; another stays as it is."""
def retarget(clip: Clip, to: Character) -> Clip:
    """The clip for another character: limbs point as they do here, and the feet stand where they do."""
def save_clip(path: str | os.PathLike[str], clip: Clip, *, original: Clip | None = None, rate: float | None = None, ground: Ground | None = None) -> SaveReport:
    """Writes a .bvh, .gltf or .glb file, whole or not at all, and reads it back. A glTF of a character from glTF keeps its
    meshes and materials. It replaces a file of these kinds, but never the character's own. `original`: the clip before
    cures, which the report compares; `rate`: frames per second; `ground`: what its feet stand on, for the report."""
def load_trace(path: str | os.PathLike[str], *, fps: float | None = None, up: str = "", handed: str = "", unit: str = "", rotations: str = "", target_joint: int | None = None) -> Trace:
    """Reads what an engine logged (JSON Lines, CSV, .trc or any log with positions in it) and explains it: flips, NaN, bones
    that change length, lag, jitter, jumps. The rest overrides the file: `up` "y" or "z", `handed` "right" or "left", `unit`
    "m", "cm" or "mm", `rotations` "xyzw" or "wxyz", `target_joint` the joint that reaches for the target."""
