"""A trained policy as a controller: what has learned in an environment decides in whole runs."""

from __future__ import annotations

import copy
from typing import Any

import gymnasium
import numpy as np

from ._episodes import AnyArray, Episodes, moved
from ._rheotaxis import _Pilot


class PolicyController:
    """A controller for ``rheotaxis.run`` that sees and does what a policy sees and does in an environment.

    >>> env = rheotaxis.Env("duck_st", period_s=2)
    >>> result = rheotaxis.run(env.scenario, seed=7, controllers=rheotaxis.PolicyController(model, env))

    ``policy`` is a function from an observation to an action, or a model of Stable-Baselines3 (its ``predict``, without
    exploring). ``env`` says what both mean: an ``Env``, ``VectorEnv``, ``ParallelEnv`` or ``sb3.VecEnv``, of which the
    options are taken, and nothing else. Its ``scenario`` is its own one with the strategy ``External`` for all
    searchers, asked once a period; any other scenario whose searchers are alike and asked as often does as well.

    The observations and orders are made by the same code as in the environment, so the run makes the decisions of an
    episode in the same plume: with ``plumes=None``, that of ``env.reset(seed=s)`` is the beginning of the run of seed
    ``s``. The run does not end at the environment's goal but as its scenario says.

    It can be used for several searchers and runs, also at once: each begins anew. It pickles if the policy does.
    """

    def __init__(self, policy: Any, env: Any) -> None:
        predict = getattr(policy, "predict", None)
        if predict is None and not callable(policy):
            raise TypeError(f"a policy must be a function or have a method `predict`, got {type(policy).__name__}")
        self._policy = policy
        self._episodes = _episodes_of(env).alone()

    def __repr__(self) -> str:
        return f"<rheotaxis.PolicyController {self._policy!r}>"

    def _act(self, seen: AnyArray) -> Any:
        if hasattr(self._policy, "predict"):
            return self._policy.predict(seen, deterministic=True)[0]
        return self._policy(seen)

    def _pilot(self, name: str, period_s: float | None) -> _Pilot:
        """What decides for one searcher of one run that begins."""
        episodes = self._episodes
        found = [searcher for searcher in episodes.searchers if searcher.name == name]
        if not found:
            names = ", ".join(searcher.name for searcher in episodes.searchers)
            raise ValueError(f"the policy's environment has no searcher {name}; it has {names}")
        if period_s is not None and abs(period_s - episodes.period_s) > 1e-9 * episodes.period_s:
            raise ValueError(
                f"{name} asks every {period_s} s, and the policy's environment every {episodes.period_s} s: run "
                "`env.scenario`, or give the environment the same period_s"
            )
        searcher = copy.copy(found[0])
        searcher.action = copy.deepcopy(searcher.action)
        only = np.zeros(1, dtype=int)
        searcher.action.begin(only)

        def decide(state: AnyArray) -> bytes:
            action = self._act(searcher.observation.of(state)[0])
            checked = episodes.checked(searcher, np.asarray(action)[None], 1)
            return np.ascontiguousarray(moved(searcher, only, state, checked)).tobytes()

        return episodes.batch.pilot(searcher.k, decide)


def _episodes_of(env: Any) -> Episodes:
    """Those of an environment, without wrappers; one that changes observations or actions is refused."""
    vector = gymnasium.vector
    changing = (
        *(gymnasium.ObservationWrapper, gymnasium.ActionWrapper),
        *(vector.VectorObservationWrapper, vector.VectorActionWrapper),
    )
    while isinstance(env, (gymnasium.Wrapper, vector.VectorWrapper)):
        if isinstance(env, changing):
            raise ValueError(f"{type(env).__name__} changes observations or actions: do that in the policy")
        env = env.env
    own = getattr(getattr(env, "vector", env), "_episodes", None)
    if not isinstance(own, Episodes):
        raise TypeError(f"env must be an environment of rheotaxis, got {type(env).__name__}")
    return own
