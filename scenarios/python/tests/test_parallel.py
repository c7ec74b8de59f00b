"""`ParallelEnv`: several searchers of one scenario."""

import numpy as np
import pytest
from pettingzoo.test import parallel_api_test, parallel_seed_test

import rheotaxis


@pytest.fixture
def two(channel):
    """The channel with two vehicles, which start on both sides of the plume."""
    robot = channel["robots.0"]
    other = {**robot, "id": "auv1", "start": {**robot["start"], "north_m": 30.0}}
    return channel.with_({"robots": [robot, other]})


def test_pettingzoo_accepts_it(two):
    env = rheotaxis.ParallelEnv(two, limit_s=10, plumes=2)
    parallel_api_test(env, num_cycles=40)
    parallel_seed_test(lambda: rheotaxis.ParallelEnv(two, limit_s=10, plumes=2), num_cycles=12)


def test_each_agent_sees_and_moves_its_own_vehicle(two):
    env = rheotaxis.ParallelEnv(two, limit_s=10, plumes=1, truth=True)
    assert env.possible_agents == ["auv0", "auv1"]
    assert env.observation_space("auv0") is env.observation_space("auv0")
    seen, infos = env.reset(seed=1)
    assert infos["auv0"]["truth_m"][1] == pytest.approx(-30, abs=1)
    assert infos["auv1"]["truth_m"][1] == pytest.approx(30, abs=1)
    actions = {"auv0": np.array([1, 0, 0]), "auv1": np.array([-1, 0, 0])}
    for _ in range(3):
        seen, rewards, terminated, truncated, infos = env.step(actions)
    sine = 8
    assert seen["auv0"][sine] > 0.1 > -0.1 > seen["auv1"][sine]
    assert not any(terminated.values()) and not any(truncated.values())
    with pytest.raises(ValueError, match="got none for auv1"):
        env.step({"auv0": actions["auv0"]})
    for _ in range(7):
        seen, rewards, terminated, truncated, infos = env.step(actions)
    assert all(truncated.values()) and env.agents == []


def test_who_declares_leaves_and_the_other_goes_on(two):
    env = rheotaxis.ParallelEnv(two, limit_s=10, plumes=1, declare=True)
    env.reset(seed=1)
    on, declare = np.zeros(4), np.array([0, 0, 0, 1])
    _, _, terminated, _, _ = env.step({"auv0": declare, "auv1": on})
    assert terminated == {"auv0": True, "auv1": False} and env.agents == ["auv1"]
    _, _, terminated, _, _ = env.step({"auv1": on})
    assert terminated == {"auv1": False}
    _, _, terminated, _, _ = env.step({"auv1": declare})
    assert terminated == {"auv1": True} and env.agents == []
