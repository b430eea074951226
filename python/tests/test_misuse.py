"""Threads, functions that raise or call back, interrupts: nothing crashes, hangs or goes wrong in silence."""

import gc
import os
import pathlib
import signal
import subprocess
import sys
import threading
import time
import weakref

import numpy as np
import pytest

import hooke


def falling_point() -> hooke.Scene:
    scene = hooke.Scene()
    scene.add_point((0, 0, 0))
    return scene


def test_threads_that_step_the_same_lab_take_turns():
    lab = hooke.load("cloth").lab()
    threads = [threading.Thread(target=lambda: [lab.step(5) for _ in range(4)]) for _ in range(3)]
    for thread in threads:
        thread.start()
    while any(thread.is_alive() for thread in threads):
        assert np.isfinite(lab.positions).all() and np.isfinite(lab.energy["total"])
    expected = hooke.load("cloth").lab()
    expected.step(60)
    assert lab.hash == expected.hash


def test_threads_that_draw_take_turns(tmp_path):
    def draw(number):
        hooke.load("two_masses").capture(tmp_path / f"{number}.png", size=(320, 180), frames=3, ui=number % 2 == 0)

    threads = [threading.Thread(target=draw, args=(number,)) for number in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    pictures = [(tmp_path / f"{number}.png").read_bytes() for number in range(4)]
    assert pictures[0] == pictures[2] and pictures[1] == pictures[3]
    draw(4)
    assert (tmp_path / "4.png").read_bytes() == pictures[0]


def test_a_force_cannot_draw_while_its_scene_is_drawn(tmp_path):
    scene = falling_point()
    scene.add_force(lambda time, positions, velocities: hooke.load("two_masses").capture(tmp_path / "other.png"))
    with pytest.raises(hooke.UsageError, match="capture: is drawing"):
        scene.capture(tmp_path / "a.png", seconds=1, size=(64, 40))


def test_a_scene_can_be_changed_and_deleted_while_it_runs():
    scene = hooke.load("cloth")
    expected = scene.run(0.5, accuracy="off").hash
    hashes = []
    thread = threading.Thread(target=lambda run: hashes.append(run(0.5, accuracy="off").hash), args=(scene.run,))
    thread.start()
    scene["stiffness"] = 1
    del scene
    gc.collect()
    thread.join()
    assert hashes[0] in (expected, hooke.load("cloth").run(0.5, accuracy="off").hash)


def test_an_error_in_a_function_ends_the_run_and_is_raised():
    scene = falling_point()
    scene.add_force(lambda time, positions, velocities: 1 / 0)
    for call in (lambda: scene.run(1, accuracy="off"), lambda: scene.run(1), lambda: scene.lab().step(), lambda: scene.capture("a.png", seconds=1),
                 lambda: scene.bench("velocity_verlet", quick=True), lambda: scene.sweep({"substeps": [1]}, "time", 1)):
        with pytest.raises(ZeroDivisionError):
            call()
    with pytest.raises(ZeroDivisionError):
        hooke.load("two_masses").run(1, on_frame=lambda lab: 1 / 0)


def test_a_lab_goes_on_after_an_error_in_a_force():
    scene = falling_point()
    fails = [False]
    scene.add_force(lambda time, positions, velocities: 1 / 0 if fails[0] else np.zeros((1, 3)))
    lab = scene.lab()
    lab.step(2)
    fails[0] = True
    before = lab.hash
    with pytest.raises(ZeroDivisionError):
        lab.step()
    assert lab.hash == before
    fails[0] = False
    lab.step()
    without_error = falling_point()
    without_error.add_force(lambda time, positions, velocities: np.zeros((1, 3)))
    expected = without_error.lab()
    expected.step(3)
    assert np.array_equal(lab.positions, expected.positions)


@pytest.mark.parametrize("forces, message", [
    (np.zeros(3), "forces: shape (3,): must be (1, 3)"), ("abc", "forces: 'abc': must be numbers"), (None, "forces: None: must be numbers"),
    ([[float("nan"), 0, 0]], "forces[0]: must be finite numbers"), ([[1j, 0, 0]], "forces: [[1j, 0, 0]]: must be numbers"),
])
def test_a_force_of_the_wrong_kind_is_refused(forces, message):
    scene = falling_point()
    scene.add_force(lambda time, positions, velocities: forces)
    with pytest.raises((hooke.InputError, TypeError)) as error:
        scene.run(1, accuracy="off")
    assert str(error.value) == message


def test_a_force_cannot_use_the_lab_that_calls_it():
    scene = falling_point()
    scene.add_force(lambda time, positions, velocities: lab.positions)
    lab = scene.lab()
    with pytest.raises(hooke.UsageError, match="lab: is computing a frame"):
        lab.step()


def test_the_function_of_a_frame_cannot_step_the_run():
    with pytest.raises(hooke.UsageError, match="step: not allowed in on_frame"):
        hooke.load("two_masses").run(1, on_frame=lambda lab: lab.step())


def test_a_numpy_value_that_is_false_ends_a_run():
    run = hooke.load("two_masses").run(1, on_frame=lambda lab: np.float64(lab.time) < 0.1, accuracy="off")
    assert run.seconds == pytest.approx(0.1)


def test_the_function_of_a_force_is_released_with_its_scene():
    class Force:
        def __call__(self, time, positions, velocities):
            return np.zeros((1, 3))

    scene, force = falling_point(), Force()
    scene.add_force(force)
    alive = weakref.ref(force)
    del force
    lab = scene.copy().lab()
    del scene
    gc.collect()
    assert alive() is not None and lab.step()
    del lab
    gc.collect()
    assert alive() is None


def test_huge_requests_are_refused_at_once():
    with pytest.raises(MemoryError):
        hooke.load("cloth").run(1e9, sample=1 / 60)
    hooke.load("two_masses").run(1e12, on_frame=lambda lab: False)


# Each of these takes minutes.
long_calls = {
    "run": 'hooke.load("cloth").run(1e6, accuracy="off")',
    "a frame": 'hooke.load("cloth").lab(substeps=1000000).step()',
    "run of long frames": 'hooke.load("cloth").run(1, substeps=1000000)',
    "bench": 'hooke.load("cloth").bench()',
    "check": 'hooke.check()',
    "hard cases": 'hooke.check_hard()',
    "capture": 'hooke.load("cloth").capture("a.png", seconds=1000)',
    "sweep": 'hooke.load("cloth").sweep({"stiffness": "1:100:lin:100"}, "max_strain", 100)',
}


@pytest.mark.parametrize("call", long_calls.values(), ids=long_calls.keys())
def test_a_long_call_stops_on_an_interrupt_as_in_a_terminal(call, tmp_path):
    script = f"import hooke\nprint('ready', flush=True)\ntry:\n    {call}\nexcept KeyboardInterrupt:\n    print('stopped')\n"
    process = subprocess.Popen([sys.executable, "-B", "-c", script], stdout=subprocess.PIPE, text=True, cwd=tmp_path,
                               env={**os.environ, "PYTHONPATH": str(pathlib.Path(hooke.__file__).parents[1])})
    assert process.stdout.readline() == "ready\n"
    time.sleep(0.3)
    process.send_signal(signal.SIGINT)
    try:
        assert process.communicate(timeout=60)[0] == "stopped\n" and process.returncode == 0
    finally:
        process.kill()
