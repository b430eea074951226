"""Scenes: loading, building, running."""

from __future__ import annotations

import concurrent.futures
import contextlib
import difflib
import json
import math
import multiprocessing
import os
import tempfile
import warnings
from collections.abc import Callable, Iterator, Mapping, Sequence
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _hooke
from ._arguments import (array, brief, flag, import_options, integer, json_value, mapping, names, number, numbers_of, optional, path,
                         plain_array, switches, text, whole_numbers)
from ._hooke import InputError
from ._parameters import Array, Parameterized, setting_text
from ._progress import bar
from ._shapes import Shapes
from .lab import Lab
from .results import Chart, Check, Run, Sweep
from .tables import method_text, parameter_text


class HookeWarning(UserWarning):
    """What the command line prints as a warning: a step beyond the stability limit, an energy balance that does not add up."""


def _warn(lines: Sequence[str], stacklevel: int) -> None:
    for line in lines:
        warnings.warn(line, HookeWarning, stacklevel=stacklevel + 1)


def load(name: str | os.PathLike[str], *, weld: float | None = None, scale: float | None = None, up: str | None = None) -> Scene:
    """Loads a shipped scene by its name, such as "cloth", or a file: .json, .obj, .xsp, .xml. See hooke.scenes().

    weld: of a mesh, joins the points of open edges that are closer than this [m]
    scale: of a mesh, the length of its unit [m], 0.001 for millimeters
    up: of a mesh, the axis that points up, "y" or "z"
    """
    scene = _hooke.Scene.load(path("name", name), import_options(weld, scale, up))
    _warn(scene.told, 2)
    return Scene._of(scene)


class CaptureResult(NamedTuple):
    """How a capture ended: whether the run diverged, the first frame beyond `fail_above`, where a replay differs, and the diagnosis."""

    diverged: bool
    error_limit: str
    difference: str
    diagnosis: str


def _capture_options(*, seconds: float | None = None, frames: int | None = None, fps: float | None = None,
                     size: tuple[int, int] = (1280, 720), scale: float = 1.0, ui: bool = False, stamp: bool = False,
                     report: str | os.PathLike[str] | None = None, fail_above: float | None = None,
                     camera: ArrayLike | None = None, threads: int = 1, device: str = "cpu") -> dict[str, Any]:
    return {
        "threads": integer("threads", threads), "device": text("device", device),
        "seconds": optional(number, "seconds", seconds), "frames": optional(integer, "frames", frames), "fps": optional(number, "fps", fps),
        "size": "x".join(str(side) for side in whole_numbers("size", size).ravel()), "scale": number("scale", scale), "ui": flag("ui", ui),
        "stamp": flag("stamp", stamp), "report": optional(path, "report", report), "fail_above": optional(number, "fail_above", fail_above),
        "camera": None if camera is None else ",".join(repr(float(value)) for value in array("camera", camera).ravel()),
    }


@contextlib.contextmanager
def _fields(part: str, name: str, known: Sequence[str] = ()) -> Iterator[None]:
    """In errors, names of arguments instead of members of a file: "add_rope: points: ..." for "scene: generators[0].points: ..."."""
    try:
        yield
    except InputError as error:
        message = str(error).removeprefix("scene: ").removeprefix(part).removeprefix(".").removeprefix(": ")
        if message.endswith(": unknown key"):
            near = difflib.get_close_matches(message.split(":")[0], known, 1)
            message = message.removesuffix("key") + "field" + (f"; did you mean {near[0]}?" if near else "")
        raise InputError(f"{name}: {message}" if name else message) from None


def _nails(value: ArrayLike, count: int) -> list[bool]:
    """True or False for each point."""
    nails = switches("nailed", value)
    if nails.ndim > 0 and nails.shape != (count,):
        raise InputError(f"nailed: shape {nails.shape}: must be one value or ({count},)")
    return [bool(nail) for nail in np.broadcast_to(nails, count)]


