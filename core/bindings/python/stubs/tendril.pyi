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

# structs

class Options:
    """Options of a solve."""

class TwoBoneOptions:
    """Options of two_bone()."""

class TwoBoneResult:
    """Where two_bone() puts the limb."""

class ActiveLimit:
    """The joint that stops the tip, and by how much."""

class Plane:
    """Keeps a chain in a plane through its root."""

class Limit:
    """How far a joint may swing and twist; all angles in radians."""
    @staticmethod
    def of(kind: JointKind | str) -> Limit:
        """A limit of this kind with typical human angles, to be adjusted."""
    @staticmethod
    def hinge(axis: ArrayLike, min: float, max: float) -> Limit:
        """A hinge about `axis`, a world axis at rest, from `min` to `max` radians."""

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
    def solve(self, joints: ArrayLike, target: ArrayLike, *, method: Method | str = "fabrik", state: State | None = None, options: Options | None = None, out: NDArray[numpy.float32] | None = None, **fields: Options) -> tuple[NDArray[numpy.float32], Report]:
        """Moves all joints but the root, (bones + 1, 3), so that the tip reaches the target, and returns them with a report.
        `joints` stay as they are unless they are `out` too. Pass the same `state` from solve to solve, and it is kept up
        to date: a chain that follows a target then moves smoothly. The members of Options may be given by name:
        pole=(0, -1, 0). Other Python threads run meanwhile. A report that says Stretched, TooClose or Limited is no
        error."""
    def explain(self, joints: ArrayLike, target: ArrayLike, *, state: State | None = None, options: Options | None = None, **fields: Options) -> ActiveLimit | None:
        """After a solve that ended Limited: the joint that stops the tip, from joints and state as the solve left them.
        None if freeing no single joint brings the tip nearer."""

def two_bone(root: ArrayLike, mid: ArrayLike, tip: ArrayLike, target: ArrayLike, *, lengths: ArrayLike, options: TwoBoneOptions | None = None, **fields: TwoBoneOptions) -> TwoBoneResult:
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
    def solve(self, joints: ArrayLike, targets: ArrayLike, *, options: ManyOptions | None = None, out: NDArray[numpy.float32] | None = None, **fields: ManyOptions) -> tuple[NDArray[numpy.float32], ManyReport]:
        """Moves all joints but the roots, (chains, bones + 1, 3), so that every tip reaches its target, (chains, 3), and
        returns them with a report. With `out=joints` it works in place, without a copy. Other Python threads run
        meanwhile."""

def solve_many(lengths: ArrayLike, joints: ArrayLike, targets: ArrayLike, *, threads: int = 1, limits: Sequence[Limit] = (), rest_directions: ArrayLike | None = None, options: ManyOptions | None = None, out: NDArray[numpy.float32] | None = None, **fields: ManyOptions) -> tuple[NDArray[numpy.float32], ManyReport]:
    """A Batch for one solve: the same arguments as Batch() and its solve()."""
