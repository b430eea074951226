"""Models of Sodaconstructor 2 (.xml), which hooke.load reads as any other file."""

from .scene import load

__all__ = ["load"]
