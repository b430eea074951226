"""Prints python/hooke/_shapes.pyi, which follows from the tables: python3 python/tests/make_shapes.py > python/hooke/_shapes.pyi"""

import hooke
from hooke._shapes import arguments_of

# As docs/reference/scene-format.md; those without a default are required.
COLLIDERS = {"plane": "point: ArrayLike, normal: ArrayLike, one_way: bool = False", "sphere": "center: ArrayLike, radius: float",
             "box": "min: ArrayLike, max: ArrayLike"}
SURFACE = ("restitution: float = 0, friction: float = 0, solid: bool = True, oscillate: ArrayLike = ..., frequency: float = 1, "
           "phase: float = 0, spin: ArrayLike = ..., belt: ArrayLike = ...")
HEAD = '''"""The types of the methods that add shapes, colliders and forces. Made from their tables by python/tests/make_shapes.py."""

from collections.abc import Callable
from typing import Any, Literal, overload

from numpy.typing import ArrayLike

from ._parameters import Array

class Shapes:
    def add_shape(self, type: str, **fields: Any) -> range: ...
    def _add(self, key: str, item: dict[str, Any], caller: str) -> range: ...'''


def kind_of(what: str, name: str = "") -> str:
    """The type of a field with this unit, format or these words."""
    if what.startswith("[") or name == "nail":
        return "ArrayLike"
    if " | " in what:
        return f"Literal[{', '.join(repr(word) for word in what.split(' | '))}]"
    return "str" if name == "color" else "float"


def stub() -> str:
    lines = [HEAD]
    for row in hooke.shapes():
        kinds = {name: what for name, what, _ in row["fields"]}
        arguments = [f"{name}: {kind_of(kinds.get(name.removesuffix('_'), ''), name)} | None = None" for name in arguments_of(row)]
        lines.append(f"    def add_{row['id']}(self, *, {', '.join(arguments)}) -> range: ...")
    for type_, fields in COLLIDERS.items():
        lines += ["    @overload", f"    def add_collider(self, type: Literal[{type_!r}], *, {fields}, {SURFACE}) -> None: ..."]
    lines += ["    @overload", "    def add_force(self, force: Callable[[float, Array, Array], ArrayLike]) -> None: ..."]
    for row in hooke.forces():
        fields = "".join(f", {name}: {kind_of(what)} = ..." for name, what, _ in row["fields"])
        lines += ["    @overload", f"    def add_force(self, force: Literal[{row['id']!r}], *{fields}, on: bool = True) -> None: ..."]
    return "\n".join(lines) + "\n"


if __name__ == "__main__":
    print(stub(), end="")
