"""The package is typed: `mypy --strict` accepts it, its stubs, and a program that uses all of it."""

import subprocess
import sys
from pathlib import Path

import pytest

import rheotaxis

HERE = Path(__file__).parent
#: The look is a program of its own, which nobody imports.
PACKAGE = ["-p", "rheotaxis", "--exclude", "rheotaxis/look/"]


@pytest.fixture(scope="module")
def mypy(tmp_path_factory):
    """Runs mypy --strict with some arguments: its exit code and what it says."""
    folder = tmp_path_factory.mktemp("mypy")

    def run(*arguments):
        command = [sys.executable, "-m", "mypy", "--strict", "--cache-dir", str(folder / "cache"), *arguments]
        done = subprocess.run(command, cwd=folder, capture_output=True, text=True, timeout=600)
        return done.returncode, done.stdout + done.stderr

    return run


def test_package_and_stubs_are_typed(mypy):
    # With the settings of the package: some of what it stands on has no types of its own.
    code, said = mypy("--config-file", str(HERE.parent / "pyproject.toml"), *PACKAGE)
    assert code == 0, said


def test_a_users_program_is_typed(mypy):
    code, said = mypy("--config-file", "", str(HERE / "typed_user.py"))
    assert code == 0, said


def test_mistakes_of_a_user_are_found(mypy, tmp_path):
    mistakes = {
        "rheotaxis.run('x', sed=1)": 'Unexpected keyword argument "sed"',
        "rheotaxis.run('x').track + 1": "Unsupported operand types for +",
        "rheotaxis.run('x', controllers=3)": 'Argument "controllers" to "run"',
        "rheotaxis.Env('x', rewards='hits')": 'Unexpected keyword argument "rewards"',
        "rheotaxis.VectorEnv('x', truth='yes')": 'Argument "truth" to "VectorEnv"',
        "rheotaxis.Env('x').scenario = 1": 'Property "scenario"',
        "rheotaxis.VectorEnv('x', num_envs='2')": 'Argument "num_envs" to "VectorEnv"',
    }
    file = tmp_path / "mistakes.py"
    file.write_text("\n".join(["import rheotaxis", *mistakes]))
    code, found = mypy("--config-file", "", str(file))
    assert code == 1
    for n, said in enumerate(mistakes.values(), start=2):
        assert any(f"mistakes.py:{n}: error: {said}" in line for line in found.splitlines()), (said, found)


def test_the_package_says_that_it_is_typed():
    assert Path(rheotaxis.__file__).with_name("py.typed").exists()
