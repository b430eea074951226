"""Errors: one line that names the argument, its value and the limit, with the text of the command line."""

import numpy as np
import pytest

import hooke

nan, inf = float("nan"), float("inf")


def pair() -> hooke.Scene:
    scene = hooke.Scene()
    scene.add_points([[0, 0, 0], [0, -1, 0]], mass=[1.0, 2.0], nailed=[True, False])
    scene.add_spring(0, 1, stiffness=100)
    return scene


def cloth(**fields) -> None:
    hooke.Scene().add_cloth(**{"corner": (0, 0, 0), "across": (1, 0, 0), "down": (0, -1, 0), "points": (3, 3), "mass": 0.2, "stiffness": 10,
                               **fields})


def set_item(name, value):
    return lambda: pair().__setitem__(name, value)


# (call, the beginning of the message, the end of it)
refused = [
    (lambda: hooke.load("clothe"), "clothe: no such file or shipped scene; did you mean cloth? All names: cloth, ", ""),
    (lambda: hooke.load("/tmp"), "/tmp: file: a folder: must be a regular file", ""),
    (lambda: hooke.load(b"\xff.json"), "\\xff.json: no such file", ""),
    (lambda: hooke.Scene(5), "dimensions: 5: must be", ""),
    (lambda: hooke.Scene(gravity=(0, nan, 0)), "gravity[1]: nan: must be a finite number", ""),
    (lambda: hooke.Scene(integrator="verlet"), '"verlet": must be one of', "; did you mean velocity_verlet?"),
    (lambda: hooke.Scene(substeps=0), "substeps: 0: must be", ""),
    (lambda: hooke.Scene(frame_rate=-1), "frame_rate: -1: must be more than 0", ""),
    (lambda: hooke.Scene.from_json("{"), "scene: line 1: unexpected end of the file", ""),
    (set_item("stiffness", -5), 'scene["stiffness"]: -5: must be from 0 to 1000000000000 [N/m]', ""),
    (set_item("stiffness", nan), 'scene["stiffness"]: nan: not a number: must be from 0 to', ""),
    (set_item("stiffness", np.array([1, 2])), 'scene["stiffness"]: [1 2]: not a number: must be', ""),
    (set_item("stifness", 1), 'scene["stifness"]: no such parameter: must be one of dimensions, ', "; did you mean stiffness?"),
    (lambda: pair()["stifness"], 'scene["stifness"]: no such parameter: ', "; did you mean stiffness?"),
    (lambda: pair().lab().__setitem__("drag", -1), 'lab["drag"]: -1: must be', ""),
    (lambda: hooke.load("cloth").lab().__setitem__("dimensions", 2), 'lab["dimensions"]: 2: point', ""),
    (lambda: pair().run(nan), "seconds: nan: must be a finite number", ""),
    (lambda: pair().run(inf), "seconds: inf: must be a finite number", ""),
    (lambda: pair().run(1, sample=0), "sample: 0: must be more than 0", ""),
    (lambda: pair().run(1, substeps=10**12), "substeps: 1000000000000: must be from 1 to 1000000", ""),
    (lambda: pair().run(1, substeps=10**30), "substeps: 1e+30: must be", ""),
    (lambda: pair().run(1, accuracy="ful"), "accuracy: ful: must be one of off, frame, full; did you mean full?", ""),
    (lambda: pair().run(1, quantities=["time"]), "quantities: requires csv", ""),
    (lambda: pair().run(1, csv="/tmp/a", json="/tmp/a"), "csv /tmp/a: is the file of json too", ""),
    (lambda: pair().run(1, points=[2]), "points: 2: must be the number of one of the 2 points, from 0", ""),
    (lambda: pair().run(1, csv="/nowhere/a.csv"), "/nowhere/a.csv: cannot be written: No such file", ""),
    (lambda: pair().lab(accuracy="all"), "accuracy: all: must be one of off, frame, full", ""),
    (lambda: pair().lab().step(-1), "frames: -1: must be at least 0", ""),
    (lambda: pair().lab().grab(5, (0, 0, 0)), "point: 5: must be the number of one of the 2 points, from 0", ""),
    (lambda: pair().lab().grab(1, (0, 0)), "target: shape (2,): must be (3,)", ""),
    (lambda: pair().lab().grab(1, (0, 0, nan)), "target: must be finite numbers", ""),
    (lambda: pair().lab().grab(1, (0, 0, 0), pull=-1), "pull: -1: must be at least 0", ""),
    (lambda: pair().lab().remove(springs=[1]), "spring: 1: must be the number of one of the 1 springs, from 0", ""),
    (lambda: pair().lab().set_state(np.zeros((3, 3)), np.zeros((2, 3))), "positions: shape (3, 3): must be (2, 3)", ""),
    (lambda: pair().lab().record("/nowhere/a.hookelog"), "/nowhere/a.hookelog: cannot be written: No such file", ""),
    (lambda: setattr(pair(), "positions", np.full((2, 3), inf)), "positions[0]: must be finite numbers", ""),
    (lambda: setattr(pair(), "masses", [1, inf]), "masses[1]: inf: must be a finite number", ""),
    (lambda: setattr(pair(), "masses", [1, 2, 3]), "masses: shape (3,): must be one number or (2,)", ""),
    (lambda: setattr(pair(), "nailed", [True]), "nailed: shape (1,): must be one value or (2,)", ""),
    (lambda: setattr(pair(), "stiffness", -1), "stiffness[0]: -1: must be at least 0", ""),
    (lambda: pair().add_point((0, 0)), "positions: shape (1, 2): must be (1, 3)", ""),
    (lambda: pair().add_points(np.zeros((2, 2, 3))), "positions: shape (2, 2, 3): must be (2, 3)", ""),
    (lambda: pair().add_points(np.zeros((2, 3)), mass=0), "mass[0]: 0: must be more than 0", ""),
    (lambda: pair().add_points(np.zeros((2, 3)), velocity=np.zeros((3, 3))), "velocity: shape (3, 3): must be (2, 3)", ""),
    (lambda: pair().add_points(np.zeros((2, 3)), nailed=[True] * 3), "nailed: shape (3,): must be one value or (2,)", ""),
    (lambda: pair().add_spring(0, 7), "points[0]: 7: must be the number of one of the 2 points", ""),
    (lambda: pair().add_spring(1, 1), "points[0]: must be two different points", ""),
    (lambda: pair().add_springs([0, 1, 1]), "points: shape (3,): must be (springs, 2)", ""),
    (lambda: pair().add_spring(0, 1, break_strain=-1), "break_strain[0]: -1: must be more than 0", ""),
    (lambda: cloth(points=(1, 3)), "add_cloth: points[0]: 1: must be a whole number from 2", ""),
    (lambda: cloth(stifness=10), "add_cloth: stifness: unknown field; did you mean stiffness?", ""),
    (lambda: cloth(corner=(0, 0, nan)), "add_cloth: corner[2]: nan: must be a finite number", ""),
    (lambda: cloth(nail=["top_lef"]), 'add_cloth: nail[0]: "top_lef": must be a point number or one of top, ', ""),
    (lambda: hooke.Scene().add_cloth(corner=(0, 0, 0)), "add_cloth: across: missing: must be [x, y, z]", ""),
    (lambda: pair().add_shape("cloht"), 'add_shape: type: "cloht": must be one of cloth, ', "; did you mean cloth?"),
    (lambda: pair().add_collider("sphere", center=(0, 0, 0), radius=-1), "add_collider: radius: -1: must be more than 0", ""),
    (lambda: pair().add_force("wimd"), 'add_force: type: "wimd": must be one of wind, ', "; did you mean wind?"),
    (lambda: pair().save("x.foo"), 'x.foo: file format: ".foo": must be', ""),
    (lambda: pair().save("/nowhere/x.json"), "/nowhere/x.json: cannot be written: No such file", ""),
    (lambda: pair().bench("verlet"), "methods: verlet: no such method: must be one of ", "; did you mean velocity_verlet?"),
    (lambda: pair().bench(tolerance_range=(0, 1)), "tolerance_range: 0: must be more than 0", ""),
    (lambda: pair().bench(tolerance_range=1e-3), "tolerance_range: shape (): must be (2,)", ""),
    (lambda: pair().bench(shard="3/2"), "shard: 3/2: must be I/N", ""),
    (lambda: hooke.check_hard(99), "cases: 99: no such case", ""),
    (lambda: hooke.check_hard(1, threads=-1), "threads: -1: must be from 1 to 256", ""),
    (lambda: hooke.convert("two_masses", "a.foo"), "a.foo: must end in .json", ""),
    (lambda: hooke.replay("nowhere.hookelog"), "nowhere.hookelog: cannot be opened: No such file", ""),
    (lambda: pair().capture("a.jpg"), "out: a.jpg: must end in .png, .mp4, .webp or .gif", ""),
    (lambda: pair().capture("a.png", size=(0, 10)), "size: 0x10: must be WIDTHxHEIGHT, each from 1 to 8192", ""),
    (lambda: pair().capture("a.png", size=(64, 40), ui=True), "size: 64x40: must be at least 320x180 with panels of this scale", ""),
    (lambda: pair().capture("a.png", camera=(0, 0)), "camera: 0.0,0.0: must be six numbers", ""),
    (lambda: pair().capture("a.png", frames=2, seconds=1), "frames: excludes seconds", ""),
    (lambda: pair().capture("a.png", fps=1000), "fps: 1000: must be at most the frame rate of the scene, 60", ""),
    (lambda: pair().capture("a.png", fail_above=0), "fail_above: 0: must be more than 0", ""),
    (lambda: pair().sweep({}, "max_strain", 1), "vary: must not be empty", ""),
    (lambda: pair().sweep({"stiffness": [1]}, "total", 1, processes=10**9), "processes: 1000000000: must be from 1 to 256", ""),
    (lambda: hooke.merge_benches([], "/tmp"), "folders: must not be empty", ""),
    (lambda: pair().run(10**400), "seconds: 1000000000", "...: must be a finite number"),
    (lambda: pair().run(1, substeps=10**400), "substeps: 1000000000", "...: must be less than 2^53"),
    (lambda: pair().run(1, substeps=10**5000), "substeps: <int>: must be less than 2^53", ""),
    (lambda: pair().run(1, integrator="\ud800"), "integrator: '\\ud800': must be text in Unicode", ""),
    (lambda: pair().sweep({"stiffness": "\ud800"}, "total", 1), "vary: 'stiffness=\\ud800': must be text in Unicode", ""),
    (lambda: pair().run(1, json="a.json\0.png"), "json: 'a.json\\x00.png': must be without null characters", ""),
    (lambda: pair().run(1, points=[[0, 1]]), "points: shape (1, 2): must be one number or a list of numbers", ""),
    (lambda: pair().run(1, points=np.uint64([2**64 - 1])), "points: 18446744073709551615: must be less than 2^31", ""),
    (lambda: hooke.check_hard(2**40), "cases: 1099511627776: must be less than 2^31", ""),
    (lambda: setattr(pair(), "fixed", "xy"), "fixed: 1 values: must be 2", ""),
    (lambda: hooke.load("x" * 200000 + ".json"), "xxx...xxx", ".json: no such file"),
    (lambda: pair().sweep({"stifness": [1]}, "max_strain", 1), "vary: stifness=1: no such parameter: ", "; did you mean stiffness?"),
    (lambda: pair().sweep({"stiffness": [1, nan]}, "max_strain", 1), "vary: stiffness=1.0,nan: nan: not a number: must be", ""),
    (lambda: pair().sweep({"stiffness": [1]}, "speed", 1), "measure: speed: must be one of ", ""),
]


