"""Runs: the same bits as the command line, arrays, control, forces, interruption."""

import gc
import sys
import threading
import types

import numpy as np
import pytest

import hooke


@pytest.mark.parametrize("scene, seconds, options", [
    ("cloth", 0.5, {}),
    ("two_masses", 1.0, {"integrator": "runge_kutta4", "substeps": 7, "frame_rate": 50}),
    ("two_masses", 0.5, {"integrator": "dop853", "tolerance": 1e-7}),
    ("rope", 0.2, {"integrator": "implicit_euler"}),
])
def test_a_run_has_the_bits_of_the_command_line(scene, seconds, options, run_json):
    arguments = [text for name, value in options.items() for text in (f"--{name.replace('_', '-')}", str(value))]
    expected = run_json(scene, "--seconds", str(seconds), "--sample", "0.1", *arguments)
    run = hooke.load(scene).run(seconds, sample=0.1, **options)
    assert run.hash == expected["hash"] and run.force_evaluations == expected["force_evaluations"]
    assert run.time.tolist() == [sample["time"] for sample in expected["samples"]]
    assert run.positions.tolist() == [sample["positions"] for sample in expected["samples"]]
    assert run.velocities.tolist() == [sample["velocities"] for sample in expected["samples"]]
    assert run.energy.total.tolist() == [sample["energy"]["total"] for sample in expected["samples"]]
    errors = [sample["error"]["accumulated"] for sample in expected["samples"]]
    assert [None if np.isnan(error) else error for error in run.error] == errors


def test_the_energy_balance_adds_up():
    scene = hooke.load("cloth")
    lab = scene.run(0.5).lab
    balance = lab.energy_balance
    assert list(balance) == ["since", "change", "hand", "edits", "forces", "muscles", "colliders", "limits", "drag", "dashpots", "contact", "method"]
    parts = sum(joules for name, joules in balance.items() if name not in ("since", "change"))
    assert balance["since"] == 0 and np.isclose(balance["change"], parts, rtol=0, atol=1e-12)
    assert scene.run(0.1, accuracy="off").lab.energy_balance is None


def test_a_set_parameter_has_the_bits_of_the_command_line(run_json):
    scene = hooke.load("cloth")
    scene["stiffness"] = 200
    scene["drag"] = 0.1
    expected = run_json("cloth", "--seconds", "0.2", "--accuracy", "off", "--set", "stiffness=200", "--set", "drag=0.1")
    assert scene.run(0.2, accuracy="off").hash == expected["hash"]


def test_a_lab_has_the_bits_of_a_run():
    scene = hooke.load("cloth")
    lab = scene.lab()
    assert lab.step(12)
    assert lab.hash == scene.run(0.2, accuracy="off").hash


def test_samples_are_contiguous_arrays_of_double_precision():
    run = hooke.load("cloth").run(0.2, sample=1 / 60, accuracy="off")
    points = hooke.load("cloth").point_count
    for array in (run.positions, run.velocities):
        assert array.shape == (13, points, 3) and array.dtype == np.float64 and array.flags.c_contiguous
        # the memory that the run wrote to, of at most two samples more
        assert not array.flags.owndata and np.shares_memory(array, array.base) and len(array.base) <= 15
    assert np.allclose(np.diff(run.time), 1 / 60)
    positions, last = run.positions, run.positions[-1].copy()
    del run
    gc.collect()
    assert np.array_equal(positions[-1], last)


def test_chosen_points_are_sampled(run_json):
    run = hooke.load("cloth").run(0.1, sample=0.05, points=[5, 0], accuracy="off")
    expected = run_json("cloth", "--seconds", "0.1", "--sample", "0.05", "--points", "5,0", "--accuracy", "off")
    assert run.positions.tolist() == [sample["positions"] for sample in expected["samples"]] and run.hash == expected["hash"]


def test_the_state_of_a_lab_is_copied_once_and_does_not_change():
    lab = hooke.load("cloth").lab()
    start = lab.positions
    assert lab.positions is start and not start.flags.writeable and start.flags.c_contiguous and start.dtype == np.float64
    kept = start.copy()
    lab.step(3)
    after = lab.positions
    assert after is not start and np.array_equal(start, kept) and not np.array_equal(after, kept)
    expected = after.copy()
    lab.grab(0, after[0])
    del lab
    gc.collect()
    assert np.array_equal(after, expected)


def test_without_sample_only_the_last_state_is_kept():
    run = hooke.load("two_masses").run(0.5)
    assert run.positions.shape[0] == 1 and run.time[-1] == pytest.approx(0.5)


def test_a_run_does_not_change_its_scene():
    scene = hooke.load("cloth")
    before = scene.hash
    scene.run(0.1, accuracy="off")
    assert scene.hash == before


def test_written_files_are_those_of_the_command_line(command_line, tmp_path):
    ours, theirs = ({kind: tmp_path / f"{who}.{kind}" for kind in ("csv", "pc2")} for who in ("ours", "theirs"))
    hooke.load("two_masses").run(0.2, sample=0.1, csv=ours["csv"], pc2=ours["pc2"], quantities=["time", "y1"], json=tmp_path / "run.json")
    command_line("run", "two_masses", "--seconds", "0.2", "--sample", "0.1", "--csv", str(theirs["csv"]), "--pc2", str(theirs["pc2"]),
                 "--quantities", "time,y1")
    assert ours["csv"].read_bytes() == theirs["csv"].read_bytes() and ours["pc2"].read_bytes() == theirs["pc2"].read_bytes()
    assert '"hash"' in (tmp_path / "run.json").read_text()


