"""The commands of the command line as functions."""

from __future__ import annotations

import json
from collections.abc import Sequence
from typing import Any, NamedTuple

from . import _hooke
from ._progress import bar
from .results import Chart, Check, Replay
from .scene import CaptureResult, _capture_options, load


def bench(scenes: Sequence[str] = (), methods: Sequence[str] = (), *, quick: bool = False, out: str | None = None,
          progress: bool | None = None) -> Chart:
    """Measures speed against error, as `hooke bench`: built-in problems, shipped scenes or files, one second of each.

    scenes: by default the built-in problems; methods: by default all of them
    quick: fewer problems, coarser, in at most a minute
    out: a folder for the results, from which the same call resumes
    """
    with bar("bench", progress, "part") as shown:
        return Chart(*_hooke.bench_names(list(scenes), list(methods), quick, None if out is None else str(out), shown))


def check(scenes: Sequence[str] = ()) -> list[Check]:
    """Runs the checks that scene files contain, as `hooke check`; by default those of all shipped scenes."""
    names = list(scenes) or [row["id"] for row in _hooke.scenes()]
    return [result for name in names for result in load(name).check()]


class HardCases(NamedTuple):
    """The hard cases of `hooke check --hard`: each with its results by method, and the number of results that are not as expected."""

    cases: list[dict[str, Any]]
    broken: int


def check_hard(cases: Sequence[int] = (), methods: Sequence[str] = (), *, quick: bool = False, strict: bool = False, threads: int = 0,
               progress: bool | None = None) -> HardCases:
    """Runs every method on the hard cases, as `hooke check --hard`. threads: by default one per core."""
    with bar("hard cases", progress, "case") as shown:
        text, broken = _hooke.check_hard(list(cases), list(methods), quick, strict, threads, shown)
    return HardCases(json.loads(text)["cases"], broken)


def convert(source: str, target: str) -> list[str]:
    """Converts a file, or a shipped scene, to the format of the extension of `target`, as `hooke convert`. Returns warnings."""
    return _hooke.convert(str(source), str(target))


def replay(file: str, *, progress: bool | None = None) -> Replay:
    """Steps a recording and compares every frame with the recorded one, as `hooke replay --verify`."""
    with bar("replay", progress) as shown:
        return Replay(*_hooke.replay(str(file), shown))


def render_recording(file: str, out: str, *, progress: bool | None = None, **options: Any) -> CaptureResult:
    """Draws a recording, by default to its end, as `hooke capture --replay`. Options: those of Scene.capture."""
    with bar("capture", progress) as shown:
        return CaptureResult(*_hooke.capture_recording(str(file), str(out), _capture_options(options), shown))
