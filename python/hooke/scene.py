"""Scenes: loading, building, running."""

from __future__ import annotations

import json
import math
import os
import tempfile
import warnings
from collections.abc import Callable, Sequence
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _hooke
from ._progress import bar
from .lab import Lab, _setting
from .results import Chart, Check, Run
from .tables import method_text, parameter_text, shape_text

Array = NDArray[np.float64]


class HookeWarning(UserWarning):
    """What the command line prints as a warning: a step beyond the stability limit, an energy balance that does not add up."""


def _warn(lines: Sequence[str]) -> None:
    for line in lines:
        warnings.warn(line, HookeWarning, stacklevel=3)


def load(name: str | os.PathLike[str]) -> Scene:
    """Loads a shipped scene by its name, such as "cloth", or a file: .json, .obj, .xsp. See hooke.scenes()."""
    return Scene._of(_hooke.Scene.load(os.fspath(name)))


def _path(path: str | os.PathLike[str] | None) -> str | None:
    return None if path is None else os.fspath(path)


class CaptureResult(NamedTuple):
    """How a capture ended: whether the run diverged, the first frame beyond `fail_above`, where a replay differs, and the diagnosis."""

    diverged: bool
    error_limit: str
    difference: str
    diagnosis: str


def _capture_options(options: dict[str, Any]) -> dict[str, Any]:
    known = {"seconds", "frames", "fps", "size", "scale", "ui", "report", "stamp", "fail_above", "camera"}
    if unknown := set(options) - known:
        raise TypeError(f"unknown option {unknown.pop()!r}: must be one of {', '.join(sorted(known))}")
    options = dict(options)
    if "size" in options and not isinstance(options["size"], str):
        options["size"] = "x".join(str(int(side)) for side in options["size"])
    if options.get("camera") is not None and not isinstance(options["camera"], str):
        options["camera"] = ",".join(repr(float(value)) for value in np.ravel(options["camera"]))
    if options.get("report") is not None:
        options["report"] = os.fspath(options["report"])
    return options


def _plain(value: Any) -> Any:
    """A value for a scene file: arrays as lists."""
    if isinstance(value, (np.ndarray, np.generic)):
        return value.tolist()
    if isinstance(value, dict):
        return {key: _plain(item) for key, item in value.items()}
    if isinstance(value, (list, tuple)):
        return [_plain(item) for item in value]
    return value


