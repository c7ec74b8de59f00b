"""The engine of the package. World axes are ENU, z = 0 at the still surface; headings are compass degrees."""

from collections.abc import Callable, Mapping
from os import PathLike
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal, TypeAlias, final

import numpy as np
import numpy.typing as npt

__version__: str

if TYPE_CHECKING:
    from .policies import PolicyController

Controller: TypeAlias = Callable[[dict[str, Any]], dict[str, Any] | None] | PolicyController

Outcome = Literal["found", "not_found", "completed", "aborted", "time_out", "interrupted", "failed"]

class ScenarioError(ValueError):
    """A scenario cannot be used.

    The text shows each mistake with file, line, column, field, legal range and, where known, the cure.
    """

    faults: list[dict[str, Any]]
    """Each mistake: ``path``, ``message``, ``help`` (or None), ``line`` and ``column``, both from 1."""

class ScenarioWarning(UserWarning):
    """Something in a scenario is legal and probably not meant."""

class RunWarning(UserWarning):
    """Something in a run is probably not meant: a machine asks a controller and has none, or one that asks lay on the
    bed, or touched an obstacle, for more than a minute."""

@final
class Scenario:
    """A scenario that has been read and checked. It does not change: ``with_`` makes another."""

    @staticmethod
    def load(path: str | PathLike[str]) -> Scenario:
        """Reads a file or, if there is none, the scenario of that name in the catalogue.

        Raises ScenarioError with every mistake of form and meaning.
        """

    @staticmethod
    def parse(text: str, name: str = "scenario") -> Scenario:
        """Reads a text. Paths in it are relative to the working folder; errors call it ``name``."""

    @property
    def text(self) -> str:
        """The text it was read from."""

    @property
    def name(self) -> str:
        """Name of its file, without the ending."""

    @property
    def title(self) -> str: ...
    def check(self) -> list[str]:
        """What is legal and probably not meant: a line ``file:line:column: field: what`` each."""

    def to_dict(self) -> dict[str, Any]:
        """All fields, with the defaults that the text leaves out. A variant is ``{"Name": {...}}``."""

    def __getitem__(self, path: str, /) -> Any:
        """The value at a path such as ``robots.0.start.heading_deg`` or ``robots[0].strategy.vertical``.

        Names of variants may be left out. Units are in the names of fields; ``rheotaxis.explain(path)`` says more.
        Raises KeyError, with what there is, if the scenario has no such place.
        """

    def with_(self, changes: dict[str, Any], /) -> Scenario:
        """Another scenario, with the values at some paths changed, checked as by ``load``.

        A value is a number, a bool, a text, a list, a dict of fields, ``{"Variant": value}``, or
        ``rheotaxis.Ron("...")`` in the notation of scenario files.

        >>> s.with_({"time.limit_s": 600, "robots.0.strategy": rheotaxis.Ron("Amp(speed_m_s: 1.5)")})
        """

    def __eq__(self, other: object, /) -> bool: ...
    def __hash__(self) -> int: ...

@final
class Figure:
    """A figure of a run."""

    @property
    def name(self) -> str: ...
    @property
    def title(self) -> str: ...
    @property
    def svg(self) -> str: ...
    @property
    def png(self) -> bytes: ...
    def save(self, path: str | PathLike[str]) -> None:
        """Writes a file; its ending, .svg or .png, says which."""

    def _repr_png_(self) -> bytes: ...

@final
class Result:
    """What a run has left.

    It pickles with all its data, so a pool of processes can return it. Its figures are drawn for that.
    """

    @property
    def outcome(self) -> Outcome:
        """How the run ended, as in ``summary.json``."""

    @property
    def success(self) -> bool:
        """Whether it ended as the scenario defines success."""

    @property
    def digest(self) -> str:
        """Hash of all states of the run: the same scenario and seed give the same."""

    @property
    def t_s(self) -> float:
        """Time of the mission, s."""

    @property
    def steps(self) -> int:
        """Steps of the mission."""

    @property
    def files(self) -> Path | None:
        """The folder with the files of the run, if they were asked for."""

    @property
    def summary(self) -> dict[str, Any]:
        """The content of ``summary.json``."""

    @property
    def declarations(self) -> list[dict[str, Any]]:
        """Every declaration: ``searcher``, ``t_s`` (s), ``position`` (``east_m``, ``north_m``, as the searcher
        believes), ``rule``, ``verdict``, ``error`` against the nearest true source (m), and more, as in
        ``summary.json``."""

    @property
    def track(self) -> dict[str, dict[str, npt.NDArray[Any]]]:
        """Columns by robot, a row for each ``record.frame_period_s`` of the scenario.

        ``t_s``; the truth: ``east_m``, ``north_m``, ``up_m``, ``roll_deg``, ``pitch_up_deg``, ``heading_deg``,
        ``speed_m_s``, ``altitude_m``; the vehicle's estimate: ``est_east_m``, ``est_north_m``, ``est_depth_m``,
        ``est_roll_deg``, ``est_pitch_up_deg``, ``est_heading_deg``, ``flow_east_m_s``, ``flow_north_m_s``; the
        chemical sensor: ``reading_v``, ``reading_ug_l``, ``detected`` (bool); ``behaviour`` (str). NaN where there is
        no value. docs/columns.md has the unit and meaning of each.
        """

    @property
    def probes(self) -> dict[str, dict[str, npt.NDArray[Any]]]:
        """Columns by gantry; k probes in the order of a scan.

        ``t_s``, ``scan_s`` (time of the newest scan), ``head_m`` (n, 3) and ``tip_m`` (n, k, 3) in ENU,
        ``joint_m`` and ``joint_m_s`` (n, 2), ``volts`` and ``threshold_v`` (n, k), ``spike`` (n, k, bool),
        ``spike_hz``, ``blocked`` (bool), ``behaviour`` (str). docs/columns.md says what each means.
        """

    @property
    def figures(self) -> list[str]:
        """Names of the figures that ``plot`` draws."""

    def plot(self, name: str | None = None) -> Figure:
        """A figure of the run, by default the first: the map, or a gantry's track over the plume."""

    def _repr_png_(self) -> bytes: ...

