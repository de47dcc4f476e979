# Written by core/bindings/generate from stubs/rope.pyi and the library's tables. Edit those.
"""Ropes and cloth among colliders.

    world = rope.World()
    line = world.add_rope(from_=(0, 2, 0), to=(1, 2, 0), length=1.5, pin_start=True, pin_end=True)
    world.add_collider(rope.Sphere(centre=(0.5, 1, 0), radius=0.3))
    for _ in range(60):
        world.advance(1 / 60)
    drawn = world.positions(line)"""
from collections.abc import Sequence
from enum import Enum
from typing import NamedTuple

import numpy
import tendril
from numpy.typing import ArrayLike, NDArray

class Solver(str, Enum):
    """Choices of `Solver`."""
    RELAXATION = "relaxation"
    XPBD = "xpbd"
    DIRECT = "direct"


class Pins(str, Enum):
    """Choices of `Pins`."""
    NONE = "none"
    CORNERS = "corners"
    ROW = "row"


class Settings(tendril.Struct):
    """Settings of the simulation."""
    substep: float
    """Seconds, min_substep to max_substep [s, 1e-05 to 0.1, default 0.00416667]."""
    iterations: int
    """Passes in a substep, 1 to max_iterations [1 to 1e4, default 16]."""
    solver: Solver | str
    """Solver [default direct]."""
    damping: float
    """Decay rate of motion, 1/s, 0 to max_rate [1/s, 0 to 1000, default 0.1]."""
    gravity: Sequence[float]
    """M/s^2, each coordinate up to max_acceleration [m/s^2, -1e4 to 1e4, default 0 -9.81 0]."""
    gravity_scale: float
    """-max_scale to max_scale [-1000 to 1000, default 1]."""
    external: Sequence[float]
    """Acceleration in addition to gravity, m/s^2 [m/s^2, -1e4 to 1e4, default 0 0 0]."""
    wind: Sequence[float]
    """Velocity of the air, m/s, each coordinate up to max_wind [m/s, -1000 to 1000, default 0 0 0]."""
    gusts: float
    """Maximum of gusts relative to the wind, in each coordinate [0 to 1, default 0.3]."""
    still_air: bool
    """Whether air at rest has drag too: cloth then falls at the speed at which drag balances its weight [default
    False]."""
    compliance: float
    """Strain per newton, 1/N, 0 to max_compliance: how much a metre of rope stretches under one newton [1/N, 0 to
    1000, default 0]."""
    friction: float
    """Coulomb's friction coefficient between bodies and colliders, 0 to max_friction [0 to 100, default 0.5]."""
    longest_frame: float
    """Longest frame [s, 0.001 to 10, default 0.25]."""
    def __init__(
            self, *, substep: float = ..., iterations: int = ..., solver: Solver | str = ..., damping: float = ...,
            gravity: Sequence[float] = ..., gravity_scale: float = ..., external: Sequence[float] = ...,
            wind: Sequence[float] = ..., gusts: float = ..., still_air: bool = ..., compliance: float = ...,
            friction: float = ..., longest_frame: float = ...) -> None: ...


class RopeShape(tendril.Struct):
    """A rope to be added."""
    from_: Sequence[float]
    """From [m, -1e9 to 1e9, default 0 0 0]."""
    to: Sequence[float]
    """To [m, -1e9 to 1e9, default 1 0 0]."""
    segments: int
    """1 to max_particles - 1 [1 to 999999, default 32]."""
    length: float | None
    """Metres; default: the distance [m, 0 to 1e9, default None]."""
    radius: float
    """Radius [m, 0 to 1e9, default 0.02]."""
    density: float
    """Density [kg/m, 1e-09 to 1e9, default 1]."""
    bending: float
    """Bending stiffness, N m^2 [N m^2, 0 to 1e9, default 0]."""
    pin_start: bool
    """Pin start [default False]."""
    pin_end: bool
    """Pin end [default False]."""
    def __init__(
            self, *, from_: Sequence[float] = ..., to: Sequence[float] = ..., segments: int = ...,
            length: float | None = ..., radius: float = ..., density: float = ..., bending: float = ...,
            pin_start: bool = ..., pin_end: bool = ...) -> None: ...


