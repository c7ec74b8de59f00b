"""Episodes of many environments: seeds, actions, observations and rewards. Env, VectorEnv and ParallelEnv share it."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from os import PathLike
from typing import Any, TypeAlias, TypedDict

import numpy as np
import numpy.typing as npt

from . import actions as _actions
from . import observations as _observations
from . import rewards as _rewards
from ._options import kind, number, positive, speeds, switch, whole
from ._rheotaxis import Scenario, _Batch
from ._ron import Ron

#: How near to a source counts as reaching it if the scenario does not say, m.
GOAL_M = 10.0
#: Most environments, plumes and threads.
MOST, MOST_THREADS = 65_536, 1024

AnyArray: TypeAlias = npt.NDArray[Any]
ScenarioLike: TypeAlias = "str | PathLike[str] | Scenario"
Told: TypeAlias = "dict[str, Any]"


class Options(TypedDict, total=False):
    """The options of all kinds of environments, by keyword; ``Env`` says what they mean."""

    period_s: float | None
    limit_s: float | None
    goal_m: float | None
    declare: bool | None
    action: str | Callable[..., Any]
    observation: str | Callable[..., Any]
    reward: str | Callable[..., Any]
    truth: bool
    plumes: int | None
    turn_deg: float
    climb_m: float
    speed_m_s: tuple[float, float] | None
    cache: bool | str | PathLike[str] | None
    render_mode: None


class AloneOptions(Options, total=False):
    """Those of one environment."""

    threads: int


class CrowdOptions(AloneOptions, total=False):
    """Those of many."""

    searchers_per_plume: int


class Searcher:
    """A searcher of the scenario: its spaces, and what its numbers mean."""

    def __init__(
        self,
        k: int,
        n: int,
        name: str,
        space: tuple[bool, int, list[tuple[str, float, float]]],
        declare: bool,
        action: str | Callable[..., Any],
        observation: str | Callable[..., Any],
    ) -> None:
        gantry, self.numbers, features = space
        self.k, self.name = k, name
        self.names = [feature for feature, _, _ in features]
        if gantry and action != "continuous":
            raise ValueError(f"{name} is a gantry, which has continuous actions only, got {action!r}")
        self.action: _actions.Action = kind("action", action, _actions.KINDS)(n, self.numbers, declare)
        self.observation: _observations.Observation = kind("observation", observation, _observations.KINDS)(gantry, features)


class Episodes:
    """Environments of one scenario, numbered from 0.

    A copy, by ``copy.deepcopy`` or ``pickle``, makes its engine anew. That of one environment repeats the actions of
    its episode under way, which brings it to the same state, bit by bit. Those of several keep no such list.
    """

    def __init__(
        self,
        scenario: ScenarioLike,
        n: int,
        per_plume: int = 1,
        *,
        period_s: float | None = None,
        limit_s: float | None = None,
        goal_m: float | None = None,
        declare: bool | None = None,
        action: str | Callable[..., Any] = "continuous",
        observation: str | Callable[..., Any] = "state",
        reward: str | Callable[..., Any] = "sparse",
        truth: bool = False,
        plumes: int | None = 16,
        turn_deg: float = 60.0,
        climb_m: float = 1.0,
        speed_m_s: tuple[float, float] | None = None,
        threads: int = 1,
        cache: bool | str | PathLike[str] | None = None,
        render_mode: None = None,
    ) -> None:
        if render_mode is not None:
            raise ValueError(f"render_mode must be None, for an environment draws nothing, got {render_mode!r}")
        if not isinstance(scenario, Scenario):
            text = isinstance(scenario, str) and ("\n" in scenario or scenario.lstrip().startswith("("))
            scenario = Scenario.parse(str(scenario)) if text else Scenario.load(scenario)
        gantries = bool(scenario["gantries"]) and not scenario["robots"]
        declare = gantries if declare is None else switch("declare", declare)
        n = whole("num_envs", n, 1, MOST)
        per_plume = whole("searchers_per_plume", per_plume, 1, MOST)
        plumes = None if plumes is None else whole("plumes", plumes, 1, MOST)
        if goal_m is not None:
            goal_m = positive("goal_m", goal_m)
        elif not declare:
            success = scenario["success"]
            rule = next(iter(success.values())) if isinstance(success, dict) else {}
            goal_m = rule.get("within_m", GOAL_M)
        self.period_s = (0.2 if gantries else 1.0) if period_s is None else number("period_s", period_s)
        turn_deg = positive("turn_deg", turn_deg)
        self.n, self.truth, self.plumes = n, switch("truth", truth), plumes
        self.made: dict[str, Any] = {
            "scenario": scenario,
            "n": n,
            "per_plume": per_plume,
            "period_s": self.period_s,
            "limit_s": None if limit_s is None else positive("limit_s", limit_s),
            "goal_m": None if declare else goal_m,
            "declare": declare,
            # Courses are anywhere: a discrete action may turn by half a circle.
            "turn_deg": turn_deg if action == "continuous" else 180.0,
            "climb_m": positive("climb_m", climb_m),
            "speed_m_s": None if speed_m_s is None else speeds("speed_m_s", speed_m_s),
            "kept_plumes": max(plumes or 0, n // per_plume, 16),
            "threads": whole("threads", threads, 0, MOST_THREADS),
            "cache": cache,
        }
        self.batch = _Batch(**self.made)
        self.dt = self.period_s / self.batch.limit_s
        named = zip(self.batch.agents, self.batch.spaces, strict=True)
        self.searchers = [
            Searcher(k, n, name, space, declare, action, observation) for k, (name, space) in enumerate(named)
        ]
        self.reward = kind("reward", reward, _rewards.KINDS)
        if self.reward is _rewards.hits and any("hits" not in searcher.names for searcher in self.searchers):
            raise ValueError("a gantry has no share of hits: use reward='sparse', 'time' or 'progress'")
        self.rngs: list[np.random.Generator | None] = [None] * n
        self.begin_m = np.ones((len(self.searchers), n))
        self.told: Told = {}
        self.closed = False
        #: How the only environment began its episode, and the actions since then.
        self.began: list[tuple[int, int, int]] = []
        self.acted: list[bytes] = []

    def __getstate__(self) -> dict[str, Any]:
        if self.told and self.n > 1 and not self.closed:
            raise RuntimeError(
                f"{self.n} environments with episodes are not copied, nor sent to another process: copy them before "
                "their first reset, or make them there; Env is copied with its episode"
            )
        return {name: value for name, value in self.__dict__.items() if name != "batch"}

    def __setstate__(self, state: dict[str, Any]) -> None:
        self.__dict__.update(state)
        if self.closed:
            return
        self.batch = _Batch(**self.made)
        over = bool(self.told) and bool(self.told["terminated"][0] or self.told["truncated"][0])
        if self.began and not over:
            self.batch.reset(self.began, True)
            for numbers in self.acted:
                self.batch.step([0], numbers)

    def alone(self) -> Episodes:
        """One environment with the same options, and no episode."""
        self.ready()
        twin = object.__new__(Episodes)
        twin.__dict__.update(self.__dict__)
        twin.n, twin.made = 1, {**self.made, "n": 1, "per_plume": 1, "threads": 1}
        twin.rngs, twin.told, twin.began, twin.acted = [None], {}, [], []
        twin.batch = _Batch(**twin.made)
        return twin

    @property
    def scenario(self) -> Scenario:
        """The scenario in which controllers do what agents do here: asked as often, for as long."""
        scenario: Scenario = self.made["scenario"]
        external = Ron(f"External(period_s: {self.period_s!r})")
        robots = {f"robots.{k}.strategy": external for k in range(len(scenario["robots"]))}
        gantries = {f"gantries.{k}.tracker": external for k in range(len(scenario["gantries"]))}
        return scenario.with_({**robots, **gantries, "time.limit_s": self.batch.limit_s})

    def ready(self) -> None:
        """Raises if the environments are closed."""
        if self.closed:
            raise RuntimeError("the environment is closed: make another")

    def begin(self, envs: Iterable[int], seeds: Iterable[int | None], fresh: bool) -> None:
        """Begins episodes in some environments. ``seeds`` are numbers, or None to go on with those of before."""
        self.ready()
        asked = []
        envs = np.asarray(envs)
        for env, seed in zip(envs, seeds, strict=True):
            if seed is not None:
                if isinstance(seed, bool) or not isinstance(seed, (int, np.integer)):
                    raise TypeError(f"a seed is a whole number from 0, got {seed!r}")
                if not 0 <= seed < 2**64:
                    raise ValueError(f"a seed is a whole number from 0 to 2**64 - 1, got {seed}")
                self.rngs[env] = np.random.default_rng(seed)
            rng = self.rngs[env]
            if rng is None:
                rng = self.rngs[env] = np.random.default_rng()
            if self.plumes is not None:
                own = int(rng.integers(2**31))
                ocean = 1 + int(rng.integers(self.plumes))
            else:
                own = ocean = int(seed) if seed is not None else int(rng.integers(2**31))
            asked.append((int(env), ocean, own))
        self.began, self.acted = [], []
        self.batch.reset(asked, fresh)
        if self.n == 1:
            self.began = asked
        self.told = self.batch.look()
        for searcher in self.searchers:
            searcher.action.begin(envs)
            self.begin_m[searcher.k, envs] = np.maximum(self.told["truth"][searcher.k][envs, 4], 1e-9)

    def step(self, envs: AnyArray, actions: list[AnyArray]) -> Told:
        """Carries out actions, a row for each environment and an array for each searcher."""
        self.ready()
        moves = []
        for searcher, action in zip(self.searchers, actions, strict=True):
            moves.append(moved(searcher, envs, self.told["obs"][searcher.k][envs], action))
        numbers = np.ascontiguousarray(np.concatenate(moves, axis=1)).tobytes()
        before = self.told
        try:
            self.batch.step(envs.tolist(), numbers)
        except BaseException:
            self.began = []
            raise
        if self.n == 1:
            self.acted.append(numbers)
        self.told = self.batch.look()
        return before

    def checked(self, searcher: Searcher, given: Any, n: int) -> AnyArray:
        """Actions of some environments; ValueError if they are none."""
        space: Any = searcher.action.space
        whole = not hasattr(space, "low")
        shape = (n,) if whole else (n, *space.shape)
        actions: AnyArray = np.asarray(given)
        if actions.shape != shape:
            raise ValueError(f"the actions of {searcher.name} must have the shape {shape}, got {actions.shape}")
        if whole:
            if not np.issubdtype(actions.dtype, np.integer) or (n and not (0 <= actions.min() <= actions.max() < space.n)):
                raise ValueError(f"an action of {searcher.name} is a whole number from 0 to {space.n - 1}, got {actions}")
        elif not (np.issubdtype(actions.dtype, np.number) and np.isfinite(actions).all()):
            raise ValueError(f"the actions of {searcher.name} must be finite numbers, got {actions}")
        return actions

    def seen(self, searcher: Searcher) -> AnyArray:
        """The newest observations of all environments."""
        return searcher.observation.of(self.told["obs"][searcher.k])

    def rewards(self, searcher: Searcher, before: Told) -> AnyArray:
        """Rewards of all environments for the step since ``before``."""
        k = searcher.k
        return np.asarray(
            self.reward(
                {
                    "success": self.told["success"],
                    "distance_before_m": before["truth"][k][:, 4],
                    "distance_m": self.told["truth"][k][:, 4],
                    "distance_begin_m": self.begin_m[k],
                    "state": self.told["obs"][k],
                    "names": searcher.names,
                    "dt": self.dt,
                }
            )
        )

    def infos(self, searcher: Searcher) -> dict[str, Any]:
        """What is told beside the observations, an array of all environments each."""
        told = self.told
        infos = {"success": told["success"], "t_s": told["t_s"]}
        if self.truth:
            truth = told["truth"][searcher.k]
            infos["truth_m"] = truth[:, :3]
            infos["truth_heading_rad"] = truth[:, 3]
            infos["distance_m"] = truth[:, 4]
            infos["closest_m"] = truth[:, 5]
        return infos

    def close(self) -> None:
        """Lets go of everything."""
        if not self.closed:
            self.closed = True
            del self.batch


def moved(searcher: Searcher, envs: AnyArray, state: AnyArray, actions: AnyArray) -> npt.NDArray[np.float64]:
    """The numbers that a searcher's actions mean in some environments."""
    return np.asarray(searcher.action.moves(envs, state, actions), dtype=np.float64)
