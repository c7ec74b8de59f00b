"""The look: readers, drawing, errors, and what must hold of a stalled viewer."""

import json
import os
import socket
import struct
import subprocess
import sys
import time

import numpy as np
import pytest

import rheotaxis

for needed in ("rerun", "mcap", "zenoh", "PIL"):
    pytest.importorskip(needed, reason='the look needs: pip install "./scenarios/python[look]"')

from look_kit import cdr_float64, cut  # noqa: E402

from rheotaxis.look import arguments, cdr, contents, events, shapes, turns  # noqa: E402
from rheotaxis.look import scene as scenes  # noqa: E402
from rheotaxis.look.command import main  # noqa: E402
from rheotaxis.look.errors import LookError  # noqa: E402
from rheotaxis.look.mailbox import Mailbox  # noqa: E402
from rheotaxis.look.recording import Recording  # noqa: E402
from rheotaxis.look.wire import Wire  # noqa: E402
from rheotaxis.look.writer import Writer  # noqa: E402


@pytest.fixture(scope="module")
def run(tmp_path_factory):
    """A folder with the recording of a minute's mission."""
    folder = tmp_path_factory.mktemp("look") / "run"
    channel = rheotaxis.Scenario.load("uniform_channel").with_({"time.spin_up_s": 300, "time.limit_s": 60})
    rheotaxis.run(channel, seed=1, files=str(folder))
    return folder


def heard(folder, **options):
    return list(Recording(contents.look_into(contents.find(folder)), **options).events())


def test_a_recording_tells_what_the_table_holds(run):
    told = heard(run)
    true = np.array([e.position for e in told if isinstance(e, events.Pose) and not e.believed])
    table = np.genfromtxt(run / "track.csv", delimiter=",", names=True, dtype=None, encoding=None)
    assert abs(true[-1][0] - table["east_m"][-1]) < 1.0 and abs(true[-1][1] - table["north_m"][-1]) < 1.0
    volts = max(e.value for e in told if isinstance(e, events.Number) and e.name == "volts")
    assert volts == pytest.approx(np.nanmax(table["reading_v"]), abs=0.05)
    plumes = [e for e in told if isinstance(e, events.Cloud) and e.name == "plume"]
    assert plumes and all(len(e.points) > 0 and (e.values["size"] > 0).all() for e in plumes)
    assert isinstance(told[-1], events.Ended)


def test_rays_and_zones_are_drawn(tmp_path, recwarn):
    harbour = rheotaxis.Scenario.load("bluerov_harbour").with_({"time.limit_s": 450})
    rheotaxis.run(harbour, seed=2, files=str(tmp_path / "run"))
    told = heard(tmp_path / "run")
    pings = [e for e in told if isinstance(e, events.Cloud) and e.name == "ranging"]
    assert len(pings) > 400 and max(len(e.points) for e in pings) > 2
    zones = [e for e in told if isinstance(e, events.Way) and e.name == "zone"]
    assert zones and np.allclose(zones[0].points[0], zones[0].points[-1])
    assert main([str(tmp_path / "run"), "--save", str(tmp_path / "run.rrd")]) == 0
    assert not [w.message for w in recwarn if "Rerun" in w.category.__name__]


def test_a_recording_ends_where_asked(run):
    told = [e for e in heard(run, until_s=20.0) if not isinstance(e, events.Ended)]
    assert 15.0 < max(e.t_s for e in told) <= 20.0


def test_the_scene_of_a_recording_is_whole(run):
    document = contents.look_into(run / "run.mcap").scene
    assert document is not None, "the recording has no scene.json"
    scene = scenes.read(document)
    assert scene.bed.shape[2] == 3 and len(scene.corners) == 4 and scene.sources
    assert scene.machines["auv0"]["links"] and scene.machines["auv0"]["joints"]


@pytest.mark.parametrize(
    ("change", "words"),
    [
        (lambda d: d.update(version=9), "version 9"),
        (lambda d: d["bed"].update(points_m="AAAA"), "bed.points_m"),
        (lambda d: d["bed"].update(shape=[3, 3]), "bed.shape"),
        (lambda d: d.pop("version"), "version"),
        (
            lambda d: d["solids"].append({"vertices_m": "AAAAAAAAAAAAAAAA", "triangles": "CQAAAAkAAAAJAAAA"}),
            "names vertex 9",
        ),
    ],
)
def test_a_damaged_scene_is_named(run, change, words):
    document = json.loads(contents.look_into(run / "run.mcap").scene)
    change(document)
    with pytest.raises(LookError, match=words):
        scenes.read(json.dumps(document).encode())


