"""Controllers in Python: the same decisions give the same run, and what goes wrong in them is raised."""

import json
import threading
from pathlib import Path

import numpy as np
import pytest

import rheotaxis
from rheotaxis import Ron

STREAM = Path(__file__).parents[3] / "tests/golden/planner_answers.json"


@pytest.fixture
def asks(channel):
    """A minute of a channel in which the robot asks each second."""
    return channel.with_({"robots.0.strategy": Ron("External()")})


def east(question):
    return {"number": question["number"], "steer": {"heading_rad": 1.5}}


def test_a_stream_of_the_planners_decisions_gives_its_digest():
    stream = json.loads(STREAM.read_text())
    answers = [answer for answer, times in stream["answers"] for _ in range(times)]
    asked = []

    def controller(question):
        asked.append(question["number"])
        return answers[question["number"]]

    result = rheotaxis.run(stream["scenario"], stream["seed"], controllers={"auv0": controller})
    assert result.digest == stream["digest"]
    assert asked == list(range(len(answers)))


def test_a_controller_decides_and_the_same_one_decides_again(asks, tmp_path):
    seen = []

    def controller(question):
        seen.append(question)
        # Numbers of numpy are numbers.
        return {"steer": {"heading_rad": np.float32(1.5), "speed_m_s": np.float64(1.0)}, "behaviour": "surge"}

    first = rheotaxis.run(asks, controllers=controller, files=tmp_path)
    assert first.summary["robots"][0]["consulted"]["answered"] == len(seen) == 60
    assert {"estimate", "gathered", "home_m", "area_m"} <= seen[-1].keys()
    assert set(first.track["auv0"]["behaviour"][-100:]) == {"surge"}
    assert b"/auv0/control" in (tmp_path / "run.mcap").read_bytes()
    again = rheotaxis.run(asks, controllers={"auv0": controller})
    assert again.digest == first.digest
    nobody = rheotaxis.run(asks, controllers={})
    assert nobody.summary["robots"][0]["consulted"]["absent"] == 60 and nobody.digest != first.digest


def test_a_scenario_that_waits_for_a_controller_says_so(asks, recwarn):
    short = asks.with_({"time.limit_s": 2})
    for controllers in ({}, east, {"auv0": east}):
        rheotaxis.run(short, controllers=controllers)
    assert not [w for w in recwarn if issubclass(w.category, rheotaxis.RunWarning)]
    said = r"auv0 asks a controller every 1 s and has none.*give controllers=\{\"auv0\": f\}"
    with pytest.warns(rheotaxis.RunWarning, match=said):
        rheotaxis.run(short)


def test_a_vehicle_at_rest_goes_with_an_order_that_gives_no_speed(asks, recwarn):
    at_rest = asks.with_({"robots.0.start.speed_m_s": 0})
    track = rheotaxis.run(at_rest, controllers=east).track["auv0"]
    assert track["speed_m_s"][-1] > 0.5 and track["altitude_m"].min() > 1
    assert not [w for w in recwarn if issubclass(w.category, rheotaxis.RunWarning)]


@pytest.mark.filterwarnings("ignore::rheotaxis.ScenarioWarning")
def test_a_vehicle_that_lies_on_the_bed_is_told_of():
    def stays(question):
        return {"steer": {"heading_rad": 0.0, "speed_m_s": 0.0}}

    # It is heavier than the water at Duck, and sinks.
    duck = rheotaxis.Scenario.load("duck_external").with_({"time.spin_up_s": 1, "time.limit_s": 200})
    with pytest.warns(rheotaxis.RunWarning, match="auv0 touched the bed .*still so: do its controller's answers give"):
        rheotaxis.run(duck, controllers=stays)


def test_a_declaration_ends_the_mission(asks):
    def controller(question):
        if question["t_s"] >= 5:
            return {"declare": {"position_m": question["home_m"], "rule": "mine"}, "end": "completed"}

    result = rheotaxis.run(asks, controllers=controller)
    assert result.t_s == pytest.approx(5, abs=0.1)
    assert result.declarations[0]["rule"] == "mine"


def test_a_gantry_has_a_controller():
    flume = rheotaxis.Scenario.load("flume_external").with_({"time.limit_s": 6, "time.spin_up_s": 2})
    result = rheotaxis.run(flume, controllers=lambda question: {"head": {"target_m": [0.1, 0.3]}})
    assert result.summary["gantries"][0]["consulted"]["answered"] == 30


@pytest.mark.parametrize(
    ("answer", "error", "text"),
    [
        ({"steer": {"heading_rad": 1.0, "speed_m_s": -1}}, ValueError, "auv0 to question 2: `speed_m_s` must be from 0"),
        ({"steer": {"heading_deg": 90}}, ValueError, "unknown field `heading_deg`"),
        ({"drives": {"set": [0.1]}}, ValueError, "3 drives, got 1"),
        ({"steer": {"heading_rad": float("nan")}}, ValueError, "JSON"),
        ({"steer": {1, 2}}, TypeError, "an answer holds numbers, texts, lists and dicts, got set"),
        ([1, 2], ValueError, "auv0 to question 2"),
        ("no", ValueError, "auv0 to question 2"),
    ],
)
def test_an_answer_that_cannot_be_carried_out_is_raised(asks, answer, error, text):
    def controller(question):
        return answer if question["number"] == 2 else None

    with pytest.raises(error, match=text.replace("`", "`")):
        rheotaxis.run(asks, controllers=controller)


def test_an_exception_of_a_controller_ends_the_run(asks, tmp_path):
    asked = []

    def controller(question):
        asked.append(question["number"])
        if question["number"] == 3:
            raise KeyError("my own")

    with pytest.raises(KeyError, match="my own"):
        rheotaxis.run(asks, controllers=controller, files=tmp_path)
    assert asked == [0, 1, 2, 3]
    # What was computed before is there.
    assert (tmp_path / "run.mcap").stat().st_size > 0 and (tmp_path / "track.csv").stat().st_size > 0
    with pytest.raises(KeyboardInterrupt):
        rheotaxis.run(asks, controllers=lambda question: (_ for _ in ()).throw(KeyboardInterrupt))


def test_wrong_controllers_are_refused(asks, channel):
    with pytest.raises(ValueError, match="no robot or gantry \"auv0\" has the strategy External.*Ron"):
        rheotaxis.run(channel, controllers={"auv0": east})
    with pytest.raises(ValueError, match="those that have: auv0"):
        rheotaxis.run(asks, controllers={"auv7": east})
    with pytest.raises(TypeError, match="a controller must be a function"):
        rheotaxis.run(asks, controllers={"auv0": 3})
    with pytest.raises(TypeError, match="controllers must be a function, or a dict"):
        rheotaxis.run(asks, controllers=3)


def test_runs_in_two_threads_have_controllers(asks):
    digests = []
    work = [threading.Thread(target=lambda: digests.append(rheotaxis.run(asks, controllers=east).digest)) for _ in "ab"]
    for thread in work:
        thread.start()
    for thread in work:
        thread.join(120)
    assert len(digests) == 2 and digests[0] == digests[1] == rheotaxis.run(asks, controllers=east).digest
