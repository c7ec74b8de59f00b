"""`PolicyController`: a policy decides in a whole run as it does in an environment."""

import copy
import pickle
import threading

import gymnasium
import numpy as np
import pytest

import rheotaxis


class Scripted:
    """A policy that looks at its observation and notes what it saw and did."""

    def __init__(self, act):
        self.act = act
        self.seen, self.done = [], []

    def __call__(self, seen):
        self.seen.append(seen.copy())
        self.done.append(self.act(seen, len(self.done)))
        return self.done[-1]


def weaves(seen, n):
    """Turns, climbs and speeds that follow from what is seen."""
    return np.tanh(np.array([3 * seen[8] + 0.4 * np.sin(n), seen[12] - 0.2, seen[5] * 4 + 0.1 * n]))


def weaves_and_declares(seen, n):
    return np.append(weaves(seen, n), 1.0 if n == 17 else 0.0)


def casts(seen, n):
    return int(n % 5 > 1)


def episode(env, policy, seed):
    """The newest info of an episode that a policy decides to its end."""
    seen, _ = env.reset(seed=seed)
    while True:
        seen, _, terminated, truncated, info = env.step(policy(seen))
        if terminated or truncated:
            return info


def in_both(env, act, seed=5):
    """What a policy sees and does in an episode and in the run of the same seed, and that run."""
    there, here = Scripted(act), Scripted(act)
    info = episode(env, there, seed)
    result = rheotaxis.run(env.scenario, seed, controllers=rheotaxis.PolicyController(here, env))
    np.testing.assert_array_equal(here.seen, there.seen)
    np.testing.assert_array_equal(here.done, there.done)
    return info, result


