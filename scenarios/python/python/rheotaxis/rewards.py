"""What an agent gets for a decision.

All begin with 1 for the decision that ends an episode with success, and 0 for all others.
"""

from __future__ import annotations

from typing import Any

import numpy as np
import numpy.typing as npt

#: What a reward is made of: arrays of all environments by name, ``names`` and ``dt``.
Step = dict[str, Any]
Rewards = npt.NDArray[np.float64]


def sparse(step: Step) -> Rewards:
    """Nothing else."""
    return np.asarray(step["success"], dtype=np.float64)


def time(step: Step) -> Rewards:
    """Less the share of the time limit that the decision took: an episode costs 1 at most."""
    return sparse(step) - float(step["dt"])


def progress(step: Step) -> Rewards:
    """And the decrease of the true distance to the nearest source, as a share of the distance at the beginning.

    It uses the truth, which a searcher does not have: for learning in simulation.
    """
    gained: Rewards = (step["distance_before_m"] - step["distance_m"]) / step["distance_begin_m"]
    return sparse(step) + gained


def hits(step: Step) -> Rewards:
    """And the share of detections among the readings, times the share of the time limit that the decision took."""
    shares: Rewards = step["state"][:, step["names"].index("hits")]
    return sparse(step) + shares * float(step["dt"])


KINDS = {"sparse": sparse, "time": time, "progress": progress, "hits": hits}
