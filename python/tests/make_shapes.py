"""Prints python/hooke/_shapes.pyi, which follows from the table of shapes: python3 python/tests/make_shapes.py > python/hooke/_shapes.pyi"""

import hooke
from hooke._shapes import arguments_of


def stub() -> str:
    lines = ['"""The types of the methods that add shapes. Made from the table of shapes by python/tests/make_shapes.py."""', "",
             "from typing import Any", "", "from numpy.typing import ArrayLike", "", "class Shapes:",
             "    def add_shape(self, type: str, **fields: Any) -> range: ...",
             "    def _add(self, key: str, item: dict[str, Any], caller: str) -> range: ..."]
    for row in hooke.shapes():
        kinds = {name: what for name, what, _ in row["fields"]}
        arguments = []
        for name in arguments_of(row):
            what = kinds.get(name.removesuffix("_"), "")
            kind = ("ArrayLike" if what.startswith("[") or name == "nail" else "str" if " | " in what or name == "color" else "float")
            arguments.append(f"{name}: {kind} | None = None")
        lines.append(f"    def add_{row['id']}(self, *, {', '.join(arguments)}) -> range: ...")
    return "\n".join(lines) + "\n"


if __name__ == "__main__":
    print(stub(), end="")
