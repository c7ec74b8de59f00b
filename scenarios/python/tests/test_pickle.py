"""Results and environments that are copied and sent to other processes."""

import copy
import multiprocessing
import pickle
from concurrent.futures import ProcessPoolExecutor
from functools import partial

import gymnasium
import numpy as np
import pytest
from test_run import golden

import rheotaxis

OPTIONS = {"limit_s": 12, "plumes": 2, "truth": True}
WAYS = [copy.deepcopy, lambda value: pickle.loads(pickle.dumps(value))]


def episode(env, n):
    """What n steps of a policy that looks at its observation give."""
    rows = []
    for _ in range(n):
        seen, reward, terminated, truncated, info = env.step(int(env.observation_space.shape[0] % 2))
        rows.append([*seen, reward, terminated, truncated, *info["truth_m"], info["t_s"]])
    return np.array(rows)


@pytest.mark.parametrize("way", WAYS)
def test_a_result_keeps_all_it_has(channel, tmp_path, way):
    result = rheotaxis.run(channel.with_({"time.limit_s": 10}), files=tmp_path / "run")
    twin = way(result)
    for name in ("outcome", "success", "digest", "t_s", "steps", "files", "summary", "declarations", "figures"):
        assert getattr(twin, name) == getattr(result, name), name
    assert repr(twin) == repr(result) and twin.probes == {}
    assert twin.track.keys() == result.track.keys() == {"auv0"}
    for name, column in result.track["auv0"].items():
        assert twin.track["auv0"][name].dtype == column.dtype
        np.testing.assert_array_equal(twin.track["auv0"][name], column, err_msg=name)
    for name in result.figures:
        assert twin.plot(name).svg == result.plot(name).svg
    assert twin._repr_png_() == result._repr_png_()
    figure = way(twin.plot())
    assert (figure.name, figure.title, figure.svg) == ("map", twin.plot().title, twin.plot().svg)
    with pytest.raises(KeyError, match="it has map"):
        twin.plot("sidescan")
    # An array belongs to its owner, also that of a copy, and a copy can be copied.
    twin.track["auv0"]["t_s"][:] = 0
    assert way(twin).track["auv0"]["t_s"][-1] > 0


def test_a_result_of_a_gantry_keeps_its_probes():
    flume = rheotaxis.Scenario.load("flume_crab").with_({"time.limit_s": 4, "time.spin_up_s": 2})
    result = rheotaxis.run(flume)
    twin = pickle.loads(pickle.dumps(result))
    (name,) = result.probes
    for column, values in result.probes[name].items():
        np.testing.assert_array_equal(twin.probes[name][column], values)
    assert twin.plot().svg == result.plot().svg


def test_a_pool_of_processes_maps_runs_over_seeds(channel):
    with ProcessPoolExecutor(2, mp_context=multiprocessing.get_context("spawn")) as pool:
        runs = list(pool.map(partial(rheotaxis.run, channel, threads=1), [1, 2]))
    assert [(run.steps, run.digest) for run in runs] == [golden("uniform_channel", seed) for seed in (1, 2)]
    assert all(run.plot().svg.startswith("<svg") for run in runs)


@pytest.mark.parametrize("way", WAYS)
@pytest.mark.parametrize("steps", [None, 0, 5, 12])
def test_a_copy_of_an_environment_goes_on_as_it_does(channel, way, steps):
    env = rheotaxis.Env(channel, **OPTIONS, action="surge_cast")
    if steps is not None:
        env.reset(seed=3)
        episode(env, steps)
    twin = way(env)
    if steps in (None, 12):
        with pytest.raises(gymnasium.error.ResetNeeded):
            twin.step(0)
    else:
        np.testing.assert_array_equal(episode(env, 7), episode(twin, 7))
    # The next episode follows from the same generator.
    if steps is not None:
        np.testing.assert_array_equal(env.reset()[0], twin.reset()[0])
    env.close()
    again, _ = twin.reset(seed=4)
    np.testing.assert_array_equal(again, rheotaxis.Env(channel, **OPTIONS, action="surge_cast").reset(seed=4)[0])


def test_a_copy_moves_nothing_of_the_original(channel):
    env = rheotaxis.Env(channel, **OPTIONS, action="surge_cast")
    env.reset(seed=3)
    twin = copy.deepcopy(env)
    for _ in range(4):
        twin.step(0)
    alone = rheotaxis.Env(channel, **OPTIONS, action="surge_cast")
    alone.reset(seed=3)
    np.testing.assert_array_equal(episode(env, 6), episode(alone, 6))


def test_a_closed_environment_stays_closed(channel):
    env = rheotaxis.Env(channel, **OPTIONS)
    env.close()
    with pytest.raises(RuntimeError, match="closed"):
        pickle.loads(pickle.dumps(env)).reset(seed=1)


def test_a_registered_environment_is_copied():
    env = gymnasium.make("rheotaxis/UniformChannel-v0", limit_s=5)
    twin = copy.deepcopy(env)
    assert twin.observation_space == env.observation_space and twin.unwrapped is not env.unwrapped


@pytest.mark.parametrize("way", WAYS)
def test_a_vector_is_copied_before_its_first_reset(channel, way):
    env = rheotaxis.VectorEnv(channel, 2, threads=2, **OPTIONS)
    twin = way(env)
    first, _ = env.reset(seed=1)
    np.testing.assert_array_equal(first, twin.reset(seed=1)[0])
    with pytest.raises(RuntimeError, match="2 environments with episodes are not copied.*before their first reset"):
        way(env)
    # What the attempt has not touched goes on.
    np.testing.assert_array_equal(env.step(np.zeros((2, 3)))[0], twin.step(np.zeros((2, 3)))[0])


def test_several_searchers_are_copied_with_their_episode(channel):
    pytest.importorskip("pettingzoo")
    robot = channel["robots.0"]
    other = {**robot, "id": "auv1", "start": {**robot["start"], "north_m": 30.0}}
    env = rheotaxis.ParallelEnv(channel.with_({"robots": [robot, other]}), limit_s=10, plumes=1)
    env.reset(seed=1)
    actions = {"auv0": np.array([1, 0, 0]), "auv1": np.array([-1, 0, 0])}
    env.step(actions)
    twin = pickle.loads(pickle.dumps(env))
    assert twin.agents == env.agents
    for _ in range(3):
        here, there = env.step(actions), twin.step(actions)
        for agent in env.agents:
            np.testing.assert_array_equal(here[0][agent], there[0][agent])
