"""Methods of Scene that add shapes, one for each row of the table of shapes, colliders and forces. _shapes.pyi has their types."""

from __future__ import annotations

import inspect
import keyword
from collections.abc import Callable
from typing import Any

from numpy.typing import ArrayLike

from . import _hooke
from ._arguments import array, text
from ._parameters import Array
from .tables import shape_text


class Shapes:
    """Base of Scene."""

    __slots__ = ()

    def add_shape(self, type: str, **fields: Any) -> range:
        """Adds a shape, as in the "generators" of a scene file: add_shape("rope", ...) is add_rope(...). Returns its points' numbers.

        A field that is a keyword of Python has an underscore at its end: from_.
        """
        named = {name.removesuffix("_"): value for name, value in fields.items() if value is not None}
        return self._add("generators", {"type": text("type", type), **named}, f"add_{type}" if hasattr(Shapes, f"add_{type}") else "add_shape")

    def add_collider(self, type: str, **fields: Any) -> None:
        """Adds a "plane" (point, normal), a "sphere" (center, radius) or a "box" (min, max) [m]; restitution, friction [1]."""
        self._add("colliders", {"type": text("type", type), **fields}, "add_collider")

    def add_force(self, force: str | Callable[[float, Array, Array], ArrayLike], **fields: Any) -> None:
        """Adds a force of the table in docs/reference/scene-format.md, such as "wind", or a function.

        force(time, positions, velocities) receives the time [s] and arrays of shape (points, 3) [m], [m/s], and returns the forces [N] in
        the same shape. It is called at every evaluation of the forces, at least twice per substep, which is slow: microseconds per call
        instead of nanoseconds. It must depend on its arguments only. A method's stability limit does not take it into account.
        """
        if callable(force):
            function = force
            self._bound.add_force(lambda time, positions, velocities: array("forces", function(time, positions, velocities)))
        else:
            self._add("forces", {"type": text("force", force), **fields}, "add_force")

    def _add(self, key: str, item: dict[str, Any], caller: str) -> range:
        raise NotImplementedError


def arguments_of(row: dict[str, Any]) -> list[str]:
    """The names of the arguments of a shape's method."""
    names = [field[0] for field in row["fields"]] + (["nail"] if row["nails"] else []) + ["color"]
    return [f"{name}_" if keyword.iskeyword(name) else name for name in names]


for _row in _hooke.shapes():
    def _method(self: Shapes, _type: str = _row["id"], /, **fields: Any) -> range:
        return self.add_shape(_type, **fields)

    _method.__name__ = f"add_{_row['id']}"
    _method.__qualname__ = f"Scene.{_method.__name__}"
    _method.__doc__ = f"{shape_text(_row)}\n\nReturns the numbers of its points."
    setattr(_method, "__signature__", inspect.Signature(
        [inspect.Parameter("self", inspect.Parameter.POSITIONAL_OR_KEYWORD)]
        + [inspect.Parameter(name, inspect.Parameter.KEYWORD_ONLY, default=None) for name in arguments_of(_row)], return_annotation=range))
    setattr(Shapes, _method.__name__, _method)
