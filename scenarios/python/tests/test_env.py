"""`Env`: one searcher, decided for by an agent."""

import os
import signal
import threading

import gymnasium
import numpy as np
import pytest
from gymnasium.utils.env_checker import check_env

import rheotaxis
from rheotaxis import actions

AHEAD = np.zeros(3, np.float32)


@pytest.fixture
def options():
    return {"limit_s": 20, "plumes": 2}


def episode(env, policy, seed=None):
    """All observations, rewards and the last step of an episode."""
    seen, _ = env.reset(seed=seed)
    rows, rewards = [seen], []
    while True:
        seen, reward, terminated, truncated, info = env.step(policy(seen))
        rows.append(seen)
        rewards.append(reward)
        if terminated or truncated:
            return np.array(rows), rewards, terminated, truncated, info


@pytest.mark.parametrize(
    "option",
    [
        {},
        {"action": "oriented", "truth": True},
        {"action": "grid", "reward": "progress"},
        {"action": "surge_cast", "observation": "reading_flow", "reward": "hits"},
        {"declare": True, "observation": "reading", "reward": "time"},
        {"action": "surge_cast", "declare": True},
    ],
)
def test_gymnasium_accepts_it(channel, options, option):
    env = rheotaxis.Env(channel, **options, **option)
    check_env(env, skip_render_check=True)


@pytest.mark.parametrize("name", ["UniformChannel", "FlumeCrab", "DuckSt"])
def test_scenarios_of_the_catalogue_have_ids(name):
    env = gymnasium.make(f"rheotaxis/{name}-v0")
    assert isinstance(env.unwrapped, rheotaxis.Env)
    vector = gymnasium.make_vec(f"rheotaxis/{name}-v0", num_envs=3)
    assert isinstance(vector, rheotaxis.VectorEnv) and vector.num_envs == 3
    assert vector.single_observation_space == env.observation_space


def test_an_episode_ends_at_its_limit_and_follows_from_its_seed(channel, options):
    env = rheotaxis.Env(channel, **options)
    rows, rewards, terminated, truncated, info = episode(env, lambda _: AHEAD, seed=3)
    assert (len(rewards), terminated, truncated) == (20, False, True)
    assert info == {"success": False, "t_s": 20.0} and rewards == [0.0] * 20
    assert all(env.observation_space.contains(row) for row in rows)
    again, *_ = episode(env, lambda _: AHEAD, seed=3)
    np.testing.assert_array_equal(rows, again)
    # Without a seed the next episode differs, and follows from the last seed.
    other, *_ = episode(env, lambda _: AHEAD)
    assert not np.array_equal(rows, other)
    episode(env, lambda _: AHEAD, seed=3)
    np.testing.assert_array_equal(episode(env, lambda _: AHEAD)[0], other)


def test_an_action_turns_climbs_and_speeds_up(channel):
    env = rheotaxis.Env(channel, limit_s=60, plumes=1, turn_deg=30, climb_m=0.1, speed_m_s=(1.0, 2.0))
    names = env.observation_names

    def after(action, steps):
        seen, _ = env.reset(seed=1)
        first = dict(zip(names, seen, strict=True))
        for _ in range(steps):
            seen, *_ = env.step(np.array(action, np.float32))
        return first, dict(zip(names, seen, strict=True))

    def heading(seen):
        return np.degrees(np.arctan2(seen["sin_heading"], seen["cos_heading"]))

    first, straight = after([0, 0, -1], 20)
    assert abs(heading(straight) - heading(first)) < 5
    assert 0.8 < straight["speed_forward_m_s"] < 1.2
    assert abs(straight["altitude_10m"] - first["altitude_10m"]) < 0.03
    _, right = after([1, 0, 0], 4)
    _, left = after([-1, 0, 0], 4)
    assert 15 < heading(right) < 90 and -90 < heading(left) < -15
    _, fast = after([0, 0, 1], 20)
    assert 1.7 < fast["speed_forward_m_s"] < 2.4
    _, high = after([0, 1, 0], 20)
    assert 0.05 < high["altitude_10m"] - first["altitude_10m"] < 0.25


def test_with_a_plume_for_each_seed_it_is_the_run_of_the_seed(channel):
    run = rheotaxis.run(channel, 7).track["auv0"]
    env = rheotaxis.Env(channel, limit_s=20, plumes=None, truth=True)
    seen, info = env.reset(seed=7)
    # The run's first row is one step of physics later.
    place = [run["east_m"][0], run["north_m"][0], run["up_m"][0]]
    np.testing.assert_allclose(info["truth_m"], place, atol=0.05)
    flow = np.hypot(*seen[[env.observation_names.index(n) for n in ("flow_forward_m_s", "flow_left_m_s")]])
    assert flow == pytest.approx(np.hypot(run["flow_east_m_s"][0], run["flow_north_m_s"][0]), abs=1e-5)
    assert info["distance_m"] == info["closest_m"] == pytest.approx(np.hypot(300, 30), abs=0.5)


