# Written by core/bindings/generate from stubs/signal.pyi and the library's tables. Edit those.
"""Filters and springs over whole arrays.

    smooth = signal.run(signal.OneEuro(min_cutoff=2, beta=0.05), recorded, dt=1 / 60)

A filter is a struct of parameters. run() starts afresh; a Chain remembers, for input that arrives frame by frame."""
from collections.abc import Sequence
from typing import NamedTuple

import numpy
import tendril
from numpy.typing import ArrayLike, NDArray

Filter = tendril.Struct

class InterpTo(tendril.Struct):
    """The same as filters: the state is the current value."""
    speed: float
    """1/s [1/s, -1e6 to 1e6, default 10]."""
    def __init__(self, *, speed: float = ...) -> None: ...


class InterpToExact(tendril.Struct):
    """As InterpTo, but exact: the same at any frame rate."""
    speed: float
    """1/s [1/s, -1e6 to 1e6, default 10]."""
    def __init__(self, *, speed: float = ...) -> None: ...


class ScaleBiasClamp(tendril.Struct):
    """Numbers from -1e9 to 1e9, speeds from -1e6 to 1e6."""
    map_range: bool
    """1 [default False]."""
    in_range: Sequence[float]
    """In range [-1e9 to 1e9, default 0 1]."""
    out_range: Sequence[float]
    """Out range [-1e9 to 1e9, default 0 1]."""
    scale: float
    """2 [-1e9 to 1e9, default 1]."""
    bias: float
    """Bias [-1e9 to 1e9, default 0]."""
    clamp: bool
    """3 [default False]."""
    clamp_min: float
    """Clamp min [-1e9 to 1e9, default 0]."""
    clamp_max: float
    """Clamp max [-1e9 to 1e9, default 1]."""
    interp: bool
    """Interp [default False]."""
    speed_increasing: float
    """Speed increasing [1/s, -1e6 to 1e6, default 10]."""
    speed_decreasing: float
    """Speed decreasing [1/s, -1e6 to 1e6, default 10]."""
    def __init__(
            self, *, map_range: bool = ..., in_range: Sequence[float] = ..., out_range: Sequence[float] = ...,
            scale: float = ..., bias: float = ..., clamp: bool = ..., clamp_min: float = ..., clamp_max: float = ...,
            interp: bool = ..., speed_increasing: float = ..., speed_decreasing: float = ...) -> None: ...


class Spring(tendril.Struct):
    """A damped spring that follows its input, exact at any frame time."""
    strength: float
    """Undamped frequency in Hz [Hz, 0 to 1e4, default 4]."""
    critical_damping: float
    """Damping ratio, 0 to 1e3: 0 oscillates for ever, 1 is the fastest without overshoot [0 to 1000, default 1]."""
    force: float
    """Force on a mass of 1, at most 1e9: shifts the target by force / w^2 [1/s^2, -1e9 to 1e9, default 0]."""
    target_velocity_amount: float
    """How much of the target's velocity is anticipated: at 1 the spring follows steady motion without lag, but
    overshoots jumps [0 to 1, default 0]."""
    def __init__(
            self, *, strength: float = ..., critical_damping: float = ..., force: float = ...,
            target_velocity_amount: float = ...) -> None: ...


class ExponentialDecay(tendril.Struct):
    """X += (input - x) (1 - 2^(-dt / halflife)): the remaining distance halves every halflife seconds, at any frame
    rate."""
    halflife: float
    """S, 0 (no smoothing) to 1e4 [s, 0 to 1e4, default 0.1]."""
    def __init__(self, *, halflife: float = ...) -> None: ...


class RateLimit(tendril.Struct):
    """Limits the speed, separately up and down."""
    rise: float
    """1/s [1/s, 0 to 1e9, default 1]."""
    fall: float
    """1/s [1/s, 0 to 1e9, default 1]."""
    def __init__(self, *, rise: float = ..., fall: float = ...) -> None: ...


class SmoothDamp(tendril.Struct):
    """Unity's Mathf.SmoothDamp (T. Lowe, "Critically Damped Ease-In/Ease-Out Smoothing", Game Programming Gems 4,
    2004): a critically damped spring with 1 / (1 + x + 0.48 x^2 + 0.235 x^3) for exp(-x), x = 2 dt / smooth_time,
    and the distance clamped to max_speed * smooth_time."""
    smooth_time: float
    """S, 0 to 1e4; under 1e-4 counts as 1e-4 [s, 0 to 1e4, default 0.1]."""
    max_speed: float
    """1/s [1/s, 0 to 1e9, default 1e6]."""
    def __init__(self, *, smooth_time: float = ..., max_speed: float = ...) -> None: ...


class SpringSemiImplicit(tendril.Struct):
    """The spring found in most games: velocity first, then position (semi-implicit Euler)."""
    strength: float
    """Strength [Hz, 0 to 1e4, default 4]."""
    critical_damping: float
    """Critical damping [0 to 1000, default 1]."""
    def __init__(self, *, strength: float = ..., critical_damping: float = ...) -> None: ...


class OneEuro(tendril.Struct):
    """The 1 Euro filter (G. Casiez, N. Roussel, D. Vogel, CHI 2012): a low pass whose cutoff rises with speed, so
    that a hand at rest is steady and a hand that moves has little lag."""
    min_cutoff: float
    """Min cutoff [Hz, 0 to 1e6, default 1]."""
    beta: float
    """Hz per 1/s [0 to 1e6, default 0.1]."""
    derivative_cutoff: float
    """Derivative cutoff [Hz, 0 to 1e6, default 1]."""
    reset_jump: float
    """Restart if input and output are farther apart, 0 to 1e9; 0: never [0 to 1e9, default 0]."""
    def __init__(
            self, *, min_cutoff: float = ..., beta: float = ..., derivative_cutoff: float = ...,
            reset_jump: float = ...) -> None: ...


class MovingAverage(tendril.Struct):
    """The mean of the last window seconds, each sample weighted by the dt of its own step, the oldest in part."""
    window: float
    """S, 0 (no smoothing) to 3600 [s, 0 to 3600, default 0.2]."""
    def __init__(self, *, window: float = ...) -> None: ...


class DeadZone(tendril.Struct):
    """0 within width of 0, sign(x) (|x| - width) outside."""
    width: float
    """Width [0 to 1e9, default 0.1]."""
    def __init__(self, *, width: float = ...) -> None: ...


class Hysteresis(tendril.Struct):
    """1 from high up, 0 from low down, unchanged in between, and 0 at first: a switch that does not flicker."""
    low: float
    """-1e9 to 1e9 [-1e9 to 1e9, default 0.4]."""
    high: float
    """-1e9 to 1e9 [-1e9 to 1e9, default 0.6]."""
    def __init__(self, *, low: float = ..., high: float = ...) -> None: ...


class Inertialize(tendril.Struct):
    """Passes its input on, and blends each jump of it away."""
    halflife: float
    """S, 0 (jumps pass) to 1e4 [s, 0 to 1e4, default 0.1]."""
    threshold: float
    """A larger change in one step is a jump [0 to 1e9, default 0.5]."""
    def __init__(self, *, halflife: float = ..., threshold: float = ...) -> None: ...


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
