"""Several searchers of one scenario, each with an agent of its own, for PettingZoo."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

try:
    from pettingzoo import ParallelEnv as _ParallelEnv
except ImportError as missing:
    raise ImportError("rheotaxis.ParallelEnv needs PettingZoo: pip install 'rheotaxis-sim[pettingzoo]'") from missing

import numpy as np

from ._episodes import AloneOptions, AnyArray, Episodes, ScenarioLike
from ._rheotaxis import Scenario

if TYPE_CHECKING:
    from typing_extensions import Unpack


class ParallelEnv(_ParallelEnv):  # type: ignore[misc, unused-ignore]
    """All robots and gantries of a scenario, by their ids.

    The options are those of ``rheotaxis.Env``. An agent leaves when its searcher's mission is over, and all leave when one
    of them has reached the goal or the time is over. The reward for success goes to all. It is copied and pickled as
    ``rheotaxis.Env``.
    """

    metadata = {"name": "rheotaxis_v0", "render_modes": [], "is_parallelizable": True}

    def __init__(self, scenario: ScenarioLike, **options: Unpack[AloneOptions]) -> None:
        self.render_mode = None
        self._episodes = Episodes(scenario, 1, **options)
        self._searchers = {searcher.name: searcher for searcher in self._episodes.searchers}
        self.possible_agents = list(self._searchers)
        self.agents: list[str] = []

    @property
    def scenario(self) -> Scenario:
        """As of ``rheotaxis.Env``."""
        return self._episodes.scenario

    def observation_space(self, agent: str) -> Any:
        return self._searchers[agent].observation.space

    def action_space(self, agent: str) -> Any:
        return self._searchers[agent].action.space

    def _seen(self, agents: list[str]) -> dict[str, AnyArray]:
        return {agent: self._episodes.seen(self._searchers[agent])[0] for agent in agents}

    def _infos(self, agents: list[str]) -> dict[str, dict[str, Any]]:
        told = {agent: self._episodes.infos(self._searchers[agent]) for agent in agents}
        return {agent: {name: value[0] for name, value in infos.items()} for agent, infos in told.items()}

    def reset(
        self, seed: int | None = None, options: dict[str, Any] | None = None
    ) -> tuple[dict[str, AnyArray], dict[str, dict[str, Any]]]:
        self.agents = []
        self._episodes.begin([0], [seed], fresh=True)
        self.agents = list(self.possible_agents)
        return self._seen(self.agents), self._infos(self.agents)

    def step(
        self, actions: dict[str, Any]
    ) -> tuple[dict[str, AnyArray], dict[str, float], dict[str, bool], dict[str, bool], dict[str, dict[str, Any]]]:
        episodes, agents = self._episodes, self.agents
        episodes.ready()
        if not agents:
            return {}, {}, {}, {}, {}
        missing = [agent for agent in agents if agent not in actions]
        if missing:
            raise ValueError(f"there must be an action for each agent, got none for {', '.join(missing)}")
        rows = []
        for name, searcher in self._searchers.items():
            if name in agents:
                rows.append(episodes.checked(searcher, np.asarray(actions[name])[None], 1))
            else:
                space: Any = searcher.action.space
                rows.append(np.zeros((1, *space.shape), space.dtype))
        try:
            before = episodes.step(np.zeros(1, dtype=int), rows)
        except BaseException:
            self.agents = []
            raise
        told = episodes.told
        over, late = bool(told["terminated"][0]), bool(told["truncated"][0])
        asks = {agent: bool(told["asks"][self._searchers[agent].k][0]) for agent in agents}
        terminated = {agent: over or not (asks[agent] or late) for agent in agents}
        truncated = {agent: late and not terminated[agent] for agent in agents}
        rewards = {agent: float(episodes.rewards(self._searchers[agent], before)[0]) for agent in agents}
        self.agents = [agent for agent in agents if not (terminated[agent] or truncated[agent])]
        return self._seen(agents), rewards, terminated, truncated, self._infos(agents)

    def close(self) -> None:
        self._episodes.close()
        self.agents = []
