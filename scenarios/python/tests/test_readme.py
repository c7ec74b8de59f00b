"""README's example in Python runs as it is printed."""

import re
from pathlib import Path

import pytest


def test_readme_runs_as_printed(capsys):
    pytest.importorskip("gymnasium")
    text = (Path(__file__).parents[3] / "README.md").read_text()
    blocks = re.findall(r"```python\n(.*?)```", text, re.S)
    assert len(blocks) == 1
    exec(compile(blocks[0], "README.md", "exec"), {})
    assert "found" in capsys.readouterr().out
