"""Links joined by hinges, sliders and balls into closed loops.

    drawn = linkage.four_bar(crank=1, coupler=2.5)
    solver = linkage.Solver(drawn)
    curve = solver.path("P", "crank", numpy.linspace(0, 2 * numpy.pi, 360))"""
from collections.abc import Mapping, Sequence
from enum import Enum

import numpy
import tendril
from numpy.typing import ArrayLike, NDArray

# structs

class Options:
    """When a solve stops."""

class Report:
    """How a solve ended, and why."""

def four_bar(lengths: FourBar | None = None, **fields: FourBar) -> Linkage:
    """Pivots A at the origin and D on +X, B at the end of link `crank`, C where coupler and rocker meet; P moves with
    the coupler."""
def slider_crank(lengths: SliderCrank | None = None, **fields: SliderCrank) -> Linkage:
    """Link `crank` at the origin, with B at its end; S slides along the line y = offset."""
def jansen(lengths: Jansen | None = None, **fields: Jansen) -> Linkage:
    """T. Jansen's walking leg: link `motor` turns, the point `foot` walks."""
class Solver:
    """Moves one linkage and keeps its state. Use it from one thread at a time."""
    def __init__(self, linkage: Linkage) -> None: ...
    @property
    def state(self) -> State:
        """A copy of the state. May be set, to one of the same linkage."""
    @state.setter
    def state(self, given: State) -> None: ...
    def solve(self, drivers: Mapping[str, float] = {}, *, targets: Mapping[str, ArrayLike] = {}, options: Options | None = None, **fields: Options) -> Report:
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
