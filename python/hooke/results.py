"""What runs, benchmarks and checks return."""

from __future__ import annotations

import base64
import contextlib
import copy
import dataclasses
import html
import io
import json
import math
import os
from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING, Any, NamedTuple, Optional, Union, overload

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _hooke
from ._arguments import array, named, names, number, path, text
from ._hooke import InputError, UnknownNameError, UsageError
from ._progress import bar

if TYPE_CHECKING:
    from .lab import Lab

Array = NDArray[np.float64]
Weights = Union[ArrayLike, tuple[Optional[ArrayLike], Optional[ArrayLike]]]
_gradients = ("stiffness", "rest_length", "damping", "masses", "positions", "velocities")


def new_axes(count: int = 1) -> list[Any]:
    """Axes of a new figure of Matplotlib, side by side."""
    try:
        import matplotlib.pyplot as plt
    except ImportError:
        raise ImportError("plot: requires Matplotlib (package python3-matplotlib)") from None
    return list(plt.subplots(1, count, figsize=(7 if count == 1 else 5 * count, 4.5), layout="constrained", squeeze=False)[1][0])


@dataclasses.dataclass(frozen=True)
class Energy:
    """Energies [J], each of shape (samples,). Gravitational energy is zero at the origin."""

    kinetic: Array
    elastic: Array
    gravitational: Array
    total: Array


