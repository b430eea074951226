"""The commands of the command line as functions."""

from __future__ import annotations

import json
import os
from collections.abc import Sequence
from typing import Any, NamedTuple

from numpy.typing import ArrayLike

from . import _hooke
from ._arguments import flag, import_options, integer, names, numbers_of, optional, path, text
from ._hooke import InputError
from ._progress import bar
from .results import Chart, Check, Replay, Sweep
from .scene import CaptureResult, _capture_options, load


def bench(scenes: str | Sequence[str] = (), methods: str | Sequence[str] = (), *, quick: bool = False, shard: str = "1/1",
          out: str | os.PathLike[str] | None = None, progress: bool | None = None) -> Chart:
    """Measures speed against error, as `hooke bench`: built-in problems, shipped scenes or files, one second of each.

    scenes: by default the built-in problems; methods: by default all of them
    quick: fewer problems, coarser, in at most a minute
    shard: "2/8" measures the second of eight parts; merge_benches puts the folders of all parts together
    out: a folder for the results, from which the same call resumes
    """
    arguments = (names("scenes", scenes), names("methods", methods), flag("quick", quick), text("shard", shard), optional(path, "out", out))
    with bar("bench", progress, "part") as shown:
        return Chart(*_hooke.bench_names(*arguments, shown))


def merge_benches(folders: Sequence[str | os.PathLike[str]], out: str | os.PathLike[str]) -> Chart:
    """Writes one table of the parts of a benchmark in these folders, as `hooke bench --merge`."""
    parts = [path("folders", folder) for folder in folders]
    if not parts:
        raise InputError("folders: must not be empty")
    return Chart(*_hooke.merge_benches(parts, path("out", out)))


def merge_sweeps(folders: Sequence[str | os.PathLike[str]], out: str | os.PathLike[str]) -> Sweep:
    """Writes one table of the parts of a sweep in these folders, as `hooke sweep --merge`."""
    return Sweep(*_hooke.merge_sweeps([path("folders", folder) for folder in folders], path("out", out)))


def check(scenes: str | Sequence[str] = ()) -> list[Check]:
    """Runs the checks that scene files contain, as `hooke check`; by default those of all shipped scenes."""
    chosen = names("scenes", scenes) or [row["id"] for row in _hooke.scenes()]
    return [result for name in chosen for result in load(name).check()]


class HardCases(NamedTuple):
    """The hard cases of `hooke check --hard`: each with its results by method, and the number of results that are not as expected."""

    cases: list[dict[str, Any]]
    broken: int


def check_hard(cases: ArrayLike = (), methods: str | Sequence[str] = (), *, quick: bool = False, strict: bool = False, threads: int = 0,
               progress: bool | None = None) -> HardCases:
    """Runs every method on the hard cases, as `hooke check --hard`: also `auto`, unless quick. threads: by default one per core."""
    arguments = (numbers_of("cases", cases), names("methods", methods), flag("quick", quick), flag("strict", strict),
                 integer("threads", threads))
    with bar("hard cases", progress, "case") as shown:
        document, broken = _hooke.check_hard(*arguments, shown)
    return HardCases(json.loads(document)["cases"], broken)


def convert(source: str | os.PathLike[str], target: str | os.PathLike[str], *, weld: float | None = None, scale: float | None = None,
            up: str | None = None) -> list[str]:
    """Converts a file, or a shipped scene, to the format of the extension of `target`, as `hooke convert`. Returns warnings.

    weld, scale, up: how a mesh is read, as in hooke.load
    """
    return _hooke.convert(path("source", source), path("target", target), import_options(weld, scale, up))


def replay(file: str | os.PathLike[str], *, threads: int = 1, progress: bool | None = None) -> Replay:
    """Steps a recording and compares every frame with the recorded one, as `hooke replay --verify`."""
    with bar("replay", progress) as shown:
        return Replay(*_hooke.replay(path("file", file), integer("threads", threads), shown))


def render_recording(file: str | os.PathLike[str], out: str | os.PathLike[str], *, progress: bool | None = None,
                     **options: Any) -> CaptureResult:
    """Draws a recording, by default to its end, as `hooke capture --replay`. Options: those of Scene.capture for pictures."""
    arguments = (path("file", file), path("out", out), _capture_options(**options))
    with bar("capture", progress) as shown:
        return CaptureResult(*_hooke.capture_recording(*arguments, shown))
