# Written by core/bindings/generate from stubs/linkage.pyi and the library's tables. Edit those.
"""Links joined by hinges, sliders and balls into closed loops.

    drawn = linkage.four_bar(crank=1, coupler=2.5)
    solver = linkage.Solver(drawn)
    curve = solver.path("P", "crank", numpy.linspace(0, 2 * numpy.pi, 360))"""
from collections.abc import Mapping, Sequence
from enum import Enum

import numpy
import tendril
from numpy.typing import ArrayLike, NDArray

class LinkJoint(str, Enum):
    """Choices of `LinkJoint`."""
    HINGE = "hinge"
    """Turns about an axis."""
    SLIDER = "slider"
    """Moves along an axis, without turning."""
    BALL = "ball"
    """Turns about a point."""


class ClosureKind(str, Enum):
    """Choices of `ClosureKind`."""
    POINT = "point"
    """Two points coincide."""
    FRAME = "frame"
    """Two points coincide, and the links keep their relative rotation as drawn."""


class LinkageStatus(str, Enum):
    """Choices of `LinkageStatus`."""
    REACHED = "Reached"
    """Closed, drivers at their values and targets reached, to 1e-6."""
    TARGET_MISSED = "TargetMissed"
    """Closed and driven, but a target is out of reach."""
    LIMITED = "Limited"
    """A range stops a driver or target."""
    DEAD_POINT = "DeadPoint"
    """A driver cannot go further."""
    OPEN = "Open"
    """No pose that closes the linkage was found: its closures contradict each other."""
    ITERATION_LIMIT = "IterationLimit"
    """Iterations used up on the way; the next solve continues."""
    INVALID_INPUT = "InvalidInput"
    """A number is not finite or out of range: nothing was moved."""


class Link(tendril.Struct):
    """A rigid link and the joint to its parent."""
    name: str
    """Name."""
    parent: int | None
    """An earlier link [default None]."""
    joint: LinkJoint | str
    """Joint [default hinge]."""
    at: Sequence[float]
    """Position of the joint, metres [m, -1e9 to 1e9, default 0 0 0]."""
    axis: Sequence[float]
    """Axis of a hinge or slider; any length but 0 [-1e9 to 1e9, default 0 0 1]."""
    rest: float
    """The joint's value as drawn: radians for a hinge, metres for a slider; no effect for a ball [-1e9 to 1e9,
    default 0]."""
    minimum: float
    """Range of the value [unset to 1e9, default None]."""
    maximum: float
    """Maximum [-1e9 to unset, default None]."""
    def __init__(
            self, *, name: str = ..., parent: int | None = ..., joint: LinkJoint | str = ..., at: Sequence[float] = ...,
            axis: Sequence[float] = ..., rest: float = ..., minimum: float = ..., maximum: float = ...) -> None: ...


class Point(tendril.Struct):
    """A point that moves with a link, or stays with the ground."""
    name: str
    """Name."""
    link: int | None
    """Link [default None]."""
    at: Sequence[float]
    """As drawn, metres [m, -1e9 to 1e9, default 0 0 0]."""
    def __init__(self, *, name: str = ..., link: int | None = ..., at: Sequence[float] = ...) -> None: ...


class Closure(tendril.Struct):
    """Closes a loop: a point of one link coincides with a point of another."""
    name: str
    """Name."""
    kind: ClosureKind | str
    """Kind [default point]."""
    first: int | None
    """Links [default None]."""
    second: int | None
    """Links [default None]."""
    first_at: Sequence[float]
    """As drawn, metres [m, -1e9 to 1e9, default 0 0 0]."""
    second_at: Sequence[float]
    """As drawn, metres [m, -1e9 to 1e9, default 0 0 0]."""
    def __init__(
            self, *, name: str = ..., kind: ClosureKind | str = ..., first: int | None = ..., second: int | None = ...,
            first_at: Sequence[float] = ..., second_at: Sequence[float] = ...) -> None: ...


class Linkage(tendril.Struct):
    """A linkage as drawn; a plain value."""
    links: Sequence[Link]
    """Parents before children."""
    points: Sequence[Point]
    """Points."""
    closures: Sequence[Closure]
    """Closures."""
    def __init__(
            self, *, links: Sequence[Link] = ..., points: Sequence[Point] = ...,
            closures: Sequence[Closure] = ...) -> None: ...


