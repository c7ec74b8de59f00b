"""Random actions in a vector of environments: the shortest loop there is.

    python scenarios/python/examples/random_policy.py [EPISODES]
"""

import sys

import numpy as np

import rheotaxis

episodes = int(sys.argv[1]) if len(sys.argv) > 1 else 16
envs = rheotaxis.VectorEnv("uniform_channel", 8, limit_s=600, plumes=4, truth=True)
envs.reset(seed=1)
envs.action_space.seed(1)
ended, found, nearest_m = 0, 0, []
while ended < episodes:
    _, _, terminated, truncated, infos = envs.step(envs.action_space.sample())
    over = terminated | truncated
    ended += over.sum()
    found += (over & infos["success"]).sum()
    nearest_m.extend(infos["closest_m"][over])
envs.close()
print(f"random: {found} of {ended} episodes reach the source; nearest {np.median(nearest_m):.0f} m (median)")
