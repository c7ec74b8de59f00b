"""Episodes of many environments: seeds, actions, observations and rewards. Env, VectorEnv and ParallelEnv share it."""

from __future__ import annotations

from typing import Any

import numpy as np

from . import actions as _actions
from . import observations as _observations
from . import rewards as _rewards
from ._rheotaxis import _Batch

#: How near to a source counts as reaching it if the scenario does not say, m.
GOAL_M = 10.0


def _kind(kinds: dict, value: Any, name: str) -> Any:
    if callable(value):
        return value
    if value not in kinds:
        raise ValueError(f"{name} must be one of {', '.join(kinds)}, got {value!r}")
    return kinds[value]


class Searcher:
    """A searcher of the scenario: its spaces, and what its numbers mean."""

    def __init__(self, k, n, name, space, declare, action, observation):
        gantry, self.numbers, features = space
        self.k, self.name = k, name
        self.names = [feature for feature, _, _ in features]
        if gantry and action != "continuous":
            raise ValueError(f"{name} is a gantry, which has continuous actions only, got {action!r}")
        self.action = _kind(_actions.KINDS, action, "action")(n, self.numbers, declare)
        self.observation = _kind(_observations.KINDS, observation, "observation")(gantry, features)


class Episodes:
    """Environments of one scenario, numbered from 0."""

    def __init__(
        self,
        scenario,
        n: int,
        per_plume: int = 1,
        *,
        period_s: float | None = None,
        limit_s: float | None = None,
        goal_m: float | None = None,
        declare: bool | None = None,
        action: str = "continuous",
        observation: str = "state",
        reward="sparse",
        truth: bool = False,
        plumes: int | None = 16,
        turn_deg: float = 60.0,
        climb_m: float = 1.0,
        speed_m_s: tuple[float, float] | None = None,
        threads: int = 1,
        cache=None,
    ) -> None:
        from . import Scenario

        if not isinstance(scenario, Scenario):
            text = isinstance(scenario, str) and ("\n" in scenario or scenario.lstrip().startswith("("))
            scenario = Scenario.parse(scenario) if text else Scenario.load(scenario)
        gantries = bool(scenario["gantries"]) and not scenario["robots"]
        declare = gantries if declare is None else declare
        if plumes is not None and plumes < 1:
            raise ValueError(f"plumes must be at least 1, or None for a plume of each seed, got {plumes}")
        if not declare and goal_m is None:
            success = scenario["success"]
            rule = next(iter(success.values())) if isinstance(success, dict) else {}
            goal_m = rule.get("within_m", GOAL_M)
        self.n, self.truth, self.plumes = n, truth, plumes
        self.batch = _Batch(
            scenario,
            n=n,
            per_plume=per_plume,
            period_s=(0.2 if gantries else 1.0) if period_s is None else period_s,
            limit_s=limit_s,
            goal_m=None if declare else goal_m,
            declare=declare,
            # Courses are anywhere: a discrete action may turn by half a circle.
            turn_deg=turn_deg if action == "continuous" else 180.0,
            climb_m=climb_m,
            speed_m_s=speed_m_s,
            kept_plumes=max(plumes or 0, n // per_plume, 16),
            threads=threads,
            cache=cache,
        )
        self.dt = (1.0 if period_s is None and not gantries else period_s or 0.2) / self.batch.limit_s
        self.reward = _kind(_rewards.KINDS, reward, "reward")
        named = zip(self.batch.agents, self.batch.spaces, strict=True)
        self.searchers = [
            Searcher(k, n, name, space, declare, action, observation) for k, (name, space) in enumerate(named)
        ]
        self.rngs: list[np.random.Generator | None] = [None] * n
        self.begin_m = np.ones((len(self.searchers), n))
        self.told: dict[str, Any] = {}
        self.closed = False

    def ready(self) -> None:
        """Raises if the environments are closed."""
        if self.closed:
            raise RuntimeError("the environment is closed: make another")

    def begin(self, envs, seeds, fresh: bool) -> None:
        """Begins episodes in some environments. ``seeds`` are numbers, or None to go on with those of before."""
        self.ready()
        asked = []
        for env, seed in zip(envs, seeds, strict=True):
            if seed is not None:
                if not isinstance(seed, (int, np.integer)) or seed < 0:
                    raise ValueError(f"a seed is a whole number from 0, got {seed!r}")
                self.rngs[env] = np.random.default_rng(seed)
            elif self.rngs[env] is None:
                self.rngs[env] = np.random.default_rng()
            rng = self.rngs[env]
            if self.plumes is not None:
                own = int(rng.integers(2**31))
                ocean = 1 + int(rng.integers(self.plumes))
            else:
                own = ocean = int(seed) if seed is not None else int(rng.integers(2**31))
            asked.append((int(env), ocean, own))
        self.batch.reset(asked, fresh)
        self.told = self.batch.look()
        envs = np.asarray(envs)
        for searcher in self.searchers:
            searcher.action.begin(envs)
            self.begin_m[searcher.k, envs] = np.maximum(self.told["truth"][searcher.k][envs, 4], 1e-9)

    def step(self, envs: np.ndarray, actions: list[np.ndarray]) -> dict[str, Any]:
        """Carries out actions, a row for each environment and an array for each searcher."""
        self.ready()
        moves = []
        for searcher, action in zip(self.searchers, actions, strict=True):
            state = self.told["obs"][searcher.k][envs]
            moves.append(np.asarray(searcher.action.moves(envs, state, action), dtype=np.float64))
        numbers = np.ascontiguousarray(np.concatenate(moves, axis=1))
        before = self.told
        self.batch.step(envs.tolist(), numbers.tobytes())
        self.told = self.batch.look()
        return before

    def checked(self, searcher: Searcher, actions, n: int) -> np.ndarray:
        """Actions of some environments; ValueError if they are none."""
        space = searcher.action.space
        whole = not hasattr(space, "low")
        shape = (n,) if whole else (n, *space.shape)
        actions = np.asarray(actions)
        if actions.shape != shape:
            raise ValueError(f"the actions of {searcher.name} must have the shape {shape}, got {actions.shape}")
        if whole:
            if not np.issubdtype(actions.dtype, np.integer) or (n and not (0 <= actions.min() <= actions.max() < space.n)):
                raise ValueError(f"an action of {searcher.name} is a whole number from 0 to {space.n - 1}, got {actions}")
        elif not (np.issubdtype(actions.dtype, np.number) and np.isfinite(actions).all()):
            raise ValueError(f"the actions of {searcher.name} must be finite numbers, got {actions}")
        return actions

    def seen(self, searcher: Searcher) -> np.ndarray:
        """The newest observations of all environments."""
        return searcher.observation.of(self.told["obs"][searcher.k])

    def rewards(self, searcher: Searcher, before: dict[str, Any]) -> np.ndarray:
        """Rewards of all environments for the step since ``before``."""
        k = searcher.k
        return self.reward(
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
