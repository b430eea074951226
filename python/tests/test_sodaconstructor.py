"""Models of Sodaconstructor."""

import math

import numpy as np
import pytest

import hooke
import hooke.sodaconstructor


def field(name, value, kind="double"):
    return f'<field name="{name}"><{kind}>{value}</{kind}></field>'


def thing(kind, number, fields):
    return f'<object id="{kind}#{number}" type="com.sodaplay.soda.constructor2.model.{kind}">{fields}</object>'


def listed(name, things):
    return f'<field name="{name}"><list class="java.util.Vector">{things}</list></field>'


def model(direction="forward", link="Muscle", end="Mass#2"):
    ends = f'<field name="a"><ref refid="Node#1" /></field><field name="b"><ref refid="{end}" /></field>'
    wave = thing("Wave", 1, field("amplitude", 0.5) + field("direction", direction, "string") + field("phase", 0.125) + field("speed", 0.02))
    nodes = thing("Node", 1, field("x", 100) + field("y", 200)) + thing("Mass", 2, field("vx", 2) + field("vy", 0) + field("x", 100) + field("y", 150))
    springs = thing(link, 1, ends + field("amplitude", 0.5) + field("phase", 0.25) + field("restLength", 40))
    content = (field("friction", 0.1) + field("gravity", 0.4) + field("gravityDirection", 1, "int") + listed("nodes", nodes) +
               listed("springs", springs) + field("springyness", 0.2) + field("surfaceReflection", -0.75) + f'<field name="wave">{wave}</field>')
    return f'<object id="ConstructorApplication#1" type="x"><field name="model">{thing("Model", 1, content)}</field></object>'


def test_model_becomes_a_scene(tmp_path):
    file = tmp_path / "hanging.xml"
    file.write_text(model())
    scene = hooke.sodaconstructor.load(file)
    assert scene.dimensions == 2 and scene.name == "hanging"
    assert np.allclose(scene.positions, [[1, 2, 0], [1, 1.5, 0]]) and np.allclose(scene.velocities, [[0, 0, 0], [1, 0, 0]])
    assert list(scene.nailed) == [True, False] and scene["stiffness"] == 500 and math.isclose(scene["drag"], -50 * math.log(0.9))
    muscle = scene.laws[0]["muscle"]
    assert math.isclose(muscle["amplitude"], 0.25) and math.isclose(muscle["frequency"], 1.0)
    assert math.isclose(math.sin(muscle["phase"]), math.sin(math.pi / 4)) and not scene.run(1.0).diverged


def test_direction_of_the_wave_is_that_of_time():
    muscle = {direction: hooke.Scene.from_json(hooke.sodaconstructor.to_json(model(direction))).laws[0]["muscle"]
              for direction in ("forward", "reverse")}
    for t in (0.0, 0.1, 0.37):
        forward, reverse = (math.sin(2 * math.pi * muscle[d]["frequency"] * s + muscle[d]["phase"]) for d, s in (("forward", t), ("reverse", -t)))
        assert math.isclose(forward, reverse, abs_tol=1e-12)


def test_spring_is_no_muscle():
    assert hooke.Scene.from_json(hooke.sodaconstructor.to_json(model(link="Spring"))).laws == [None]


@pytest.mark.parametrize("text", ["", "<a>", "<object id='x'/>", model(end="Mass#9"), "<!DOCTYPE a><a/>", model().replace("40", "inf")])
def test_anything_else_is_refused(text):
    with pytest.raises(ValueError):
        hooke.sodaconstructor.to_json(text)