class JointPlace(tendril.Struct):
    """State of one joint: value is a hinge's angle (radians, not wrapped) or a slider's travel (metres), turn a
    ball's rotation from the pose as drawn."""
    value: float
    """Value [-1.024e+12 to 1.024e+12, default 0]."""
    turn: Sequence[float]
    """Turn [unit length, default 0 0 0 1]."""
    last: float
    """Change of the value in the last substep of a drive, whether driven or not [-1.024e+12 to 1.024e+12, default
    0]."""
    def __init__(self, *, value: float = ..., turn: Sequence[float] = ..., last: float = ...) -> None: ...


class State(tendril.Struct):
    """All state that a linkage keeps from frame to frame: one JointPlace per link."""
    joints: Sequence[JointPlace]
    """Joints."""
    def __init__(self, *, joints: Sequence[JointPlace] = ...) -> None: ...


class Options(tendril.Struct):
    """When a solve stops."""
    max_iterations: int
    """Max iterations [1 to 1e6, default 1000]."""
    tolerance: float | None
    """Metres; by default 1e-10 of the size [m, over 0 to 1e9, default None]."""
    def __init__(self, *, max_iterations: int = ..., tolerance: float | None = ...) -> None: ...


class Report(tendril.Struct):
    """How a solve ended, and why."""
    status: LinkageStatus | str
    """Status."""
    iterations: int
    """Iterations."""
    closed_to: float
    """The largest closure error, metres: the distance of points that should coincide, or the angle between frames
    times the size [m]."""
    residual: float
    """The largest distance of a point from its target, metres; infinite if refused [m]."""
    driver_residual: float
    """The largest error of a driver, radians or metres."""
    freedom: int
    """Degrees of freedom that drivers and active ranges leave."""
    stopped: int | None
    """The link of the driver that cannot go further, and the value where it stopped."""
    stopped_at: float
    """Stopped at."""
    passed_dead_point: bool
    """A target pulled the linkage past a dead point of its drivers (of watched, if nothing is driven): it switched
    to another assembly mode."""
    jumped: int | None
    """Index of the target whose point jumped: the point of the path nearest to the target vanished, and it moved on
    to another part of the path."""
    jump: float
    """Distance that point moved, metres [m]."""
    def __init__(
            self, *, status: LinkageStatus | str = ..., iterations: int = ..., closed_to: float = ...,
            residual: float = ..., driver_residual: float = ..., freedom: int = ..., stopped: int | None = ...,
            stopped_at: float = ..., passed_dead_point: bool = ..., jumped: int | None = ...,
            jump: float = ...) -> None: ...


class Freedom(tendril.Struct):
    """Degrees of freedom: Gruebler's (Kutzbach's) count, and the true number in the given pose."""
    counted: int
    """The joints' freedoms minus the closures' equations; in the plane if planar [-1e6 to 1e6, default 0]."""
    actual: int
    """The joints' freedoms minus the rank of the closures [0 to 1e6, default 0]."""
    def __init__(self, *, counted: int = ..., actual: int = ...) -> None: ...


class FourBar(tendril.Struct):
    """Fixed pivots A at the origin and D on +X; B at the end of the crank, C where coupler and rocker meet, above
    the line from B to D. P moves with the coupler: coupler_point is in the coupler's frame, from B, first
    coordinate towards C. Driver crank, 0 along +X."""
    ground: float
    """Ground [m, 1e-09 to 1e9, default 3]."""
    crank: float
    """Crank [m, 1e-09 to 1e9, default 1]."""
    coupler: float
    """Coupler [m, 1e-09 to 1e9, default 2.5]."""
    rocker: float
    """Rocker [m, 1e-09 to 1e9, default 2]."""
    coupler_point: Sequence[float]
    """Coupler point [m, -1e9 to 1e9, default 1.25 0.8]."""
    def __init__(
            self, *, ground: float = ..., crank: float = ..., coupler: float = ..., rocker: float = ...,
            coupler_point: Sequence[float] = ...) -> None: ...


