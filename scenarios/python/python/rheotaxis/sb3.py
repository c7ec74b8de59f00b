"""Many environments for Stable-Baselines3."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

try:
    from stable_baselines3.common.vec_env import VecEnv as _VecEnv
except ImportError as missing:
    raise ImportError("rheotaxis.sb3 needs Stable-Baselines3: pip install 'rheotaxis-sim[sb3]'") from missing

import numpy as np

from ._episodes import AnyArray, CrowdOptions, ScenarioLike
from ._rheotaxis import Scenario
from .gym import VectorEnv

if TYPE_CHECKING:
    from typing_extensions import Unpack


class VecEnv(_VecEnv):  # type: ignore[misc, unused-ignore]
    """``rheotaxis.VectorEnv`` as Stable-Baselines3 wants it. The options are those of VectorEnv.

    >>> model = PPO("MlpPolicy", rheotaxis.sb3.VecEnv("uniform_channel", 8, reward="progress"))
    """

    def __init__(self, scenario: ScenarioLike, num_envs: int = 1, **options: Unpack[CrowdOptions]) -> None:
        self.vector = VectorEnv(scenario, num_envs, autoreset_mode="SameStep", **options)
        self.render_mode = None
        self._actions: AnyArray | None = None
        self._returns = np.zeros(num_envs)
        self._lengths = np.zeros(num_envs, dtype=int)
        super().__init__(num_envs, self.vector.single_observation_space, self.vector.single_action_space)

    @property
    def scenario(self) -> Scenario:
        """As of ``rheotaxis.Env``."""
        return self.vector.scenario

    def reset(self) -> AnyArray:
        seeds = [None if seed is None else int(seed) for seed in self._seeds]
        seen, _ = self.vector.reset(seed=None if seeds[0] is None else seeds)
        self._reset_seeds()
        self._reset_options()
        self._returns[:], self._lengths[:] = 0.0, 0
        return seen

    def step_async(self, actions: AnyArray) -> None:
        self._actions = actions

    def step_wait(self) -> tuple[AnyArray, AnyArray, AnyArray, list[dict[str, Any]]]:
        seen, rewards, terminated, truncated, told = self.vector.step(self._actions)
        self._returns += rewards
        self._lengths += 1
        over = terminated | truncated
        infos: list[dict[str, Any]] = [{} for _ in range(self.num_envs)]
        for env in np.flatnonzero(over):
            last = {name: value[env] for name, value in told["final_info"].items() if not name.startswith("_")}
            infos[env] = {
                **last,
                "terminal_observation": told["final_obs"][env],
                "TimeLimit.truncated": bool(truncated[env] and not terminated[env]),
                "episode": {"r": float(self._returns[env]), "l": int(self._lengths[env]), "t": float(last["t_s"])},
            }
        self._returns[over], self._lengths[over] = 0.0, 0
        return seen, rewards.astype(np.float32), over, infos

    def close(self) -> None:
        self.vector.close()

    def get_attr(self, attr_name: str, indices: Any = None) -> list[Any]:
        return [getattr(self.vector if hasattr(self.vector, attr_name) else self, attr_name) for _ in self._get_indices(indices)]

    def set_attr(self, attr_name: str, value: Any, indices: Any = None) -> None:
        raise AttributeError(f"the environments share one object, so none has {attr_name} of its own to set")

    def env_method(self, method_name: str, *args: Any, indices: Any = None, **kwargs: Any) -> list[Any]:
        raise AttributeError(f"the environments share one object, so none has {method_name} of its own to call")

    def env_is_wrapped(self, wrapper_class: Any, indices: Any = None) -> list[bool]:
        return [False for _ in self._get_indices(indices)]
