"""What a run tells of itself, in one form whichever way it came.

Positions are in the world: east, north, up in m, z = 0 at the still surface. Quaternions are x, y, z, w and take body
axes to the world's. `t_s` is simulated time in seconds from the start of the mission. `machine` is the id of a robot or
gantry, or None.
"""

from dataclasses import dataclass, field

import numpy as np


@dataclass(slots=True)
class Event:
    """Something at a time."""

    t_s: float
    machine: str | None

    def slot(self):
        """Events of one slot replace each other in a queue that runs over; None for those that must all arrive."""
        return (type(self), self.machine)


@dataclass(slots=True)
class Pose(Event):
    """Where a vehicle is, or believes it is; `speed_m_s` over ground."""

    believed: bool
    position: np.ndarray
    quaternion: np.ndarray
    speed_m_s: float | None = None

    def slot(self):
        return (Pose, self.machine, self.believed)


@dataclass(slots=True)
class Number(Event):
    """A value with a name, in the unit of the name."""

    name: str
    value: float

    def slot(self):
        return (Number, self.machine, self.name)


@dataclass(slots=True)
class Words(Event):
    """A state with a name, such as `behaviour`."""

    name: str
    text: str

    def slot(self):
        return None


@dataclass(slots=True)
class Joints(Event):
    """Positions of a gantry's joints, m or rad, by name."""

    positions: dict


@dataclass(slots=True)
class Place(Event):
    """Where a named part of a machine is."""

    name: str
    position: np.ndarray

    def slot(self):
        return (Place, self.machine, self.name)


@dataclass(slots=True)
class Cloud(Event):
    """Points with values: `plume`, `water`, `map`, `sidescan`; `ranging`, whose echoes are in body axes."""

    name: str
    points: np.ndarray
    values: dict
    #: Of a map: size of a cell along its axes, m, and the direction of its first axis, rad from east to north.
    cell_m: np.ndarray | None = None
    turned_rad: float | None = None

    def slot(self):
        return (Cloud, self.machine, self.name)


@dataclass(slots=True)
class Way(Event):
    """A path that is planned (`plan`), the line to the present goal (`goal`), the outline of a zone (`zone`)."""

    name: str
    points: np.ndarray

    def slot(self):
        return (Way, self.machine, self.name)


@dataclass(slots=True)
class Marks(Event):
    """Places with one meaning, such as `lost`: where the plume was lost; `zone_points`: what the declaration rule looks at."""

    name: str
    points: np.ndarray

    def slot(self):
        return (Marks, self.machine, self.name)


@dataclass(slots=True)
class Declared(Event):
    """A source that a machine declared (east, north, up; up is NaN where only the plane is meant)."""

    number: int
    position: np.ndarray
    words: str = ""

    def slot(self):
        return None


@dataclass(slots=True)
class Said(Event):
    """A line of the run's own log; `warning` where something went wrong."""

    text: str
    warning: bool = False

    def slot(self):
        return None


@dataclass(slots=True)
class Picture(Event):
    """A camera's picture (PNG or JPEG). The camera's axes are right, down, into the scene.

    Its pose is in the world if `mounted` is false, else relative to the vehicle's body.
    """

    media: str
    data: bytes
    position: np.ndarray | None = None
    quaternion: np.ndarray | None = None
    mounted: bool = False
    view_rad: float | None = None


@dataclass(slots=True)
class SceneSaid(Event):
    """The scene document (bytes of JSON)."""

    document: bytes = b""
    run: str = ""

    def slot(self):
        return None


@dataclass(slots=True)
class Ended(Event):
    """The run is over."""

    why: str = ""
    notes: list = field(default_factory=list)

    def slot(self):
        return None
