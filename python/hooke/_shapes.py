"""Methods of Scene that add shapes: one for each row of the table of shapes. _shapes.pyi has their types."""

from __future__ import annotations

import inspect
import keyword
from typing import Any

from . import _hooke
from .tables import shape_text


class Shapes:
    """Base of Scene."""

    __slots__ = ()

    def add_shape(self, type: str, **fields: Any) -> range:
        """Adds a shape, as in the "generators" of a scene file: add_shape("rope", ...) is add_rope(...). Returns its points' numbers.

        A field that is a keyword of Python has an underscore at its end: from_.
        """
        named = {name.removesuffix("_"): value for name, value in fields.items() if value is not None}
        return self._add("generators", {"type": type, **named}, f"add_{type}" if hasattr(Shapes, f"add_{type}") else "add_shape")

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
