"""The vector of environments for Stable-Baselines3."""

import numpy as np
import pytest

pytest.importorskip("stable_baselines3")

from rheotaxis.sb3 import VecEnv  # noqa: E402


def test_stable_baselines_learns_with_it(channel):
    from stable_baselines3 import PPO

    env = VecEnv(channel, 4, limit_s=8, plumes=2, reward="progress", searchers_per_plume=2)
    model = PPO("MlpPolicy", env, n_steps=16, batch_size=16, n_epochs=1, seed=1)
    model.learn(64)
    assert model.num_timesteps == 64 and model.ep_info_buffer[0]["l"] == 8


def test_an_end_is_told_as_stable_baselines_wants_it(channel):
    env = VecEnv(channel, 2, limit_s=3, plumes=1, truth=True)
    env.seed(5)
    first = env.reset()
    for _ in range(3):
        seen, rewards, dones, infos = env.step(np.zeros((2, 3), np.float32))
    assert dones.all() and rewards.dtype == np.float32
    for n, info in enumerate(infos):
        assert info["TimeLimit.truncated"] and info["episode"]["l"] == 3
        assert info["t_s"] == 3.0 and "distance_m" in info
        assert not np.array_equal(info["terminal_observation"], seen[n])
    env.seed(5)
    np.testing.assert_array_equal(env.reset(), first)
    assert env.get_attr("render_mode") == [None, None] and env.env_is_wrapped(object) == [False, False]
    env.close()
