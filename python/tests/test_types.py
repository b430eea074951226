"""The package and a program that uses it have consistent types: mypy --strict."""

import pathlib
import subprocess

import hooke
from make_shapes import stub

program = """
import numpy as np

import hooke


def control(lab: hooke.Lab) -> bool:
    lab.move_hand(lab.positions[0] + [0.0, 0.0, 0.01])
    return lab.time < 1.0


scene = hooke.load("cloth")
scene.add_cloth(corner=(0, 0, 0), across=(1, 0, 0), down=(0, -1, 0), points=(32, 32), mass=0.2, stiffness=1000, nail=["top_left"])
scene["stiffness"] = 200
scene.masses = 0.5
scene.nailed = np.zeros(scene.point_count, dtype=bool)
scene.add_force(lambda time, positions, velocities: -0.1 * velocities)
run = scene.run(seconds=2, integrator="velocity_verlet", substeps=40, sample=1 / 60, on_frame=control)
total = float(run.energy.total[-1] + run.error[-1] + run.time[-1])
diagnosis: str | None = run.diagnosis
lab = scene.lab()
lab.grab(0, target=(0, 0, 1))
is_valid: bool = lab.step()
dimensions: int = scene["dimensions"]
chart = scene.bench(methods=["velocity_verlet"], tolerance_range=(1e-2, 1e-8))
chart.plot()
table = scene.sweep({"stiffness": np.logspace(2, 3, 4), "substeps": [8, 16]}, "max_strain", 1.0)
table["max_strain"].mean()
rows: list[dict[str, object]] = list(table)
forces = float(lab.tension.sum() + lab.reactions.sum())
slopes = run.gradient(2 * run.positions, "stiffness").sum() + run.gradient((None, run.velocities), ["masses"])["masses"].sum()

# mistakes that are found: an error code that does not apply would be an error
scene.run(seconds="2")  # type: ignore[arg-type]
scene.add_clothe()  # type: ignore[attr-defined]
scene.add_cloth(foo=1)  # type: ignore[call-arg]
word: str = lab["dimensions"]  # type: ignore[assignment]
scene.add_point((0, 0, 0), weight=1)  # type: ignore[call-arg]
scene.add_force("wind", x=3, gusts=0.5, on=True)
scene.add_force("wimd")  # type: ignore[call-overload]
scene.add_force("wind", xx=3)  # type: ignore[call-overload]
scene.add_force("wind", x="3")  # type: ignore[call-overload]
scene.add_force("bending", rest="bent")  # type: ignore[call-overload]
scene.add_force(lambda time: 0)  # type: ignore[arg-type,misc]
scene.add_collider("plane", point=(0, 0, 0), normal=(0, 1, 0), friction=0.5)
scene.add_collider("cube", min=(0, 0, 0), max=(1, 1, 1))  # type: ignore[call-overload]
scene.add_collider("sphere", center=(0, 0, 0))  # type: ignore[call-overload]
scene.add_collider("sphere", center=(0, 0, 0), radius="1")  # type: ignore[call-overload]
scene.add_collider("plane", center=(0, 0, 0), radius=1)  # type: ignore[call-overload]
"""


def test_a_program_that_uses_the_module_has_consistent_types(tmp_path):
    (tmp_path / "program.py").write_text(program)
    packages = pathlib.Path(__file__).parents[1]
    done = subprocess.run(["/usr/bin/mypy", "--strict", "--ignore-missing-imports", "--python-executable", "/usr/bin/python3", "program.py",
                           str(packages / "hooke")], capture_output=True, text=True, cwd=tmp_path, env={"MYPYPATH": str(packages)}, check=False)
    assert done.stdout.startswith("Success"), done.stdout + done.stderr


def test_the_types_of_shapes_follow_from_their_table():
    file = pathlib.Path(hooke.__file__).resolve().parent / "_shapes.pyi"
    assert file.resolve().read_text() == stub()
