"""The laboratory: a scene that is stepped frame by frame, with commands and undo."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _hooke
from ._progress import bar

if TYPE_CHECKING:
    from .scene import Scene

Array = NDArray[np.float64]


def _setting(name: str, value: Any) -> str:
    """NAME=VALUE, with all digits of a number."""
    if isinstance(value, (bool, np.bool_)):
        return f"{name}={'on' if value else 'off'}"
    if isinstance(value, (float, np.floating)):
        return f"{name}={float(value)!r}"
    return f"{name}={value}"


class Lab:
    """A running scene. Commands take effect with the next frame and can be undone, while the run goes on.

    lab = hooke.load("cloth").lab()
    lab.grab(0, target=(0.5, 0.5, 0.5))
    lab.step(60)
    """

    def __init__(self, lab: _hooke.Lab) -> None:
        self._lab = lab

    @property
    def time(self) -> float:
        """Simulated time [s]."""
        return self._lab.time

    @property
    def positions(self) -> Array:
        """Positions [m], (points, 3): a copy, which stays valid."""
        return self._lab.positions

    @property
    def velocities(self) -> Array:
        """Velocities [m/s], (points, 3): a copy, which stays valid."""
        return self._lab.velocities

    @property
    def energy(self) -> dict[str, float]:
        """kinetic, elastic, gravitational and total energy [J]."""
        return self._lab.energy()

    @property
    def error(self) -> dict[str, float | None]:
        """The measured accuracy: frame, frame_max and accumulated error [m], amplification [1], predictable [s]. None: not known."""
        self._lab.measure_accuracy()
        return self._lab.error()

    @property
    def hash(self) -> str:
        """Of the state: 16 hexadecimal digits, equal for equal bits."""
        return self._lab.hash

    def step(self, frames: int = 1, *, progress: bool | None = False) -> bool:
        """Computes frames. False if one diverged: the state is then that of the last valid frame, and diagnosis says why."""
        with bar("step", progress) as shown:
            return self._lab.step(frames, shown)

    @property
    def diagnosis(self) -> str | None:
        """Why the last frame diverged; None if it did not."""
        return self._lab.diagnosis(None, 0.0)

    def grab(self, point: int, target: ArrayLike, *, pull: float | None = None) -> None:
        """Grabs a point, which then follows the target [m], or is pulled to it by a spring of the stiffness `pull` [N/m]."""
        self._lab.grab(point, target, pull)

    def move_hand(self, target: ArrayLike) -> None:
        """Moves what is grabbed to the target [m] within the next frame."""
        self._lab.move_hand(target)

    def release(self) -> None:
        """Releases what is grabbed."""
        self._lab.release()

    def nail(self, points: int | list[int], nailed: bool = True) -> None:
        """Nails points in place, or releases them."""
        self._lab.nail(np.atleast_1d(points).tolist(), nailed)

    def remove(self, points: list[int] = (), springs: list[int] = ()) -> None:
        """Removes points, with the springs attached to them, and springs. Later points and springs move up in the arrays."""
        self._lab.remove(list(points), list(springs))

    def __setitem__(self, name: str, value: Any) -> None:
        """Sets a parameter: see help(hooke.Scene)."""
        self._lab.set(_setting(name, value))

    def __getitem__(self, name: str) -> Any:
        return self._lab.scene().get(name)

    def set_integrator(self, integrator: str) -> None:
        """Continues with another method, from the next frame on."""
        self._lab.set_integrator(integrator)

    def set_state(self, positions: ArrayLike, velocities: ArrayLike) -> None:
        """Moves all points: positions [m] and velocities [m/s], (points, 3)."""
        self._lab.set_state(positions, velocities)

    def undo(self) -> None:
        """Undoes the last command, but not the time or the motion of other points."""
        self._lab.undo()

    def redo(self) -> None:
        """Repeats the command that was undone last."""
        self._lab.redo()

    @property
    def history(self) -> tuple[str, str]:
        """The names of the commands that undo and redo would apply to; empty if there are none."""
        return self._lab.history()

    def go_to_start(self) -> None:
        """Back to the positions, velocities and time of the start; edits of structure and parameters stay."""
        self._lab.go_to_start()

    def record(self, file: str) -> None:
        """Records to a .hookelog file from now on, which hooke.replay and the window play."""
        self._lab.record(str(file))

    def stop_recording(self) -> None:
        """Ends the recording."""
        self._lab.stop_recording()

    def scene(self) -> Scene:
        """A copy of the scene in its present state."""
        from .scene import Scene

        return Scene._of(self._lab.scene())

    def __repr__(self) -> str:
        return f"Lab({len(self.positions)} points at {self.time:g} s)"
