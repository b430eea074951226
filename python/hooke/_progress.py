"""Progress bars by tqdm, if it is installed."""

from __future__ import annotations

import contextlib
import sys
from collections.abc import Callable, Iterator
from typing import Any, Optional

Progress = Optional[Callable[[int, int], None]]


def _tqdm() -> Any:
    try:
        from tqdm.auto import tqdm
    except ImportError:
        return None
    return tqdm


@contextlib.contextmanager
def bar(label: str, show: bool | None, unit: str = "frame") -> Iterator[Progress]:
    """A function (done, all) that shows progress; None where none is shown.

    show: True, False, or None for a bar on terminals and in notebooks only.
    """
    if show is None:
        show = sys.stderr.isatty() or "ipykernel" in sys.modules
    tqdm = _tqdm() if show else None
    if tqdm is None:
        yield None
        return
    shown = tqdm(desc=label, unit=unit, leave=False, delay=0.5)

    def update(done: int, total: int) -> None:
        shown.total = total
        shown.update(done - shown.n)

    with shown:
        yield update
