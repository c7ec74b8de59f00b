"""What an agent's action means for a robot.

Every kind of action becomes three numbers from -1 to 1: a turn, a change of depth or altitude, and a speed. A robot then
steers its believed heading plus ``turn * turn_deg`` through the water, at a depth or altitude that changes by
``change * climb_m``, with a speed through the water from its least (-1) to its greatest (1).
"""

from __future__ import annotations

from typing import Any, Protocol

import numpy as np
import numpy.typing as npt
from gymnasium import spaces

AnyArray = npt.NDArray[Any]


class Action(Protocol):
    """What a kind of action is: made with the number of environments, of numbers, and whether it may declare."""

    @property
    def space(self) -> spaces.Space[Any]:
        """The actions of one agent."""

    def begin(self, envs: AnyArray) -> None:
        """Episodes begin in these environments."""

    def moves(self, envs: AnyArray, obs: AnyArray, actions: AnyArray) -> AnyArray:
        """The numbers of these environments' actions, from their observations."""


#: Places of numbers in a robot's observation, see ``rheotaxis.observations``.
FLOW_FORWARD, FLOW_LEFT, FLOW_KNOWN, SIN, COS = 5, 6, 7, 8, 9


class Continuous:
    """``Box(-1, 1, (3,))``: turn, change of depth or altitude, speed; of a gantry ``(2,)``: forward and left.

    The axes of a gantry move by what they can reach until the next decision. With ``declare`` there is one more number:
    above 0.5 it declares a source where the searcher believes itself to be, and ends the mission.
    """

    def __init__(self, n: int, numbers: int, declare: bool) -> None:
        self.space = spaces.Box(-1.0, 1.0, (numbers,), np.float32)

    def begin(self, envs: AnyArray) -> None:
        """Episodes begin in these environments."""

    def moves(self, envs: AnyArray, obs: AnyArray, actions: AnyArray) -> AnyArray:
        """The numbers of these environments' actions, from their observations."""
        return actions


class _Discrete:
    """One of a few courses at half speed, and with ``declare`` one more action, the last, that declares."""

    courses: int

    def __init__(self, n: int, numbers: int, declare: bool) -> None:
        self.declare = declare
        self.numbers = numbers
        self.space = spaces.Discrete(self.courses + declare)

    def begin(self, envs: AnyArray) -> None:
        """Episodes begin in these environments."""

    def moves(self, envs: AnyArray, obs: AnyArray, actions: AnyArray) -> AnyArray:
        """The numbers of these environments' actions, from their observations."""
        moves = np.zeros((len(envs), self.numbers))
        turns = self.turns(envs, obs, actions)
        moves[:, 0] = _wrapped(turns) / np.pi
        if self.declare:
            moves[:, -1] = actions == self.courses
        return moves

    def turns(self, envs: AnyArray, obs: AnyArray, actions: AnyArray) -> AnyArray:
        """Turns, clockwise, rad."""
        raise NotImplementedError


class Oriented(_Discrete):
    """``Discrete(3)``: straight on, left, right; ``turn_rad`` is the turn."""

    courses = 3
    turn_rad = np.pi / 6

    def turns(self, envs: AnyArray, obs: AnyArray, actions: AnyArray) -> AnyArray:
        return np.choose(np.minimum(actions, 2), [0.0, -self.turn_rad, self.turn_rad])


class Grid(_Discrete):
    """``Discrete(4)``: north, east, south, west through the water."""

    courses = 4

    def turns(self, envs: AnyArray, obs: AnyArray, actions: AnyArray) -> AnyArray:
        heading = np.arctan2(obs[:, SIN], obs[:, COS])
        return np.minimum(actions, 3) * (np.pi / 2) - heading


class SurgeCast(_Discrete):
    """``Discrete(2)``: 0 surges against the believed flow, 1 casts across it.

    Casting begins on the other side than last time, and changes sides after 1, 2, 3, ... decisions. Without a flow
    estimate both go straight on.
    """

    courses = 2

    def __init__(self, n: int, numbers: int, declare: bool) -> None:
        super().__init__(n, numbers, declare)
        self.side = np.ones(n)
        self.leg = np.zeros(n, dtype=int)
        self.left = np.zeros(n, dtype=int)

    def begin(self, envs: AnyArray) -> None:
        self.side[envs] = 1.0
        self.leg[envs] = self.left[envs] = 0

    def turns(self, envs: AnyArray, obs: AnyArray, actions: AnyArray) -> AnyArray:
        casts = actions == 1
        over = casts & (self.left[envs] == 0)
        self.side[envs] = np.where(over, -self.side[envs], self.side[envs])
        self.leg[envs] = np.where(casts, self.leg[envs] + over, 0)
        self.left[envs] = np.where(over, self.leg[envs], self.left[envs])
        self.left[envs] = np.where(casts, self.left[envs] - 1, 0)
        up_flow = np.arctan2(obs[:, FLOW_LEFT], -obs[:, FLOW_FORWARD])
        turns = up_flow + casts * self.side[envs] * (np.pi / 2)
        return np.where(obs[:, FLOW_KNOWN] > 0, turns, 0.0)


def _wrapped(angle: AnyArray) -> AnyArray:
    return (angle + np.pi) % (2 * np.pi) - np.pi


KINDS = {"continuous": Continuous, "oriented": Oriented, "grid": Grid, "surge_cast": SurgeCast}
