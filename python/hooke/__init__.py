"""Hooke: a laboratory for networks of point masses and springs that reports its own error.

    import hooke
    scene = hooke.load("cloth")
    scene["stiffness"] = 200
    run = scene.run(seconds=2, sample=1 / 60)
    run.positions            # (samples, points, 3) [m]
    run.error[-1]            # [m]: the estimated error of the last sample

SI units throughout. Everything is computed by the modules that the command line uses: the same options and defaults give the same bits.
Errors are exceptions: InputError, UsageError (for an unknown name also a KeyError) and FileError (for a missing file also a
FileNotFoundError), all of them Error, with the message that the command line prints, which here names the argument instead of the option;
TypeError for an argument of the wrong type.
"""

from ._hooke import Error, FileError, InputError, MissingFileError, UnknownNameError, UsageError
from ._hooke import version as __version__
from .commands import HardCases, bench, check, check_hard, convert, merge_benches, merge_sweeps, replay, render_recording
from .lab import Contact, Lab
from .results import Chart, Check, Energy, Replay, Run, Sweep
from .scene import CaptureResult, HookeWarning, Scene, load
from .tables import forces, methods, parameters, quantities, scenes, shapes

__all__ = [
    "CaptureResult", "Chart", "Check", "Contact", "Energy", "Error", "FileError", "HardCases", "HookeWarning", "InputError", "Lab",
    "MissingFileError", "Replay", "Run", "Scene", "Sweep", "UnknownNameError", "UsageError", "bench", "check", "check_hard", "convert",
    "forces", "load", "merge_benches", "merge_sweeps", "methods", "parameters", "quantities", "render_recording", "replay", "scenes", "shapes",
]
