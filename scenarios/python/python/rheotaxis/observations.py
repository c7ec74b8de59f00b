"""What an agent sees. Nothing of it is the truth: it is what the searcher's instruments and its navigation say.

A robot's ``state`` has 17 numbers (``NAMES``):

==================== ==================================================================================
reading              newest chemical reading, share of full scale; before the first one 0
mean_reading         mean of the readings since the last decision, share of full scale
highest_reading      the greatest of them
hits                 share of them that are detections
since_hit            time since the newest detection, in 600 s; 1 if it was longer ago or never
flow_forward_m_s     believed velocity of the water over ground in body axes, m/s: forward
flow_left_m_s        the same: left
flow_known           1 once the flow has been measured; before, both are 0
sin_heading          sine of the believed compass heading: its east component
cos_heading          cosine: its north component
speed_forward_m_s    believed velocity over ground in body axes, m/s: forward
speed_left_m_s       the same: left
altitude_10m         believed height above the bed, in 10 m; 0 until it is measured
depth_10m            believed depth below the still surface, in 10 m
east_of_home         believed place relative to that of the launch, in half lengths of the area: east
north_of_home        the same: north
time                 time of the episode as a share of its limit
==================== ==================================================================================

A gantry's has its axes' places in their travel (``forward``, ``left``: -1 to 1), ``arrived``, ``blocked``, ``time``, and
of each probe the newest output and the highest since the last decision, as shares of its range.
"""

from __future__ import annotations

from typing import Any, Protocol

import numpy as np
import numpy.typing as npt
from gymnasium import spaces


class Observation(Protocol):
    """What a kind of observation is: made with whether it is of a gantry, and names and bounds of all numbers."""

    names: list[str]

    @property
    def space(self) -> spaces.Space[Any]:
        """The observations of one agent."""

    def of(self, state: npt.NDArray[Any]) -> npt.NDArray[Any]:
        """The observations of some environments, from all their numbers."""


class State:
    """All numbers, ``Box`` of float32."""

    def __init__(self, gantry: bool, features: list[tuple[str, float, float]]) -> None:
        self.names = [name for name, _, _ in features]
        low = np.array([low for _, low, _ in features], np.float32)
        high = np.array([high for _, _, high in features], np.float32)
        self.space = spaces.Box(low, high, dtype=np.float32)

    def of(self, state: npt.NDArray[Any]) -> npt.NDArray[Any]:
        """The observations of a row of environments."""
        return state.copy()


class _Chosen(State):
    chosen: list[str]

    def __init__(self, gantry: bool, features: list[tuple[str, float, float]]) -> None:
        if gantry:
            raise ValueError(f"a gantry has no observation of {self.chosen}: use observation='state'")
        super().__init__(gantry, features)
        self.places = [self.names.index(name) for name in self.chosen]
        box = self.space
        self.space = spaces.Box(box.low[self.places], box.high[self.places], dtype=np.float32)
        self.names = self.chosen

    def of(self, state: npt.NDArray[Any]) -> npt.NDArray[Any]:
        return state[:, self.places]


class Reading(_Chosen):
    """``Box(0, 1, (1,))``: the newest reading."""

    chosen = ["reading"]


class ReadingFlow(_Chosen):
    """``Box((4,))``: the newest reading, the time since a hit, and the flow in body axes."""

    chosen = ["reading", "since_hit", "flow_forward_m_s", "flow_left_m_s"]


KINDS = {"state": State, "reading": Reading, "reading_flow": ReadingFlow}