@pytest.mark.parametrize("call, beginning, end", refused, ids=[beginning[:40] for _, beginning, _ in refused])
def test_a_refused_value_is_named_with_its_limit(call, beginning, end):
    with pytest.raises(hooke.Error) as error:
        call()
    message = str(error.value)
    assert beginning in message and message.endswith(end) and "\n" not in message and "--" not in message


@pytest.mark.parametrize("call, message", [
    (lambda: hooke.load(5), "name: 5: must be the path of a file"),
    (lambda: hooke.Scene("x"), "dimensions: 'x': must be a whole number"),
    (lambda: hooke.Scene(gravity="abc"), "gravity: 'abc': must be numbers"),
    (lambda: hooke.Scene(name=5), "name: 5: must be a string"),
    (lambda: pair()[0], "name of a parameter: 0: must be a string"),
    (lambda: list(pair()), "'Scene' object is not iterable"),
    (lambda: pair().run("abc"), "seconds: 'abc': must be a number"),
    (lambda: pair().run(None), "seconds: None: must be a number"),
    (lambda: pair().run(np.array([1, 2])), r"seconds: array([1, 2]): must be a number"),
    (lambda: pair().run(1, integrator=5), "integrator: 5: must be a string"),
    (lambda: pair().run(1, substeps=1.5), "substeps: 1.5: must be a whole number"),
    (lambda: pair().run(1, substeps="4"), "substeps: '4': must be a whole number"),
    (lambda: pair().run(1, on_frame=5), "on_frame: 5: must be a function"),
    (lambda: pair().run(1, steps=5), "unexpected keyword argument 'steps'"),
    (lambda: pair().lab().step("a"), "frames: 'a': must be a whole number"),
    (lambda: pair().lab().grab(1.5, (0, 0, 0)), "point: 1.5: must be a whole number"),
    (lambda: pair().lab().move_hand("abc"), "target: 'abc': must be numbers"),
    (lambda: pair().lab().nail([0.5]), "points: [0.5]: must be whole numbers"),
    (lambda: pair().lab().set_state(np.zeros((2, 3)) * 1j, np.zeros((2, 3))), "positions: array([[0.+0.j"),
    (lambda: setattr(pair(), "positions", [[1, 2], [3]]), "positions: [[1, 2], [3]]: must be numbers"),
    (lambda: setattr(pair(), "masses", None), "masses: None: must be numbers"),
    (lambda: setattr(pair(), "nailed", "ab"), "nailed: 'ab': must be True or False"),
    (lambda: pair().add_spring(0, 0.5), "points: [(0, 0.5)]: must be whole numbers"),
    (lambda: cloth(corner={1}), "corner: {1}: must be a number, a string or a list"),
    (lambda: pair().bench(5), "methods: 5: must be a list of strings"),
    (lambda: pair().capture("a.png", size=(10.5, 10)), "size: (10.5, 10): must be whole numbers"),
    (lambda: pair().capture("a.png", fps="x"), "fps: 'x': must be a number"),
    (lambda: pair().run([[1], [1, 2]]), "seconds: [[1], [1, 2]]: must be a number"),
    (lambda: pair().run(1, on_frame=np.zeros((2, 2))), "on_frame: array([[0., 0.], [0., 0.]]): must be a function"),
    (lambda: hooke.load("\ud800"), "name: '\\ud800': must be the path of a file"),
    (lambda: setattr(pair(), "fixed", [0, 1]), "fixed: [0, 1]: must be a list of strings"),
    (lambda: setattr(pair(), "laws", ["cable"]), "laws[0]: 'cable': must be a dictionary"),
    (lambda: pair().sweep("stiffness", "total", 1), "vary: 'stiffness': must be a dictionary"),
    (lambda: pair().sweep({"stiffness": [[1], [1, 2]]}, "total", 1), "vary: stiffness: [[1], [1, 2]]: must be numbers or words"),
    (lambda: pair().lab().nail([0, 1], [True, False]), "nailed: [True, False]: must be True or False"),
    (lambda: pair().capture("a.png", ui="no"), "ui: 'no': must be True or False"),
    (lambda: pair().add_shape(np.ma.array([1, 2])), "type: masked_array"),
    (lambda: pair().capture("a.png", colour=1), "unexpected keyword argument 'colour'"),
])
def test_a_value_of_the_wrong_type_is_named(call, message):
    with pytest.raises(TypeError) as error:
        call()
    assert message in str(error.value) and "\n" not in str(error.value)


