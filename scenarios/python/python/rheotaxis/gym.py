"""Environments for Gymnasium: ``Env`` and ``VectorEnv``, and the registered ids ``rheotaxis/<Scenario>-v0``."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

try:
    import gymnasium
    from gymnasium import spaces
    from gymnasium.vector import AutoresetMode
    from gymnasium.vector.utils import batch_space
except ImportError as missing:
    raise ImportError("rheotaxis.Env needs Gymnasium: pip install 'rheotaxis-sim[gym]'") from missing

import numpy as np

from ._episodes import AloneOptions, AnyArray, Episodes, Options, ScenarioLike, Searcher
from ._rheotaxis import Scenario, catalogue

if TYPE_CHECKING:
    from typing_extensions import Unpack


def _one(episodes: Episodes) -> Searcher:
    if len(episodes.searchers) != 1:
        names = ", ".join(searcher.name for searcher in episodes.searchers)
        raise ValueError(f"the scenario has several searchers ({names}): use rheotaxis.ParallelEnv")
    return episodes.searchers[0]


class Env(gymnasium.Env[AnyArray, Any]):
    """One searcher of a scenario, decided for by an agent.

    ``scenario`` is the name of one in the catalogue, a path, a text or a Scenario, with one robot or gantry; its own
    strategy is replaced. The options:

    - ``period_s``: simulated time between two decisions, s (1; of a gantry 0.2).
    - ``limit_s``: longest episode, s; by default the scenario's ``time.limit_s``. Then it is truncated.
    - ``goal_m``: an episode ends with success when the robot has come so near to a source, m, in the truth; by default
      what the scenario's rule of success says, or 10 m. Not with ``declare``.
    - ``declare``: an action may declare a source where the searcher believes to be, which ends the episode. It is a
      success as the scenario defines it. By default only for gantries.
    - ``action``, ``observation``, ``reward``: see ``rheotaxis.actions``, ``.observations`` and ``.rewards``.
    - ``turn_deg``, ``climb_m``, ``speed_m_s``: what 1 means in a continuous action: a turn (60°), a change of depth or
      altitude (1 m), and the least and greatest speed through the water (by default the vehicle's own).
    - ``truth``: whether ``info`` tells the truth: ``truth_m`` (ENU), ``truth_heading_rad``, ``distance_m`` to the nearest
      source and ``closest_m``, the least one so far.
    - ``plumes``: each episode is in one of so many developed plumes, drawn with the environment's seed; they are kept in
      memory and, as by ``run``, on the disk. None: in the plume of the seed itself. ``reset(seed=s)`` then begins the run
      of ``rheotaxis.run(scenario, s)``.
    - ``threads``, ``cache``: as for ``run``.

    The mission ends early (terminated without success) if the vehicle leaves the area too far. After an episode whose
    mission is over, the observation is the last one that the searcher made.

    A copy (``copy.deepcopy``, ``pickle``) is made anew from the options; its episode is made again from its actions, and
    goes on bit by bit as that of the original. Functions among the options must be ones that pickle knows.

    Unknown options and values of a wrong type raise TypeError, values out of range ValueError.
    """

    metadata = {"render_modes": []}

    def __init__(self, scenario: ScenarioLike, **options: Unpack[AloneOptions]) -> None:
        self._episodes = Episodes(scenario, 1, **options)
        self._searcher = _one(self._episodes)
        self.observation_space: spaces.Space[AnyArray] = self._searcher.observation.space
        self.action_space: spaces.Space[Any] = self._searcher.action.space
        self.observation_names = list(self._searcher.observation.names)
        self._over = True

    @property
    def scenario(self) -> Scenario:
        """The scenario in which a controller is asked as an agent is here: for ``run`` with a ``PolicyController``."""
        return self._episodes.scenario

    def _infos(self) -> dict[str, Any]:
        infos: dict[str, Any] = {name: value[0] for name, value in self._episodes.infos(self._searcher).items()}
        infos["success"], infos["t_s"] = bool(infos["success"]), float(infos["t_s"])
        return infos

    def reset(
        self, *, seed: int | None = None, options: dict[str, Any] | None = None
    ) -> tuple[AnyArray, dict[str, Any]]:
        self._over = True
        self._episodes.begin([0], [seed], fresh=True)
        super().reset(seed=None if seed is None else int(seed))
        self._over = False
        return self._episodes.seen(self._searcher)[0], self._infos()

    def step(self, action: Any) -> tuple[AnyArray, float, bool, bool, dict[str, Any]]:
        episodes, searcher = self._episodes, self._searcher
        episodes.ready()
        if self._over:
            raise gymnasium.error.ResetNeeded("the episode is over: reset first")
        actions = episodes.checked(searcher, np.asarray(action)[None], 1)
        try:
            before = episodes.step(np.zeros(1, dtype=int), [actions])
        except BaseException:
            self._over = True
            raise
        told = episodes.told
        terminated, truncated = bool(told["terminated"][0]), bool(told["truncated"][0])
        self._over = terminated or truncated
        reward = float(episodes.rewards(searcher, before)[0])
        return episodes.seen(searcher)[0], reward, terminated, truncated, self._infos()

    def close(self) -> None:
        self._episodes.close()


class VectorEnv(gymnasium.vector.VectorEnv[AnyArray, Any, AnyArray]):
    """Many environments of one scenario, stepped together by threads of their own, without Python's lock.

    The options are those of ``Env``, and:

    - ``num_envs``; ``threads``: 0 means one for each core. The results are the same with any number.
    - ``autoreset_mode``: NEXT_STEP (a step after the end ignores its action and begins the next episode), SAME_STEP, or
      DISABLED (``reset(options={"reset_mask": ...})``).
    - ``searchers_per_plume``: so many environments share a plume, which saves most of the time. A searcher does not move
      the water, so they do not notice each other. An episode that begins later begins in the plume as it is then. It
      follows from the seed of the ocean, the step in which it begins, and the seed of its searcher.

    With one searcher in each plume, environment ``i`` after ``reset(seed=s)`` is ``Env`` after ``reset(seed=s + i)``.

    A vector is copied or pickled before its first reset. Later that raises RuntimeError: it does not keep what its
    episodes were made of.
    """

    def __init__(
        self,
        scenario: ScenarioLike,
        num_envs: int = 1,
        *,
        autoreset_mode: AutoresetMode | str = AutoresetMode.NEXT_STEP,
        searchers_per_plume: int = 1,
        threads: int = 0,
        **options: Unpack[Options],
    ) -> None:
        self.autoreset_mode = AutoresetMode(autoreset_mode)
        self.metadata = {"render_modes": [], "autoreset_mode": self.autoreset_mode}
        self._episodes = Episodes(scenario, num_envs, searchers_per_plume, threads=threads, **options)
        self._searcher = _one(self._episodes)
        self.num_envs = num_envs = self._episodes.n
        self.single_observation_space: spaces.Space[Any] = self._searcher.observation.space
        self.single_action_space: spaces.Space[Any] = self._searcher.action.space
        self.observation_space = batch_space(self.single_observation_space, num_envs)
        self.action_space = batch_space(self.single_action_space, num_envs)
        self.observation_names = list(self._searcher.observation.names)
        self._done = np.ones(num_envs, dtype=bool)

    @property
    def scenario(self) -> Scenario:
        """As of ``Env``."""
        return self._episodes.scenario

    def _infos(self, of: AnyArray) -> dict[str, Any]:
        infos = {}
        for name, value in self._episodes.infos(self._searcher).items():
            infos[name] = value
            infos[f"_{name}"] = of.copy()
        return infos

    def reset(
        self, *, seed: int | Sequence[int | None] | None = None, options: dict[str, Any] | None = None
    ) -> tuple[AnyArray, dict[str, Any]]:
        n = self.num_envs
        seeds: list[int | None]
        if seed is None or isinstance(seed, (int, np.integer)):
            seeds = [None if seed is None else int(seed) + i for i in range(n)]
        elif isinstance(seed, Sequence) and not isinstance(seed, str) or isinstance(seed, np.ndarray):
            seeds = list(seed)
        else:
            raise TypeError(f"seed must be a whole number, or a list of one for each environment, got {seed!r}")
        if len(seeds) != n:
            raise ValueError(f"there must be a seed for each of the {n} environments, got {len(seeds)}")
        mask = np.ones(n, dtype=bool)
        if options and "reset_mask" in options:
            mask = np.asarray(options["reset_mask"])
            if mask.shape != (n,) or mask.dtype != bool or not mask.any():
                raise ValueError(f"reset_mask must be {n} bools, at least one of them true, got {mask!r}")
        envs = np.flatnonzero(mask)
        self._done[envs] = True
        self._episodes.begin(envs, [seeds[env] for env in envs], fresh=bool(mask.all()))
        self._done[envs] = False
        return self._episodes.seen(self._searcher), self._infos(mask)

    def step(self, actions: Any) -> tuple[AnyArray, AnyArray, AnyArray, AnyArray, dict[str, Any]]:
        episodes, searcher, n = self._episodes, self._searcher, self.num_envs
        episodes.ready()
        actions = episodes.checked(searcher, actions, n)
        again = self._done.copy()
        if again.any() and self.autoreset_mode != AutoresetMode.NEXT_STEP:
            raise gymnasium.error.ResetNeeded(f"episodes are over: reset environments {np.flatnonzero(again)} first")
        going = np.flatnonzero(~again)
        rewards = np.zeros(n)
        try:
            before = episodes.step(going, [actions[going]]) if len(going) else episodes.told
            terminated, truncated = episodes.told["terminated"] & ~again, episodes.told["truncated"] & ~again
            rewards[going] = episodes.rewards(searcher, before)[going]
            over = terminated | truncated
            if again.any():
                self._begin(again)
            infos: dict[str, Any] = {}
            if over.any() and self.autoreset_mode == AutoresetMode.SAME_STEP:
                last, told = episodes.seen(searcher), episodes.infos(searcher)
                for env in np.flatnonzero(over):
                    final = {"final_obs": last[env], "final_info": {name: v[env] for name, v in told.items()}}
                    infos = self._add_info(infos, final, int(env))
                self._begin(over)
                over = np.zeros(n, dtype=bool)
        except BaseException:
            self._done[:] = True
            raise
        self._done = over
        infos.update(self._infos(np.ones(n, dtype=bool)))
        return episodes.seen(searcher), rewards, terminated, truncated, infos

    def _begin(self, mask: AnyArray) -> None:
        envs = np.flatnonzero(mask)
        self._episodes.begin(envs, [None] * len(envs), fresh=False)

    def close_extras(self, **kwargs: Any) -> None:
        self._episodes.close()


def _id(name: str) -> str:
    return f"rheotaxis/{''.join(word.capitalize() for word in name.split('_'))}-v0"


def register() -> list[str]:
    """Registers an id for each scenario of the catalogue with one searcher, such as ``rheotaxis/DuckSt-v0``."""
    ids = []
    for name, scenario in catalogue().items():
        if len(scenario["searchers"]) == 1:
            ids.append(_id(name))
            if ids[-1] not in gymnasium.registry:
                gymnasium.register(
                    id=ids[-1],
                    entry_point="rheotaxis.gym:Env",
                    vector_entry_point="rheotaxis.gym:VectorEnv",
                    kwargs={"scenario": name},
                )
    return ids
