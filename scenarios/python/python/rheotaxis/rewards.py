"""What an agent gets for a decision.

All begin with 1 for the decision that ends an episode with success, and 0 for all others.
"""

from __future__ import annotations

import numpy as np


def sparse(step) -> np.ndarray:
    """Nothing else."""
    return step["success"].astype(float)


def time(step) -> np.ndarray:
    """Less the share of the time limit that the decision took: an episode costs 1 at most."""
    return sparse(step) - step["dt"]


def progress(step) -> np.ndarray:
    """And the decrease of the true distance to the nearest source, as a share of the distance at the beginning.

    It uses the truth, which a searcher does not have: for learning in simulation.
    """
    return sparse(step) + (step["distance_before_m"] - step["distance_m"]) / step["distance_begin_m"]


def hits(step) -> np.ndarray:
    """And the share of detections among the readings, times the share of the time limit that the decision took."""
    if "hits" not in step["names"]:
        raise ValueError("a gantry has no share of hits: use reward='sparse', 'time' or 'progress'")
    return sparse(step) + step["state"][:, step["names"].index("hits")] * step["dt"]


KINDS = {"sparse": sparse, "time": time, "progress": progress, "hits": hits}
