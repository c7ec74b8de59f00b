"""The examples in Python of README and of the page about interfaces run as they are printed."""

import os
import re
import socket
import subprocess
import time
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[3]
BINARY = Path(os.environ.get("RHEOTAXIS_BINARY", ROOT / "target/release/rheotaxis"))


def example(page, words):
    """The one block of a page with these words."""
    blocks = re.findall(r"```python\n(.*?)```", (ROOT / page).read_text(), re.S)
    [block] = [block for block in blocks if words in block]
    return block


def test_readme_runs_as_printed(capsys):
    pytest.importorskip("gymnasium")
    exec(compile(example("README.md", "import rheotaxis"), "README.md", "exec"), {})
    printed = capsys.readouterr().out.split()
    assert printed == ["found", "time_out"]
    assert all(f'# "{outcome}": ' in example("README.md", "import rheotaxis") for outcome in printed)


@pytest.mark.skipif(
    not BINARY.is_file(), reason=f"skipped: no {BINARY} (cargo build --release, or set RHEOTAXIS_BINARY)"
)
def test_the_subscriber_of_the_docs_hears_a_run_to_its_end(tmp_path, capsys):
    pytest.importorskip("zenoh")
    block, default = example("docs/interfaces.md", "zenoh.open"), "range(7447, 7511)"
    assert block.count(default) == 1 and len(block.split("\n\n")[1].splitlines()) < 10
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        address = probe.getsockname()
    end = f"tcp/127.0.0.1:{address[1]}"
    command = [BINARY, "run", "uniform_channel", "--speed", "50", "--quiet", "--no-cache", "--out", tmp_path / "run"]
    run = subprocess.Popen([*command, "--zenoh-listen", end])
    try:
        # The run would otherwise be over before a subscriber that came too early tries again.
        for _ in range(6000):
            with socket.socket() as knock:
                if knock.connect_ex(address) == 0:
                    break
            assert run.poll() is None, "the run has ended"
            time.sleep(0.1)
        exec(compile(block.replace(default, f"[{address[1]}]"), "docs/interfaces.md", "exec"), {})
    finally:
        run.kill()
        run.wait()
    assert capsys.readouterr().out.startswith("rheotaxis/uniform_channel_1/clock ")
