"""Looks into the wheel and the source distribution of the Python package: names, version, extras, files.

    maturin build --release --out DIST && maturin sdist --out DIST      (both in scenarios/python)
    python3 tools/check_wheel.py DIST

Prints the path of the wheel, which can then be installed and tested.
"""

import email
import sys
import tarfile
import zipfile
from email.message import Message
from pathlib import Path

#: The crates that the source distribution must hold, by their folders in it.
CRATES = ("world", "plumes", "robots", "robots/eyes", "scenarios/simulation", "scenarios/output", "scenarios/python")
EXTRAS = {"gym", "look", "pettingzoo", "sb3", "test"}

root = Path(__file__).parents[1]


def workspace_version() -> str:
    """The version in the workspace's manifest."""
    lines = (root / "Cargo.toml").read_text().split("[workspace.package]")[1].splitlines()
    return next(line.split('"')[1] for line in lines if line.startswith("version = "))


def one(folder: Path, pattern: str) -> Path:
    """The only file of a pattern."""
    found = sorted(folder.glob(pattern))
    if len(found) != 1:
        raise SystemExit(f"{folder} must hold one {pattern}, got {[path.name for path in found]}")
    return found[0]


def check(what: str, got: object, expected: object) -> None:
    if got != expected:
        raise SystemExit(f"{what} must be {expected!r}, got {got!r}")


def check_metadata(where: str, said: Message) -> None:
    """Name, version and the rest, which wheel and source distribution say alike."""
    check(f"{where}: Name", said["Name"], "rheotaxis-sim")
    check(f"{where}: Version", said["Version"], workspace_version())
    check(f"{where}: Requires-Python", said["Requires-Python"], ">=3.10")
    check(f"{where}: License-Expression", said["License-Expression"], "MIT OR Apache-2.0")
    check(f"{where}: extras", set(said.get_all("Provides-Extra", [])), EXTRAS)
    for field in ("Summary", "Keywords", "Classifier", "Description-Content-Type"):
        check(f"{where}: has {field}", field in said, True)


def check_files(where: str, needed: list[str], names: list[str]) -> None:
    missing = [name for name in needed if name not in names]
    check(f"{where}: missing files", missing, [])


def main() -> None:
    folder = Path(sys.argv[1])
    wheel, source = one(folder, "rheotaxis_sim-*.whl"), one(folder, "rheotaxis_sim-*.tar.gz")
    with zipfile.ZipFile(wheel) as opened:
        names = opened.namelist()
        about = f"rheotaxis_sim-{workspace_version()}.dist-info"
        check_files("wheel", [f"{about}/METADATA", f"{about}/entry_points.txt"], names)
        check_metadata("wheel", email.message_from_bytes(opened.read(f"{about}/METADATA")))
        check_files("wheel", [f"rheotaxis/{name}" for name in ("__init__.py", "_rheotaxis.pyi", "py.typed")], names)
        check("wheel: engine", any(name.startswith("rheotaxis/_rheotaxis.abi3") for name in names), True)
        check("wheel: packages", {name.split("/")[0] for name in names}, {"rheotaxis", about})
    top = source.name.removesuffix(".tar.gz")
    with tarfile.open(source) as opened_source:
        names = opened_source.getnames()
        check_files("sdist", [f"{top}/{name}" for name in ("PKG-INFO", "pyproject.toml", "Cargo.lock")], names)
        check_files("sdist", [f"{top}/{crate}/Cargo.toml" for crate in CRATES], names)
        info = opened_source.extractfile(f"{top}/PKG-INFO")
        assert info is not None
        check_metadata("sdist", email.message_from_bytes(info.read()))
    print(wheel)


if __name__ == "__main__":
    main()