class Scene:
    """A network of points and springs with everything that a scene file contains.

    scene = hooke.load("cloth")      # a shipped scene or a file
    scene = hooke.Scene()            # an empty one, to build

    Parameters are read and set by name: scene["stiffness"] = 200. They are:

    {parameters}

    Integration methods, for run, lab, bench and capture:

    {methods}
    """

    def __init__(self, dimensions: int = 3, *, gravity: ArrayLike = (0.0, -9.81, 0.0), integrator: str = "velocity_verlet",
                 substeps: int = 20, frame_rate: float = 60.0, name: str = "scene") -> None:
        """An empty scene without a floor. gravity [m/s^2], frame_rate [1/s]; dimensions 2: everything stays in the plane z = 0."""
        simulation = {"integrator": integrator, "substeps": substeps, "frame_rate": frame_rate}
        document = {"hooke": 1, "name": name, "dimensions": dimensions, "gravity": _plain(list(gravity)), "simulation": simulation}
        self._scene = _hooke.Scene.parse(json.dumps(document), name)

    @classmethod
    def _of(cls, scene: _hooke.Scene) -> Scene:
        made = cls.__new__(cls)
        made._scene = scene
        return made

    @classmethod
    def from_json(cls, text: str, name: str = "scene") -> Scene:
        """A scene from the text of a scene file; see docs/scene-format.md. `name` stands for the file in messages."""
        return cls._of(_hooke.Scene.parse(text, name))

    def to_json(self) -> str:
        """The text of the scene file, which reads back as the same scene, bit for bit."""
        return self._scene.json()

    def copy(self) -> Scene:
        """An independent copy."""
        return self._of(self._scene.copy())

    def save(self, file: str | os.PathLike[str]) -> list[str]:
        """Writes the scene in the format of the extension, atomically. Returns what the format cannot represent."""
        return self._scene.save(os.fspath(file))

    # Building

    def add_shape(self, type: str, **fields: Any) -> range:
        """Adds a shape, as in the "generators" of a scene file: add_shape("rope", ...) is add_rope(...). Returns its points' numbers."""
        return self._add("generators", {"type": type, **fields})

    def add_collider(self, type: str, **fields: Any) -> None:
        """Adds a "plane" (point, normal), a "sphere" (center, radius) or a "box" (min, max) [m]; restitution, friction [1]."""
        self._add("colliders", {"type": type, **fields})

    def add_force(self, force: str | Callable[[float, Array, Array], ArrayLike], **fields: Any) -> None:
        """Adds a force of the table in docs/scene-format.md, such as "wind", or a function.

        force(time, positions, velocities) receives the time [s] and arrays of shape (points, 3) [m], [m/s], and returns the forces [N] in
        the same shape. It is called at every evaluation of the forces, at least twice per substep, which is slow: about 10 us per call
        instead of nanoseconds. It must depend on its arguments only. A method's stability limit does not take it into account.
        """
        if callable(force):
            self._scene.add_force(force)
        else:
            self._add("forces", {"type": force, **fields})

    def _add(self, key: str, item: dict[str, Any]) -> range:
        first = self.point_count
        self._scene.add(f"{json.dumps(key)}: [{json.dumps(_plain(item))}]", "scene")
        return range(first, self.point_count)

    def add_points(self, positions: ArrayLike, *, mass: ArrayLike = 1.0, velocity: ArrayLike | None = None, radius: ArrayLike = 0.02,
                   nailed: bool | Sequence[bool] = False) -> range:
        """Adds points: positions (points, 3) [m]; mass [kg] and radius [m], one for all or for each; velocity (points, 3) [m/s]."""
        positions = np.asarray(positions, dtype=float)
        if positions.ndim == 1:
            positions = positions[np.newaxis]
        velocity = np.zeros_like(positions) if velocity is None else np.broadcast_to(np.asarray(velocity, float), positions.shape)
        nails = np.broadcast_to(np.asarray(nailed, bool), positions.shape[:1]).tolist()
        first = self._scene.add_points(positions, mass, velocity, radius, nails)
        return range(first, self.point_count)

    def add_point(self, position: ArrayLike, **properties: Any) -> int:
        """Adds a point at a position [m] and returns its number. Properties: those of add_points."""
        return self.add_points(np.asarray(position, dtype=float)[np.newaxis], **properties)[0]

    def add_springs(self, points: ArrayLike, *, stiffness: ArrayLike = 100.0, damping: ArrayLike = 0.0,
                    rest_length: ArrayLike | None = None, break_strain: ArrayLike | None = None) -> range:
        """Adds springs between pairs of points, (springs, 2).

        stiffness [N/m], damping [N s/m], rest_length [m] (None: as drawn) and break_strain [1] (None: never), one for all or for each.
        """
        first = self._scene.add_springs(np.asarray(points).reshape(-1, 2), stiffness, damping, rest_length, break_strain)
        return range(first, self.spring_count)

    def add_spring(self, first: int, second: int, **properties: Any) -> int:
        """Adds a spring between two points and returns its number. Properties: those of add_springs."""
        return self.add_springs([(first, second)], **properties)[0]

    # Properties

    def __getitem__(self, name: str) -> Any:
        """The value of a parameter."""
        return self._scene.get(name)

    def __setitem__(self, name: str, value: Any) -> None:
        """Sets a parameter; a value out of its range is refused."""
        self._scene.set(_setting(name, value))

    positions: Array = property(lambda self: self._scene.positions, lambda self, value: setattr(self._scene, "positions", value),
                                doc="Positions [m], (points, 3): a copy; assign to change them.")  # type: ignore[assignment]
    velocities: Array = property(lambda self: self._scene.velocities, lambda self, value: setattr(self._scene, "velocities", value),
                                 doc="Velocities [m/s], (points, 3): a copy; assign to change them.")  # type: ignore[assignment]
    masses: Array = property(lambda self: self._scene.masses, lambda self, value: setattr(self._scene, "masses", value),
                             doc="Masses [kg], (points,); assign one value or one for each.")  # type: ignore[assignment]
    radii: Array = property(lambda self: self._scene.radii, lambda self, value: setattr(self._scene, "radii", value),
                            doc="Radii [m], (points,); assign one value or one for each.")  # type: ignore[assignment]
    nailed: NDArray[np.bool_] = property(lambda self: self._scene.nailed,
                                         lambda self, value: setattr(self._scene, "nailed", np.asarray(value, bool).tolist()),
                                         doc="Whether each point is nailed, (points,).")  # type: ignore[assignment]
    stiffness: Array = property(lambda self: self._scene.stiffness, lambda self, value: setattr(self._scene, "stiffness", value),
                                doc="Stiffness of each spring [N/m], (springs,); assign one value or one for each.")  # type: ignore
    damping: Array = property(lambda self: self._scene.damping, lambda self, value: setattr(self._scene, "damping", value),
                              doc="Damping of each spring [N s/m], (springs,); assign one value or one for each.")  # type: ignore
    rest_length: Array = property(lambda self: self._scene.rest_length, lambda self, value: setattr(self._scene, "rest_length", value),
                                  doc="Rest length of each spring [m], (springs,); assign one value or one for each.")  # type: ignore

    @property
    def springs(self) -> NDArray[np.int64]:
        """The points of each spring, (springs, 2)."""
        return self._scene.springs

    @property
    def faces(self) -> NDArray[np.int64]:
        """The points of each triangle of a surface, (faces, 3)."""
        return self._scene.faces

    @property
    def point_count(self) -> int:
        """Number of points."""
        return len(self._scene.masses)

    @property
    def spring_count(self) -> int:
        """Number of springs."""
        return len(self._scene.stiffness)

    @property
    def name(self) -> str:
        """The file or the name it was loaded by."""
        return self._scene.name

    @property
    def title(self) -> str:
        """The title in the scene file."""
        return self._scene.title

    @property
    def description(self) -> str:
        """What to try, from the scene file."""
        return self._scene.description

    @property
    def dimensions(self) -> int:
        """2: everything stays in the plane z = 0; or 3."""
        return self._scene.dimensions

    @property
    def time(self) -> float:
        """The time of the state [s]."""
        return self._scene.time

    @property
    def integrator(self) -> str:
        """The method of the scene file."""
        return self._scene.integrator

    @property
    def substeps(self) -> int:
        """Integration steps per frame."""
        return self._scene.substeps

    @property
    def frame_rate(self) -> float:
        """Frames per simulated second [1/s]."""
        return self._scene.frame_rate

    @property
    def hash(self) -> str:
        """Of the state: 16 hexadecimal digits, equal for equal bits."""
        return self._scene.hash

    # Running

    def _stepped(self, integrator: str | None, substeps: int | None, frame_rate: float | None, tolerance: float | None) -> _hooke.Scene:
        return self._scene.with_options(
            {"integrator": integrator, "substeps": substeps, "frame_rate": frame_rate, "tolerance": tolerance})

    def run(self, seconds: float, *, sample: float | None = None, integrator: str | None = None, substeps: int | None = None,
            frame_rate: float | None = None, tolerance: float | None = None, accuracy: str = "full",
            json: str | os.PathLike[str] | None = None, csv: str | os.PathLike[str] | None = None,
            quantities: Sequence[str] | None = None, pc2: str | os.PathLike[str] | None = None,
            on_frame: Callable[[Lab], bool | None] | None = None, progress: bool | None = None) -> Run:
        """Runs a copy of the scene, as `hooke run --json`, with the same bits.

        seconds: simulated time, rounded up to whole frames [s]
        sample: sample at the start and at the end of the first frame at or after each multiple [s]; None: only the last state
        integrator, substeps (per frame), frame_rate [1/s], tolerance [m, of an adaptive method]: None: those of the scene
        accuracy: "full" measures run.error at two and a half times the cost; "frame" only run.frame_error, at a tenth; "off" nothing
        json, csv, pc2: files to write as `hooke run` does; quantities: the columns of the CSV file, see hooke.quantities()
        on_frame: called with the Lab at the start and after every frame, to control it; False ends the run
        progress: a tqdm bar, by default on terminals and in notebooks
        """
        start = self._stepped(integrator, substeps, frame_rate, tolerance)
        _warn(start.warnings)
        callback = None if on_frame is None else lambda lab: on_frame(Lab(lab))
        with bar("run", progress) as shown:
            columns = None if quantities is None else ",".join(quantities)
            values, lab = _hooke.run(start, seconds, sample, accuracy, _path(json), _path(csv), columns, _path(pc2), callback, shown)
        _warn(values["warnings"])
        return Run(values, Lab(lab), start, seconds)

    def lab(self, *, integrator: str | None = None, substeps: int | None = None, frame_rate: float | None = None,
            tolerance: float | None = None, accuracy: str = "off") -> Lab:
        """A laboratory with a copy of the scene, to step frame by frame. Options: those of run."""
        return Lab(_hooke.Lab(self._stepped(integrator, substeps, frame_rate, tolerance), accuracy))

    def bench(self, methods: Sequence[str] = (), *, tolerance_range: tuple[float, float] | None = None, quick: bool = False,
              out: str | os.PathLike[str] | None = None, progress: bool | None = None) -> Chart:
        """Measures speed against error of methods on one second of the scene, as `hooke bench`.

        methods: by default all of them
        tolerance_range: the largest and the smallest error of interest, relative to the size of the scene; no finer setting is measured,
            and rows with a larger error are left out
        quick: coarser, in at most a minute
        out: a folder for the results, from which the same call resumes
        """
        largest, smallest = (math.inf, None) if tolerance_range is None else (max(tolerance_range), min(tolerance_range))
        with bar("bench", progress, "method") as shown:
            folder = None if out is None else os.fspath(out)
            return Chart(*_hooke.bench_scene(self._scene, list(methods), quick, smallest, folder, shown), largest)

    def check(self) -> list[Check]:
        """Runs the check that the scene file contains, with every method that it names; an empty list if it has none."""
        return [Check(self.name, *result) for result in _hooke.check(self._scene)]

    def capture(self, out: str | os.PathLike[str], *, integrator: str | None = None, substeps: int | None = None,
                frame_rate: float | None = None, tolerance: float | None = None, progress: bool | None = None,
                **options: Any) -> CaptureResult:
        """Draws the scene as it moves, without a display, as `hooke capture`.

        out: a .png for the last picture only, a folder for all, or a .mp4 (by ffmpeg)
        seconds: simulated time from the first picture to the last [s], default 0; or frames: the number of pictures
        fps: pictures per simulated second [1/s]; size: (width, height) [px], default (1280, 720); scale: of points, lines and panels
        ui: include the panels; stamp: write time, error and method into each picture; report: a folder for report.csv and report.json
        fail_above: a limit of the accumulated error [m]; camera: the eye and its target, six numbers [m]
        """
        start = self._stepped(integrator, substeps, frame_rate, tolerance)
        with bar("capture", progress) as shown:
            return CaptureResult(*_hooke.capture(start, os.fspath(out), _capture_options(options), shown))

    def _repr_png_(self) -> bytes:
        """The picture that Jupyter shows."""
        with tempfile.TemporaryDirectory() as folder:
            file = os.path.join(folder, "scene.png")
            self.capture(file, size=(640, 400), progress=False)
            with open(file, "rb") as picture:
                return picture.read()

    def __repr__(self) -> str:
        return f"Scene({self.title or self.name!r}, {self.point_count} points, {self.spring_count} springs)"


def _add_shape_methods() -> None:
    """add_cloth, add_rope, ...: one for each row of the table of shapes."""
    for row in _hooke.shapes():
        def add(self: Scene, _type: str = row["id"], /, **fields: Any) -> range:
            return self.add_shape(_type, **fields)

        add.__name__ = f"add_{row['id']}"
        add.__qualname__ = f"Scene.{add.__name__}"
        add.__doc__ = f"{shape_text(row)}\n\nReturns the numbers of its points."
        if not hasattr(Scene, add.__name__):
            setattr(Scene, add.__name__, add)


_add_shape_methods()
Scene.__doc__ = (Scene.__doc__ or "").format(parameters=parameter_text().lstrip(), methods=method_text().lstrip())