@pytest.mark.parametrize("options, arguments", [
    ({"substeps": 0}, ["--substeps", "0"]), ({"integrator": "euler"}, ["--integrator", "euler"]),
    ({"tolerance": 1e-6, "integrator": "xpbd"}, ["--tolerance", "1e-06", "--integrator", "xpbd"]),
    ({"frame_rate": -1}, ["--frame-rate", "-1"]), ({"sample": 0}, ["--sample", "0"]),
    ({"csv": "-", "quantities": ["tyme"]}, ["--csv", "-", "--quantities", "tyme"]),
])
def test_options_are_refused_with_the_text_of_the_command_line(options, arguments, refusal):
    with pytest.raises(hooke.UsageError) as error:
        hooke.load("two_masses").run(0.1, **options)
    assert str(error.value) == refusal("run", "two_masses", "--seconds", "0.1", *arguments)


@pytest.mark.parametrize("setting", ["stiffness=-5", "substeps=1.5", "gravity=1e9", "reading=x"])
def test_a_refused_parameter_has_the_text_of_the_command_line(setting, refusal):
    name, value = setting.split("=")
    with pytest.raises(hooke.UsageError) as error:
        hooke.load("cloth")[name] = value
    assert str(error.value) == refusal("run", "cloth", "--seconds", "0", "--set", setting).replace(f"set: {setting}", f'scene["{name}"]: {value}')


