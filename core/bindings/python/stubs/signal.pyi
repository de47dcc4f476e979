"""Filters and springs over whole arrays.

    smooth = signal.run(signal.OneEuro(min_cutoff=2, beta=0.05), recorded, dt=1 / 60)

A filter is a struct of parameters. run() starts afresh; a Chain remembers, for input that arrives frame by frame."""
from collections.abc import Sequence
from typing import NamedTuple

import numpy
import tendril
from numpy.typing import ArrayLike, NDArray

Filter = tendril.Struct

# structs

class InterpToExact:
    """As InterpTo, but exact: the same at any frame rate."""

class Spring:
    """A damped spring that follows its input, exact at any frame time."""

class Inertialize:
    """Passes its input on, and blends each jump of it away."""

class Measures(NamedTuple):
    """How filters follow an input. A measure that the input does not determine is None. `following`: "unknown", "follows",
    "does_not_follow" or "unstable"; lag and settling time in seconds; overshoot relative to the step; jitter relative to
    the input's; rate_difference: the largest difference between frame rates."""
    following: str
    lag: float | None
    overshoot: float | None
    settling_time: float | None
    jitter: float | None
    rate_difference: float

class Chain:
    """Filters one after the other that remember their states, with one of its own for each channel."""
    def __init__(self, filters: Filter | Sequence[Filter]) -> None: ...
    def run(self, values: ArrayLike, dt: ArrayLike) -> NDArray[numpy.float64]:
        """The output after each row of `values`, (n,) or (n, channels). `dt`: the seconds that pass before each row, (n,) or
        one number for all. Goes on from the last call; if a value is refused, nothing changes. Other Python threads run
        meanwhile."""
    def step(self, value: ArrayLike, dt: float) -> NDArray[numpy.float64]:
        """One row: a number, or one per channel."""
    def reset(self) -> None:
        """Forgets all states: the next row is the first."""
    def copy(self) -> Chain:
        """A copy with its states."""

def run(filters: Filter | Sequence[Filter], values: ArrayLike, dt: ArrayLike) -> NDArray[numpy.float64]:
    """The output of filters, one after the other, after each row of `values`, (n,) or (n, channels), from fresh states. `dt`:
    seconds, one number for all rows or one per row."""

def measure(filters: Filter | Sequence[Filter], values: ArrayLike, dt: ArrayLike) -> Measures:
    """Lag, overshoot, settling time, jitter and dependence on the frame rate of filters on one input, (n,)."""