class SliderCrank(tendril.Struct):
    """Crank at the origin, with B at its end; the slider S moves along the line y = offset, on the side of +X."""
    crank: float
    """Crank [m, 1e-09 to 1e9, default 1]."""
    rod: float
    """Rod [m, 1e-09 to 1e9, default 3]."""
    offset: float
    """Offset [m, -1e9 to 1e9, default 0]."""
    def __init__(self, *, crank: float = ..., rod: float = ..., offset: float = ...) -> None: ...


class Jansen(tendril.Struct):
    """T. Jansen's leg, with his names for the lengths."""
    a: float
    """A [m, -1e9 to 1e9, default 38]."""
    b: float
    """B [m, 1e-09 to 1e9, default 41.5]."""
    c: float
    """C [m, 1e-09 to 1e9, default 39.3]."""
    d: float
    """D [m, 1e-09 to 1e9, default 40.1]."""
    e: float
    """E [m, 1e-09 to 1e9, default 55.8]."""
    f: float
    """F [m, 1e-09 to 1e9, default 39.4]."""
    g: float
    """G [m, 1e-09 to 1e9, default 36.7]."""
    h: float
    """H [m, 1e-09 to 1e9, default 65.7]."""
    i: float
    """I [m, 1e-09 to 1e9, default 49]."""
    j: float
    """J [m, 1e-09 to 1e9, default 50]."""
    k: float
    """K [m, 1e-09 to 1e9, default 61.9]."""
    l: float
    """L [m, -1e9 to 1e9, default 7.8]."""
    m: float
    """M [m, 1e-09 to 1e9, default 15]."""
    def __init__(
            self, *, a: float = ..., b: float = ..., c: float = ..., d: float = ..., e: float = ..., f: float = ...,
            g: float = ..., h: float = ..., i: float = ..., j: float = ..., k: float = ..., l: float = ...,
            m: float = ...) -> None: ...


def four_bar(
        lengths: FourBar | None = None, ground: float = ..., crank: float = ..., coupler: float = ...,
        rocker: float = ..., coupler_point: Sequence[float] = ...) -> Linkage:
    """Pivots A at the origin and D on +X, B at the end of link `crank`, C where coupler and rocker meet; P moves with
    the coupler."""
def slider_crank(
        lengths: SliderCrank | None = None, crank: float = ..., rod: float = ..., offset: float = ...) -> Linkage:
    """Link `crank` at the origin, with B at its end; S slides along the line y = offset."""
def jansen(
        lengths: Jansen | None = None, a: float = ..., b: float = ..., c: float = ..., d: float = ..., e: float = ...,
        f: float = ..., g: float = ..., h: float = ..., i: float = ..., j: float = ..., k: float = ..., l: float = ...,
        m: float = ...) -> Linkage:
    """T. Jansen's walking leg: link `motor` turns, the point `foot` walks."""
class Solver:
    """Moves one linkage and keeps its state. Use it from one thread at a time."""
    def __init__(self, linkage: Linkage) -> None: ...
    @property
    def state(self) -> State:
        """A copy of the state. May be set, to one of the same linkage."""
    @state.setter
    def state(self, given: State) -> None: ...
    def solve(
            self, drivers: Mapping[str, float] = {}, *, targets: Mapping[str, ArrayLike] = {},
            options: Options | None = None, max_iterations: int = ..., tolerance: float | None = ...) -> Report:
        """Closes the loops, gives each named link's joint its value (radians, or metres for a slider) and pulls each
        named point to its target, metres. Other Python threads run meanwhile."""
    def path(self, point: str, driver: str, values: ArrayLike) -> NDArray[numpy.float64]:
        """The point's positions, (values, 3), metres, as the driver takes one value after the other; NaN where it does
        not get there. Other Python threads run meanwhile."""
    def positions(self) -> NDArray[numpy.float64]:
        """Where the linkage's points are now, (points, 3), metres."""
    def other_mode(self, drivers: Mapping[str, float] = {}, *, nearest: bool = False) -> None:
        """Changes to the next assembly mode, another closed pose with the driven joints where they are, or to the
        nearest one. KeyError if there is none."""
    @property
    def freedom(self) -> Freedom:
        """Degrees of freedom in this pose, without drivers."""
