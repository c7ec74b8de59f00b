"""Runs: the same as the command's, and what they leave."""

import csv
import json
from pathlib import Path

import numpy as np
import pytest

import rheotaxis

GOLDEN = Path(__file__).parents[3] / "tests/golden/digests.txt"


def golden(name, seed):
    for line in GOLDEN.read_text().splitlines():
        words = line.split()
        if words[:2] == [name, str(seed)]:
            return int(words[2]), words[3]
    raise AssertionError(f"no golden digest of {name} {seed}")


@pytest.mark.parametrize("seed", [1, 2])
def test_a_run_has_the_golden_digest(channel, seed):
    result = rheotaxis.run(channel, seed)
    assert (result.steps, result.digest) == golden("uniform_channel", seed)
    assert result.outcome == "time_out" and not result.success
    assert result.t_s == pytest.approx(60)


def test_a_gantry_has_the_golden_digest_and_its_probes():
    flume = rheotaxis.Scenario.load("flume_crab").with_({"time.limit_s": 40})
    result = rheotaxis.run(flume, 1, threads=1)
    assert (result.steps, result.digest) == golden("flume_crab", 1)
    assert result.track == {}
    (probes,) = result.probes.values()
    rows = len(probes["t_s"])
    # Twenty scans a second, until the head has stopped.
    assert result.steps < 4000
    assert rows == pytest.approx(20 * result.t_s, abs=1)
    for name, shape in {
        "scan_s": (rows,),
        "head_m": (rows, 3),
        "joint_m": (rows, 2),
        "joint_m_s": (rows, 2),
        "tip_m": (rows, 3, 3),
        "volts": (rows, 3),
        "threshold_v": (rows, 3),
        "spike": (rows, 3),
        "behaviour": (rows,),
    }.items():
        assert probes[name].shape == shape, name
    assert probes["spike"].dtype == bool
    # The tips stand still relative to the head, and some scan hits the plume.
    offsets = probes["tip_m"] - probes["head_m"][:, None, :]
    assert np.ptp(offsets, axis=0).max() < 1e-9
    assert probes["spike"].any() and np.ptp(probes["volts"]) > 0
    assert result.plot().name.startswith("flume-")


def test_the_whole_mission_with_its_files(tmp_path):
    result = rheotaxis.run("uniform_channel", files=tmp_path / "run")
    assert result.success and result.outcome == "found"
    assert result.files == tmp_path / "run"
    listed = {p.name for p in result.files.iterdir()}
    assert {"summary.json", "track.csv", "map.svg", "map.png", "report.html", "run.mcap"} <= listed

    assert json.loads((result.files / "summary.json").read_text()) == result.summary
    (declared,) = result.declarations
    assert declared["searcher"] == "auv0" and declared["error"]["total_m"] < 20
    assert declared["position"] == result.summary["robots"][0]["declarations"][0]["position"]

    # The columns are those of the table, with all digits.
    track = result.track["auv0"]
    with open(result.files / "track.csv", newline="") as table:
        rows = list(csv.DictReader(table))
    assert {len(column) for column in track.values()} == {len(rows)}
    for name, column in track.items():
        written = [row[name] for row in rows]
        if name == "behaviour":
            assert list(column) == written
        else:
            numbers = np.array([float(text) if text else np.nan for text in written])
            np.testing.assert_allclose(column, numbers, atol=6e-4, err_msg=name)
    assert track["detected"].dtype == bool and track["detected"].any()
    # An array belongs to its owner.
    track["t_s"][:] = 0
    assert result.track["auv0"]["t_s"][-1] > 0


def test_without_a_recording_there_is_none(channel, tmp_path):
    result = rheotaxis.run(channel, files=str(tmp_path), recording=False)
    listed = {p.name for p in tmp_path.iterdir()}
    assert "run.mcap" not in listed and "track.csv" in listed
    assert "series-auv0" in result.figures


def test_figures_are_drawn_in_memory(channel, tmp_path):
    result = rheotaxis.run(channel)
    assert result.files is None
    assert result.figures == ["map", "series-auv0"]
    assert result._repr_png_().startswith(b"\x89PNG")
    figure = result.plot("series-auv0")
    assert figure.svg.startswith("<svg") and "auv0" in figure.title
    figure.save(tmp_path / "series.svg")
    assert (tmp_path / "series.svg").read_text() == figure.svg
    figure.save(str(tmp_path / "series.png"))
    assert (tmp_path / "series.png").read_bytes() == figure.png
    with pytest.raises(ValueError, match=r"\.svg or \.png"):
        figure.save(tmp_path / "series.jpg")
    with pytest.raises(KeyError, match="it has map, series-auv0"):
        result.plot("sidescan")


def test_kept_spin_ups_change_nothing(tmp_path, channel):
    # Long enough to be worth keeping.
    scenario = channel.with_({"time.spin_up_s": 20000, "time.limit_s": 5})
    digests = {rheotaxis.run(scenario, cache=tmp_path).digest for _ in range(2)}
    assert digests == {rheotaxis.run(scenario, cache=False).digest}
    assert any(p.is_file() for p in tmp_path.rglob("*"))


def test_what_is_probably_not_meant_is_a_warning(channel):
    odd = channel.with_({"sources": []})
    assert any("the scenario has no source" in line for line in odd.check())
    with pytest.warns(rheotaxis.ScenarioWarning, match="the scenario has no source"):
        rheotaxis.run(odd.with_({"time.limit_s": 1}))


def test_a_folder_that_cannot_be_written_is_named(channel, tmp_path):
    (tmp_path / "taken").write_text("")
    with pytest.raises(RuntimeError, match="cannot create the folder .*taken/run"):
        rheotaxis.run(channel, files=tmp_path / "taken" / "run")


@pytest.mark.parametrize(
    ("argument", "error", "said"),
    [
        ({"seed": -1}, ValueError, "seed must be from 0 to 18446744073709551615, got -1"),
        ({"seed": 2**64}, ValueError, "seed must be from 0"),
        ({"seed": 1.5}, TypeError, "seed must be a whole number"),
        ({"seed": "one"}, TypeError, "seed must be a whole number"),
        ({"threads": -1}, ValueError, "threads must be from 0 to 1024, got -1"),
        ({"threads": "all"}, TypeError, "threads must be a whole number"),
        ({"files": 3}, TypeError, "files"),
        ({"cache": 3}, TypeError, "cache"),
        ({"recording": "yes"}, TypeError, "recording"),
        ({"speed": 3}, TypeError, "unexpected keyword argument 'speed'"),
    ],
)
def test_a_wrong_argument_is_named(channel, argument, error, said):
    with pytest.raises(error, match=said):
        rheotaxis.run(channel, **argument)


def test_a_seed_of_numpy_is_a_seed(channel):
    short = channel.with_({"time.limit_s": 1})
    assert rheotaxis.run(short, np.int64(2)).digest == rheotaxis.run(short, 2).digest