class _Column:
    """A property that is an array."""

    def __init__(self, name: str, what: str, convert: Callable[[Scene, Any], Any] | None = None) -> None:
        self._name = name
        self._convert = convert or (lambda scene, value: array(name, value))
        one = "" if name in ("positions", "velocities", "loads") else ", or one value for all,"
        self.__doc__ = f"{what}: a copy, read-only. Assign an array{one} to change them."

    def __get__(self, scene: Scene | None, owner: type[Scene]) -> NDArray[Any]:
        return self if scene is None else getattr(scene._bound, self._name)  # type: ignore

    def __set__(self, scene: Scene, value: ArrayLike) -> None:
        setattr(scene._bound, self._name, self._convert(scene, value))


class Scene(Parameterized, Shapes):
    """A network of points and springs with everything that a scene file contains.

    scene = hooke.load("cloth")      # a shipped scene or a file
    scene = hooke.Scene()            # an empty one, to build

    Parameters are read and set by name: scene["stiffness"] = 200. They are:

    {parameters}

    Integration methods, for run, lab, bench and capture:

    {methods}
    """

    __slots__ = ()
    _bound: _hooke.Scene

    def __init__(self, dimensions: int = 3, *, gravity: ArrayLike = (0.0, -9.81, 0.0), integrator: str = "velocity_verlet",
                 substeps: int = 20, frame_rate: float = 60.0, name: str = "scene") -> None:
        """An empty scene without a floor. gravity [m/s^2], frame_rate [1/s]; dimensions 2: everything stays in the plane z = 0."""
        simulation = {"integrator": text("integrator", integrator), "substeps": integer("substeps", substeps),
                      "frame_rate": number("frame_rate", frame_rate)}
        document = {"hooke": 1, "name": text("name", name), "dimensions": integer("dimensions", dimensions),
                    "gravity": array("gravity", gravity).tolist(), "simulation": simulation}
        with _fields("simulation", ""):
            self._bound = _hooke.Scene.parse(json.dumps(json_value("", document)), "scene")

    @classmethod
    def _of(cls, scene: _hooke.Scene) -> Scene:
        made = cls.__new__(cls)
        made._bound = scene
        return made

    @classmethod
    def from_json(cls, document: str, name: str = "scene") -> Scene:
        """A scene from the text of a scene file; see docs/reference/scene-format.md. `name` stands for the file in messages."""
        return cls._of(_hooke.Scene.parse(text("document", document), path("name", name)))

    def to_json(self) -> str:
        """The text of the scene file, which reads back as the same scene, bit for bit."""
        return self._bound.json()

    def copy(self) -> Scene:
        """An independent copy."""
        return self._of(self._bound.copy())

    def __copy__(self) -> Scene:
        return self.copy()

    def __deepcopy__(self, memo: object) -> Scene:
        return self.copy()

    def __reduce__(self) -> tuple[Any, ...]:
        """For pickle and multiprocessing; not with a force that is a Python function."""
        return Scene.from_json, (self.to_json(), self.name)

    def save(self, file: str | os.PathLike[str]) -> list[str]:
        """Writes the scene in the format of the extension, atomically. Returns what the format cannot represent."""
        return self._bound.save(path("file", file))

    # Building

    def _add(self, key: str, item: dict[str, Any], caller: str) -> range:
        first = self.point_count
        rows = _hooke.shapes() + _hooke.forces()
        known = [field[0] for row in rows if row["id"] == item["type"] for field in row["fields"]] + ["nail", "color"]
        with _fields(f"{key}[0]", caller, known):
            self._bound.add(f"{json.dumps(key)}: [{json.dumps(json_value('', item))}]", "scene")
        return range(first, self.point_count)

    def add_points(self, positions: ArrayLike, *, mass: ArrayLike = 1.0, velocity: ArrayLike | None = None, radius: ArrayLike = 0.02,
                   nailed: ArrayLike = False) -> range:
        """Adds points: positions (points, 3) [m]; mass [kg], radius [m] and nailed, one for all or for each; velocity (points, 3) [m/s]."""
        positions = array("positions", positions)
        if positions.ndim == 1:  # one point, or none
            positions = positions[np.newaxis] if positions.size > 0 else positions.reshape(0, 3)
        velocity = np.zeros_like(positions) if velocity is None else array("velocity", velocity)
        nails = _nails(nailed, len(positions))
        first = self._bound.add_points(positions, array("mass", mass), velocity, array("radius", radius), nails)
        return range(first, self.point_count)

    def add_point(self, position: ArrayLike, *, mass: float = 1.0, velocity: ArrayLike | None = None, radius: float = 0.02,
                  nailed: bool = False) -> int:
        """Adds a point at a position [m] and returns its number. mass [kg], velocity [m/s], radius [m]."""
        moving = None if velocity is None else array("velocity", velocity)[np.newaxis]
        return self.add_points(array("position", position)[np.newaxis], mass=mass, velocity=moving, radius=radius, nailed=nailed)[0]

    def add_springs(self, points: ArrayLike, *, stiffness: ArrayLike = 100.0, damping: ArrayLike = 0.0,
                    rest_length: ArrayLike | None = None, break_strain: ArrayLike | None = None) -> range:
        """Adds springs between pairs of points, (springs, 2).

        stiffness [N/m], damping [N s/m], rest_length [m] (None: as drawn) and break_strain [1] (None: never), one for all or for each.
        """
        ends = whole_numbers("points", points)
        first = self._bound.add_springs(ends if ends.size > 0 else ends.reshape(0, 2), array("stiffness", stiffness),
                                        array("damping", damping), optional(array, "rest_length", rest_length),
                                        optional(array, "break_strain", break_strain))
        return range(first, self.spring_count)

    def add_spring(self, first: int, second: int, *, stiffness: float = 100.0, damping: float = 0.0, rest_length: float | None = None,
                   break_strain: float | None = None) -> int:
        """Adds a spring between two points and returns its number. stiffness [N/m], damping [N s/m], rest_length [m], break_strain [1]."""
        return self.add_springs([(first, second)], stiffness=stiffness, damping=damping, rest_length=rest_length,
                                break_strain=break_strain)[0]

    # Properties

    positions = _Column("positions", "Positions [m], (points, 3)")
    velocities = _Column("velocities", "Velocities [m/s], (points, 3)")
    loads = _Column("loads", "Constant forces on the points [N], (points, 3)")
    masses = _Column("masses", "Masses [kg], (points,)")
    radii = _Column("radii", "Radii [m], (points,)")
    nailed = _Column("nailed", "Whether each point is nailed, (points,)", lambda scene, value: _nails(value, scene.point_count))
    stiffness = _Column("stiffness", "Stiffness of each spring [N/m], (springs,)")
    damping = _Column("damping", "Damping of each spring [N s/m], (springs,)")
    rest_length = _Column("rest_length", "Rest length of each spring [m], (springs,)")

    @property
    def fixed(self) -> list[str]:
        """The axes along which each point does not move, as "y" or "xz"; "": none. Assign a list to change them."""
        return self._bound.fixed

    @fixed.setter
    def fixed(self, fixed: Sequence[str]) -> None:
        self._bound.fixed = names("fixed", fixed)

    @property
    def laws(self) -> list[dict[str, Any] | None]:
        """The law of each spring as in scene files, such as {"law": "cable"} or {"muscle": {"amplitude": 0.2}}; None: a plain spring."""
        return [None if law is None else json.loads(law) for law in self._bound.laws]

    @laws.setter
    def laws(self, laws: Sequence[Mapping[str, Any] | None]) -> None:
        self._bound.laws = [None if law is None else json.dumps(json_value(f"laws[{i}]", mapping(f"laws[{i}]", law))) for i, law in enumerate(laws)]

    @property
    def springs(self) -> NDArray[np.int64]:
        """The points of each spring, (springs, 2)."""
        return self._bound.springs

    @property
    def faces(self) -> NDArray[np.int64]:
        """The points of each triangle of a surface, (faces, 3)."""
        return self._bound.faces

    @property
    def point_count(self) -> int:
        """Number of points."""
        return len(self._bound.masses)

    @property
    def spring_count(self) -> int:
        """Number of springs."""
        return len(self._bound.stiffness)

    @property
    def name(self) -> str:
        """The file or the name it was loaded by."""
        return os.fsdecode(self._bound.name)

    @property
    def title(self) -> str:
        """The title in the scene file."""
        return self._bound.title

    @property
    def summary(self) -> str:
        """The size of a mesh, as `hooke run` prints it; empty for other scenes."""
        return self._bound.summary

    @property
    def description(self) -> str:
        """What to try, from the scene file."""
        return self._bound.description

    @property
    def dimensions(self) -> int:
        """2: everything stays in the plane z = 0; or 3."""
        return self._bound.dimensions

    @property
    def integrator(self) -> str:
        """The method of the scene file."""
        return self._bound.integrator

    @property
    def substeps(self) -> int:
        """Integration steps per frame."""
        return self._bound.substeps

    @property
    def frame_rate(self) -> float:
        """Frames per simulated second [1/s]."""
        return self._bound.frame_rate

    # Running

    def _stepped(self, integrator: str | None, substeps: int | None, frame_rate: float | None, tolerance: float | None) -> _hooke.Scene:
        """A copy with these options, whose warnings are given."""
        scene = self._bound.with_options(optional(text, "integrator", integrator), optional(integer, "substeps", substeps),
                                         optional(number, "frame_rate", frame_rate), optional(number, "tolerance", tolerance))
        _warn([line for line in scene.warnings if not any(told.endswith(line) for told in scene.told)], 3)
        return scene

    def run(self, seconds: float, *, sample: float | None = None, integrator: str | None = None, substeps: int | None = None,
            frame_rate: float | None = None, tolerance: float | None = None, accuracy: str = "full",
            json: str | os.PathLike[str] | None = None, csv: str | os.PathLike[str] | None = None,
            quantities: str | Sequence[str] | None = None, pc2: str | os.PathLike[str] | None = None, points: ArrayLike | None = None,
            on_frame: Callable[[Lab], Any] | None = None, threads: int = 1, precision: str = "double", device: str = "cpu",
            progress: bool | None = None) -> Run:
        """Runs a copy of the scene, as `hooke run --json`, with the same bits.

        seconds: simulated time, rounded up to whole frames [s]
        sample: sample at the start and at the end of the first frame at or after each multiple [s]; None: only the last state
        integrator, substeps (per frame), frame_rate [1/s], tolerance [m, of an adaptive method]: None: those of the scene
        accuracy: "full" measures run.error at two and a half times the cost; "frame" only run.frame_error, at a tenth; "off" nothing
        json, csv, pc2: files to write as `hooke run` does; quantities: the columns of the CSV file, see hooke.quantities()
        points: the numbers of the points to sample; None: all
        on_frame: called with the Lab at the start and after every frame, to control it; False (not None) ends the run
        threads: that compute a frame, to the same bits; precision: "single" for twice the speed where `hooke run` allows it
        device: "gpu" for compute shaders of OpenGL, for scenes for which `hooke run --device gpu` allows it
        progress: a tqdm bar, by default on terminals and in notebooks
        """
        columns = None if quantities is None else ",".join(names("quantities", quantities))
        sampled = optional(numbers_of, "points", points)
        arguments = (number("seconds", seconds), optional(number, "sample", sample), text("accuracy", accuracy),
                     optional(path, "json", json), optional(path, "csv", csv), columns, optional(path, "pc2", pc2), sampled)
        if on_frame is not None and not callable(on_frame):
            raise TypeError(f"on_frame: {brief(on_frame)}: must be a function")
        control = None if on_frame is None else _control(on_frame)
        execution = (integer("threads", threads), text("precision", precision), text("device", device))
        start = self._stepped(integrator, substeps, frame_rate, tolerance)
        with bar("run", progress) as shown:
            values, lab = _hooke.run(start, *arguments, *execution, control, shown)
        _warn(values["warnings"], 2)
        return Run(values, Lab(lab), start, seconds, sampled)

    def lab(self, *, integrator: str | None = None, substeps: int | None = None, frame_rate: float | None = None,
            tolerance: float | None = None, accuracy: str = "off", threads: int = 1, precision: str = "double", device: str = "cpu") -> Lab:
        """A laboratory with a copy of the scene, to step frame by frame. Options: those of run."""
        options = (text("accuracy", accuracy), integer("threads", threads), text("precision", precision), text("device", device))
        return Lab(_hooke.Lab(self._stepped(integrator, substeps, frame_rate, tolerance), *options))

    def bench(self, methods: Sequence[str] = (), *, tolerance_range: tuple[float, float] | None = None, quick: bool = False,
              shard: str = "1/1", out: str | os.PathLike[str] | None = None, progress: bool | None = None) -> Chart:
        """Measures speed against error of methods on one second of the scene, as `hooke bench`.

        methods: by default all of them
        tolerance_range: the largest and the smallest error of interest, relative to the size of the scene; no finer setting is measured,
            and rows with a larger error are left out
        quick: coarser, in at most a minute
        shard: "2/8" measures the second of eight parts; hooke.merge_benches puts the folders of all parts together
        out: a folder for the results, from which the same call resumes
        """
        largest, smallest = math.inf, None
        if tolerance_range is not None:
            ends = array("tolerance_range", tolerance_range)
            if ends.shape != (2,):
                raise InputError(f"tolerance_range: shape {ends.shape}: must be (2,)")
            if not np.isfinite(ends).all():
                raise InputError(f"tolerance_range: {tolerance_range}: must be finite numbers")
            largest, smallest = float(ends.max()), float(ends.min())
        chosen = names("methods", methods)
        with bar("bench", progress, "method") as shown:
            return Chart(*_hooke.bench_scene(self._bound, chosen, flag("quick", quick), smallest, text("shard", shard), optional(path, "out", out),
                                             shown), largest)

    def sweep(self, vary: Mapping[str, ArrayLike | str], measure: str | Sequence[str], seconds: float, *, integrator: str | None = None,
              substeps: int | None = None, frame_rate: float | None = None, tolerance: float | None = None, shard: str = "1/1",
              out: str | os.PathLike[str] | None = None, processes: int = 1, progress: bool | None = None) -> Sweep:
        """Runs a copy of the scene for every combination of parameter values, as `hooke sweep`, with the same values.

        vary: the values of each parameter, {"stiffness": np.logspace(2, 4, 5), "substeps": [8, 16]}, or a range "100:1e4:log:20"
        measure: columns of the table: hooke.quantities(), at the end of a run, or "max:", "min:" or "mean:" of one over it; and "cpu"
        seconds: simulated time of each run [s]
        shard: "2/8" runs the second of eight parts; hooke.merge_sweeps puts the folders of all parts together
        out: a folder for the table and charts, from which the same call resumes
        processes: that share the runs, to the same table; they start a new interpreter each, in which the main module is imported
        """
        axes, vary = [], mapping("vary", vary)
        if not 1 <= (parts := integer("processes", processes)) <= 256:
            raise InputError(f"processes: {parts}: must be from 1 to 256")
        if parts > 1:
            if shard != "1/1":
                raise InputError("processes: excludes shard")
            return self._sweep_in_parts(parts, out, vary=vary, measure=measure, seconds=seconds, integrator=integrator,
                                        substeps=substeps, frame_rate=frame_rate, tolerance=tolerance, progress=False)
        for name, values in vary.items():
            listed = values if isinstance(values, str) else ",".join(setting_text(value) for value in np.atleast_1d(plain_array(f"vary: {name}", values, "biufU", "numbers or words")))
            axes.append(text("vary", f"{text('vary', name)}={listed}"))
        measures = ",".join(names("measure", measure))
        for name, given in (("vary", axes), ("measure", measures)):
            if not given:
                raise InputError(f"{name}: must not be empty")
        arguments = (axes, measures, number("seconds", seconds), text("shard", shard), optional(path, "out", out))
        start = self._bound.with_options(optional(text, "integrator", integrator), optional(integer, "substeps", substeps),
                                         optional(number, "frame_rate", frame_rate), optional(number, "tolerance", tolerance))
        with bar("sweep", progress, "run") as shown:
            return Sweep(*_hooke.sweep(start, *arguments, shown))

    def _sweep_in_parts(self, parts: int, out: str | os.PathLike[str] | None, **options: Any) -> Sweep:
        with tempfile.TemporaryDirectory() as scratch:
            folders = [os.path.join(scratch, str(part)) for part in range(parts)]
            jobs = [(self, options, f"{part + 1}/{parts}", folder) for part, folder in enumerate(folders)]
            with concurrent.futures.ProcessPoolExecutor(parts, mp_context=multiprocessing.get_context("spawn")) as pool:
                list(pool.map(_sweep_part, jobs))
            target = os.path.join(scratch, "all") if out is None else out
            return Sweep(*_hooke.merge_sweeps([path("out", folder) for folder in folders], path("out", target)))

    def check(self) -> list[Check]:
        """Runs the check that the scene file contains, with every method that it names; an empty list if it has none."""
        return [Check(self.name, *result) for result in _hooke.check(self._bound)]

    def capture(self, out: str | os.PathLike[str], *, seconds: float | None = None, frames: int | None = None, fps: float | None = None,
                size: tuple[int, int] = (1280, 720), scale: float = 1.0, ui: bool = False, stamp: bool = False,
                report: str | os.PathLike[str] | None = None, fail_above: float | None = None, camera: ArrayLike | None = None,
                integrator: str | None = None, substeps: int | None = None, frame_rate: float | None = None,
                tolerance: float | None = None, threads: int = 1, device: str = "cpu", progress: bool | None = None) -> CaptureResult:
        """Draws the scene as it moves, without a display, as `hooke capture`.

        out: a .png for the last picture only, a folder for all, or a film: .mp4 (by ffmpeg), .webp or .gif
        seconds: simulated time from the first picture to the last [s], default 0; or frames: the number of pictures
        fps: pictures per simulated second [1/s]; size: (width, height) [px]; scale: of points, lines and panels
        ui: include the panels; stamp: write time, error and method into each picture; report: a folder for report.csv and report.json
        fail_above: a limit of the accumulated error [m]; camera: the eye and its target, six numbers [m]
        """
        options = _capture_options(seconds=seconds, frames=frames, fps=fps, size=size, scale=scale, ui=ui, stamp=stamp, report=report,
                                   fail_above=fail_above, camera=camera, threads=threads, device=device)
        file = path("out", out)
        start = self._stepped(integrator, substeps, frame_rate, tolerance)
        with bar("capture", progress) as shown:
            return CaptureResult(*_hooke.capture(start, file, options, shown))

    def _repr_png_(self) -> bytes:
        """The picture that Jupyter shows."""
        return self._picture()

    def _picture(self) -> bytes:
        with tempfile.TemporaryDirectory() as folder:
            file = os.path.join(folder, "scene.png")
            _hooke.capture(self._bound, os.fsencode(file), _capture_options(size=(640, 400)), None)
            with open(file, "rb") as picture:
                return picture.read()

    def __repr__(self) -> str:
        what = self.summary or f"{self.title or self.name!r}, {self.point_count} points"
        return f"Scene({what}, {self.spring_count} springs)"


def _sweep_part(job: tuple[Scene, dict[str, Any], str, str]) -> None:
    scene, options, shard, folder = job
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", HookeWarning)
        scene.sweep(**options, shard=shard, out=folder)


def _control(on_frame: Callable[[Lab], Any]) -> Callable[[_hooke.Lab], bool]:
    def control(lab: _hooke.Lab) -> bool:
        answer = on_frame(Lab(lab))
        return answer is None or bool(answer)

    return control


Scene.__doc__ = (Scene.__doc__ or "").format(parameters=parameter_text().lstrip(), methods=method_text().lstrip())
