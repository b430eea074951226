"""bench, check, convert, capture, replay: as on the command line."""

import json
import pathlib
import warnings

import numpy as np
import pytest

import hooke
import hooke.sodaconstructor


@pytest.fixture(scope="module")
def chart() -> hooke.Chart:
    return hooke.load("two_masses").bench(["velocity_verlet", "runge_kutta4"], tolerance_range=(1e-1, 1e-5), quick=True)


def test_a_benchmark_measures_the_methods_and_its_front(chart):
    assert {row["method"] for row in chart.rows} == {"velocity_verlet", "runge_kutta4"}
    errors = [row["relative_error"] for row in chart.rows if row["relative_error"] is not None]
    assert min(errors) <= 1e-4 and max(errors) <= 1e-1
    front = chart.front()
    assert all(a["cpu_ms_per_s"] <= b["cpu_ms_per_s"] and a["error_m"] > b["error_m"] for a, b in zip(front, front[1:]))
    assert chart.cheapest(1e9) == front[0] and chart.cheapest(0) is None
    with pytest.raises(KeyError, match="scene: nowhere: must be one of "):
        chart.front("nowhere")


def test_a_chart_is_drawn_with_matplotlib(chart):
    import matplotlib

    matplotlib.use("Agg")
    axes = chart.plot()
    assert axes.get_xscale() == axes.get_yscale() == "log" and len(axes.lines) == 3


def test_a_chart_is_saved_as_the_command_line_does(chart, tmp_path):
    chart.save(tmp_path)
    assert json.loads((tmp_path / "bench.json").read_text())["scenes"][0]["scene"] == "two_masses"
    assert (tmp_path / "bench.csv").read_text().startswith("scene,method,setting,step_s,error_m")


def test_a_chart_without_matplotlib_names_the_package(chart, monkeypatch):
    import sys

    monkeypatch.setitem(sys.modules, "matplotlib.pyplot", None)
    with pytest.raises(ImportError, match="plot: requires Matplotlib .package python3-matplotlib."):
        chart.plot()


def test_the_parts_of_a_benchmark_are_merged_into_that_of_the_command_line(tmp_path, command_line):
    def measured(rows):
        return {(row["method"], row["setting"]): row for row in rows}

    methods = ["symplectic_euler", "velocity_verlet"]
    for part in (1, 2):
        chart = hooke.bench("net_w2", methods, quick=True, shard=f"{part}/2", out=tmp_path / str(part))
        assert {row["method"] for row in chart.rows} == {methods[part - 1]}
    merged = hooke.merge_benches([tmp_path / "1", tmp_path / "2"], tmp_path / "all")
    assert {row["method"] for row in merged.rows} == set(methods) and (tmp_path / "all" / "bench.csv").exists()
    assert merged.is_complete
    half = hooke.merge_benches([tmp_path / "2"], tmp_path / "half")
    assert not half.is_complete and any("the first is 1/2" in line for line in half.messages)
    command_line("bench", "net_w2", "--methods", ",".join(methods), "--quick", "--quiet", "--out", str(tmp_path / "printed"))
    problem = json.loads((tmp_path / "printed" / "bench.json").read_text())["scenes"][0]
    assert problem["fingerprint"] == merged.problems[0]["fingerprint"]
    # how far each method and the reference get within the time depends on the machine; what a setting does, does not
    ours, theirs = measured(merged.rows), measured(problem["rows"])
    common = ours.keys() & theirs.keys()
    assert common
    for setting in common:
        for column in ("step_s", "energy_drift", "strain_error", "status"):
            assert ours[setting][column] == theirs[setting][column]
        assert ours[setting]["error_m"] == pytest.approx(theirs[setting]["error_m"], rel=1e-6)


def test_meshes_are_read_with_the_options_of_the_command_line(tmp_path):
    mesh, out = tmp_path / "sheet.obj", tmp_path / "out.json"
    mesh.write_text("v 0 0 0\nv 1000 0 0\nv 0 0 500\nf 1 2 3\n")
    assert hooke.load(mesh, scale=0.001, up="z").positions[2].tolist() == [0.0, 0.5, 0.0]
    assert hooke.convert(mesh, out, scale=0.001, weld=0) == []
    with pytest.raises(hooke.UsageError, match="up: x: must be y or z"):
        hooke.load(mesh, up="x")


def test_warnings_about_a_mesh_are_given_when_it_is_loaded(tmp_path):
    mesh = tmp_path / "fan.obj"
    mesh.write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 -1 0\nv 0 0 1\nf 1 2 3\nf 1 2 4\nf 1 2 5\n")
    with pytest.warns(hooke.HookeWarning, match="more than two faces"):
        scene = hooke.load(mesh)
    assert "5 points" in scene.summary and scene.summary in repr(scene)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        scene.run(0.1, accuracy="off")


