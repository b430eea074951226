"""The tables of Hooke: what can be set, and with which values."""

from __future__ import annotations

from typing import Any

from . import _hooke


def parameters() -> list[dict[str, Any]]:
    """The parameters of a scene: name, unit, description, kind, min, max, default, choices."""
    return _hooke.parameters()


def methods() -> list[dict[str, Any]]:
    """The integration methods: id, label, summary, cost, order, adaptive."""
    return _hooke.methods()


def shapes() -> list[dict[str, Any]]:
    """The shapes that Scene.add_shape generates: id, description, fields (name, unit, format or words, default), nails."""
    return _hooke.shapes()


def forces() -> list[dict[str, Any]]:
    """The forces that Scene.add_force adds by name: id, description, fields (name, unit or words, default)."""
    return _hooke.forces()


def quantities() -> list[dict[str, Any]]:
    """The quantities of `hooke run --csv` and of sweeps: name, unit, description."""
    return _hooke.quantities()


def scenes() -> list[dict[str, str]]:
    """The shipped scenes: id, title, group, description."""
    return _hooke.scenes()


def _number(value: float) -> str:
    return f"{value:g}"


def parameter_text() -> str:
    """A line for each parameter: name, range, unit, description."""
    lines = []
    for row in parameters():
        if row["kind"] == "switch":
            values = "True or False"
        elif row["kind"] == "choice":
            values = " | ".join(row["choices"])
        else:
            values = f"{_number(row['min'])} ... {_number(row['max'])}"
        unit = f" [{row['unit']}]" if row["unit"] else ""
        lines.append(f"    {row['name']}: {values}{unit}\n        {row['description']}")
    return "\n".join(lines)


def method_text() -> str:
    """A line for each integration method."""
    return "\n".join(f"    {row['id']}: {row['summary']}" for row in methods())


def shape_text(row: dict[str, Any]) -> str:
    """The documentation of one shape."""
    lines = [row["description"], ""]
    for name, what, default in row["fields"]:
        value = "" if default is None else f", default {default if isinstance(default, str) else _number(default)}"
        lines.append(f"    {name}: {what if ' | ' in what or what.startswith('[') or not what else f'[{what}]'}{value}")
    if row["nails"]:
        lines.append(f"    nail: a list of {', '.join(row['nails'])}, or of numbers of points within the shape")
    return "\n".join(lines)
