"""What scenes and laboratories have in common: parameters by name."""

from __future__ import annotations

from typing import Any, Literal, overload

import numpy as np
from numpy.typing import NDArray

from . import _hooke
from ._arguments import as_float, text

Array = NDArray[np.float64]


def setting_text(value: Any) -> str:
    """The value of a parameter as the command line reads it, with all digits of a number."""
    if isinstance(value, (bool, np.bool_)):
        return "on" if value else "off"
    if isinstance(value, (float, np.floating)):
        return repr(as_float(value))
    return text("value", str(value))


class Parameterized:
    """Base of Scene and Lab."""

    __slots__ = ("_bound", "__weakref__")
    _bound: _hooke.Scene | _hooke.Lab

    @overload
    def __getitem__(self, name: Literal["dimensions", "substeps", "iterations"]) -> int: ...
    @overload
    def __getitem__(self, name: str) -> Any: ...

    def __getitem__(self, name: str) -> Any:
        """The value of a parameter."""
        return self._bound.get(text("name of a parameter", name))

    def __setitem__(self, name: str, value: Any) -> None:
        """Sets a parameter; a value out of its range is refused."""
        self._bound.set(text("name of a parameter", name), setting_text(value))

    def __contains__(self, name: object) -> bool:
        return isinstance(name, str) and any(row["name"] == name for row in _hooke.parameters())

    __iter__: None = None  # or Python would try the parameters 0, 1, ...

    @property
    def time(self) -> float:
        """The time of the state [s]."""
        return self._bound.time

    @property
    def hash(self) -> str:
        """Of the state: 16 hexadecimal digits, equal for equal bits."""
        return self._bound.hash
