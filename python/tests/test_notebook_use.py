"""What a notebook does with results: pickle and copy them, share work among processes, read forces, show them."""

import copy
import importlib.metadata
import inspect
import multiprocessing
import pickle
import time
import warnings

import numpy as np
import pytest

import hooke


def final(stiffness: float) -> hooke.Run:
    scene = hooke.load("two_masses")
    scene["stiffness"] = stiffness
    return scene.run(0.1, sample=0.05)


def test_runs_come_back_from_other_processes():
    with multiprocessing.get_context("fork").Pool(2) as pool:
        runs = pool.map(final, [100.0, 200.0])
    for run, stiffness in zip(runs, (100.0, 200.0)):
        expected = final(stiffness)
        assert run.hash == expected.hash and np.array_equal(run.positions, expected.positions)
        assert np.array_equal(run.energy.total, expected.energy.total)
        with pytest.raises(hooke.UsageError, match="lab: a run that was pickled has none"):
            run.lab


def test_a_diverged_run_that_was_pickled_says_why():
    run = hooke.load("two_masses").run(5, integrator="explicit_euler", substeps=1, frame_rate=5)
    assert run.diverged and pickle.loads(pickle.dumps(run)).diagnosis.startswith("The simulation blew up at t = 0.6 s: ")


def test_a_lab_is_pickled_and_copied_as_its_state():
    lab = hooke.load("cloth").lab(accuracy="frame")
    lab.step(6)
    for made in (pickle.loads(pickle.dumps(lab)), copy.deepcopy(lab), copy.copy(lab)):
        assert made.hash == lab.hash and made.time == lab.time
        made.step(3)
        assert made.error["frame"] is not None
    expected = copy.deepcopy(lab)
    lab.step(3)
    assert lab.time > expected.time
    expected.step(3)
    assert expected.hash == lab.hash


@pytest.mark.parametrize("pull", [None, 50.0])
def test_a_lab_is_pickled_with_what_the_hand_holds(pull):
    lab = hooke.load("cloth").lab()
    lab.grab(5, target=(0.2, 0.4, 0.3), pull=pull)
    lab.step(4)
    lab.move_hand((0.3, 0.3, 0.3))
    copies = [pickle.loads(pickle.dumps(lab)), copy.deepcopy(lab)]
    free = copy.copy(lab)
    free.release()
    for each in (lab, free, *copies):
        each.step(3)
    assert [made.hash for made in copies] == [lab.hash, lab.hash] and free.hash != lab.hash


def test_runs_sweeps_and_charts_are_copied():
    run = final(100.0)
    for made in (copy.copy(run), copy.deepcopy(run)):
        assert made.hash == run.hash and made.lab.hash == run.lab.hash
    assert copy.deepcopy(run).lab is not run.lab
    sweep = hooke.load("two_masses").sweep({"stiffness": [100, 200]}, "total", 0.1)
    for made in (copy.deepcopy(sweep), pickle.loads(pickle.dumps(sweep))):
        assert np.array_equal(made["total"], sweep["total"])
    chart = hooke.load("two_masses").bench(["velocity_verlet"], quick=True, tolerance_range=(1e-1, 1e-2))
    assert pickle.loads(pickle.dumps(chart)).rows == chart.rows


def test_a_scene_is_pickled_whatever_its_file_is_called(tmp_path):
    file = bytes(tmp_path) + b"/\xff.json"
    hooke.load("two_masses").save(file)
    scene = hooke.load(file)
    made = pickle.loads(pickle.dumps(scene))
    assert made.name == scene.name and made.hash == scene.hash


def test_processes_share_a_sweep_to_the_same_table():
    scene = hooke.load("two_masses")
    arguments = ({"stiffness": [100, 150, 200], "substeps": [20, 40]}, ["total", "max:y1"], 0.1)
    alone, shared = scene.sweep(*arguments), scene.sweep(*arguments, processes=2)
    assert shared.is_complete and shared.to_csv() == alone.to_csv()
    with pytest.raises(hooke.InputError, match="processes: 0: must be from 1 to 256"):
        scene.sweep(*arguments, processes=0)


def test_the_rows_of_a_sweep_are_dictionaries():
    sweep = hooke.load("two_masses").sweep({"stiffness": [100, 200]}, "total", 0.1)
    rows = list(sweep)
    assert len(rows) == len(sweep) == 2
    assert rows[1] == {"stiffness": 200.0, "total": sweep["total"][1], "status": "ok", "note": ""}
    pandas = pytest.importorskip("pandas")
    frame = pandas.DataFrame(sweep)
    assert list(frame.columns) == ["stiffness", "total", "status", "note"] and frame["total"].tolist() == sweep["total"].tolist()


def test_numbers_of_single_precision_are_decimal():
    scene = hooke.load("two_masses")
    assert scene.run(np.float32(0.1), accuracy="off").seconds == scene.run(0.1, accuracy="off").seconds
    scene["drag"] = np.float32(0.1)
    assert scene["drag"] == 0.1
    assert scene.run(np.float64(0.1), accuracy="off").seconds == pytest.approx(0.1)