class ClothShape(tendril.Struct):
    """A cloth: a grid of columns x rows particles."""
    corner: Sequence[float]
    """Corner [m, -1e9 to 1e9, default 0 0 0]."""
    along: Sequence[float]
    """From the corner to the other end of the first row [m, -1e9 to 1e9, default 1 0 0]."""
    down: Sequence[float]
    """From the corner to the last row [m, -1e9 to 1e9, default 0 -1 0]."""
    columns: int
    """Particles, 2 or more each [2 to 1e6, default 24]."""
    rows: int
    """Particles, 2 or more each [2 to 1e6, default 24]."""
    radius: float
    """Radius [m, 0 to 1e9, default 0.01]."""
    density: float
    """Density [kg/m^2, 1e-09 to 1e9, default 0.2]."""
    shear: float
    """Compliance of shear and bend links, m/N. Soft, as in woven cloth: with stiff diagonals a crumpled cloth stays
    crumpled [m/N, 0 to 1e9, default 0.3]."""
    bend: float
    """Compliance of shear and bend links, m/N. Soft, as in woven cloth: with stiff diagonals a crumpled cloth stays
    crumpled [m/N, 0 to 1e9, default 0.3]."""
    tear: float
    """Strain at which links tear; 0: never [0 to 1e9, default 0]."""
    pins: Pins | str
    """In the first row [default none]."""
    def __init__(
            self, *, corner: Sequence[float] = ..., along: Sequence[float] = ..., down: Sequence[float] = ...,
            columns: int = ..., rows: int = ..., radius: float = ..., density: float = ..., shear: float = ...,
            bend: float = ..., tear: float = ..., pins: Pins | str = ...) -> None: ...


class Sphere(tendril.Struct):
    """Sphere."""
    centre: Sequence[float]
    """Centre [m, -1e9 to 1e9, default 0 0 0]."""
    radius: float
    """Metres, 0 or more [m, 0 to 1e9, default 0.5]."""
    def __init__(self, *, centre: Sequence[float] = ..., radius: float = ...) -> None: ...


class Capsule(tendril.Struct):
    """All points within radius of the segment from a to b."""
    a: Sequence[float]
    """A [m, -1e9 to 1e9, default 0 0 0]."""
    b: Sequence[float]
    """B [m, -1e9 to 1e9, default 0 1 0]."""
    radius: float
    """Radius [m, 0 to 1e9, default 0.25]."""
    def __init__(self, *, a: Sequence[float] = ..., b: Sequence[float] = ..., radius: float = ...) -> None: ...


class Plane(tendril.Struct):
    """The half space behind a plane."""
    point: Sequence[float]
    """Point [m, -1e9 to 1e9, default 0 0 0]."""
    normal: Sequence[float]
    """Any length but 0 [-1e9 to 1e9, default 0 1 0]."""
    def __init__(self, *, point: Sequence[float] = ..., normal: Sequence[float] = ...) -> None: ...


class Box(tendril.Struct):
    """Box."""
    centre: Sequence[float]
    """Centre [m, -1e9 to 1e9, default 0 0 0]."""
    half_extents: Sequence[float]
    """Metres, each 0 or more [m, 0 to 1e9, default 0.5 0.5 0.5]."""
    rotation: Sequence[float]
    """Rotation [unit length, default 0 0 0 1]."""
    def __init__(
            self, *, centre: Sequence[float] = ..., half_extents: Sequence[float] = ...,
            rotation: Sequence[float] = ...) -> None: ...


class Drive(tendril.Struct):
    """A collider's steady motion."""
    velocity: Sequence[float]
    """Velocity [m/s, -1e4 to 1e4, default 0 0 0]."""
    axis: Sequence[float]
    """Through the centre, any length; (0, 0, 0): upright [-1e9 to 1e9, default 0 1 0]."""
    spin: float
    """Rad/s about the axis [rad/s, -1000 to 1000, default 0]."""
    def __init__(self, *, velocity: Sequence[float] = ..., axis: Sequence[float] = ..., spin: float = ...) -> None: ...


