"""`VectorEnv`: many environments at once, and what threads and processes do to them."""

import multiprocessing
import os
import signal
import threading

import gymnasium
import numpy as np
import pytest
from gymnasium.vector import AutoresetMode

import rheotaxis

OPTIONS = {"limit_s": 5, "plumes": 2}


def steps(env, n, seed=1):
    """What n random steps give: observations, rewards, ends."""
    env.reset(seed=seed)
    env.action_space.seed(seed)
    out = [env.step(env.action_space.sample()) for _ in range(n)]
    return [np.array(column) for column in list(zip(*out, strict=True))[:4]]


@pytest.mark.parametrize("mode", list(AutoresetMode))
def test_one_row_is_the_environment_of_its_seed(channel, mode):
    vector = rheotaxis.VectorEnv(channel, 3, autoreset_mode=mode, threads=2, **OPTIONS)
    rows, _ = vector.reset(seed=4)
    single = [rheotaxis.Env(channel, **OPTIONS) for _ in range(3)]
    for n, env in enumerate(single):
        np.testing.assert_array_equal(rows[n], env.reset(seed=4 + n)[0])
    vector.action_space.seed(1)
    done = np.zeros(3, bool)
    for _ in range(14):
        actions = vector.action_space.sample()
        if mode == AutoresetMode.DISABLED and done.any():
            with pytest.raises(gymnasium.error.ResetNeeded):
                vector.step(actions)
            rows, infos = vector.reset(options={"reset_mask": done})
            for n in np.flatnonzero(done):
                np.testing.assert_array_equal(rows[n], single[n].reset()[0])
            np.testing.assert_array_equal(infos["_t_s"], done)
        fresh = mode == AutoresetMode.NEXT_STEP
        rows, rewards, terminated, truncated, infos = vector.step(actions)
        for n, env in enumerate(single):
            if fresh and done[n]:
                np.testing.assert_array_equal(rows[n], env.reset()[0])
                assert (rewards[n], terminated[n], truncated[n]) == (0, False, False)
                continue
            seen, reward, end, late, info = env.step(actions[n])
            assert (rewards[n], terminated[n], truncated[n]) == (reward, end, late)
            if mode == AutoresetMode.SAME_STEP and (end or late):
                assert infos["_final_obs"][n] and infos["_final_info"][n]
                np.testing.assert_array_equal(infos["final_obs"][n], seen)
                assert infos["final_info"]["t_s"][n] == info["t_s"] == 5.0
                seen, _ = env.reset()
            np.testing.assert_array_equal(rows[n], seen)
        done = terminated | truncated


@pytest.mark.parametrize("shared", [1, 3])
def test_threads_change_nothing(channel, shared):
    runs = [
        steps(rheotaxis.VectorEnv(channel, 6, searchers_per_plume=shared, threads=threads, **OPTIONS), 12)
        for threads in (1, 2)
    ]
    for one, other in zip(*runs, strict=True):
        np.testing.assert_array_equal(one, other)


def test_searchers_in_one_plume_do_not_notice_each_other(channel):
    alone = steps(rheotaxis.VectorEnv(channel, 1, plumes=1, limit_s=30), 4)
    shared = rheotaxis.VectorEnv(channel, 4, searchers_per_plume=4, plumes=1, limit_s=30)
    shared.reset(seed=1)
    single = rheotaxis.VectorEnv(channel, 1, plumes=1, limit_s=30)
    single.action_space.seed(1)
    for n in range(4):
        actions = shared.action_space.sample()
        actions[0] = single.action_space.sample()[0]
        rows, *_ = shared.step(actions)
        np.testing.assert_array_equal(rows[0], alone[0][n][0])
        assert not np.array_equal(rows[0], rows[1])


def test_episodes_end_and_begin_again_in_a_shared_plume(channel):
    env = rheotaxis.VectorEnv(channel, 4, searchers_per_plume=2, limit_s=3, plumes=2, truth=True)
    seen, _, terminated, truncated = steps(env, 8)
    np.testing.assert_array_equal(np.flatnonzero(truncated.all(axis=1)), [2, 6])
    assert not terminated.any() and np.isfinite(seen).all()


