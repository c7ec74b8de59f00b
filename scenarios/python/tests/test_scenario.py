"""Scenarios: read, looked at, changed, and their mistakes."""

import pickle
from pathlib import Path

import numpy as np
import pytest

import rheotaxis
from rheotaxis import Ron, Scenario, ScenarioError

CATALOGUE = Path(__file__).parents[2] / "catalog"
BAD_INPUT = Path(__file__).parents[3] / "tests/golden/bad_input"


def test_the_catalogue_is_that_of_the_folder():
    names = rheotaxis.catalogue()
    assert set(names) == {p.stem for p in CATALOGUE.glob("*.ron")}
    assert names["flume_crab"]["searchers"] and names["duck_st"]["title"]
    for name in names:
        assert Scenario.load(name).check() == []


def test_a_name_a_path_and_a_text_are_the_same_scenario():
    by_name = Scenario.load("uniform_channel")
    by_path = Scenario.load(CATALOGUE / "uniform_channel.ron")
    by_text = Scenario.parse(by_name.text, "uniform_channel")
    assert by_name == by_path == by_text
    assert hash(by_name) == hash(by_text)
    assert by_name.name == by_path.name == by_text.name == "uniform_channel"
    assert by_name != by_name.with_({"title": "another"})


def test_values_are_read_by_path_with_their_defaults():
    s = Scenario.load("uniform_channel")
    assert s["robots.0.start.heading_deg"] == s["robots[0].start.heading_deg"] == 0
    assert s["time.limit_s"] == 1800
    assert s["time.step_s"] == 0.02, "a default"
    assert s["robots.0.strategy.speed_m_s"] == s["robots.0.strategy.Amp.speed_m_s"] == 1.5
    assert s["robots.0.strategy.vertical"] == {"Altitude": 2.0}
    assert s.to_dict()["success"] == {"Declared": {"within_m": 20.0}}
    with pytest.raises(KeyError, match="time has no `limit`; it has .*limit_s"):
        s["time.limit"]
    with pytest.raises(KeyError, match="robots has no `3`; it has 1 elements"):
        s["robots.3.id"]


def test_values_are_changed_by_path_and_the_rest_stays():
    s = Scenario.load("uniform_channel")
    changed = s.with_(
        {
            "time.limit_s": 600,
            "time.step_s": 0.01,
            "title": 'a "quoted" title',
            "robots.0.start.heading_deg": np.float64(90),
            "robots.0.strategy.Amp.lost_points": np.int64(4),
            "robots.0.strategy.vertical": {"Altitude": 3},
            "robots.0.estimator": Ron("DeadReckoning()"),
            "success": {"Declared": {"within_m": 5}},
        }
    )
    assert s["time.limit_s"] == 1800
    assert changed["time.limit_s"] == 600 and changed["time.step_s"] == 0.01
    assert changed.title == 'a "quoted" title'
    assert changed["robots.0.start.heading_deg"] == 90
    assert changed["robots.0.strategy.lost_points"] == 4
    assert changed["robots.0.strategy.vertical"] == {"Altitude": 3.0}
    assert changed["success"] == {"Declared": {"within_m": 5.0}}
    assert changed.text.splitlines()[0] == s.text.splitlines()[0], "comments stay"


@pytest.mark.parametrize("name", sorted(rheotaxis.catalogue()))
def test_every_block_can_be_read_and_put_back(name):
    s = Scenario.load(name)
    blocks = {block: value for block, value in s.to_dict().items() if value is not None}
    assert s.with_(blocks).to_dict() == s.to_dict()


def test_mistakes_are_shown_as_the_command_shows_them(tmp_path, monkeypatch):
    s = Scenario.load("uniform_channel")
    with pytest.raises(ScenarioError) as raised:
        s.with_({"time.limit_s": -2, "robots.0.start.nort_m": 3})
    said = str(raised.value)
    assert "× time.limit_s: must be > 0, got -2" in said
    assert "╭─[uniform_channel:34:38]" in said
    assert "help: did you mean `north_m`?" in said
    places = [(f["path"], f["line"], f["column"]) for f in raised.value.faults]
    assert places == [("robots[0].start", 27, 95), ("time.limit_s", 34, 38)]
    assert isinstance(raised.value, ValueError)

    # Word for word, as in the golden texts of the command.
    monkeypatch.chdir(tmp_path)
    (tmp_path / "ponds").mkdir()
    with pytest.raises(ScenarioError) as raised:
        Scenario.load("ponds")
    assert str(raised.value).strip() == (BAD_INPUT / "a_folder.txt").read_text().strip()


def test_mistakes_of_meaning_are_found_too():
    s = Scenario.load("uniform_channel")
    with pytest.raises(ScenarioError, match="east_m|outside"):
        s.with_({"sources.0.east_m": 1e4})


@pytest.mark.parametrize(
    ("path", "value", "said"),
    [
        ("robots.3.id", "b", "`robots` has no element 3"),
        ("time.limit_s.x", 1, "has no fields"),
        ("time.step s", 1, "a path reads like"),
        ("time.limit_s", Ron("1, step_s: 2"), "is not one RON value"),
        ("time.limit_s", float("nan"), "must be > 0"),
    ],
)
def test_changes_that_cannot_be_made(path, value, said):
    with pytest.raises(ScenarioError, match=said):
        Scenario.load("uniform_channel").with_({path: value})


def test_a_value_of_another_type_is_refused():
    with pytest.raises(TypeError, match="no value of type object"):
        Scenario.load("uniform_channel").with_({"time.limit_s": object()})


def test_a_missing_file_is_told():
    with pytest.raises(ScenarioError, match="there is no such file"):
        Scenario.load("no/such/file.ron")
    with pytest.raises(ScenarioError, match="there is no such file"):
        rheotaxis.run("no_such_scenario")


def test_a_text_can_be_run(channel):
    s = channel.with_({"time.limit_s": 1})
    assert rheotaxis.run(s.text).digest == rheotaxis.run(s).digest


def test_a_scenario_can_be_sent_to_another_process():
    for name in ["uniform_channel", "mound"]:
        s = Scenario.load(name)
        copy = pickle.loads(pickle.dumps(s))
        assert copy == s and copy.name == s.name and copy.check() == []


def test_fields_are_explained():
    assert "m/s" in rheotaxis.explain("robots.0.strategy.Amp.speed_m_s")
    assert "robots" in rheotaxis.explain()
    with pytest.raises(KeyError, match="the nearest are .*limit_s"):
        rheotaxis.explain("time.limit")