class Advance(NamedTuple):
    """What one call of advance() did: substeps, those dropped because the frame was too long, times a particle stayed inside
    a collider, lengths that did not converge, fallbacks, crossings prevented, links torn, and joules lost in contact."""
    substeps: int
    dropped: int
    unresolved: int
    unconverged: int
    fallbacks: int
    held_back: int
    torn: int
    contact_loss: float

class Body:
    """A handle of a rope or cloth in its World. It becomes invalid when the body is removed."""
    def __eq__(self, other: object) -> bool: ...

class Collider:
    """A handle of a collider in its World. It becomes invalid when the collider is removed."""
    def __eq__(self, other: object) -> bool: ...

class World:
    """Ropes, cloth and colliders. Steps are fixed, so that a second gives the same bits however it is cut into frames. The
    members of Settings may be given by name. `threads` share the bodies, and change no bit. One thread at a time may use
    a world; another gets a RuntimeError."""
    def __init__(
            self, settings: Settings | None = None, *, threads: int = 1, substep: float = ..., iterations: int = ...,
            solver: Solver | str = ..., damping: float = ..., gravity: Sequence[float] = ...,
            gravity_scale: float = ..., external: Sequence[float] = ..., wind: Sequence[float] = ...,
            gusts: float = ..., still_air: bool = ..., compliance: float = ..., friction: float = ...,
            longest_frame: float = ...) -> None: ...
    @property
    def settings(self) -> Settings:
        """A copy of the settings; assign it to change them."""
    @settings.setter
    def settings(self, given: Settings) -> None: ...
    def add_rope(
            self, shape: RopeShape | None = None, from_: Sequence[float] = ..., to: Sequence[float] = ...,
            segments: int = ..., length: float | None = ..., radius: float = ..., density: float = ...,
            bending: float = ..., pin_start: bool = ..., pin_end: bool = ...) -> Body:
        """Adds a rope. The members of RopeShape may be given by name."""
    def add_cloth(
            self, shape: ClothShape | None = None, corner: Sequence[float] = ..., along: Sequence[float] = ...,
            down: Sequence[float] = ..., columns: int = ..., rows: int = ..., radius: float = ..., density: float = ...,
            shear: float = ..., bend: float = ..., tear: float = ..., pins: Pins | str = ...) -> Body:
        """Adds a cloth. The members of ClothShape may be given by name."""
    def remove(self, body: Body) -> None:
        """Removes a body."""
    def add_collider(self, shape: Sphere | Capsule | Plane | Box) -> Collider:
        """Adds a solid shape that ropes and cloth cannot enter."""
    def move_collider(self, collider: Collider, to: ArrayLike, seconds: float = 0.0) -> None:
        """Moves a collider evenly to `to` in the next `seconds`; 0: within the next substep."""
    def drive_collider(
            self, collider: Collider, drive: Drive | None = None, velocity: Sequence[float] = ...,
            axis: Sequence[float] = ..., spin: float = ...) -> None:
        """Moves and turns a collider steadily, until the next call."""
    def remove_collider(self, collider: Collider) -> None:
        """Removes a collider."""
    def particle(self, body: Body, index: int) -> int:
        """The index in the world of a body's particle, valid until an earlier body is removed."""
    def pin(self, particle: int, at: ArrayLike, seconds: float = 0.0) -> None:
        """Pins a particle of the world and moves it evenly to `at` in the next `seconds`."""
    def unpin(self, particle: int) -> None:
        """Lets a pinned particle go."""
    def advance(self, seconds: float) -> Advance:
        """Lets `seconds` pass. Other Python threads run meanwhile."""
    def positions(self, body: Body | None = None) -> NDArray[numpy.float64]:
        """The particles of a body, or of the world, at the time of the frame: (particles, 3), metres."""
    def length_error(self, body: Body | None = None) -> float:
        """The largest relative length error of a body's links, or of all bodies'."""
    @property
    def energy(self) -> float:
        """Kinetic, potential and elastic energy, joules."""
    @property
    def pending(self) -> float:
        """Seconds that have passed since the last substep."""
    def copy(self) -> World:
        """A copy, which goes on with the same bits."""
    def __len__(self) -> int: ...
