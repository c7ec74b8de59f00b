"""Controllers of ``run``: functions that decide for a robot or gantry, as the simulator calls them."""

from __future__ import annotations

import json
from collections.abc import Callable
from typing import Any


def _plain(value: Any) -> Any:
    """A number or an array of numpy as Python's own."""
    if hasattr(value, "tolist"):
        return value.tolist()
    raise TypeError(f"an answer holds numbers, texts, lists and dicts, got {type(value).__name__}")


def asked(controller: Callable[[dict[str, Any]], dict[str, Any] | None]) -> Callable[[str], str]:
    """The controller with question and answer as texts."""
    if not callable(controller):
        raise TypeError(f"a controller must be a function of a question, got {type(controller).__name__}")

    def answer(question: str) -> str:
        told = controller(json.loads(question))
        return "{}" if told is None else json.dumps(told, default=_plain, allow_nan=False)

    return answer