def test_a_divergence_is_reported_as_on_the_command_line(command_line):
    scene = hooke.load("two_masses")
    options = {"integrator": "explicit_euler", "substeps": 1, "frame_rate": 2}
    with pytest.warns(hooke.HookeWarning):
        run = scene.run(60, accuracy="off", **options)
    printed = command_line("run", "two_masses", "--seconds", "60", "--integrator", "explicit_euler", "--substeps", "1", "--frame-rate", "2")
    assert run.diverged and printed.returncode == 4
    assert run.diagnosis + "\n" in printed.stderr
    assert np.isfinite(run.positions).all()


def test_a_frame_callback_controls_the_run_and_can_end_it():
    times = []

    def control(lab):
        times.append(lab.time)
        if len(times) == 1:
            lab.grab(1, target=lab.positions[1])
        lab.move_hand(lab.positions[1] + [0.01, 0, 0])
        return lab.time < 0.3 - 1e-9

    scene = hooke.load("two_masses")
    run = scene.run(2, on_frame=control, accuracy="off")
    assert run.seconds == pytest.approx(0.3) and len(times) == 19 and run.time.tolist() == times[-1:]
    assert run.positions[0, 1, 0] - scene.positions[1, 0] == pytest.approx(0.01 * 18)


def test_commands_of_a_lab_can_be_undone():
    scene = hooke.load("cloth")
    lab = scene.lab()
    lab["stiffness"] = 321.0
    assert lab["stiffness"] == 321 and "stiffness" in lab.history[0].lower()
    lab.undo()
    assert lab["stiffness"] == scene["stiffness"]
    lab.redo()
    assert lab["stiffness"] == 321
    lab.step(3)
    lab.go_to_start()
    assert lab.time == 0 and lab.scene()["stiffness"] == 321


def test_states_pass_in_and_out_as_arrays():
    lab = hooke.load("two_masses").lab()
    lab.step(5)
    other = hooke.load("two_masses").lab()
    other.set_state(lab.positions, lab.velocities)
    assert (other.positions == lab.positions).all() and (other.velocities == lab.velocities).all()


def test_a_force_in_python_moves_points_as_the_closed_form_says():
    # constant acceleration from rest: x = a t^2 / 2
    scene = hooke.Scene(gravity=(0, 0, 0), substeps=4)
    scene.add_points([[0, 0, 0], [1, 0, 0]], mass=[1, 2])
    scene.add_force(lambda time, positions, velocities: [[3, 0, 0], [0, 4, 0]])
    run = scene.run(1, accuracy="off")
    assert not run.diverged and run.warnings == []
    assert np.allclose(run.positions[-1], [[1.5, 0, 0], [1, 1, 0]])


def test_other_threads_go_on_during_a_run():
    steps = []

    def count(stop):
        while not stop.wait(0.001):
            steps.append(1)

    stop = threading.Event()
    thread = threading.Thread(target=count, args=(stop,))
    thread.start()
    hooke.load("cloth").run(2, accuracy="off")
    stop.set()
    thread.join()
    assert len(steps) > 5


def test_progress_is_shown_by_tqdm(monkeypatch):
    bars = []

    class Bar:
        def __init__(self, **options):
            self.n, self.total, self.is_closed = 0, None, False
            bars.append(self)

        def update(self, count):
            self.n += count

        def __enter__(self):
            return self

        def __exit__(self, *error):
            self.is_closed = True

    module = types.ModuleType("tqdm.auto")
    module.tqdm = Bar
    monkeypatch.setitem(sys.modules, "tqdm", types.ModuleType("tqdm"))
    monkeypatch.setitem(sys.modules, "tqdm.auto", module)
    hooke.load("two_masses").run(0.5, progress=True)
    assert [(bar.n, bar.total, bar.is_closed) for bar in bars] == [(30, 30, True)]
    hooke.load("two_masses").run(0.5, progress=False)
    assert len(bars) == 1


@pytest.mark.parametrize("options", [{}, {"integrator": "runge_kutta4"}, {"integrator": "symplectic_euler"},
                                     {"integrator": "dop853", "tolerance": 1e-8}])
def test_the_floor_carries_the_weight(options):
    scene = hooke.Scene(gravity=(0, -9.81, 0))
    scene.add_points([(0, 0.02, 0), (1, 0.02, 0), (2, 5, 0), (3, 0, 0)], mass=[1, 3, 1, 1], nailed=[False, False, False, True])
    scene.add_collider("plane", point=(0, 0, 0), normal=(0, 1, 0))
    lab = scene.lab(**options)
    assert not lab.contact_forces.any()
    lab.step(30)
    assert np.allclose(lab.contact_forces, [(0, 9.81, 0), (0, 29.43, 0), (0, 0, 0), (0, 0, 0)], rtol=1e-9, atol=1e-12)


def test_contact_between_points_changes_no_momentum():
    scene = hooke.Scene(gravity=(0, 0, 0))
    scene.add_points([(0, 0, 0), (1, 0, 0)], mass=[1, 2], velocity=[(6.5, 0, 0), (-6.5, 0, 0)], radius=0.1)
    scene["contact_points"] = True
    lab = scene.lab()
    while not lab.contact_forces.any():
        before = lab.velocities
        lab.step()
    assert np.allclose(lab.contact_forces / 60, (lab.velocities - before) * [[1], [2]], rtol=1e-9)
    assert np.allclose(lab.contact_forces.sum(axis=0), 0, atol=1e-9)