@pytest.mark.parametrize(
    ("options", "act"),
    [
        ({"speed_m_s": (1.0, 2.0), "turn_deg": 40}, weaves),
        ({"period_s": 2, "climb_m": 0.3}, weaves),
        ({"action": "surge_cast"}, casts),
        ({"action": "grid", "observation": "reading_flow"}, lambda seen, n: n // 4 % 4),
    ],
)
def test_a_run_makes_the_decisions_of_the_episode(channel, options, act):
    env = rheotaxis.Env(channel, limit_s=30, plumes=None, truth=True, **options)
    info, result = in_both(env, act)
    assert result.t_s == info["t_s"] == 30.0 and result.outcome == "time_out"
    # It came to the same place: the last row of the track is the last but one step of the episode.
    track = result.track["auv0"]
    place = np.array([track["east_m"][-1], track["north_m"][-1], track["up_m"][-1]])
    assert np.abs(place - info["truth_m"]).max() < 0.3
    assert result.summary["robots"][0]["consulted"]["answered"] == 30 / options.get("period_s", 1)


def test_a_run_that_is_declared_has_the_digest_of_the_episode(channel):
    env = rheotaxis.Env(channel, limit_s=30, plumes=None, declare=True)
    _, result = in_both(env, weaves_and_declares)
    assert result.digest == env._episodes.told["digest"][0]
    assert len(result.declarations) == 1 and result.outcome != "time_out"


def test_a_gantry_has_a_policy():
    flume = rheotaxis.Scenario.load("flume_crab").with_({"time.spin_up_s": 5})
    env = rheotaxis.Env(flume, limit_s=6, plumes=None)

    def act(seen, n):
        return np.array([0.5, np.cos(n) * (1 - seen[0]), 1.0 if n == 25 else 0.0])

    _, result = in_both(env, act)
    assert result.digest == env._episodes.told["digest"][0]


def test_a_model_predicts_without_exploring(channel):
    class Model:
        def predict(self, seen, deterministic=False):
            assert deterministic
            return np.zeros(3, np.float32), None

    env = rheotaxis.VectorEnv(channel, 4, limit_s=5, searchers_per_plume=2)
    of_model = rheotaxis.run(env.scenario, controllers=rheotaxis.PolicyController(Model(), env))
    of_function = rheotaxis.run(env.scenario, controllers={"auv0": rheotaxis.PolicyController(ahead, env)})
    assert of_model.digest == of_function.digest


def ahead(seen):
    return np.zeros(3, np.float32)


def test_it_begins_anew_in_each_run_and_outlives_its_environment(channel):
    env = rheotaxis.Env(channel, limit_s=10, action="surge_cast")
    env.reset(seed=1)
    scenario, decides = env.scenario, rheotaxis.PolicyController(lambda seen: 1, env)
    env.close()
    digests = [rheotaxis.run(scenario, controllers=decides).digest]

    def work_on():
        digests.append(rheotaxis.run(scenario, controllers=decides).digest)

    work = [threading.Thread(target=work_on) for _ in "ab"]
    for thread in work:
        thread.start()
    for thread in work:
        thread.join()
    assert len(digests) == 3 and len(set(digests)) == 1


def test_it_is_sent_to_another_process(channel):
    env = rheotaxis.Env(channel, limit_s=5)
    env.reset(seed=1)
    decides = rheotaxis.PolicyController(ahead, env)
    twin = pickle.loads(pickle.dumps(decides))
    first, second = (rheotaxis.run(env.scenario, controllers=each).digest for each in (decides, twin))
    assert first == second


def test_what_does_not_fit_is_named(channel):
    env = rheotaxis.Env(channel, limit_s=5)
    decides = rheotaxis.PolicyController(ahead, env)
    slower = env.scenario.with_({"robots.0.strategy": rheotaxis.Ron("External(period_s: 2)")})
    with pytest.raises(ValueError, match=r"auv0 asks every 2(\.0)? s, and the policy's environment every 1.0 s"):
        rheotaxis.run(slower, controllers=decides)
    flume = rheotaxis.Scenario.load("flume_external").with_({"time.spin_up_s": 1})
    with pytest.raises(ValueError, match="has no searcher crab0; it has auv0"):
        rheotaxis.run(flume, controllers=decides)
    with pytest.raises(ValueError, match="has the strategy External"):
        rheotaxis.run(channel, controllers={"auv0": decides})
    with pytest.raises(ValueError, match=r"must have the shape \(1, 3\)"):
        rheotaxis.run(env.scenario, controllers=rheotaxis.PolicyController(lambda seen: np.zeros(2), env))
    with pytest.raises(ZeroDivisionError):
        rheotaxis.run(env.scenario, controllers=rheotaxis.PolicyController(lambda seen: 1 / 0, env))
    with pytest.raises(TypeError, match="a policy must be a function"):
        rheotaxis.PolicyController(3, env)
    with pytest.raises(TypeError, match="env must be an environment of rheotaxis"):
        rheotaxis.PolicyController(ahead, channel)
    changed = gymnasium.wrappers.FlattenObservation(copy.deepcopy(env))
    with pytest.raises(ValueError, match="FlattenObservation changes observations"):
        rheotaxis.PolicyController(ahead, changed)
    rheotaxis.PolicyController(ahead, gymnasium.make("rheotaxis/UniformChannel-v0"))


def test_each_of_several_searchers_has_its_own(channel):
    pytest.importorskip("pettingzoo")
    robot = channel["robots.0"]
    other = {**robot, "id": "auv1", "start": {**robot["start"], "north_m": 30.0}}
    env = rheotaxis.ParallelEnv(channel.with_({"robots": [robot, other]}), limit_s=6, plumes=None)
    acts = {"auv0": np.array([1.0, 0.0, 0.0]), "auv1": np.array([-1.0, 0.0, 0.5])}
    there = {agent: [] for agent in acts}
    seen, _ = env.reset(seed=2)
    while env.agents:
        for agent in env.agents:
            there[agent].append(seen[agent])
        seen, *_ = env.step({agent: acts[agent] for agent in env.agents})
    policies = {agent: Scripted(lambda seen, n, agent=agent: acts[agent]) for agent in acts}
    controllers = {agent: rheotaxis.PolicyController(policy, env) for agent, policy in policies.items()}
    rheotaxis.run(env.scenario, 2, controllers=controllers)
    for agent in acts:
        np.testing.assert_array_equal(policies[agent].seen, there[agent])