@final
class _Batch:
    """Many environments, stepped together: what Env, VectorEnv and ParallelEnv stand on."""

    def __new__(
        cls,
        scenario: str | PathLike[str] | Scenario,
        *,
        n: int = 1,
        per_plume: int = 1,
        period_s: float = 1.0,
        limit_s: float | None = None,
        goal_m: float | None = None,
        declare: bool = False,
        turn_deg: float = 180.0,
        climb_m: float = 1.0,
        speed_m_s: tuple[float, float] | None = None,
        kept_plumes: int = 32,
        threads: int = 1,
        cache: bool | str | PathLike[str] | None = None,
    ) -> _Batch: ...
    @property
    def agents(self) -> list[str]: ...
    @property
    def spaces(self) -> list[tuple[bool, int, list[tuple[str, float, float]]]]: ...
    @property
    def limit_s(self) -> float: ...
    def reset(self, begin: list[tuple[int, int, int]], fresh: bool) -> None: ...
    def step(self, acting: list[int], actions: bytes) -> None: ...
    def pilot(self, agent: int, decide: Callable[[npt.NDArray[Any]], bytes]) -> _Pilot: ...
    def look(self) -> dict[str, Any]: ...

@final
class _Pilot:
    """A policy that decides for a searcher of a run: what PolicyController stands on."""

def run(
    scenario: str | PathLike[str] | Scenario,
    seed: int = 1,
    *,
    controllers: Controller | Mapping[str, Controller] | None = None,
    files: str | PathLike[str] | None = None,
    recording: bool = True,
    cache: bool | str | PathLike[str] | None = None,
    threads: int = 0,
) -> Result:
    """Runs a scenario to its end: the spin-up of the plume, then the mission.

    ``scenario`` is a Scenario, the name of one in the catalogue, the path of a file, or a text. The run is that of
    ``rheotaxis run --seed``, bit by bit. Other threads of Python go on meanwhile; Ctrl-C ends the run and raises
    KeyboardInterrupt.

    ``controllers`` decide for robots and gantries whose strategy is ``External``: a function for all of them, or a dict
    of functions by id. A function gets a question as a dict and returns an answer as a dict, with the fields of
    docs/interfaces.md; None changes nothing. An exception of it ends the run and is raised here; an answer that the
    machine cannot carry out raises ValueError. A ``rheotaxis.PolicyController`` stands in the place of a function. A machine
    that asks and has no controller gives a RunWarning; ``controllers={}`` says that none is meant.

    ``files`` names a folder for the files that the command would write, ``run.mcap`` among them if ``recording``.
    ``cache`` is about spin-ups kept on the disk: by default those of the command (``RHEOTAXIS_CACHE``,
    ``RHEOTAXIS_NO_CACHE``), False for none, or a folder. ``threads`` step the plume; 0 means one for each core. The
    result is the same with any number.

    Raises ScenarioError, or RuntimeError if the run could not be made. An argument of a wrong type raises TypeError, one
    out of its range (``seed`` from 0 to 2**64 - 1, ``threads`` from 0 to 1024) ValueError.
    """

def catalogue() -> dict[str, dict[str, Any]]:
    """The scenarios that come with the program, by name: ``title``, ``citation``, ``searchers`` (ids)."""

def _panic(words: str) -> None: ...
def explain(path: str = "") -> str:
    """What a place of a scenario may hold: unit, range, default, meaning and source of each field. Paths that begin
    with ``vehicle`` are places of a ``vehicle.ron``.

    Raises KeyError, with the nearest paths, if there is no such place.
    """