class Run:
    """The samples of a run, and what it cost.

    time: (samples,) [s]
    positions, velocities: (samples, points, 3) [m], [m/s], float64, C-contiguous: views of the memory that the run wrote to, no copies
    energy: Energy, of shape (samples,) [J]
    error: (samples,) [m], estimated RMS over the points of the distance from the exact motion; NaN where it is not known
    frame_error: (samples,) [m], the part of it that the last measured frame added
    amplification: (samples,) [1], by which a small difference grows in a second
    diverged: whether the run stopped because it became unstable; then the last sample is the last valid state
    hash: of the last state; equal to that of `hooke run` with the same options
    seconds, cpu_seconds, wall_seconds: simulated time, and time taken without measuring the error [s]
    force_evaluations, factorizations: the work done
    gas_releases: times at which tears opened surfaces filled with gas, one for each surface [s]
    warnings: clauses about the energy balance and about solves that did not converge
    lab: the laboratory at the end of the run
    """

    def __init__(self, values: dict[str, Any], lab: Lab, start: _hooke.Scene | None, asked_seconds: float,
                 points: list[int] | None) -> None:
        self.time: Array = values["time"]
        self.positions: Array = values["positions"]
        self.velocities: Array = values["velocities"]
        self.energy = Energy(*(values[name] for name in ("kinetic", "elastic", "gravitational", "total")))
        self.error: Array = values["error"]
        self.frame_error: Array = values["frame_error"]
        self.amplification: Array = values["amplification"]
        self.diverged: bool = values["diverged"]
        self.hash: str = values["hash"]
        self.seconds: float = values["seconds"]
        self.cpu_seconds: float = values["cpu_seconds"]
        self.wall_seconds: float = values["wall_seconds"]
        self.accuracy_cpu_seconds: float = values["accuracy_cpu_seconds"]
        self.force_evaluations: int = values["force_evaluations"]
        self.factorizations: int = values["factorizations"]
        self.gas_releases: list[float] = values["gas_releases"]
        self.warnings: list[str] = values["warnings"]
        self._lab: Lab | None = lab
        self._start = start
        self._asked_seconds = asked_seconds
        self._points = points
        self._diagnosis: str | None = None

    def __getstate__(self) -> dict[str, Any]:
        """For pickle: without the laboratory and the search for a remedy."""
        diagnosis = self._diagnosis
        if self.diverged and diagnosis is None:
            diagnosis = self._lab._bound.diagnosis(None, 0.0) if self._lab is not None else None
        return {**self.__dict__, "_lab": None, "_start": None, "_diagnosis": diagnosis}

    def __copy__(self) -> Run:
        made = Run.__new__(Run)
        made.__dict__.update(self.__dict__)
        return made

    def __deepcopy__(self, memo: dict[int, Any]) -> Run:
        made = Run.__new__(Run)
        memo[id(self)] = made
        made.__dict__.update({name: value if name == "_start" else copy.deepcopy(value, memo) for name, value in self.__dict__.items()})
        return made

    @property
    def lab(self) -> Lab:
        """The laboratory at the end of the run."""
        if self._lab is None:
            raise UsageError("lab: a run that was pickled has none")
        return self._lab

    @overload
    def gradient(self, of: Weights, with_respect_to: str, *, progress: bool | None = None) -> Array: ...  # type: ignore[misc]
    @overload
    def gradient(self, of: Weights, with_respect_to: Sequence[str], *, progress: bool | None = None) -> dict[str, Array]: ...

    def gradient(self, of: Weights, with_respect_to: str | Sequence[str], *, progress: bool | None = None) -> Array | dict[str, Array]:
        """Derivatives of the sum of weight times position over all samples, points and components, by the adjoint of the very steps.

        of: the weights, of the shape of run.positions, or a pair: of positions, and of velocities. Those of the squared distance from a
            measured motion are 2 * (run.positions - measured)
        with_respect_to: "stiffness", "rest_length" or "damping" of the springs, "masses", or "positions" or "velocities" of the start; a
            name returns an array as that of the scene [unit of the sum per N/m, m, N s/m, kg, m or m/s], several a dict of arrays. More
            names cost nothing
        Takes longer than the run, and the memory of the positions and velocities of all frames. Raises InputError, which names the
        reason, for other methods than velocity_verlet and runge_kutta4, contact, springs that break, strain limits, laws and forces.
        """
        chosen = names("with_respect_to", with_respect_to)
        if unknown := [name for name in chosen if name not in _gradients]:
            raise UnknownNameError(f"with_respect_to: {named(unknown[0])}: must be one of {', '.join(_gradients)}")
        if self._start is None:
            raise UsageError("gradient: a run that was pickled has none")
        if self.diverged:
            raise InputError("gradient: the run diverged")
        given = of if isinstance(of, tuple) else (of, None)
        if len(given) != 2:
            raise UsageError("of: must be weights, or a pair of them")
        positions, velocities = (self._weights(name, value) for name, value in zip(("of positions", "of velocities"), given))
        frame_rate = self._start.frame_rate
        frames = [round((time - self._start.time) * frame_rate) for time in self.time]
        with bar("gradient", progress) as shown:
            found = _hooke.gradient(self._start, round(self.seconds * frame_rate), frames, positions, velocities, shown)
        if found["hash"] != self.hash:
            raise InputError("gradient: the run cannot be repeated: on_frame changed it, or its precision is single")
        return found[with_respect_to] if isinstance(with_respect_to, str) else {name: found[name] for name in chosen}

    def _weights(self, name: str, value: ArrayLike | None) -> Array:
        assert self._start is not None
        if value is None:
            return np.empty(0)
        weights = array(name, value)
        if weights.shape != self.positions.shape:
            raise InputError(f"{name}: shape {weights.shape}: must be {self.positions.shape}")
        if not np.isfinite(weights).all():
            raise InputError(f"{name}: must be finite numbers")
        if self._points is None:
            return weights
        spread = np.zeros((len(weights), len(self._start.masses), 3))
        for number, point in enumerate(self._points):
            spread[:, point] += weights[:, number]
        return spread

    def plot(self, ax: Any = None) -> Any:
        """Draws the energies over time with Matplotlib, and returns the axes."""
        ax = ax or new_axes()[0]
        for name in ("kinetic", "elastic", "gravitational", "total"):
            ax.plot(self.time, getattr(self.energy, name), label=name)
        ax.set(xlabel="time [s]", ylabel="energy [J]")
        ax.legend(fontsize="small")
        return ax

    def _repr_html_(self) -> str:
        """What Jupyter shows: the figures, the last state, and the energies if Matplotlib is installed."""
        pictures = [] if self._lab is None else [self._lab._repr_png_()]
        if len(self.time) > 1:
            with contextlib.suppress(ImportError):
                from matplotlib.figure import Figure
                figure, file = Figure(figsize=(6, 4), layout="constrained"), io.BytesIO()
                self.plot(figure.subplots())
                figure.savefig(file)
                pictures.append(file.getvalue())
        images = "".join(f'<img src="data:image/png;base64,{base64.b64encode(picture).decode()}"/>' for picture in pictures)
        error = f"error {self.error[-1]:.2g} m" if len(self.error) and not math.isnan(self.error[-1]) else "error not known"
        return f"<div>{html.escape(repr(self))}<br/>{error}<br/>{images}</div>"

    @property
    def diagnosis(self) -> str | None:
        """Why the run diverged, and a setting that does not, tested on copies; None if it did not. Takes a second or two, once."""
        if self.diverged and self._diagnosis is None and self._lab is not None:
            self._diagnosis = self.lab._bound.diagnosis(self._start, self._asked_seconds)
        return self._diagnosis

    def __repr__(self) -> str:
        samples, points = self.positions.shape[:2]
        end = "diverged" if self.diverged else f"hash {self.hash}"
        return f"Run({samples} samples of {points} points, {self.seconds:g} s simulated in {self.wall_seconds:.3g} s, {end})"