def test_no_truth_is_told_unless_asked(channel, options):
    env = rheotaxis.Env(channel, **options)
    _, info = env.reset(seed=1)
    assert set(info) == {"success", "t_s"}


def test_surge_and_cast_reaches_the_source_and_is_paid_once():
    env = rheotaxis.Env("uniform_channel", limit_s=900, plumes=1, action="surge_cast", reward="sparse", truth=True)
    since = env.observation_names.index("since_hit")
    _, rewards, terminated, truncated, info = episode(env, lambda s: int(s[since] * 600 > 15), seed=1)
    assert terminated and not truncated and info["success"]
    assert info["closest_m"] <= 20 and sum(rewards) == rewards[-1] == 1.0


@pytest.mark.parametrize("reward", ["time", "progress", "hits", lambda step: 2 * step["success"] + 0.5])
def test_rewards(channel, options, reward):
    env = rheotaxis.Env(channel, **options, reward=reward, truth=True)
    env.reset(seed=1)
    before = env.reset(seed=1)[1]["distance_m"]
    begin = before
    names = env.observation_names
    for _ in range(5):
        seen, paid, _, _, info = env.step(AHEAD)
        expected = {
            "time": -1 / 20,
            "progress": (before - info["distance_m"]) / begin,
            "hits": seen[names.index("hits")] / 20,
        }
        assert paid == pytest.approx(0.5 if callable(reward) else expected[reward])
        before = info["distance_m"]


def test_a_declaration_ends_the_episode(channel):
    near = channel.with_({"robots.0.start.east_m": -148, "robots.0.start.north_m": 2})
    for scenario, found in [(near, True), (channel, False)]:
        env = rheotaxis.Env(scenario, limit_s=60, plumes=1, declare=True)
        env.reset(seed=1)
        _, reward, terminated, truncated, info = env.step(np.array([0, 0, 0, 1], np.float32))
        assert (terminated, truncated, info["success"], reward) == (True, False, found, float(found))


def test_who_leaves_the_area_has_failed():
    channel = rheotaxis.Scenario.load("uniform_channel").with_({"time.spin_up_s": 10})
    env = rheotaxis.Env(channel, limit_s=600, plumes=1, turn_deg=180)
    _, rewards, terminated, truncated, info = episode(env, lambda _: np.array([0, 0, 1], np.float32), seed=1)
    assert terminated and not truncated and not info["success"] and sum(rewards) == 0


def test_a_gantry_moves_its_head_and_declares():
    flume = rheotaxis.Scenario.load("flume_crab").with_({"time.spin_up_s": 5})
    env = rheotaxis.Env(flume, limit_s=10, plumes=1, truth=True)
    assert env.action_space.shape == (3,)
    seen, info = env.reset(seed=1)
    place = info["truth_m"]
    for _ in range(10):
        seen, _, _, _, info = env.step(np.array([1, 0, 0], np.float32))
    moved = info["truth_m"] - place
    # Forward is up-stream: towards the nozzle, in the west.
    assert moved[0] < -0.02 and abs(moved[1]) < 1e-3
    assert env.observation_names[0] == "forward" and seen[0] > -1
    _, _, terminated, _, info = env.step(np.array([0, 0, 1], np.float32))
    assert terminated and not info["success"]


@pytest.mark.parametrize(
    ("option", "error", "said"),
    [
        ({"period_s": 0.03}, ValueError, "whole number of the scenario's steps of 0.02 s"),
        ({"period_s": 0}, ValueError, "whole number"),
        ({"period_s": "1"}, TypeError, "period_s must be a number, got '1'"),
        ({"limit_s": float("nan")}, ValueError, "limit_s must be above 0"),
        ({"limit_s": True}, TypeError, "limit_s must be a number"),
        ({"goal_m": -1}, ValueError, "goal_m must be above 0"),
        ({"goal_m": [1]}, TypeError, "goal_m must be a number"),
        ({"declare": "yes"}, TypeError, "declare must be True or False"),
        ({"truth": 1}, TypeError, "truth must be True or False"),
        ({"turn_deg": float("inf")}, ValueError, "turn_deg must be above 0"),
        ({"climb_m": None}, TypeError, "climb_m must be a number"),
        ({"speed_m_s": (2, 1)}, ValueError, "two speeds, the smaller first"),
        ({"speed_m_s": (float("nan"), 1)}, ValueError, "two speeds, the smaller first"),
        ({"speed_m_s": 2}, TypeError, "speed_m_s must be two speeds"),
        ({"speed_m_s": ("1", "2")}, TypeError, "speed_m_s must be a number"),
        ({"action": "jump"}, ValueError, "action must be one of continuous"),
        ({"action": ["grid"]}, TypeError, "action must be one of continuous"),
        ({"observation": "all"}, ValueError, "observation must be one of state"),
        ({"observation": 3}, TypeError, "observation must be one of state"),
        ({"reward": "money"}, ValueError, "reward must be one of sparse"),
        ({"reward": None}, TypeError, "reward must be one of sparse"),
        ({"plumes": 0}, ValueError, "plumes must be from 1"),
        ({"plumes": 1.5}, TypeError, "plumes must be a whole number"),
        ({"threads": -1}, ValueError, "threads must be from 0 to 1024"),
        ({"cache": 3}, TypeError, "cache"),
        ({"render_mode": "human"}, ValueError, "render_mode must be None"),
        ({"rewards": "hits"}, TypeError, "unexpected keyword argument 'rewards'"),
    ],
)
def test_wrong_options_are_named(channel, option, error, said):
    with pytest.raises(error, match=said):
        rheotaxis.Env(channel, **option)


