"""Reads a recording (`run.mcap`) as events, thinned out to what a viewer bears."""

import struct

import numpy as np
from mcap.records import Channel, Message
from mcap.stream_reader import StreamReader

from . import cdr, turns
from .contents import BROKEN
from .events import Cloud, Declared, Ended, Joints, Number, Marks, Picture, Place, Pose, Said, Way, Words

#: Most rows of one value over a mission, and most points of all clouds of one kind.
ROWS, POINTS = 8000, 4_000_000
#: Shortest time between two clouds of one topic, s.
CLOUD_S = 2.0
#: Shortest time between two pings of the ranging, s.
PING_S = 0.5
#: Marks that are shown: their names in the recording and ours.
MARKS = {"lost points": "lost", "points of the zone": "zone_points"}
#: Values of which the largest in an interval is kept, because they come in short bursts.
PEAKS = ("chemical", "probes/", "spikes/")
#: Numbers of a machine: the topic's name and ours.
NUMBERS = {"altitude": "altitude_m", "chemical": "volts", "spike_hz": "spike_hz"}
#: Topics of words, which come only when they change.
WORDS = ("behaviour", "layers", "layer", "region", "abnormal")


class Recording:
    """The events of a recording, in the order in which they were written."""

    def __init__(self, contents, until_s=None):
        self.contents = contents
        self.until_s = until_s
        duration = contents.duration_s if until_s is None else min(contents.duration_s, until_s)
        self.period_s = duration / ROWS
        self.cloud_s = max(CLOUD_S, duration * 2000.0 / POINTS)
        self.whole = True
        self._next = {}
        self._peaks = {}
        self._declared = {}
        self._frames = {}

    def events(self):
        """Yields the events; afterwards `whole` says whether the file could be read to its end."""
        channels = {}
        last = self.contents.first_s or 0.0
        try:
            with open(self.contents.path, "rb") as file:
                for record in StreamReader(file).records:
                    if isinstance(record, Channel):
                        channels[record.id] = record.topic
                    elif isinstance(record, Message):
                        t = 1e-9 * record.log_time
                        if self.until_s is not None and t > self.until_s:
                            continue
                        last = max(last, t)
                        yield from self._message(channels[record.channel_id], t, record.data)
        except BROKEN:
            self.whole = False
        for (machine, name), (t, value) in self._peaks.items():
            yield Number(t, machine, name, value)
        yield Ended(
            last, None, "the recording ends" if self.whole and self.contents.whole else "the recording breaks off"
        )

    def _due(self, topic, t, period):
        if t < self._next.get(topic, -np.inf):
            return False
        # Half a step early counts, so that samples which lie on the period do not slip to the next one.
        self._next[topic] = t + 0.999 * period
        return True

    def _message(self, topic, t, data):
        parts = topic.split("/", 2)
        if len(parts) == 2:
            yield from self._common(parts[1], topic, t, data)
            return
        machine, name = parts[1], parts[2]
        if name.startswith(PEAKS):
            yield from self._peak(machine, NUMBERS.get(name, name), t, struct.unpack_from("<d", data, 4)[0])
        elif name in WORDS:
            yield Words(t, machine, name, cdr.string(data))
        elif name == "declaration":
            at, position, _ = cdr.pose_stamped(data)
            number = self._declared.get(machine, 0)
            self._declared[machine] = number + 1
            yield Declared(min(at, t) if at > 0 else t, machine, number, position)
        elif name == "marks":
            for kind, places in cdr.markers(data):
                if kind in MARKS:
                    yield Marks(t, machine, MARKS[kind], places)
        elif name in ("plan", "zone"):
            yield Way(t, machine, name, cdr.path(data))
        elif name == "camera/compressed":
            frame, kind, image = cdr.compressed_image(data)
            above, position, quaternion = self._seen_from(frame, machine)
            media = "image/png" if "png" in kind else "image/jpeg"
            yield Picture(t, machine, media, image, position, quaternion, above == machine)
        elif name in ("map", "sidescan", "ranging"):
            periods = {"map": self.cloud_s, "ranging": max(self.period_s, PING_S)}
            if name not in periods or self._due(topic, t, periods[name]):
                yield self._cloud(t, machine, name, data)
        elif self._due(topic, t, self.period_s):
            yield from self._dense(machine, name, t, data)

    def _dense(self, machine, name, t, data):
        if name in ("truth", "estimate"):
            position, quaternion, velocity = cdr.odometry(data)
            yield Pose(t, machine, name == "estimate", position, quaternion, float(np.linalg.norm(velocity)))
        elif name in NUMBERS:
            yield Number(t, machine, NUMBERS[name], cdr.float64(data))
        elif name.startswith(("actuators/", "thresholds/")):
            yield Number(t, machine, name.removeprefix("actuators/"), cdr.float64(data))
        elif name == "flow":
            v = cdr.vector3_stamped(data)
            yield Number(t, machine, "flow_m_s", float(np.hypot(v[0], v[1])))
        elif name == "joint_states":
            yield Joints(t, machine, cdr.joint_state(data))

    def _common(self, name, topic, t, data):
        if name in ("plume", "water"):
            if self._due(topic, t, self.cloud_s):
                yield self._cloud(t, None, name, data)
        elif name == "rosout":
            at, level, machine, line = cdr.log(data)
            yield Said(at, machine, line, level >= 30)
        elif name == "tf_static" or (name == "tf" and (b"/camera" in data or self._due(topic, t, self.period_s))):
            for parent, child, position, quaternion in cdr.transforms(data):
                self._frames[child] = (parent, position, quaternion)
                machine, _, part = child.partition("/")
                if part == "head" or part.startswith("probe_"):
                    above, place, _ = self._seen_from(child, machine)
                    if above == "world":
                        yield Place(t, machine, part, place)

    def _seen_from(self, frame, machine):
        """The place and direction of a frame in the nearest of its parents that is the machine itself or the world."""
        above, position, quaternion = self._frames.get(frame, (frame, np.zeros(3), np.array([0.0, 0.0, 0.0, 1.0])))
        for _ in range(20):
            if above in ("world", machine) or above not in self._frames:
                break
            above, p, q = self._frames[above]
            position, quaternion = p + turns.turn(q, position), turns.times(q, quaternion)
        return above, position, quaternion

    def _cloud(self, t, machine, name, data):
        frame, fields = cdr.point_cloud(data)
        points = cdr.points(fields)
        if frame.startswith("world/"):
            points += self._seen_from(frame, machine)[1]
        values = {k: v for k, v in fields.items() if k not in ("x", "y", "z")}
        return Cloud(t, machine, name, points, values)

    def _peak(self, machine, name, t, value):
        key = (machine, name)
        held = self._peaks.get(key)
        if held is None or value > held[1]:
            self._peaks[key] = (t, value)
        if self._due(f"{machine} {name}", t, self.period_s):
            yield Number(self._peaks[key][0], machine, name, self._peaks[key][1])
            del self._peaks[key]
