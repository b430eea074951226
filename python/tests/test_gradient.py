"""Sensitivities of runs: against finite differences, and what has none."""

import json

import numpy as np
import pytest

import hooke

# of each parameter, the part of its size by which finite differences move it: what rounding and the curvature of stiff scenes allow
SMALL = {"stiffness": 1e-3, "rest_length": 3e-7, "damping": 3e-3, "masses": 1e-4, "positions": 1e-7, "velocities": 1e-5}
NAMES = list(SMALL)
SCENES = ["spring_pendulum", "three_masses", "grid_4x4", "how_wrong", "heavy_on_light", "damping_ratios", "catenary", "rope_64",
          "normal_modes", "cloth_32"]


def scene_with_everything(name):
    """A shipped scene with dashpots, drag, wind and a kick, so that no derivative is zero by symmetry."""
    scene, random = hooke.load(name), np.random.default_rng(1)
    flat = np.array([1, 1, 0 if scene.dimensions == 2 else 1])
    document = json.loads(scene.to_json())
    scene = hooke.Scene.from_json(json.dumps({**document, "wind": [0.5, 0.2, 0]}))
    scene["drag"] = 0.3
    scene.damping = 0.02 * np.sqrt(scene.stiffness * scene.masses.min()) * random.uniform(0.5, 1.5, scene.spring_count)
    scene.velocities = scene.velocities + 0.1 * random.normal(size=(scene.point_count, 3)) * flat
    return scene, random, flat


def difference(scene, name, direction, weights, options):
    """The derivative of the weighted sum along a direction, by central differences of fourth order."""

    def value(steps):
        moved = scene.copy()
        setattr(moved, name, getattr(scene, name) + steps * direction)
        run = moved.run(accuracy="off", **options)
        return np.sum(weights[0] * run.positions) + np.sum(weights[1] * run.velocities)

    return (8 * (value(1) - value(-1)) - (value(2) - value(-2))) / 12


@pytest.mark.parametrize("name", SCENES)
@pytest.mark.parametrize("method", ["velocity_verlet", "runge_kutta4"])
@pytest.mark.filterwarnings("ignore::hooke.HookeWarning")
def test_gradients_are_finite_differences_to_a_millionth(name, method):
    scene, random, flat = scene_with_everything(name)
    options = {"seconds": 6 / scene.frame_rate, "sample": 2 / scene.frame_rate, "integrator": method, "substeps": max(20, scene.substeps)}
    run = scene.run(accuracy="off", **options)
    weights = random.normal(size=run.positions.shape), 0.1 * random.normal(size=run.positions.shape)
    gradients = run.gradient(weights, NAMES)
    nails = scene.nailed
    for of in NAMES:
        value = getattr(scene, of)
        assert gradients[of].shape == value.shape
        if of in ("positions", "velocities"):
            direction = random.normal(size=value.shape) * flat * (~nails[:, None] if of == "velocities" else 1)
        else:
            direction = random.uniform(-1, 1, value.shape) * value
        direction *= SMALL[of] * (np.ptp(scene.positions) if of == "positions" else 1)
        exact, measured = np.sum(gradients[of] * direction), difference(scene, of, direction, weights, options)
        assert exact == pytest.approx(measured, rel=1e-6, abs=1e-6 * np.linalg.norm(gradients[of] * direction)), of


def test_what_has_no_gradient_is_refused_by_name():
    def refused(scene, because, **options):
        run = scene.run(0.5, sample=0.1, accuracy="off", **options)
        with pytest.raises(hooke.InputError, match=because):
            run.gradient(np.ones_like(run.positions), "stiffness")

    def pendulum():
        scene = hooke.Scene()
        scene.add_points([(0, 0, 0), (0, -1, 0)], nailed=[True, False])
        scene.add_spring(0, 1, stiffness=50)
        return scene

    refused(pendulum(), "^integrator: dop853: gradients are of velocity_verlet", integrator="dop853")
    floor, far_floor = pendulum(), pendulum()
    floor.add_collider("plane", point=(0, -1.1, 0), normal=(0, 1, 0))
    refused(floor, "^contact: something touches before 0[.].* s: gradients are of springs")
    far_floor.add_collider("plane", point=(0, -9, 0), normal=(0, 1, 0))
    run = far_floor.run(0.5, sample=0.1, accuracy="off")
    assert run.gradient(np.ones_like(run.positions), "stiffness")[0] != 0
    rail = pendulum()
    rail.fixed = ["", "x"]
    refused(rail, "^points: fixed: gradients are of")
    breaks, limited, law, wind = pendulum(), pendulum(), pendulum(), pendulum()
    breaks["break_strain"] = 0.05
    refused(breaks, "^break_strain: a spring breaks before")
    limited["strain_limit_percent"] = 5
    refused(limited, "^strain_limit: ")
    law.laws = [{"law": "cable"}]
    refused(law, "^laws of springs: ")
    wind.add_force(lambda time, positions, velocities: -velocities)
    refused(wind, "^forces: ")
    refused(pendulum(), "on_frame", on_frame=lambda lab: lab.nail(1) if lab.time == 0 else None)


def test_arguments_are_checked():
    run = hooke.load("spring_pendulum").run(0.1, sample=0.05, accuracy="off", points=[1])
    with pytest.raises(hooke.InputError, match=r"of positions: shape \(3,\): must be \(3, 1, 3\)"):
        run.gradient([1, 2, 3], "stiffness")
    with pytest.raises(KeyError, match="with_respect_to: stifness: must be one of stiffness, rest_length"):
        run.gradient(np.ones_like(run.positions), "stifness")
    everything = hooke.load("spring_pendulum").run(0.1, sample=0.05, accuracy="off")
    weights = np.zeros_like(everything.positions)
    weights[:, [1]] = 1
    assert run.gradient(np.ones_like(run.positions), "masses").tolist() == everything.gradient(weights, "masses").tolist()