def test_outputs_are_new_arrays(channel):
    env = rheotaxis.VectorEnv(channel, 2, **OPTIONS)
    first, _ = env.reset(seed=1)
    kept = first.copy()
    first[:] = -1
    again, *_ = env.step(np.zeros((2, 3), np.float32))
    assert not np.shares_memory(first, again)
    env.reset(seed=1)
    np.testing.assert_array_equal(env.reset(seed=1)[0], kept)


def test_what_is_no_action_is_refused(channel):
    env = rheotaxis.VectorEnv(channel, 2, **OPTIONS)
    env.reset(seed=1)
    with pytest.raises(ValueError, match=r"must have the shape \(2, 3\), got \(3, 2\)"):
        env.step(np.zeros((3, 2)))
    with pytest.raises(ValueError, match="must be finite numbers"):
        env.step(np.full((2, 3), np.nan))
    with pytest.raises(ValueError, match="a seed for each of the 2 environments"):
        env.reset(seed=[1, 2, 3])
    with pytest.raises(ValueError, match="reset_mask must be 2 bools"):
        env.reset(options={"reset_mask": np.zeros(2, bool)})
    with pytest.raises(ValueError, match="fill their plumes"):
        rheotaxis.VectorEnv(channel, 3, searchers_per_plume=2, **OPTIONS)
    for option, error in [
        ({"num_envs": 10**9}, ValueError),
        ({"num_envs": 0}, ValueError),
        ({"num_envs": 2.0}, TypeError),
        ({"searchers_per_plume": 0}, ValueError),
        ({"searchers_per_plume": "2"}, TypeError),
        ({"autoreset_mode": "Never"}, ValueError),
    ]:
        with pytest.raises(error, match=next(iter(option)) if "autoreset_mode" not in option else "Never"):
            rheotaxis.VectorEnv(channel, **OPTIONS, **option)
    with pytest.raises(TypeError, match="seed must be a whole number, or a list"):
        env.reset(seed=1.5)
    env.close()
    with pytest.raises(RuntimeError, match="closed"):
        env.step(np.zeros((2, 3)))


def test_ctrl_c_ends_a_batch_and_a_reset_mends_it(channel):
    env = rheotaxis.VectorEnv(channel, 4, period_s=2000, limit_s=1e6, plumes=1, threads=2, goal_m=1e-6)
    circle = np.tile(np.array([1, 0, -1], np.float32), (4, 1))
    env.reset(seed=1)
    threading.Timer(0.5, os.kill, (os.getpid(), signal.SIGINT)).start()
    with pytest.raises(KeyboardInterrupt):
        for _ in range(10_000):
            env.step(circle)
    seen, _ = env.reset(seed=1)
    np.testing.assert_array_equal(seen, env.reset(seed=1)[0])


def test_two_environments_in_two_threads(channel):
    expected = [steps(rheotaxis.VectorEnv(channel, 2, **OPTIONS), 10, seed)[0] for seed in (1, 2)]
    got = [None, None]

    def work(n):
        got[n] = steps(rheotaxis.VectorEnv(channel, 2, threads=2, **OPTIONS), 10, n + 1)[0]

    threads = [threading.Thread(target=work, args=(n,)) for n in range(2)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    np.testing.assert_array_equal(got[0], expected[0])
    np.testing.assert_array_equal(got[1], expected[1])


def _forked(env, pipe):
    try:
        env.reset(seed=1)
        pipe.send("went on")
    except RuntimeError as error:
        pipe.send(str(error))


@pytest.mark.filterwarnings("ignore:.*fork.*:DeprecationWarning")
@pytest.mark.parametrize(("threads", "said"), [(2, "made in another process"), (1, "went on")])
def test_threads_do_not_come_along_into_a_forked_process(channel, threads, said):
    env = rheotaxis.VectorEnv(channel, 2, threads=threads, **OPTIONS)
    env.reset(seed=1)
    ours, theirs = multiprocessing.Pipe()
    process = multiprocessing.get_context("fork").Process(target=_forked, args=(env, theirs))
    process.start()
    assert ours.poll(60) and said in ours.recv()
    process.join()


def test_gymnasiums_own_vectors_take_it(channel):
    def make():
        return rheotaxis.Env(channel, **OPTIONS)

    vector = gymnasium.vector.AsyncVectorEnv([make, make], context="spawn")
    rows, _ = vector.reset(seed=4)
    vector.close()
    ours = rheotaxis.VectorEnv(channel, 2, **OPTIONS)
    np.testing.assert_array_equal(rows, ours.reset(seed=4)[0])
