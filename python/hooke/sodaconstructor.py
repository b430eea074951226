"""Models of Sodaconstructor 2 (.xml) as scenes: hooke.sodaconstructor.load("daintywalker.xml"), or as a program

    python3 -m hooke.sodaconstructor daintywalker.xml daintywalker.json

A pixel becomes one centimeter and a step of Sodaconstructor a fiftieth of a second. There, v = (1 - friction) (v + springyness e) - gravity
and x = x + v in each step, e the extension of a spring and all masses 1; here, the same forces act continuously. The rest length of a muscle
is l0 (1 + a A sin(2 pi (phase - p))), a its amplitude, A that of the wave, and p the phase of the wave, which grows ("forward") or falls
("reverse") by its speed in each step. The motion is not the same step for step: steps there are long, and limit the speed. The floor has the
reflection of the file as restitution; instead of the tenth of its speed that a mass keeps on the floor in each step there is a friction
coefficient of 1. There are no walls.
"""

from __future__ import annotations

import json
import math
import os
import sys
import xml.etree.ElementTree as ElementTree
from pathlib import Path
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from .scene import Scene

_METERS, _STEPS = 0.01, 50.0  # per pixel, and per second


def _fields(item: ElementTree.Element) -> dict[str, ElementTree.Element]:
    return {field.get("name", ""): field[0] for field in item.findall("field") if len(field) > 0}


def _number(fields: dict[str, ElementTree.Element], name: str, default: float = 0.0) -> float:
    value = float(fields[name].text or "") if name in fields else default
    if not math.isfinite(value):
        raise ValueError(f"{name}: {value}: must be finite")
    return value


def to_json(document: str) -> str:
    """The scene of a model, as the text of a scene file. Raises ValueError for anything but a model of Sodaconstructor 2."""
    if "<!DOCTYPE" in document or "<!ENTITY" in document:
        raise ValueError("must not declare entities")
    try:
        root = ElementTree.fromstring(document)
    except ElementTree.ParseError as error:
        raise ValueError(str(error)) from None
    kinds = {item.get("id"): item.get("type", "").rpartition(".")[2] for item in root.iter("object")}
    found = next((item for item in root.iter("object") if kinds[item.get("id")] == "Model"), None)
    if found is None:
        raise ValueError("contains no model of Sodaconstructor 2")
    model = _fields(found)
    wave = _fields(model["wave"]) if "wave" in model else {}
    reverse = wave.get("direction") is not None and wave["direction"].text == "reverse"

    places: dict[str | None, int] = {}
    points: list[dict[str, Any]] = []
    for node in model.get("nodes", ()):
        fields, speed = _fields(node), _METERS * _STEPS
        places[node.get("id")] = len(points)
        points.append({"position": [_METERS * _number(fields, "x"), _METERS * _number(fields, "y"), 0],
                       "velocity": [speed * _number(fields, "vx"), speed * _number(fields, "vy"), 0],
                       "nailed": kinds[node.get("id")] == "Node", "mass": 1, "radius": 0.02})

    stiffness = _number(model, "springyness") * _STEPS**2
    springs: list[dict[str, Any]] = []
    for link in model.get("springs", ()):
        fields = _fields(link)
        ends = [places.get(fields[end].get("refid")) if end in fields else None for end in "ab"]
        if None in ends:
            raise ValueError(f"{link.get('id')}: must join two masses")
        spring: dict[str, Any] = {"points": ends, "stiffness": stiffness, "rest_length": _METERS * _number(fields, "restLength")}
        amplitude = _number(wave, "amplitude") * _number(fields, "amplitude")
        if kinds[link.get("id")] == "Muscle" and amplitude != 0.0:
            phase = 2.0 * math.pi * (_number(fields, "phase") - _number(wave, "phase"))
            spring["muscle"] = {"amplitude": max(-1.0, min(1.0, amplitude)), "frequency": abs(_number(wave, "speed")) * _STEPS,
                                "phase": phase if reverse else math.pi - phase}
        springs.append(spring)

    down = {1: -1.0, 0: 0.0}.get(round(_number(model, "gravityDirection", 1.0)), 1.0)
    friction = min(_number(model, "friction"), 0.999)
    floor = {"type": "plane", "point": [0, 0, 0], "normal": [0, 1, 0], "friction": 1,
             "restitution": max(0.0, min(1.0, -_number(model, "surfaceReflection", -0.75)))}
    return json.dumps({"hooke": 1, "dimensions": 2, "gravity": [0, down * _METERS * _STEPS**2 * _number(model, "gravity"), 0],
                       "drag": -_STEPS * math.log1p(-friction), "points": points, "springs": springs, "colliders": [floor]}, indent=1)


def load(file: str | os.PathLike[str]) -> Scene:
    """The scene of a model."""
    from .scene import Scene

    return Scene.from_json(to_json(Path(file).read_text(encoding="utf-8")), Path(file).stem)


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit("usage: python3 -m hooke.sodaconstructor MODEL.xml SCENE.json")
    try:
        Path(sys.argv[2]).write_text(to_json(Path(sys.argv[1]).read_text(encoding="utf-8")), encoding="utf-8")
    except (OSError, ValueError) as error:
        sys.exit(f"{sys.argv[1]}: {error}")
