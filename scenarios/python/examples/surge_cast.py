"""Surge and cast in NumPy: against the flow while there is a scent, across it when it is lost.

    python scenarios/python/examples/surge_cast.py [EPISODES]
"""

import sys

import rheotaxis
from rheotaxis.actions import SurgeCast  # what the two actions mean

SURGE, CAST = 0, 1
#: The plume counts as lost after so many seconds without a detection.
LOST_S = 15.0

episodes = int(sys.argv[1]) if len(sys.argv) > 1 else 16
envs = rheotaxis.VectorEnv("uniform_channel", 8, limit_s=900, plumes=4, action="surge_cast", observation="state")
assert envs.single_action_space == SurgeCast(1, 3, False).space
since_hit = envs.observation_names.index("since_hit")
seen, _ = envs.reset(seed=1)
ended, found, times_s = 0, 0, []
while ended < episodes:
    lost = seen[:, since_hit] * 600.0 > LOST_S
    seen, _, terminated, truncated, infos = envs.step(lost.astype(int) * CAST)
    over = terminated | truncated
    ended += over.sum()
    found += (over & infos["success"]).sum()
    times_s.extend(infos["t_s"][over & infos["success"]])
envs.close()
print(f"surge and cast: {found} of {ended} episodes reach the source", end="")
print(f", in {min(times_s):.0f} to {max(times_s):.0f} s" if times_s else "")