def test_invalid_files_are_refused_with_the_line_of_the_command_line(refusal, tmp_path):
    file = tmp_path / "bad.json"
    file.write_text('{"hooke": 1, "points": [{"position": [0, 0, 0], "mass": -1}]}')
    for name, kind in ((file, hooke.InputError), ("nowhere.json", hooke.FileError)):
        with pytest.raises(kind) as error:
            hooke.load(name)
        assert str(error.value) == refusal("run", str(name), "--seconds", "0")
        assert isinstance(error.value, OSError if kind is hooke.FileError else ValueError)


def test_a_run_does_not_replace_its_scene(tmp_path):
    file = tmp_path / "scene.json"
    pair().save(file)
    before = file.read_bytes()
    for option in ("json", "csv", "pc2"):
        with pytest.raises(hooke.UsageError, match=f"{option} .*scene.json: would replace the scene"):
            hooke.load(file).run(0.1, **{option: file})
    assert file.read_bytes() == before


def test_refused_parts_change_nothing():
    scene = pair()
    before = scene.to_json()
    for change in (lambda: scene.add_point((0, 0, 0), mass=-1), lambda: scene.add_spring(0, 7), lambda: scene.add_cloth(points=(2, 2)),
                   lambda: setattr(scene, "positions", np.zeros((3, 3))), lambda: scene.add_force("wind", nothing=1)):
        with pytest.raises(hooke.InputError):
            change()
        assert scene.to_json() == before


def test_a_misspelled_attribute_is_refused():
    for thing in (pair(), pair().lab()):
        with pytest.raises(AttributeError):
            thing.stifness = 5
    assert "stiffness" in pair() and "stifness" not in pair()


def test_any_array_of_numbers_is_accepted():
    points = np.asfortranarray(np.arange(12, dtype=np.float32).reshape(4, 3))[::2]
    scene = hooke.Scene()
    assert scene.add_points(points) == range(2) and scene.positions.tolist() == points.tolist()
    assert scene.add_points([]) == range(2, 2) and scene.add_points(np.zeros((0, 3))) == range(2, 2) and scene.add_springs([]) == range(0)
    assert scene.run(0, substeps=np.int64(4), frame_rate=np.float32(30)).positions.shape == (1, 2, 3)
