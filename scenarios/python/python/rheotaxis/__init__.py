"""Simulator for chemical-plume tracing by underwater vehicles and flume gantries.

>>> import rheotaxis
>>> result = rheotaxis.run("uniform_channel", seed=1)
>>> result.outcome, result.declarations[0]["position"]
>>> result.track["auv0"]["depth_m"]

World axes are ENU (east, north, up) with z = 0 at the still surface; headings are compass degrees; times are in
seconds from the start of the mission. The same seed gives the same run, bit by bit.
"""

from importlib.util import find_spec as _find_spec
from typing import TYPE_CHECKING, Any

from ._rheotaxis import (
    Figure,
    Result,
    RunWarning,
    Scenario,
    ScenarioError,
    ScenarioWarning,
    __version__,
    catalogue,
    explain,
    run,
)
from ._ron import Ron

if TYPE_CHECKING:
    from .gym import Env, VectorEnv
    from .parallel import ParallelEnv
    from .policies import PolicyController

__all__ = [
    "Env",
    "Figure",
    "ParallelEnv",
    "PolicyController",
    "Result",
    "Ron",
    "RunWarning",
    "Scenario",
    "ScenarioError",
    "ScenarioWarning",
    "VectorEnv",
    "__version__",
    "catalogue",
    "explain",
    "run",
]

#: Names that need packages which are not always there.
_LATER = {
    "Env": "gym",
    "VectorEnv": "gym",
    "ParallelEnv": "parallel",
    "PolicyController": "policies",
    "gym": "gym",
    "parallel": "parallel",
    "policies": "policies",
    "sb3": "sb3",
}


def __getattr__(name: str) -> Any:
    if name not in _LATER:
        raise AttributeError(f"module 'rheotaxis' has no attribute {name!r}")
    from importlib import import_module

    module = import_module(f".{_LATER[name]}", __name__)
    return module if name == _LATER[name] else getattr(module, name)


def __dir__() -> list[str]:
    return sorted({*globals(), *_LATER})


if _find_spec("gymnasium") is not None:
    from . import gym as _gym

    _gym.register()