class Check(NamedTuple):
    """One method of the check that a scene file contains."""

    scene: str
    method: str
    passed: bool
    measured: str


class Replay(NamedTuple):
    """A replayed recording. difference: the first frame and point that differ from the recorded ones, or that its last line is incomplete;
    empty if every frame is equal."""

    frames: int
    hash: str
    difference: str


class Chart:
    """Speed against error of methods on scenes.

    rows: dictionaries as in bench.json, with scene, method, setting, step_s [s], tolerance_m [m], error_m [m], relative_error [1] (of the
        size of the scene), cpu_ms_per_s [ms/s], energy_drift [1], work counts and status; None where a number is unknown
    problems: the same by scene, with the reference that errors are measured against
    is_complete: whether every method was measured; False after the time limit of a quick benchmark, and where merged parts are missing
    messages: why something is missing, one line each
    """

    def __init__(self, text: str, is_complete: bool, messages: list[str], largest_error: float = math.inf) -> None:
        self._text = text
        self.is_complete = is_complete
        self.messages = messages
        self.problems: list[dict[str, Any]] = json.loads(text)["scenes"]
        self.rows: list[dict[str, Any]] = []
        for problem in self.problems:
            for row in problem["rows"]:
                error = row["relative_error"]
                if error is None or error <= largest_error:
                    self.rows.append({"scene": problem["scene"], **row})

    def _scene(self, name: str | None) -> str:
        scenes: list[str] = [problem["scene"] for problem in self.problems]
        if name is None and scenes:
            return scenes[0]
        if text("scene", name) not in scenes:
            raise UnknownNameError(f"scene: {named(name)}: must be one of {', '.join(scenes)}")
        return str(name)

    def front(self, scene: str | None = None) -> list[dict[str, Any]]:
        """The rows that no other row beats in both error and cost, cheapest first. Scene: by default the first one."""
        scene = self._scene(scene)
        known = [row for row in self.rows if row["scene"] == scene and row["error_m"] is not None and row["cpu_ms_per_s"] is not None]
        front: list[dict[str, Any]] = []
        for row in sorted(known, key=lambda row: (row["cpu_ms_per_s"], row["error_m"])):
            if not front or row["error_m"] < front[-1]["error_m"]:
                front.append(row)
        return front

    def cheapest(self, error: float, scene: str | None = None) -> dict[str, Any] | None:
        """The cheapest row whose error [m] is at most this; None if there is none."""
        limit = number("error", error)
        return next((row for row in self.front(scene) if row["error_m"] <= limit), None)

    def save(self, folder: str | os.PathLike[str]) -> None:
        """Writes bench.json, .csv, .md, methods.md and, with gnuplot, bench.svg and bench.png, as `hooke bench --out FOLDER` does."""
        message = _hooke.save_bench(self._text, path("folder", folder))
        if message:
            self.messages.append(message)

    def plot(self, ax: Any = None, scene: str | None = None) -> Any:
        """Draws error against cost on logarithmic axes with Matplotlib, a line for each method, and returns the axes.

        Without Matplotlib it raises ImportError; `save` draws charts with gnuplot.
        """
        scene = self._scene(scene)
        ax = ax or new_axes()[0]
        rows = [row for row in self.rows if row["scene"] == scene and row["error_m"] and row["cpu_ms_per_s"] is not None]
        for method in dict.fromkeys(row["method"] for row in rows):
            own = sorted((row["cpu_ms_per_s"], row["error_m"]) for row in rows if row["method"] == method)
            ax.loglog(*zip(*own), marker="o", markersize=3, label=method)
        front = [row for row in self.front(scene) if row["error_m"]]
        ax.loglog([row["cpu_ms_per_s"] for row in front], [row["error_m"] for row in front], color="0.5", linewidth=5, alpha=0.3, zorder=0,
                  label="cheapest")
        ax.set(xlabel="cost [CPU ms per simulated s]", ylabel="error [m]", title=scene)
        ax.legend(fontsize="small")
        return ax

    def __repr__(self) -> str:
        return f"Chart({len(self.rows)} measurements of {', '.join(problem['scene'] for problem in self.problems)})"


