"""How many decisions a second a vector of environments makes.

    python scenarios/python/examples/benchmark.py [THREADS]

Random actions, one decision a second of simulated time, about 1000 filaments. The REMUS has its whole dynamics at 50 Hz;
the kinematic vehicle moves in steps of 1 s. Spin-ups are not counted. If plume_nav_sim is there (``pip install
plume-nav-sim``), its environment is measured beside ours: a point on a grid in a plume that stands still.
"""

import sys
import time

import rheotaxis
from rheotaxis import Ron

THREADS = int(sys.argv[1]) if len(sys.argv) > 1 else 1

channel = rheotaxis.Scenario.load("uniform_channel")
few = channel.with_({"sources.0.release.rate_hz": 0.5})
simple = few.with_(
    {
        "robots.0.vehicle": Ron("Kinematic()"),
        "robots.0.sensors": Ron(
            "(fluorometer: (rate_hz: 1), dvl: (rate_hz: 1), adcp: (rate_hz: 1), compass: (rate_hz: 1), "
            "depth: (rate_hz: 1), altimeter: (rate_hz: 1), lbl: (noise_m: 1))"
        ),
        "time.step_s": 1,
        "record.frame_period_s": 1,
    }
)


def measure(what: str, scenario, n: int, per_plume: int, steps: int) -> None:
    env = rheotaxis.VectorEnv(scenario, n, searchers_per_plume=per_plume, plumes=8, threads=THREADS, limit_s=600)
    env.reset(seed=1)
    env.action_space.seed(1)
    actions = [env.action_space.sample() for _ in range(8)]
    env.step(actions[0])
    began = time.perf_counter()
    for k in range(steps):
        env.step(actions[k % 8])
    took = time.perf_counter() - began
    print(f"{what:58} {n * steps / took:9.0f} decisions/s")
    env.close()


print(f"{THREADS} thread{'s' if THREADS != 1 else ''}")
measure("kinematic vehicle, 256 in 8 plumes", simple, 256, 32, 100)
measure("kinematic vehicle, 256, a plume each", simple, 256, 1, 40)
measure("kinematic vehicle, 1", simple, 1, 1, 2000)
measure("REMUS, 256 in 8 plumes", few, 256, 32, 10)
measure("REMUS, 32, a plume each", few, 32, 1, 40)
measure("REMUS, 1", few, 1, 1, 500)


def measure_plume_nav_sim(steps: int) -> None:
    try:
        import plume_nav_sim
    except ImportError:
        print("plume_nav_sim is not installed")
        return
    env = plume_nav_sim.make_env()
    env.reset(seed=1)
    env.action_space.seed(1)
    actions = [env.action_space.sample() for _ in range(64)]
    began = time.perf_counter()
    for k in range(steps):
        _, _, terminated, truncated, _ = env.step(actions[k % 64])
        if terminated or truncated:
            env.reset()
    took = time.perf_counter() - began
    what = f"plume_nav_sim {plume_nav_sim.PACKAGE_VERSION}, PlumeEnv, 1"
    print(f"{what:58} {steps / took:9.0f} decisions/s")


measure_plume_nav_sim(100_000)
