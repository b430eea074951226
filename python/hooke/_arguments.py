"""Arguments from users: converted, or refused in one line that names the argument and the value."""

from __future__ import annotations

import operator
import os
from collections.abc import Callable, Sequence
from typing import Any, TypeVar

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ._hooke import InputError, UsageError

Value = TypeVar("Value")


def brief(value: Any) -> str:
    """Its representation in one short line."""
    try:
        line = " ".join(repr(value).split())
    except Exception:  # a whole number of too many digits, or what has a representation that fails
        line = f"<{type(value).__name__}>"
    return line if len(line) <= 80 else line[:77] + "..."


def named(name: Any) -> str:
    """A name as it is, unless it is long, not printable, or no name."""
    return name if isinstance(name, str) and len(name) <= 80 and name.isprintable() else brief(name)


def optional(convert: Callable[[str, Any], Value], name: str, value: Any) -> Value | None:
    """None stays None."""
    return None if value is None else convert(name, value)


def as_float(value: Any) -> float:
    """Of a number of single or half precision the decimal one that it stands for: 0.1 for np.float32(0.1)."""
    dtype = getattr(value, "dtype", None)
    return float(str(value)) if dtype == np.float32 or dtype == np.float16 else float(value)


def number(name: str, value: Any) -> float:
    """A real number."""
    try:
        if not isinstance(value, (str, bytes, bool, np.bool_, complex)) and np.ndim(value) == 0:
            return as_float(value)
    except OverflowError:
        raise UsageError(f"{name}: {brief(value)}: must be a finite number") from None
    except (TypeError, ValueError):
        pass
    raise TypeError(f"{name}: {brief(value)}: must be a number")


def import_options(weld: float | None, scale: float | None, up: str | None) -> dict[str, str]:
    """How a mesh is read."""
    lengths = {name: repr(number(name, value)) for name, value in (("weld", weld), ("scale", scale)) if value is not None}
    return lengths if up is None else lengths | {"up": text("up", up)}


def integer(name: str, value: Any) -> int:
    """A whole number; 40.0 is one."""
    if not isinstance(value, (bool, np.bool_)):
        try:
            whole = operator.index(int(value) if isinstance(value, (float, np.floating)) and value == np.floor(value) else value)
        except (TypeError, ValueError, OverflowError):
            pass
        else:
            if abs(whole) < 2**53:
                return whole
            raise UsageError(f"{name}: {f'{whole:g}' if abs(whole) < 10**300 else brief(whole)}: must be less than 2^53")
    raise TypeError(f"{name}: {brief(value)}: must be a whole number")


def text(name: str, value: Any) -> str:
    """A string."""
    if not isinstance(value, str):
        raise TypeError(f"{name}: {brief(value)}: must be a string")
    try:
        value.encode()
    except UnicodeEncodeError:
        raise UsageError(f"{name}: {brief(value)}: must be text in Unicode, without lone surrogates") from None
    return value


def flag(name: str, value: Any) -> bool:
    """True or False; 1 and 0 are that, too."""
    if isinstance(value, (bool, np.bool_)) or (isinstance(value, (int, np.integer)) and 0 <= value <= 1):
        return bool(value)
    raise TypeError(f"{name}: {brief(value)}: must be True or False")


def mapping(name: str, value: Any) -> dict[Any, Any]:
    """A dictionary, or what makes one."""
    try:
        return dict(value)
    except (TypeError, ValueError):
        raise TypeError(f"{name}: {brief(value)}: must be a dictionary") from None


def path(name: str, value: Any) -> bytes:
    """The name of a file, with any bytes that the system allows."""
    try:
        file = os.fsencode(value)
    except (TypeError, UnicodeEncodeError):
        raise TypeError(f"{name}: {brief(value)}: must be the path of a file") from None
    if b"\0" in file:
        raise UsageError(f"{name}: {brief(value)}: must be without null characters")
    return file


def names(name: str, value: str | Sequence[str]) -> list[str]:
    """A list of strings; one string is a list of one."""
    try:
        return [text(name, value)] if isinstance(value, str) else [text(name, item) for item in value]
    except TypeError:
        raise TypeError(f"{name}: {brief(value)}: must be a list of strings") from None


def plain_array(name: str, value: ArrayLike, kinds: str, wanted: str) -> NDArray[Any]:
    try:
        array = np.asarray(value)
    except ValueError:  # rows of different lengths
        array = np.empty(0, dtype=object)
    if array.size == 0 and array.dtype.kind == "f":
        return array
    if array.dtype.kind not in kinds:
        raise TypeError(f"{name}: {brief(value)}: must be {wanted}")
    return array


def array(name: str, value: ArrayLike) -> NDArray[np.float64]:
    """Numbers as float64, C-contiguous: without a copy if they are that already."""
    return np.asarray(plain_array(name, value, "biuf", "numbers"), dtype=np.float64, order="C")


def whole_numbers(name: str, value: ArrayLike) -> NDArray[np.int64]:
    """Whole numbers, such as those of points."""
    whole = plain_array(name, value, "iu", "whole numbers")
    for extreme in (whole.min(), whole.max()) if whole.size > 0 else ():
        if abs(int(extreme)) >= 2**31:
            raise UsageError(f"{name}: {extreme}: must be less than 2^31")
    return np.asarray(whole, dtype=np.int64, order="C")


def numbers_of(name: str, value: ArrayLike) -> list[int]:
    """The number of a point or another part, or a list of such numbers."""
    listed = np.atleast_1d(whole_numbers(name, value))
    if listed.ndim > 1:
        raise InputError(f"{name}: shape {listed.shape}: must be one number or a list of numbers")
    return listed.tolist()  # type: ignore[no-any-return]


def switches(name: str, value: ArrayLike) -> NDArray[np.bool_]:
    """True or False for each."""
    return np.asarray(plain_array(name, value, "b", "True or False"), dtype=bool)


def json_value(name: str, value: Any) -> Any:
    """A value for a scene file: arrays as lists."""
    if isinstance(value, (np.ndarray, np.generic)):
        value = value.tolist()
    if isinstance(value, dict):
        return {key: json_value(f"{name}.{key}" if name else str(key), item) for key, item in value.items()}
    if isinstance(value, (list, tuple, range)):
        return [json_value(f"{name}[{i}]", item) for i, item in enumerate(value)]
    if isinstance(value, float) and not np.isfinite(value):
        raise InputError(f"{name}: {value}: must be a finite number")
    if value is None or isinstance(value, (str, bool, int, float)):
        return value
    raise TypeError(f"{name}: {brief(value)}: must be a number, a string or a list")
