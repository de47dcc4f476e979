# Written by core/bindings/generate from stubs/tendril.pyi and the library's tables. Edit those.
"""Chains that reach; tendril.signal has filters, tendril.rope ropes and cloth.

    arm = tendril.Solver([0.4, 0.35, 0.1])
    joints, report = arm.solve(arm.rest_joints(), (0.3, 0.4, 0.1), pole=(0, -1, 0))

Units are metres, seconds and radians; rotations are [x, y, z, w]. Arrays are NumPy's: float32 and in C order they are
used where they lie, other numbers are converted. A refused argument raises ValueError or TypeError, and nothing changes."""
from collections.abc import Iterator, Sequence
from enum import Enum
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
