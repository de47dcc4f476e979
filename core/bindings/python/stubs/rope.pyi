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

# structs

class Settings:
    """Settings of the simulation."""

class RopeShape:
    """A rope to be added."""

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
    def __init__(self, settings: Settings | None = None, *, threads: int = 1, **fields: Settings) -> None: ...
    @property
    def settings(self) -> Settings:
        """A copy of the settings; assign it to change them."""
    @settings.setter
    def settings(self, given: Settings) -> None: ...
    def add_rope(self, shape: RopeShape | None = None, **fields: RopeShape) -> Body:
        """Adds a rope. The members of RopeShape may be given by name."""
    def add_cloth(self, shape: ClothShape | None = None, **fields: ClothShape) -> Body:
        """Adds a cloth. The members of ClothShape may be given by name."""
    def remove(self, body: Body) -> None:
        """Removes a body."""
    def add_collider(self, shape: Sphere | Capsule | Plane | Box) -> Collider:
        """Adds a solid shape that ropes and cloth cannot enter."""
    def move_collider(self, collider: Collider, to: ArrayLike, seconds: float = 0.0) -> None:
        """Moves a collider evenly to `to` in the next `seconds`; 0: within the next substep."""
    def drive_collider(self, collider: Collider, drive: Drive | None = None, **fields: Drive) -> None:
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