def test_models_of_sodaconstructor_are_read(tmp_path):
    model = tmp_path / "walker.xml"
    model.write_text('<object id="Model#1" type="com.sodaplay.soda.constructor2.model.Model"><field name="nodes"><list>'
                     '<object id="Mass#1" type="Mass"><field name="x"><double>250</double></field></object></list></field></object>')
    assert hooke.load(model).positions.tolist() == [[2.5, 0.0, 0.0]] and hooke.sodaconstructor.load is hooke.load
    model.write_text("<object>")
    with pytest.raises(hooke.InputError, match="walker.xml: line 1: XML: "):
        hooke.load(model)


def test_checks_are_those_of_the_command_line(command_line):
    results = hooke.check(["two_masses"])
    lines = [f"{'passed' if each.passed else 'FAILED'}  {each.scene}, {each.method}: {each.measured}" for each in results]
    assert results and command_line("check", "two_masses").stdout.splitlines() == lines


def test_hard_cases_are_those_of_the_command_line(command_line):
    def without_times(cases):
        return [{**case, "results": [{**result, "cpu_seconds": 0} for result in case["results"]]} for case in cases]

    printed = json.loads(command_line("check", "--hard", "--cases", "1", "--methods", "velocity_verlet", "--json", "-").stdout)
    ours = hooke.check_hard([1], ["velocity_verlet"])
    assert without_times(ours.cases) == without_times(printed["cases"]) and ours.broken == printed["broken"]
    every = hooke.check_hard([1])
    printed = json.loads(command_line("check", "--hard", "--cases", "1", "--json", "-").stdout)
    assert without_times(every.cases) == without_times(printed["cases"])
    assert "auto" in [result["method"] for result in every.cases[0]["results"]]
    with pytest.raises(hooke.UsageError, match="no such case"):
        hooke.check_hard([9999])


def test_a_converted_file_is_that_of_the_command_line(command_line, tmp_path):
    ours, theirs = tmp_path / "ours.xsp", tmp_path / "theirs.xsp"
    warnings = hooke.convert("two_masses", ours)
    printed = command_line("convert", "two_masses", str(theirs)).stderr
    assert ours.read_bytes() == theirs.read_bytes() and printed == "".join(f"warning: {line}\n" for line in warnings)


def test_a_picture_is_that_of_the_command_line(command_line, tmp_path):
    ours, theirs = tmp_path / "ours.png", tmp_path / "theirs.png"
    assert not hooke.load("two_masses").capture(ours, size=(160, 100), seconds=0.1).diverged
    command_line("capture", "two_masses", "--out", str(theirs), "--size", "160x100", "--seconds", "0.1")
    assert ours.read_bytes() == theirs.read_bytes()


def test_jupyter_shows_a_picture():
    assert hooke.load("two_masses")._repr_png_().startswith(b"\x89PNG")


def test_frames_in_a_folder_are_those_of_the_command_line(command_line, tmp_path):
    ours, theirs = tmp_path / "ours", tmp_path / "theirs"
    hooke.load("two_masses").capture(ours, size=(64, 40), frames=3, fps=30, camera=(0, 0, 2, 0, 0, 0), stamp=True)
    command_line("capture", "two_masses", "--out", str(theirs), "--size", "64x40", "--frames", "3", "--fps", "30", "--camera",
                 "0,0,2,0,0,0", "--stamp")
    assert len(list(theirs.iterdir())) == 3
    assert all((ours / file.name).read_bytes() == file.read_bytes() for file in theirs.iterdir())


def test_a_recording_replays_to_the_same_bits(command_line, tmp_path):
    log = tmp_path / "run.hookelog"
    lab = hooke.load("two_masses").lab()
    lab.record(log)
    lab["stiffness"] = 150
    lab.step(10)
    lab.stop_recording()
    replayed = hooke.replay(log)
    assert replayed == (10, lab.hash, "")
    assert f"hash {lab.hash}: every frame as recorded" in command_line("replay", str(log), "--verify").stdout


def test_the_stub_lists_what_the_extension_defines():
    import ast

    from hooke import _hooke

    stub = ast.parse((pathlib.Path(hooke.__file__).parent / "_hooke.pyi").read_text())
    classes = {node.name: node for node in stub.body if isinstance(node, ast.ClassDef)}
    functions = {node.name for node in stub.body if isinstance(node, ast.FunctionDef)}
    public = {name for name in dir(_hooke) if not name.startswith("_")}
    assert functions | set(classes) | {"version"} == public
    for name in ("Scene", "Lab"):
        members = {node.name for node in classes[name].body if isinstance(node, ast.FunctionDef)} - {"__init__"}
        members |= {node.target.id for node in classes[name].body if isinstance(node, ast.AnnAssign)}
        assert members == {member for member in dir(getattr(_hooke, name)) if not member.startswith("_")}


def test_everything_public_is_documented():
    for name in hooke.__all__:
        thing = getattr(hooke, name)
        assert thing.__doc__, name
        if isinstance(thing, type):
            for member, value in vars(thing).items():
                if not member.startswith("_") and (callable(value) or isinstance(value, property)):
                    assert value.__doc__, f"{name}.{member}"


def test_arrays_of_a_run_agree_with_its_lab():
    run = hooke.load("two_masses").run(0.2)
    assert np.array_equal(run.positions[-1], run.lab.positions) and run.hash == run.lab.hash
