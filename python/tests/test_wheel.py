"""The wheel that `pip install .` builds, made of the files of this build: it is installed without a network, has metadata, and is removed."""

import importlib.util
import os
import pathlib
import subprocess
import sys

import pytest

import hooke

root = pathlib.Path(__file__).parents[2]


def test_the_wheel_is_installed_used_and_removed(tmp_path):
    pytest.importorskip("ensurepip")
    spec = importlib.util.spec_from_file_location("build_backend", root / "python" / "build_backend.py")
    assert spec is not None and spec.loader is not None
    backend = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(backend)
    backend._install = lambda prefix: subprocess.run(
        ["cmake", "--install", os.environ["HOOKE_BUILD"], "--prefix", prefix, "--component", "python_module"], check=True, capture_output=True)
    wheel = tmp_path / backend.build_wheel(str(tmp_path))
    assert backend.prepare_metadata_for_build_wheel(str(tmp_path)) == f"hooke-{hooke.__version__}.dist-info"

    subprocess.run([sys.executable, "-m", "venv", "--system-site-packages", tmp_path / "venv"], check=True)
    environment = {**{name: value for name, value in os.environ.items() if name != "PYTHONPATH"}, "PIP_NO_INDEX": "1"}

    def run(*words):
        return subprocess.run([tmp_path / "venv" / "bin" / words[0], *words[1:]], check=True, capture_output=True, text=True, cwd="/",
                              env=environment).stdout

    run("pip", "install", "--no-deps", "--ignore-installed", wheel)
    program = ("import hooke, importlib.metadata; print(importlib.metadata.version('hooke'), "
               "hooke.load('two_masses').run(0.1, accuracy='off').hash, hooke.__file__, *(row['id'] for row in hooke.scenes()))")
    version, hash_of_run, file, *scenes = run("python", "-c", program).split()
    assert scenes == [row["id"] for row in hooke.scenes()]
    installed = pathlib.Path(file).parent / "share" / "hooke"
    for folder in ("scenes", "textures", "fonts"):
        assets = root / "assets" / folder
        assert {part.relative_to(assets) for part in assets.rglob("*")} == {
            part.relative_to(installed / folder) for part in (installed / folder).rglob("*")}
    assert version == hooke.__version__ and hash_of_run == hooke.load("two_masses").run(0.1, accuracy="off").hash
    assert file.startswith(str(tmp_path))
    run("pip", "uninstall", "-y", "hooke")
    assert not list((tmp_path / "venv").rglob("*hooke*"))