@pytest.mark.parametrize(("seed", "error"), [(-1, ValueError), (2**64, ValueError), (1.5, TypeError), ("1", TypeError)])
def test_wrong_seeds_are_named(channel, options, seed, error):
    env = rheotaxis.Env(channel, **options)
    with pytest.raises(error, match="a seed is a whole number"):
        env.reset(seed=seed)


def test_a_gantry_is_refused_what_it_has_not():
    for option in ({"reward": "hits"}, {"action": "grid"}, {"observation": "reading"}):
        with pytest.raises(ValueError, match="gantry"):
            rheotaxis.Env("flume_crab", **option)


def test_what_is_no_action_is_refused_and_changes_nothing(channel, options):
    env = rheotaxis.Env(channel, **options)
    env.reset(seed=1)
    for action in [[np.nan, 0, 0], [0, np.inf, 0]]:
        with pytest.raises(ValueError, match="must be finite numbers"):
            env.step(np.array(action))
    with pytest.raises(ValueError, match=r"must have the shape \(1, 3\)"):
        env.step(np.zeros(4))
    kept, *_ = env.step(AHEAD)
    env.reset(seed=1)
    np.testing.assert_array_equal(kept, env.step(AHEAD)[0])
    discrete = rheotaxis.Env(channel, **options, action="grid")
    discrete.reset(seed=1)
    for action in [4, -1, 0.5]:
        with pytest.raises(ValueError, match="whole number from 0 to 3"):
            discrete.step(action)


def test_an_environment_is_reset_first_and_not_used_when_closed(channel, options):
    env = rheotaxis.Env(channel, **options)
    with pytest.raises(gymnasium.error.ResetNeeded):
        env.step(AHEAD)
    with pytest.raises(ValueError, match="a seed is a whole number"):
        env._episodes.begin([0], [-1], True)
    episode(env, lambda _: AHEAD, seed=1)
    with pytest.raises(gymnasium.error.ResetNeeded, match="the episode is over"):
        env.step(AHEAD)
    env.close()
    env.close()
    with pytest.raises(RuntimeError, match="closed"):
        env.reset(seed=1)
    with pytest.raises(RuntimeError, match="closed"):
        env.step(AHEAD)


def test_ctrl_c_ends_a_spin_up_and_the_environment_goes_on_after_a_reset(channel):
    env = rheotaxis.Env(channel.with_({"time.spin_up_s": 1e6}), limit_s=20)
    threading.Timer(0.7, os.kill, (os.getpid(), signal.SIGINT)).start()
    with pytest.raises(KeyboardInterrupt):
        env.reset(seed=1)
    with pytest.raises(gymnasium.error.ResetNeeded):
        env.step(AHEAD)


def test_scenarios_that_do_not_fit():
    with pytest.raises(ValueError, match="several searchers .*use rheotaxis.ParallelEnv"):
        rheotaxis.Env("four_maps")
    with pytest.raises(ValueError, match="has no robot and no gantry"):
        rheotaxis.Env("block_in_channel")
    with pytest.raises(ValueError, match="continuous actions only"):
        rheotaxis.Env("flume_crab", action="grid")
    with pytest.raises(rheotaxis.ScenarioError):
        rheotaxis.Env("no_such_scenario")


def test_surge_and_cast_means_courses_relative_to_the_flow():
    kind = actions.SurgeCast(2, 3, False)
    seen = np.zeros((2, 17), np.float32)
    # The water goes to the left of the first one; nothing is known to the second.
    seen[0, actions.FLOW_LEFT], seen[0, actions.FLOW_KNOWN] = 0.2, 1
    both = np.arange(2)
    kind.begin(both)
    turns = [np.degrees(kind.turns(both, seen, np.full(2, action))) for action in (0, 1, 1, 1, 0, 1)]
    first = [round(turn[0]) for turn in turns]
    # Against it is to the right; across it begins to the other side, then for two decisions back.
    assert first == [90, 0, 180, 180, 90, 0] or first == [90, 180, 0, 0, 90, 180]
    assert all(turn[1] == 0 for turn in turns)


def test_a_grid_keeps_to_the_compass():
    kind = actions.Grid(1, 3, False)
    seen = np.zeros((1, 17), np.float32)
    seen[0, actions.SIN] = 1.0
    turns = [kind.moves(np.arange(1), seen, np.array([action]))[0, 0] * 180 for action in range(4)]
    off = np.mod(np.array(turns) - [270, 0, 90, 180] + 180, 360) - 180
    np.testing.assert_allclose(off, 0, atol=1e-4)
