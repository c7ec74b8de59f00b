"""How the viewer opens: which views, where, and from where the scene is looked at.

There is one layout for each kind of mission.
"""

from dataclasses import dataclass, field

import numpy as np
import rerun as rr
import rerun.blueprint as rrb
from rerun.blueprint import encodings

from . import colours
from .canvas import TIMELINE

#: Layouts by name; `Plan.kind` picks one.
KINDS = ("plume", "auv", "gantry", "map", "vision", "several")
#: What may be laid out: all panels, or one 3D view alone.
VIEWS = ("all", "mission", "beside")


@dataclass
class Plan:
    """What there is to lay out."""

    robots: list = field(default_factory=list)
    gantries: list = field(default_factory=list)
    map: bool = False
    pictures: bool = False
    layers: bool = False
    live: bool = False
    #: Where the 3D overview looks at, m, relative to the scene's origin.
    middle: tuple = (0.0, 0.0, 0.0)
    #: Length and width of what it shows, m, and the direction of its length, rad from east to north.
    length_m: float = 100.0
    width_m: float = 100.0
    turned_rad: float = 0.0
    #: First and last time of a recording, s; None for a run that goes on.
    span_s: tuple | None = None
    #: Distance from which each machine is looked at, m.
    follow_m: dict = field(default_factory=dict)

    @property
    def kind(self):
        """The kind of mission, one of `KINDS`."""
        if not (self.gantries or self.robots or self.live):
            return "plume"
        if self.gantries and not self.robots:
            return "gantry"
        if len(self.robots) + len(self.gantries) > 1:
            return "several"
        if self.pictures:
            return "vision"
        return "map" if self.map else "auv"


def plan_of(scene, machines, **flags):
    """The plan of a scene; `machines` are ids that are known otherwise, for a scene that names none."""
    plan = Plan(**flags)
    names = list(scene.machines) or list(machines)
    plan.gantries = [n for n in names if scene.kind(n) == "gantry"]
    plan.robots = [n for n in names if n not in plan.gantries]
    if scene.corners is not None:
        corners = scene.local(scene.corners)
        plan.middle = (*corners.mean(axis=0), -0.5 * scene.depth_m())
        sides = np.diff(corners[:3], axis=0) if len(corners) >= 3 else np.eye(2)
        lengths = np.linalg.norm(sides, axis=1)
        k = int(np.argmax(lengths))
        plan.length_m, plan.width_m = max(float(lengths[k]), 0.5), max(float(lengths[1 - k]), 0.2)
        plan.turned_rad = float(np.arctan2(sides[k][1], sides[k][0]))
    plan.follow_m = {n: reach_m(m) for n, m in scene.machines.items()}
    if any(scene.sensor(n, "camera") for n in plan.robots):
        plan.pictures = True
    return plan


def reach_m(machine):
    """A distance from which a machine is seen whole, m; a gantry's head and probes."""
    if machine.get("kind") == "gantry":
        return 0.9
    reach = 0.3
    for link in machine.get("links") or []:
        for shape in link.get("shapes") or []:
            size = max(
                [*(shape.get("size_m") or [0.0]), shape.get("length_m") or 0.0, 2.0 * (shape.get("radius_m") or 0.0)]
            )
            reach = max(reach, float(np.linalg.norm(shape.get("position_m") or [0.0])) + 0.5 * size)
    return 2.3 * reach


def blueprint(plan, view="all"):
    """The blueprint of a plan; `view` is one of `VIEWS`."""
    names = plan.robots + plan.gantries
    if view != "all" and names:
        return _whole(_overview(plan, names) if view == "mission" else _follow(plan, names[0]))
    main = _overview(plan, names)
    legend = rrb.TextDocumentView(origin="legend", name="Legend")
    if plan.kind == "plume":
        return _whole(rrb.Horizontal(main, legend, column_shares=[13, 5]))
    lanes = rrb.StateTimelineView(origin="states", name="Behaviour and states", time_view=_time(plan))
    who = len(names) > 1
    log = rrb.TextLogView(
        origin="log",
        name="Decisions",
        columns=rrb.TextLogColumns(
            timeline_columns=[encodings.TimelineColumn(TIMELINE, visible=False)],
            text_log_columns=[
                encodings.TextLogColumn(encodings.TextLogColumnKind.EntityPath, visible=who),
                encodings.TextLogColumn(encodings.TextLogColumnKind.LogLevel, visible=False),
                encodings.TextLogColumn(encodings.TextLogColumnKind.Body),
            ],
        ),
    )
    kind = plan.kind
    if kind == "gantry":
        side = rrb.Vertical(
            _follow(plan, names[0]),
            _chart(plan, "probes", "Probes, V"),
            _chart(plan, "axes", "Axes, m"),
            rrb.Tabs(log, legend),
            row_shares=[4, 3, 2, 2],
        )
    elif kind == "several":
        follow = rrb.Tabs(*[_follow(plan, n) for n in names])
        charts = [_chart(plan, "reading", "Readings, V"), _chart(plan, "height", "Height, m (0: surface)")]
        if plan.map:
            charts.append(_chart(plan, "map", "Entropy of the maps, nat"))
        side = rrb.Vertical(follow, *charts, rrb.Tabs(log, legend), row_shares=[4] + [2] * len(charts) + [2])
    else:
        name = names[0] if names else "auv0"
        follow = _follow(plan, name)
        if kind == "vision":
            part = rr.escape_entity_path_part(name)
            eye = rrb.Spatial2DView(
                origin=f"world/machines/{part}/body/camera" if not plan.live else f"world/marks/{part}/camera",
                name="Camera",
            )
            follow = rrb.Horizontal(follow, eye)
        rest = [_chart(plan, "position_error", "Position error, m")]
        if plan.map:
            rest.insert(0, _chart(plan, "map", "Entropy of the map, nat"))
        side = rrb.Vertical(
            follow,
            _chart(plan, "reading", "Reading, V"),
            _chart(plan, "height", "Height, m (0: surface)"),
            rrb.Tabs(*([rest[0]] if plan.map else []), _chart(plan, "speed", "Speed, m/s"), *rest[int(plan.map) :]),
            rrb.Tabs(log, legend),
            row_shares=[5, 2, 2, 2, 2],
        )
    left = rrb.Vertical(main, lanes, row_shares=[5, 1 + 0.5 * plan.layers])
    return _whole(rrb.Horizontal(left, side, column_shares=[13, 8]))