def test_a_recording_is_saved_for_the_viewer(run, tmp_path, capsys):
    target = tmp_path / "run.rrd"
    assert main([str(run), "--save", str(target), "--truth"]) == 0
    assert target.read_bytes()[:4] == b"RRF2" and target.stat().st_size > 50_000
    assert "Missing" not in capsys.readouterr().err


def test_pictures_of_a_camera_are_drawn_and_rerun_complains_of_nothing(tmp_path, recwarn):
    eyes = rheotaxis.Scenario.load("inspect_places").with_({"time.spin_up_s": 60, "time.limit_s": 200})
    rheotaxis.run(eyes, seed=1, files=str(tmp_path / "run"))
    assert any(isinstance(e, events.Picture) for e in heard(tmp_path / "run"))
    assert main([str(tmp_path / "run"), "--save", str(tmp_path / "run.rrd")]) == 0
    assert not [w.message for w in recwarn if "Rerun" in w.category.__name__]


def test_a_recording_that_is_cut_off_is_shown_as_far_as_it_goes(run, tmp_path, capsys):
    for share in (0.3, 0.6, 0.95):
        cut(run / "run.mcap", tmp_path / "cut.mcap", share)
        target = tmp_path / "cut.rrd"
        assert main([str(tmp_path / "cut.mcap"), "--save", str(target)]) == 1
        assert "is cut off; what can be read ends at" in capsys.readouterr().err
        assert target.stat().st_size > 10_000


@pytest.mark.parametrize(
    ("make", "words"),
    [
        (lambda p: None, "there is no such file or folder"),
        (lambda p: p.mkdir(), "no run.mcap in this folder"),
        (lambda p: p.write_bytes(b"no recording at all"), "this is no MCAP recording"),
        (lambda p: p.write_bytes(b""), "this is no MCAP recording"),
    ],
)
def test_what_is_no_recording_is_named(tmp_path, capsys, make, words):
    make(tmp_path / "x")
    assert main([str(tmp_path / "x"), "--save", str(tmp_path / "x.rrd")]) == 1
    assert words in capsys.readouterr().err
    assert not (tmp_path / "x.rrd").exists()


def test_where_nothing_can_be_written_is_named(run, tmp_path, capsys):
    assert main([str(run), "--save", str(tmp_path / "none" / "x.rrd")]) == 1
    assert "does not exist" in capsys.readouterr().err
    assert main([str(run), "--save", str(tmp_path)]) == 1
    assert "no regular file" in capsys.readouterr().err


def test_a_taken_port_is_named(run, capsys):
    with socket.socket() as taken:
        taken.bind(("127.0.0.1", 0))
        taken.listen()
        port = taken.getsockname()[1]
        assert main([str(run), "--web", "--web-port", str(port)]) == 1
        assert f"port {port} is taken" in capsys.readouterr().err
        assert main([str(run), "--web", "--data-port", str(port)]) == 1
        assert f"port {port} is taken" in capsys.readouterr().err


def test_no_run_is_named(tmp_path, capsys):
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        end = f"tcp/127.0.0.1:{probe.getsockname()[1]}"
    assert main(["--save", str(tmp_path / "x.rrd"), "--connect", end, "--wait", "1"]) == 1
    assert "no run was found within 1 s" in capsys.readouterr().err


@pytest.mark.parametrize(
    "words", [["--memory", "lots"], ["--at", "-1", "x"], ["--web-port", "80"], ["--size", "9x9"], ["x", "--run", "y"]]
)
def test_wrong_usage_is_2(words, capsys):
    with pytest.raises(SystemExit) as e:
        arguments.read(words)
    assert e.value.code == 2 and capsys.readouterr().err


def test_no_chromium_is_named(run, tmp_path, monkeypatch, capsys):
    monkeypatch.setenv("CHROMIUM", "no-such-program")
    assert main([str(run), "--picture", str(tmp_path / "x.png")]) == 1
    assert "no Chromium found" in capsys.readouterr().err


def test_messages_are_read_to_their_last_byte():
    assert cdr.float64(cdr_float64(2.5)) == 2.5
    with pytest.raises((ValueError, struct.error)):
        cdr.float64(cdr_float64(2.5)[:-1])
    with pytest.raises(ValueError):
        cdr.string(b"\0\1\0\0\xff\xff\xff\x7fab")


