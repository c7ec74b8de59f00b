"""The examples of docs/python.md run as they are printed, one after the other, and do what the page says of them."""

import re
import warnings
from importlib.util import find_spec
from pathlib import Path

import numpy as np
import pytest

import rheotaxis

PAGE = Path(__file__).parents[3] / "docs/python.md"


def drives(names):
    """The controller drives its vehicle, above the bed and through the water."""
    track = names["result"].track["auv0"]
    moved_m = np.hypot(np.diff(track["east_m"]), np.diff(track["north_m"])).sum()
    assert moved_m > 500 and track["altitude_m"].min() > 0.5
    assert "surge" in track["behaviour"]


def same_seeds_in_both_pools(names):
    assert len({run.digest for run in names["runs"]}) == 4
    assert names["runs"][0].digest == names["result"].digest


def decides(names):
    consulted = names["result"].summary["robots"][0]["consulted"]
    assert consulted["asked"] == consulted["answered"] == 60


#: What holds after the block with these words.
AFTER = {
    'files="runs/x"': lambda names: Path("runs/x/summary.json").resolve(strict=True),
    "ThreadPoolExecutor": same_seeds_in_both_pools,
    "get_context": same_seeds_in_both_pools,
    "def up_flow": drives,
    "PolicyController": decides,
}


def test_the_examples_of_the_page_run(tmp_path, monkeypatch):
    pytest.importorskip("pettingzoo")
    blocks = re.findall(r"```python\n(.*?)```", PAGE.read_text(), re.S)
    monkeypatch.chdir(tmp_path)
    names, checked = {"__name__": "docs"}, 0
    with warnings.catch_warnings():
        # What the page shows is meant.
        warnings.simplefilter("error", rheotaxis.RunWarning)
        warnings.simplefilter("error", rheotaxis.ScenarioWarning)
        for block in blocks:
            if "stable_baselines3" in block and find_spec("stable_baselines3") is None:
                continue
            exec(compile(block, PAGE.name, "exec"), names)
            for words, holds in AFTER.items():
                if words in block:
                    holds(names)
                    checked += 1
    assert checked == len(AFTER)
