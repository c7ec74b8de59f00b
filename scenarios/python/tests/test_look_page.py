"""The look's page in headless Chromium, judged by what is to be seen on it."""

import os
import socket
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

import rheotaxis

for needed in ("rerun", "mcap", "zenoh", "PIL"):
    pytest.importorskip(needed, reason='the look needs: pip install "./scenarios/python[look]"')

from look_kit import chromium, near  # noqa: E402

from rheotaxis.look import colours, picture  # noqa: E402
from rheotaxis.look.command import main  # noqa: E402

pytestmark = pytest.mark.skipif(not chromium(), reason="skipped: no Chromium here (install chromium, or set CHROMIUM)")

BINARY = Path(os.environ.get("RHEOTAXIS_BINARY", Path(__file__).parents[3] / "target/release/rheotaxis"))
SIZE = (1200, 700)
#: The views of the layout of an AUV's mission in a page of that size: left, top, right, bottom.
MISSION, BESIDE = (0, 50, 740, 560), (745, 50, 1200, 270)


def part(image, box):
    left, top, right, bottom = box
    return image[top:bottom, left:right]


def judge(png):
    """Bed, plume, track and hull are there, each in the view in which it belongs."""
    image = picture.pixels(png)
    assert image.shape == (SIZE[1], SIZE[0], 3)
    mission, beside = part(image, MISSION), part(image, BESIDE)
    bed = colours.shade([0.55], "bed")[0]
    assert near(mission, colours.BACKGROUND, 2) > 0.05
    assert near(mission, bed, 45) > 0.08, "no bed in the overview"
    red, green, blue = (mission[..., k] for k in range(3))
    assert ((red - green > 40) & (blue - green > 15)).mean() > 0.002, "no plume in the overview"
    white = [(view.min(axis=2) > 200).mean() for view in (mission, beside)]
    # Early in a live run the track is short in the overview.
    assert white[0] > 0.0005 or white[1] > 0.001, "no track"
    red, green, blue = (beside[..., k] for k in range(3))
    assert ((red - blue > 60) & (green - blue > 40)).mean() > 0.004, "no hull in the view beside the vehicle"


def test_the_page_of_a_replay_shows_the_mission(tmp_path):
    channel = rheotaxis.Scenario.load("uniform_channel").with_({"time.limit_s": 120})
    rheotaxis.run(channel, seed=1, files=str(tmp_path / "run"))
    target = tmp_path / "replay.png"
    assert main([str(tmp_path / "run"), "--picture", str(target), "--size", "1200x700"]) == 0
    judge(target.read_bytes())
    # Another time is another picture.
    early = tmp_path / "early.png"
    assert main([str(tmp_path / "run"), "--picture", str(early), "--size", "1200x700", "--at", "5"]) == 0
    apart = np.abs(picture.pixels(early.read_bytes()) - picture.pixels(target.read_bytes())).max(axis=2) > 8
    assert apart.mean() > 0.005


@pytest.mark.skipif(
    not BINARY.is_file(), reason=f"skipped: no {BINARY} (cargo build --release, or set RHEOTAXIS_BINARY)"
)
def test_the_page_of_a_live_run_shows_the_mission(tmp_path):
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        end = f"tcp/127.0.0.1:{probe.getsockname()[1]}"
    target = tmp_path / "live.png"
    # The look is there before the run.
    look = subprocess.Popen(
        [
            sys.executable,
            "-m",
            "rheotaxis.look",
            "--connect",
            end,
            "--picture",
            str(target),
            "--size",
            "1200x700",
            "--at",
            "40",
        ],
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
    )
    run = subprocess.Popen(
        [
            BINARY,
            "run",
            "uniform_channel",
            "--speed",
            "4",
            "--quiet",
            "--no-cache",
            "--zenoh-listen",
            end,
            "--out",
            tmp_path / "run",
        ]
    )
    try:
        said, _ = look.communicate(timeout=400)
        assert look.returncode == 0, said
        assert run.poll() is None, "the run was over before the picture"
        judge(target.read_bytes())
    finally:
        look.kill()
        run.kill()
        run.wait()


def test_both_servers_listen_on_this_machine_only(tmp_path):
    from rheotaxis.look.viewer import Viewer

    with Viewer(True, "64MB") as viewer:
        ports = {viewer.web_port, viewer.data_port}
        table = [
            line.split() for name in ("tcp", "tcp6") for line in Path(f"/proc/net/{name}").read_text().splitlines()[1:]
        ]
        listening = {(int(row[1].split(":")[1], 16), row[1].split(":")[0]) for row in table if row[3] == "0A"}
        at = {where for port, where in listening if port in ports}
        assert at == {"0100007F"}, at
    assert not viewer.alive()