class Sweep:
    """The table of a parameter sweep: a row for each run.

    vary: the values of the parameters by name, measures: what was measured by name; arrays of shape (rows,)
    units: by name; status: "ok", "warning" or "diverged" for each row; notes: why
    rows: the numbers of the rows in the complete table; is_complete: whether all of them are there, which they are not in a shard
    messages: why there are no charts in the folder

    sweep["stiffness"] is a column, and NaN where a value is not known.
    """

    def __init__(self, csv: str, json_text: str, is_complete: bool, message: str | None) -> None:
        self._csv = csv
        self.is_complete = is_complete
        self.messages = [message] if message else []
        document = json.loads(json_text)
        self.scene: str = document["scene"]
        self.seconds: float = document["seconds"]
        rows = document["rows"]
        self.rows = np.array([row["row"] for row in rows], dtype=np.int64)
        self.status: list[str] = [row["status"] for row in rows]
        self.notes: list[str] = [row["note"] for row in rows]
        self.units: dict[str, str] = {column["name"]: column["unit"] for column in document["vary"] + document["measures"]}
        self.vary: dict[str, NDArray[Any]] = {axis["name"]: np.array([row[axis["name"]] for row in rows]) for axis in document["vary"]}
        self.measures: dict[str, Array] = {
            measure["name"]: np.array([math.nan if row["values"][i] is None else row["values"][i] for row in rows], dtype=float)
            for i, measure in enumerate(document["measures"])}

    @property
    def columns(self) -> dict[str, NDArray[Any]]:
        """All columns by name, as pandas.DataFrame takes them."""
        return {**self.vary, **self.measures}

    def __getitem__(self, name: str) -> NDArray[Any]:
        """A column."""
        columns = self.columns
        if name not in columns:
            raise UnknownNameError(f"{named(name)}: must be one of {', '.join(columns)}")
        return columns[name]

    def __len__(self) -> int:
        return len(self.rows)

    def __iter__(self) -> Iterator[dict[str, Any]]:
        """The rows as dictionaries, with status and note, as pandas.DataFrame takes them."""
        columns: dict[str, Any] = {**self.columns, "status": self.status, "note": self.notes}
        return ({name: values[row] for name, values in columns.items()} for row in range(len(self)))

    def to_csv(self, file: str | os.PathLike[str] | None = None) -> str:
        """The table as `hooke sweep` writes it to sweep.csv, also written to the file if there is one."""
        if file is not None:
            _hooke.write_text(path("file", file), self._csv)
        return self._csv

    def plot(self, measure: str | None = None, ax: Any = None) -> Any:
        """Draws a measure over the parameter with the most values with Matplotlib, a line for each combination of the others.

        measure: by default all, side by side; ax: for one measure, the axes to draw on. Returns the axes, a list for several measures.
        """
        drawn = list(self.measures) if measure is None else [text("measure", measure)]
        if unknown := [name for name in drawn if name not in self.measures]:
            raise UnknownNameError(f"{named(unknown[0])}: must be one of {', '.join(self.measures)}")
        axes = new_axes(len(drawn)) if ax is None else [ax]
        over = max(self.vary, key=lambda name: len(np.unique(self.vary[name])))
        others = [name for name in self.vary if name != over]
        lines: dict[tuple[Any, ...], list[int]] = {}
        for row in range(len(self)):
            lines.setdefault(tuple(self.vary[name][row] for name in others), []).append(row)
        for one, name in zip(axes, drawn):
            for values, at in lines.items():
                label = ", ".join(f"{other} {value:g}" if isinstance(value, (int, float)) else f"{other} {value}"
                                  for other, value in zip(others, values))
                one.plot(self.vary[over][at], self.measures[name][at], marker="o", markersize=3, label=label)
            one.set(xlabel=self._heading(over), ylabel=self._heading(name), title=self.scene)
            if np.issubdtype(self.vary[over].dtype, np.number) and self.vary[over].min() > 0:
                one.set_xscale("log")
            if others:
                one.legend(fontsize="small")
        return axes[0] if len(axes) == 1 else axes

    def _heading(self, name: str) -> str:
        return f"{name} [{self.units[name]}]" if self.units[name] else name

    def __repr__(self) -> str:
        return f"Sweep({len(self)} runs of {self.scene}: {', '.join(self.columns)})"