def _whole(views):
    return rrb.Blueprint(
        views,
        rrb.TimePanel(state="collapsed", timeline=TIMELINE, play_state="following"),
        rrb.SelectionPanel(state="hidden"),
        rrb.BlueprintPanel(state="hidden"),
        auto_views=False,
        auto_layout=False,
    )


def _chart(plan, what, title):
    contents = [f"/plots/{rr.escape_entity_path_part(n)}/{what}/**" for n in plan.robots + plan.gantries]
    return rrb.TimeSeriesView(
        origin="plots",
        contents=contents or ["/plots/**"],
        name=title,
        axis_x=_time(plan),
        plot_legend=rrb.PlotLegend("RightTop"),
    )


def _time(plan):
    """The time axis of charts: the whole of a recording."""
    if plan.span_s is None:
        return None
    first, last = plan.span_s
    return rrb.TimeAxis(
        view_range=rrb.TimeRange(
            start=rrb.TimeRangeBoundary.absolute(seconds=first), end=rrb.TimeRangeBoundary.absolute(seconds=last)
        )
    )


def _ranges(names):
    """Entities of which everything up to the time looked at is shown."""
    all_past = rrb.VisibleTimeRanges(
        timeline=TIMELINE, start=rrb.TimeRangeBoundary.infinite(), end=rrb.TimeRangeBoundary.cursor_relative()
    )
    parts = [rr.escape_entity_path_part(n) for n in names]
    tracks = [f"/world/tracks/{p}/{x}" for p in parts for x in ("true", "believed", "detections")]
    return {path: all_past for path in tracks + [f"/world/marks/{p}/sidescan" for p in parts]}


def _overview(plan, names):
    middle = np.asarray(plan.middle, float)
    # Across the long side, so that the area fills the picture's width; from the south or the west.
    across = np.array([-np.sin(plan.turned_rad), np.cos(plan.turned_rad), 0.0])
    if across[1] > 0.0 or (abs(across[1]) < 1e-6 and across[0] > 0.0):
        across = -across
    along = np.array([np.cos(plan.turned_rad), np.sin(plan.turned_rad), 0.0])
    up = np.array([0.0, 0.0, 1.0])
    look = 0.60 * across - 0.16 * along + 0.78 * up
    sides = [(i * plan.length_m, j * plan.width_m) for i in (-0.5, 0.5) for j in (-0.5, 0.5)]
    corners = np.array([x * along + y * across for x, y in sides])
    eye = middle + _away(look / np.linalg.norm(look), corners) * look
    return rrb.Spatial3DView(
        origin="/world",
        contents="/world/**",
        name="Mission",
        background=list(colours.BACKGROUND),
        line_grid=False,
        eye_controls=rrb.EyeControls3D(
            kind=rrb.Eye3DKind.Orbital, position=eye, look_target=middle, eye_up=up, speed=0.2 * plan.length_m
        ),
        overrides=_ranges(names),
    )


def _away(look, corners):
    """The least distance from which all corners (about the middle) are in the picture with a margin."""
    right = np.cross([0.0, 0.0, 1.0], look)
    right /= np.linalg.norm(right)
    top = np.cross(look, right)
    # Of Rerun's eye, and of the view in a window of 16:9.
    high = np.tan(0.5 * np.radians(55.0)) * 0.92
    wide = 1.4 * high
    needed = [max(abs(c @ right) / wide, abs(c @ top) / high) + c @ look for c in corners]
    return float(max(needed))


def _follow(plan, name):
    """The scene as seen from beside a machine: its frame moves along and keeps east, north and up."""
    part = rr.escape_entity_path_part(name)
    away = plan.follow_m.get(name, 3.0)
    markers = [f"- /world/machines/{rr.escape_entity_path_part(n)}/marker" for n in plan.robots]
    # Filaments can be larger than the vehicle and would hide it: here they are dots at their middles.
    dots = rr.Points3D.from_fields(radii=[rr.Radius.ui_points(2.0)]).visualizer()
    return rrb.Spatial3DView(
        origin=f"/world/machines/{part}" + ("_head" if name in plan.gantries else ""),
        contents=["/world/**", "- /world/surface", "- /world/layers/**", *markers],
        name=f"Beside {name}",
        background=list(colours.BACKGROUND),
        line_grid=False,
        eye_controls=rrb.EyeControls3D(
            kind=rrb.Eye3DKind.Orbital,
            position=[0.55 * away, -0.75 * away, 0.42 * away],
            look_target=[0, 0, 0],
            eye_up=[0, 0, 1],
            speed=away,
        ),
        overrides={**_ranges([name]), "/world/plume": dots},
    )