def test_live_messages_become_events_and_nonsense_none():
    wire = Wire()
    said = {"t_s": 3.0, "behaviour": "find", "lost_points_m": [[1, 2]]}
    told = wire.events("auv/a/behaviour", json.dumps(said).encode(), None)
    assert [type(e) for e in told] == [events.Words, events.Marks] and told[0].text == "find"
    assert wire.events("auv/a/behaviour", json.dumps(said).encode(), None) == []
    said |= {"zone_points_m": [[1, 2], [3, 2]], "zone_m": [[1, 2], [3, 2], [3, 4]]}
    here = {"t_s": 3.0, "position_m": [1, 2], "depth_m": 5, "heading_rad": 0, "pitch_rad": 0, "roll_rad": 0}
    wire.events("auv/a/estimate", json.dumps(here).encode(), None)
    points, outline = wire.events("auv/a/behaviour", json.dumps(said).encode(), None)
    assert points.name == "zone_points" and outline.points.tolist() == [[1, 2, -5], [3, 2, -5], [3, 4, -5], [1, 2, -5]]
    ping = {"t_s": 3.0, "echoes_body_m": [[3, 0, 0]]}
    (cloud,) = wire.events("auv/a/ranging", json.dumps(ping).encode(), None)
    assert cloud.name == "ranging" and cloud.points.shape == (1, 3)
    plume = np.arange(12, dtype="<f4").tobytes()
    (cloud,) = wire.events("plume", plume, b'{"t_s": 1.0}')
    assert cloud.points.shape == (2, 3) and cloud.values["mass"][1] == 10.0
    for nonsense in (b"", b"{", b"[]", b'{"t_s": 1}', b"\xff\xfe", b"null", b"3"):
        for key in ("plume", "auv/a/truth", "auv", "map/a", "gantry/g/joints", "auv/a/picture"):
            assert wire.events(key, nonsense, None) == []


def test_newest_wins_and_what_must_arrive_arrives():
    box = Mailbox()
    for k in range(100_000):
        box.put(events.Number(float(k), "a", "volts", k))
    for k in range(50):
        box.put(events.Words(float(k), "a", "behaviour", str(k)))
    taken = box.take(0.0)
    assert [e.value for e in taken if isinstance(e, events.Number)] == [99_999]
    assert [e.text for e in taken if isinstance(e, events.Words)] == [str(k) for k in range(50)]
    box.close()
    assert box.take(0.0) is None


def test_a_viewer_that_stalls_or_is_gone_holds_nothing_back(run):
    """The data's end is a socket that takes a connection and never reads."""
    document = contents.look_into(run / "run.mcap").scene
    with socket.socket() as stalled:
        stalled.bind(("127.0.0.1", 0))
        stalled.listen()
        writer = Writer(f"rerun+http://127.0.0.1:{stalled.getsockname()[1]}/proxy", False, False)
        writer.put(events.SceneSaid(float("-inf"), None, document, "x_1"))
        points = np.random.default_rng(1).random((5000, 3))
        values = {"size": np.full(5000, 0.1), "concentration": np.full(5000, 1e-6)}
        # More than the sockets between the two can take: whoever waited for the viewer would wait for ever.
        for k in range(1500):
            writer.put(events.Cloud(4.0 * k, None, "plume", points, values))
            writer.put(events.Number(float(k), "auv0", "volts", 1.0))
            time.sleep(0.002)
        before = time.monotonic()
        writer.close()
        assert time.monotonic() - before < 120.0 and not writer.alive()


def test_shapes_enclose_their_volume():
    def volume(shape):
        points, triangles, _ = shape
        a, b, c = (points[np.asarray(triangles)[:, k]] for k in range(3))
        return abs(np.einsum("ij,ij->i", a, np.cross(b, c)).sum() / 6.0)

    assert volume(shapes.capsule(0.5, 2.0)) == pytest.approx(np.pi * 0.25 * 2.0 + 4 / 3 * np.pi * 0.125, rel=0.03)
    assert volume(shapes.sphere(1.0)) == pytest.approx(4 / 3 * np.pi, rel=0.03)


def test_headings_turn_the_body_as_compasses_do():
    assert turns.turn(turns.from_compass(0.0), [1, 0, 0]) == pytest.approx([0, 1, 0], abs=1e-12)
    assert turns.turn(turns.from_compass(np.pi / 2), [1, 0, 0]) == pytest.approx([1, 0, 0], abs=1e-12)
    assert turns.turn(turns.from_compass(0.0, 0.3), [1, 0, 0])[2] == pytest.approx(np.sin(0.3))
    assert turns.turn(turns.from_compass(0.0, 0.0, 0.3), [0, 1, 0])[2] == pytest.approx(np.sin(0.3))


def test_help_teaches():
    said = subprocess.run(
        [sys.executable, "-m", "rheotaxis.look", "--help"],
        capture_output=True,
        text=True,
        env=os.environ,
        timeout=60,
        check=True,
    ).stdout
    assert "runs/duck_st-1" in said and "127.0.0.1" in said and "default 1GiB" in said
