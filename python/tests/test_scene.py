"""Scenes: loading, building, properties, messages."""

import copy
import pickle

import numpy as np
import pytest

import hooke


def hanging_pair() -> hooke.Scene:
    scene = hooke.Scene()
    scene.add_points([[0, 0, 0], [0, -1, 0]], mass=[1.0, 2.0], nailed=[True, False])
    scene.add_spring(0, 1, stiffness=100)
    return scene


def test_a_built_scene_moves_as_the_closed_form_says():
    # x'' = g - k/m x from rest at the rest length: x(t) = m g / k (1 - cos(omega t))
    scene = hanging_pair()
    run = scene.run(1.0, sample=0.1, substeps=400, accuracy="off")
    omega, sag = np.sqrt(100 / 2), 2 * 9.81 / 100
    assert np.allclose(run.positions[:, 1, 1], -1 - sag * (1 - np.cos(omega * run.time)), atol=1e-5)


def test_shapes_of_the_table_have_methods_with_the_result_of_a_scene_file():
    built = hooke.Scene()
    points = built.add_cloth(corner=(0, 0, 0), across=(1, 0, 0), down=(0, -1, 0), points=(8, 8), mass=0.2, stiffness=1000,
                             nail=["top_left", "top_right"])
    assert points == range(64) and built.nailed.sum() == 2
    text = built.to_json()
    assert '"generators"' in text and '"points": [{' not in text
    read = hooke.Scene.from_json(text)
    assert read.run(0.2, accuracy="off").hash == built.run(0.2, accuracy="off").hash
    for row in hooke.shapes():
        assert row["description"] in getattr(hooke.Scene, f"add_{row['id']}").__doc__
    assert "mass_model: equal | tributary, default tributary" in hooke.Scene.add_cloth.__doc__
    assert "across: [x, y, z]" in hooke.Scene.add_cloth.__doc__ and "stiffness: [N/m]" in hooke.Scene.add_cloth.__doc__


def test_parts_are_added_after_the_present_ones():
    scene = hanging_pair()
    rope = scene.add_rope(**{"from": (0, 0, 1), "to": (1, 0, 1)}, points=4, mass=0.1, stiffness=100)
    cloth = scene.add_cloth(corner=(0, 0, 2), across=(1, 0, 0), down=(0, -1, 0), points=(3, 3), mass=0.2, stiffness=10)
    assert (rope, cloth) == (range(2, 6), range(6, 15))
    joining = scene.add_springs([(1, 2), (5, 6)], stiffness=[1, 2], rest_length=0.5)
    assert scene.springs[joining.start].tolist() == [1, 2] and scene.rest_length[joining.stop - 1] == 0.5
    scene.add_collider("sphere", center=(0, -3, 0), radius=0.5)
    assert hooke.Scene.from_json(scene.to_json()).hash == scene.hash


def test_loads_and_rollers_are_properties_of_points():
    scene = hooke.Scene(gravity=(0, 0, 0))
    scene.add_points([[0, 0, 0], [1, 0, 0]], nailed=[True, False])
    scene.add_spring(0, 1, stiffness=50)
    scene.loads = [[0, 0, 0], [2, -3, 0]]
    scene.fixed = ["", "y"]
    assert scene.loads.tolist() == [[0, 0, 0], [2, -3, 0]] and scene.fixed == ["", "y"]
    run = scene.run(0.5, sample=0.1, substeps=400, accuracy="off")
    assert np.allclose(run.positions[:, 1], [[1 + 2 / 50 * (1 - np.cos(np.sqrt(50) * t)), 0, 0] for t in run.time], atol=1e-5)
    assert hooke.Scene.from_json(scene.to_json()).run(0.5, accuracy="off").hash == scene.run(0.5, accuracy="off").hash
    with pytest.raises(hooke.InputError, match="^fixed\\[1\\]: up: must be axes"):
        scene.fixed = ["", "up"]
    with pytest.raises(hooke.InputError, match="^loads: "):
        scene.loads = [[1, 2, 3]]


def test_properties_are_arrays_that_can_be_assigned():
    scene = hanging_pair()
    assert scene.positions.shape == (2, 3) and scene.positions.dtype == np.float64 and scene.positions.flags.c_contiguous
    for name in ("positions", "velocities", "masses", "nailed", "stiffness", "springs", "faces"):
        with pytest.raises(ValueError, match="read-only"):
            getattr(scene, name)[...] = 0
    scene.positions = scene.positions + [1, 0, 0]
    scene.velocities = np.ones((2, 3))
    scene.masses = 3
    scene.stiffness = [50]
    assert scene.positions[1].tolist() == [1, -1, 0] and scene.velocities[1, 2] == 1
    assert scene.masses.tolist() == [3, 3] and scene["stiffness"] == 50
    scene.nailed = [False, True]
    assert scene.nailed.tolist() == [False, True]


def test_a_copy_is_independent():
    scene = hanging_pair()
    other = scene.copy()
    other["stiffness"] = 7
    assert scene["stiffness"] == 100


def test_every_parameter_is_in_the_help_with_its_unit_and_range():
    for row in hooke.parameters():
        assert f"    {row['name']}: " in hooke.Scene.__doc__ or hooke.Scene.__doc__.find(row["name"] + ": ") > 0
        assert row["description"] in hooke.Scene.__doc__
        if row["unit"] and row["kind"] in ("number", "integer"):
            assert f"{row['max']:g} [{row['unit']}]" in hooke.Scene.__doc__


def test_copies_and_pickles_are_independent_scenes():
    scene = hanging_pair()
    for other in (copy.copy(scene), copy.deepcopy(scene), pickle.loads(pickle.dumps(scene))):
        assert other.hash == scene.hash and other.to_json() == scene.to_json()
        other["stiffness"] = 7
        assert scene["stiffness"] == 100


def test_points_of_a_flat_scene_stay_in_the_plane():
    scene = hooke.Scene(2)
    with pytest.raises(hooke.InputError, match="must be 0 in a 2-D scene"):
        scene.add_point((0, 0, 1))


def test_save_and_load_keep_every_bit(tmp_path):
    scene = hooke.load("cloth")
    scene["stiffness"] = 123.456
    scene.save(tmp_path / "scene.json")
    assert hooke.load(tmp_path / "scene.json").run(0.1, accuracy="off").hash == scene.run(0.1, accuracy="off").hash


def test_shipped_scenes_are_listed():
    assert {"cloth", "two_masses"} <= {row["id"] for row in hooke.scenes()}


def test_laws_are_those_of_scene_files_and_bad_ones_are_refused_by_field():
    scene = hanging_pair()
    for law in ({"law": "cable"}, {"law": "cubic", "k3": -1e9}, {"muscle": {"amplitude": 0.2, "frequency": 2, "phase": 0}}, None):
        scene.laws = [law]
        assert scene.laws == [law]
    for bad, message in (({"law": "rope"}, 'laws\\[0\\].law: "rope": must be'), ({"law": "cubic", "k3": np.inf}, r"laws\[0\].k3: inf: must be a finite"),
                         ({"law": "strut", "k3": 3}, r"laws\[0\].k3: must be 0 unless"),
                         ({"rest_length_rate": 1, "rest_length_limits": [2, 3]}, r"laws\[0\].rest_length_limits: must contain")):
        with pytest.raises(hooke.InputError, match=message):
            scene.laws = [bad]
