"""Simulator for chemical-plume tracing by underwater vehicles and flume gantries.

>>> import rheotaxis
>>> result = rheotaxis.run("uniform_channel", seed=1)
>>> result.outcome, result.declarations[0]["position"]
>>> result.track["auv0"]["depth_m"]

World axes are ENU (east, north, up) with z = 0 at the still surface; headings are compass degrees; times are in
seconds from the start of the mission. The same seed gives the same run, bit by bit.
"""

from ._rheotaxis import (
    Figure,
    Result,
    Scenario,
    ScenarioError,
    ScenarioWarning,
    __version__,
    catalogue,
    explain,
    run,
)
from ._ron import Ron

__all__ = [
    "Figure",
    "Result",
    "Ron",
    "Scenario",
    "ScenarioError",
    "ScenarioWarning",
    "__version__",
    "catalogue",
    "explain",
    "run",
]