def test_threads_and_precision_are_those_of_the_command_line(run_json):
    scene = hooke.load("cloth_64") if any(row["id"] == "cloth_64" for row in hooke.scenes()) else hooke.load("cloth")
    assert scene.run(0.05, accuracy="off", threads=2).hash == scene.run(0.05, accuracy="off").hash
    lab = scene.lab(threads=2)
    lab.step(3)
    assert lab.hash == scene.run(0.05, accuracy="off").hash
    grid = hooke.Scene()
    grid.add_cloth(corner=(0, 0, 0), across=(1, 0, 0), down=(0, -1, 0), points=(32, 32), mass=0.2, stiffness=100, nail=["top_left"])
    assert grid.run(0.1, accuracy="off", precision="single").hash != grid.run(0.1, accuracy="off").hash
    for options, message in (({"threads": 0}, "threads: 0: must be from 1"), ({"precision": "half"}, "precision: half: must be double or"),
                             ({"precision": "single"}, "precision: single: not for springs with dashpots")):
        with pytest.raises(hooke.UsageError, match=message):
            hooke.load("two_masses").run(0.1, **options)


def test_a_short_run_costs_little_beyond_its_frames():
    scene = hooke.load("two_masses")

    def cost() -> float:
        start = time.process_time()
        for _ in range(50):
            scene.run(0, accuracy="off", progress=False)
        return (time.process_time() - start) / 50

    scene.run(0, accuracy="off", progress=False)
    assert min(cost() for _ in range(10)) < 2e-4  # 0.1 ms on an idle machine
    # a run that is repeated has the same warnings, and one of a changed scene its own
    for _ in range(2):
        with pytest.warns(hooke.HookeWarning, match="substeps: 1: may be too few"):
            scene.run(0, accuracy="off", substeps=1, frame_rate=2)
    scene["damping"] = 0
    scene["stiffness"] = 0.01
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        scene.run(0, accuracy="off", substeps=1, frame_rate=2)


def hanging() -> hooke.Lab:
    scene = hooke.Scene()
    scene.add_points([[0, 0, 0], [0, -1, 0]], mass=[1.0, 2.0], nailed=[True, False])
    scene.add_spring(0, 1, stiffness=100)
    lab = scene.lab()
    lab.set_state([[0, 0, 0], [0, -1.25, 0]], np.zeros((2, 3)))
    return lab


def test_a_lab_has_the_forces_of_springs_and_nails():
    lab = hanging()
    assert lab.strain.tolist() == [0.25] and lab.tension.tolist() == [25.0] and lab.spring_energy.tolist() == [0.5 * 100 * 0.25**2]
    assert lab.spring_forces.tolist() == [[0, -25, 0]]
    assert np.allclose(lab.loads, [[0, -9.81, 0], [0, -19.62, 0]])
    assert np.allclose(lab.reactions, [[0, 25 + 9.81, 0], [0, 0, 0]])


def test_nails_bear_the_weight_of_a_net_at_rest():
    scene = hooke.Scene()
    scene.add_cloth(corner=(0, 0, 0), across=(1, 0, 0), down=(0, 0, 1), points=(6, 6), mass=0.2, stiffness=100, nail=["corners"])
    scene["drag"] = 5
    lab = scene.lab()
    lab.step(1200)
    assert np.allclose(lab.reactions.sum(axis=0), [0, scene.masses.sum() * 9.81, 0], atol=1e-6)


def test_an_edit_in_place_is_one_command():
    lab = hanging()
    with lab.edit() as (positions, velocities):
        positions[1, 1] -= 1
        velocities[1, 0] = 3
    assert lab.positions[1].tolist() == [0, -2.25, 0] and lab.velocities[1].tolist() == [3, 0, 0]
    lab.undo()
    assert lab.positions[1].tolist() == [0, -1.25, 0]
    with pytest.raises(RuntimeError), lab.edit() as (positions, _):
        positions[1, 1] = 7
        raise RuntimeError
    assert lab.positions[1].tolist() == [0, -1.25, 0]


def test_errors_are_those_that_python_programs_expect():
    with pytest.raises(KeyError, match="no such parameter") as unknown:
        hooke.load("two_masses")["stifness"]
    assert isinstance(unknown.value, hooke.UsageError) and str(unknown.value).startswith('scene["stifness"]: no such parameter')
    for missing in (lambda: hooke.load("/nowhere/a.json"), lambda: hooke.load("nowhere"), lambda: hooke.replay("/nowhere/a.hookelog")):
        with pytest.raises(FileNotFoundError) as error:
            missing()
        assert isinstance(error.value, hooke.FileError)
    with pytest.raises(KeyError, match="must be one of"):
        hooke.load("two_masses").sweep({"stiffness": [100]}, "total", 0.1)["nothing"]
    assert hooke.load("two_masses")["dimensions"] == 2 and hooke.load("cloth")["dimensions"] == 3


def test_shapes_have_signatures():
    assert "from_" in inspect.signature(hooke.Scene.add_rope).parameters
    rope = hooke.Scene()
    assert len(rope.add_rope(from_=(0, 0, 0), to=(1, 0, 0), points=5, mass=1, stiffness=10, nail=["from"])) == 5
    assert len(rope.add_rope(**{"from": (0, 1, 0), "to": (1, 1, 0)}, points=5, mass=1, stiffness=10)) == 5


def test_jupyter_shows_runs_and_labs():
    run = hooke.load("two_masses").run(0.1, sample=0.05)
    page = run._repr_html_()
    assert page.count("<img ") == 2 and "error " in page and "hash " + run.hash in page
    assert run.lab._repr_png_().startswith(b"\x89PNG") and pickle.loads(pickle.dumps(run))._repr_html_().count("<img ") == 1


def test_the_version_is_in_the_metadata():
    assert importlib.metadata.version("hooke") == hooke.__version__
