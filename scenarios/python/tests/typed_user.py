"""What a user's program does with the package, for `mypy --strict` (test_typing.py). It is checked, not run."""

from __future__ import annotations

from concurrent.futures import ProcessPoolExecutor
from functools import partial
from pathlib import Path
from typing import Any

import gymnasium
import numpy as np
import numpy.typing as npt
from typing_extensions import assert_type

import rheotaxis
from rheotaxis import actions, observations, rewards
from rheotaxis.sb3 import VecEnv


def up_flow(asked: dict[str, Any]) -> dict[str, Any] | None:
    return {"steer": {"heading_rad": 1.0, "speed_m_s": 1.5}} if "flow" in asked else None


def runs() -> None:
    scenario = rheotaxis.Scenario.load(Path("uniform_channel.ron"))
    assert_type(scenario.with_({"time.limit_s": 60, "success": rheotaxis.Ron("Completed")}), rheotaxis.Scenario)
    assert_type(scenario.check(), list[str])
    result = rheotaxis.run(scenario, seed=1, controllers={"auv0": up_flow}, files=Path("runs"), cache=False)
    assert_type(result, rheotaxis.Result)
    assert_type(result.files, Path | None)
    east_m: npt.NDArray[Any] = result.track["auv0"]["east_m"]
    assert_type(result.t_s + float(east_m[0]), float)
    assert_type(result.plot("map").svg, str)
    assert_type(rheotaxis.explain("time"), str)
    assert_type(rheotaxis.__version__, str)
    with ProcessPoolExecutor() as pool:
        for one in pool.map(partial(rheotaxis.run, scenario), range(4)):
            assert_type(one, rheotaxis.Result)
    try:
        rheotaxis.Scenario.parse("()")
    except rheotaxis.ScenarioError as error:
        assert_type(error.faults, list[dict[str, Any]])


def reward(step: rewards.Step) -> npt.NDArray[np.float64]:
    return rewards.sparse(step) - 1.0


class Slow(actions.Continuous):
    def moves(self, envs: npt.NDArray[Any], obs: npt.NDArray[Any], given: npt.NDArray[Any]) -> npt.NDArray[Any]:
        return super().moves(envs, obs, given) / 2


def environments() -> None:
    env = rheotaxis.Env("uniform_channel", limit_s=60, reward=reward, action=Slow, observation=observations.Reading)
    seen, info = env.reset(seed=1)
    assert_type(info, dict[str, Any])
    seen, paid, terminated, truncated, info = env.step(env.action_space.sample())
    assert_type(paid, float)
    assert_type(terminated or truncated, bool)
    assert_type(env.observation_names, list[str])
    assert_type(env.scenario, rheotaxis.Scenario)
    generic: gymnasium.Env[npt.NDArray[Any], Any] = env
    generic.close()

    envs = rheotaxis.VectorEnv("uniform_channel", 4, searchers_per_plume=2, autoreset_mode="SameStep", threads=2)
    rows, _ = envs.reset(seed=[1, 2, 3, 4])
    rows, paid_all, ended, late, infos = envs.step(envs.action_space.sample())
    assert_type(paid_all, npt.NDArray[Any])

    several = rheotaxis.ParallelEnv("four_maps", limit_s=10)
    everyone, _ = several.reset(seed=1)
    assert_type(everyone, dict[str, npt.NDArray[Any]])
    training = VecEnv("uniform_channel", 8, reward="progress")
    assert_type(training.vector, rheotaxis.VectorEnv)


def policy(seen: npt.NDArray[Any]) -> npt.NDArray[np.float32]:
    return np.zeros(3, np.float32)


def policies() -> None:
    env = rheotaxis.Env("duck_st", period_s=2)
    decides = rheotaxis.PolicyController(policy, env)
    rheotaxis.run(env.scenario, controllers=decides)
    functions = {"auv0": up_flow}
    rheotaxis.run(env.scenario, controllers={"auv0": decides})
    rheotaxis.run(env.scenario, controllers=functions)
