"""Messages of the live state as events; `rheotaxis topics` explains the keys."""

import json

import numpy as np

from . import turns
from .events import Cloud, Declared, Joints, Marks, Number, Picture, Place, Pose, Way, Words

#: Set-points of drives in the message `command`.
DRIVES = ("rudder_rad", "stern_rad", "rpm")


class Wire:
    """Turns messages of one run into events. Words come only when they change."""

    def __init__(self):
        self._said = {}
        self._at = {}

    def events(self, key, payload, attachment):
        """Events of a message; `key` without the run's prefix. What cannot be read gives none."""
        try:
            head = json.loads(attachment if attachment is not None else payload)
            return list(self._events(key.split("/"), head, payload))
        except (ValueError, KeyError, TypeError, IndexError, AttributeError):
            return []

    def _events(self, key, head, payload):
        kind, t = key[0], head.get("t_s")
        if kind in ("plume", "water"):
            numbers = np.frombuffer(payload, "<f4")
            names = (
                ["x", "y", "z", "vx", "vy", "vz"] if kind == "water" else ["x", "y", "z", "size", "mass", "stands_for"]
            )
            rows = numbers.reshape(-1, len(head.get("fields") or names))
            values = {n: rows[:, k] for k, n in enumerate(names) if k > 2 and k < rows.shape[1]}
            east_m, north_m = head.get("origin_m") or (0.0, 0.0)
            yield Cloud(t, None, kind, rows[:, :3].astype(float) + [east_m, north_m, 0.0], values)
        elif kind == "map":
            yield from self._map(key[1], t, head, payload)
        elif kind == "auv":
            yield from self._auv(t, key[1], key[2], key[3:], head, payload)
        elif kind == "gantry":
            yield from self._gantry(t, key[1], key[2], head)

    def _auv(self, t, who, what, rest, m, payload):
        if what == "truth":
            yield Pose(
                t,
                who,
                False,
                np.array(m["position_m"]),
                np.array(m["quaternion_xyzw"]),
                float(np.linalg.norm(m["velocity_m_s"])),
            )
            if m.get("altitude_m") is not None:
                yield Number(t, who, "altitude_m", m["altitude_m"])
        elif what == "estimate":
            at = np.array([*m["position_m"], -m["depth_m"]])
            self._at[who] = at
            yield Pose(t, who, True, at, turns.from_compass(m["heading_rad"], m["pitch_rad"], m["roll_rad"]))
        elif what == "goal":
            at = self._at.get(who)
            start, end = m.get("from_m") or (None if at is None else at[:2]), m.get("point_m")
            if start is not None and end is not None and at is not None:
                yield Way(t, who, "goal", np.array([[*start, at[2]], [*end, at[2]]]))
        elif what == "plan":
            yield Way(t, who, "plan", np.array(m["points_m"], float).reshape(-1, 3))
        elif what == "command":
            values = {n: m[n] for n in DRIVES if m.get(n) is not None}
            values |= {f"drive_{k + 1}": v for k, v in enumerate(m.get("drives") or [])}
            for name, value in values.items():
                yield Number(t, who, name, value)
        elif what == "chemical":
            yield Number(t, who, "volts", m["volts"])
        elif what == "flow":
            yield Number(t, who, "flow_m_s", float(np.hypot(*m["velocity_m_s"])))
        elif what == "behaviour":
            yield from self._words(t, who, "behaviour", m["behaviour"])
            yield from self._words(t, who, "region", m.get("region_name") or "")
            wrong = m.get("abnormal") or ""
            yield from self._words(t, who, "abnormal", wrong if isinstance(wrong, str) else ", ".join(map(str, wrong)))
            lost = np.array(m.get("lost_points_m") or [], float).reshape(-1, 2)
            if self._new(who, "lost", lost.tobytes()):
                yield Marks(t, who, "lost", lost)
            yield from self._zone(t, who, m)
        elif what == "ranging":
            ends = np.array(m["echoes_body_m"], float).reshape(-1, 3)
            yield Cloud(t, who, "ranging", ends, {})
        elif what == "layers":
            states = ", ".join(f"{n} {s}" for n, s in zip(m["layers"], m["states"]))
            yield from self._words(t, who, "layers", states)
            yield from self._words(t, who, "layer", m.get("holds") or "")
        elif what == "declaration":
            said = f"{m['rule']}, {m['verdict']}" if m.get("verdict") else m["rule"]
            if self._new(who, f"declared {rest}", (m["position_m"], said)):
                yield Declared(t, who, int(m["number"]), np.array([*m["position_m"], np.nan]), said)
        elif what == "picture":
            place, turn = np.array(m["position_m"]), np.array(m["quaternion_xyzw"])
            yield Picture(t, who, "image/jpeg", bytes(payload), place, turn, False, m["view_rad"])
        elif what == "sidescan":
            yield from self._sidescan(t, who, m, payload)

    def _zone(self, t, who, m):
        """What the declaration rule looked at last: its points and the zone's outline at the vehicle's height."""
        points, corners = (np.array(m.get(n) or [], float).reshape(-1, 2) for n in ("zone_points_m", "zone_m"))
        if who not in self._at or not self._new(who, "zone", points.tobytes() + corners.tobytes()):
            return
        yield Marks(t, who, "zone_points", points)
        outline = np.concatenate([corners, corners[:1]])
        yield Way(t, who, "zone", np.column_stack([outline, np.full(len(outline), self._at[who][2])]))

    def _gantry(self, t, who, what, m):
        if what == "joints":
            yield Joints(t, who, dict(zip(m["name"], m["position_m"])))
            yield Place(t, who, "head", np.array(m["head_m"]))
        elif what == "probes":
            for n, (place, volts) in enumerate(zip(m["position_m"], m["volts"])):
                yield Place(t, who, f"probe_{n}", np.array(place))
                yield Number(t, who, f"probes/{n}", volts)
        elif what == "spikes":
            for n, volts in enumerate(m["threshold_v"]):
                yield Number(t, who, f"thresholds/{n}", volts)
            yield Number(t, who, "spike_hz", m["spike_hz"])
        elif what == "behaviour":
            yield from self._words(t, who, "behaviour", m["behaviour"])
        elif what == "declaration" and self._new(who, "declared", m["position_m"]):
            yield Declared(t, who, 0, np.array([*m["position_m"], np.nan]), m["rule"])

    def _map(self, who, t, head, payload):
        cells, size = np.array(head["cells"], int), np.array(head["cell_m"], float)
        p = np.frombuffer(payload, "<f4").reshape(cells[::-1])
        k, j, i = np.nonzero(p >= 1e-6 * p.max())
        turned = 0.5 * np.pi - head["axis_heading_rad"]
        along, left = np.array([np.cos(turned), np.sin(turned)]), np.array([-np.sin(turned), np.cos(turned)])
        apart = (np.stack([i, j, k], 1) + 0.5) * size
        points = np.array(head["corner_m"], float) + np.column_stack(
            [apart[:, :1] * along + apart[:, 1:2] * left, apart[:, 2]]
        )
        values = {"probability": p[k, j, i], "entropy_nat": head["entropy_nat"]}
        yield Cloud(t, who, "map", points, values, size, turned)
        yield Number(t, who, "entropy_nat", head["entropy_nat"])

    def _sidescan(self, t, who, m, payload):
        """Echoes on a flat bed under the vehicle; those before the first of the bed are left out."""
        if m.get("altitude_m") is None:
            return
        level = np.frombuffer(payload, "<f4").astype(float)
        at, heading, high = np.array(m["position_m"], float), m["heading_rad"], m["altitude_m"]
        left = np.array([-np.cos(heading), np.sin(heading)])
        points, levels = [], []
        for side, part in ((1.0, level[: m["port"]]), (-1.0, level[m["port"] : m["port"] + m["starboard"]])):
            slant = (np.arange(len(part)) + 0.5) * m["max_m"] / max(len(part), 1)
            hit = slant > high
            away = side * np.sqrt(slant[hit] ** 2 - high**2)
            points.append(np.column_stack([at[:2] + away[:, None] * left, np.full(hit.sum(), at[2] - high)]))
            levels.append(part[hit])
        yield Cloud(t, who, "sidescan", np.concatenate(points), {"level": np.concatenate(levels)})

    def _words(self, t, who, name, text):
        if self._new(who, name, text):
            yield Words(t, who, name, text)

    def _new(self, who, name, said):
        if self._said.get((who, name)) == said:
            return False
        # What was never said and is empty is no news.
        known = (who, name) in self._said
        self._said[who, name] = said
        return known or bool(said)
