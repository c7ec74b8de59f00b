"""Checks of options: TypeError if a value is of a wrong type, ValueError if it is out of its range."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from numbers import Integral, Real
from typing import Any


def _refuse(name: str, must: str, value: object) -> TypeError:
    return TypeError(f"{name} must be {must}, got {value!r} ({type(value).__name__})")


def number(name: str, value: Any) -> float:
    """A number, whatever its range."""
    if isinstance(value, bool) or not isinstance(value, Real):
        raise _refuse(name, "a number", value)
    return float(value)


def positive(name: str, value: Any) -> float:
    """A finite number above 0."""
    checked = number(name, value)
    if not 0 < checked < float("inf"):
        raise ValueError(f"{name} must be above 0, got {value}")
    return checked


def whole(name: str, value: Any, least: int, most: int) -> int:
    """A whole number of a range."""
    if isinstance(value, bool) or not isinstance(value, Integral):
        raise _refuse(name, "a whole number", value)
    if not least <= int(value) <= most:
        raise ValueError(f"{name} must be from {least} to {most}, got {value}")
    return int(value)


def switch(name: str, value: Any) -> bool:
    """A yes or no."""
    if not isinstance(value, bool):
        raise _refuse(name, "True or False", value)
    return value


def speeds(name: str, value: Any) -> tuple[float, float]:
    """Two speeds; which ones go together is checked with the vehicle's."""
    if isinstance(value, str) or not hasattr(value, "__len__") or len(value) != 2:
        raise _refuse(name, "two speeds, the smaller first", value)
    return number(name, value[0]), number(name, value[1])


def kind(name: str, value: Any, kinds: Mapping[str, Callable[..., Any]]) -> Callable[..., Any]:
    """One of several by its name, or a function or class of the user's own."""
    own: Callable[..., Any] | None = value if callable(value) else None
    if own is not None:
        return own
    if not isinstance(value, str):
        raise _refuse(name, f"one of {', '.join(kinds)}, or a function or class", value)
    if value not in kinds:
        raise ValueError(f"{name} must be one of {', '.join(kinds)}, got {value!r}")
    return kinds[value]
