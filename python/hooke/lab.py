"""The laboratory: a scene that is stepped frame by frame, with commands and undo."""

from __future__ import annotations

import contextlib
import copy
import os
from collections.abc import Iterator
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from . import _hooke
from ._arguments import array, flag, integer, number, numbers_of, optional, path, text
from ._parameters import Array, Parameterized
from ._progress import bar

if TYPE_CHECKING:
    from .scene import Scene


def _restore(scene: Scene, accuracy: str, execution: tuple[int, str, str], hand: tuple[int, float | None, Array] | None) -> Lab:
    lab = Lab(_hooke.Lab(scene._bound, accuracy, *execution))
    if hand is not None:
        point, pull, (position, target) = hand
        lab.grab(point, position, pull=pull)
        lab.move_hand(target)
    return lab


class Contact(NamedTuple):
    """A point that touched something in the last frame.

    kind: "collider", "point", "spring" or "face", what it most probably touched: the nearest part of the scene in the direction of the force
        now; or "unknown"
    number: of that part in its list; normal: from it to the point; force: the mean over the frame [N]
    """

    point: int
    kind: str
    number: int
    normal: tuple[float, float, float]
    force: tuple[float, float, float]


class Lab(Parameterized):
    """A running scene. Commands take effect with the next frame and can be undone while the run continues.

    lab = hooke.load("cloth").lab()
    lab.grab(0, target=(0.5, 0.5, 0.5))
    lab.step(60)

    Parameters are read and set by name, as those of a Scene: lab["stiffness"] = 200. Several threads may use a laboratory: each call
    waits for the one before.
    """

    __slots__ = ()
    _bound: _hooke.Lab

    def __init__(self, lab: _hooke.Lab) -> None:
        self._bound = lab

    @property
    def positions(self) -> Array:
        """Positions [m], (points, 3), read-only: the present state, which later steps do not change. Copied once for each state."""
        return self._bound.positions

    @property
    def velocities(self) -> Array:
        """Velocities [m/s], (points, 3), read-only: the present state, which later steps do not change. Copied once for each state."""
        return self._bound.velocities

    @property
    def energy(self) -> dict[str, float]:
        """kinetic, elastic, gravitational and total energy [J]."""
        return self._bound.energy()

    @property
    def energy_balance(self) -> dict[str, float] | None:
        """Where the energy [J] came from since the time `since` [s]: change, and what the hand, edits, forces, muscles, colliders, limits,
        drag, dashpots and contact supplied, negative if they took it; method: what the numerical method gained or lost. None: not measured."""
        return self._bound.energy_balance()

    @property
    def error(self) -> dict[str, float | None]:
        """The measured accuracy: frame, frame_max and accumulated error [m], amplification [1], predictable [s]. None: not known."""
        return self._bound.error()

    def _loads(self, name: str) -> Array:
        values: Array = self._bound.loads()[name]
        values.flags.writeable = False
        return values

    @property
    def strain(self) -> Array:
        """Strain of every spring [1], (springs,): length / rest length - 1."""
        return self._loads("strain")

    @property
    def tension(self) -> Array:
        """Tension of every spring [N], (springs,), without its dashpot; negative in compression."""
        return self._loads("tension")

    @property
    def spring_forces(self) -> Array:
        """Force of every spring on its first point [N], (springs, 3), without its dashpot."""
        return self._loads("forces")

    @property
    def spring_energy(self) -> Array:
        """Elastic energy of every spring [J], (springs,)."""
        return self._loads("spring_energy")

    @property
    def loads(self) -> Array:
        """External force on every point [N], (points, 3): gravity, wind and the listed forces; without contact."""
        return self._loads("loads")

    @property
    def reactions(self) -> Array:
        """Force of the nail or the hand that keeps a point in place [N], (points, 3); zero for free points."""
        return self._loads("reactions")

    @property
    def contact_forces(self) -> Array:
        """Mean force of contact on every point over the last frame [N], (points, 3); zero where nothing touched, and for nails."""
        return self._loads("contact")

    @property
    def contacts(self) -> list[Contact]:
        """What touched something in the last frame, in the order of the points."""
        return [Contact(*contact) for contact in self._bound.contacts()]

    @contextlib.contextmanager
    def edit(self) -> Iterator[tuple[Array, Array]]:
        """Arrays of the positions [m] and velocities [m/s] to write to: `with lab.edit() as (positions, velocities):`. One edit to undo."""
        positions, velocities = self.positions.copy(), self.velocities.copy()
        yield positions, velocities
        self.set_state(positions, velocities)

    def __copy__(self) -> Lab:
        return copy.deepcopy(self)

    def __reduce__(self) -> tuple[Any, ...]:
        """For pickle: the scene in its present state, what is held, and how it is computed and measured, without the history."""
        return _restore, (self.scene(), self._bound.accuracy, self._bound.execution, self._bound.hand)

    def _repr_png_(self) -> bytes:
        """The picture that Jupyter shows."""
        return self.scene()._picture()

    def step(self, frames: int = 1, *, progress: bool | None = False) -> bool:
        """Computes frames. False if one diverged: the state is then that of the last valid frame, and diagnosis says why."""
        with bar("step", progress) as shown:
            return self._bound.step(integer("frames", frames), shown)

    @property
    def diagnosis(self) -> str | None:
        """Why the last frame diverged; None if it did not."""
        return self._bound.diagnosis(None, 0.0)

    def grab(self, point: int, target: ArrayLike, *, pull: float | None = None) -> None:
        """Grabs a point, which then follows the target [m], or is pulled to it by a spring of the stiffness `pull` [N/m]."""
        self._bound.grab(integer("point", point), array("target", target), optional(number, "pull", pull))

    def move_hand(self, target: ArrayLike) -> None:
        """Moves what is grabbed to the target [m] within the next frame. Without a grab it does nothing."""
        self._bound.move_hand(array("target", target))

    def release(self) -> None:
        """Releases what is grabbed."""
        self._bound.release()

    def nail(self, points: ArrayLike, nailed: bool = True) -> None:
        """Nails points in place, or releases them."""
        self._bound.nail(numbers_of("points", points), flag("nailed", nailed))

    def remove(self, points: ArrayLike = (), springs: ArrayLike = ()) -> None:
        """Removes points, with the springs attached to them, and springs. Later points and springs move up in the arrays."""
        self._bound.remove(numbers_of("points", points), numbers_of("springs", springs))

    def set_integrator(self, integrator: str) -> None:
        """Continues with another method, from the next frame on."""
        self._bound.set_integrator(text("integrator", integrator))

    def set_state(self, positions: ArrayLike, velocities: ArrayLike) -> None:
        """Moves all points: positions [m] and velocities [m/s], (points, 3)."""
        self._bound.set_state(array("positions", positions), array("velocities", velocities))

    def undo(self) -> None:
        """Undoes the last command, but not the time or the motion of other points."""
        self._bound.undo()

    def redo(self) -> None:
        """Repeats the command that was undone last."""
        self._bound.redo()

    @property
    def history(self) -> tuple[str, str]:
        """The names of the commands that undo and redo would apply to; empty if there are none."""
        return self._bound.history()

    def go_to_start(self) -> None:
        """Back to the positions, velocities and time of the start; edits of structure and parameters stay."""
        self._bound.go_to_start()

    def record(self, file: str | os.PathLike[str]) -> None:
        """Records to a .hookelog file from now on, which hooke.replay and the window play."""
        self._bound.record(path("file", file))

    def stop_recording(self) -> None:
        """Ends the recording."""
        self._bound.stop_recording()

    def scene(self) -> Scene:
        """A copy of the scene in its present state."""
        from .scene import Scene

        return Scene._of(self._bound.scene())

    def __repr__(self) -> str:
        return f"Lab({len(self.positions)} points at {self.time:g} s)"
