"""Draws a recording into an `.rrd` file of the viewer."""

import numpy as np
import rerun as rr

from . import contents as inside
from . import scene as scenes
from .drawing import Drawing
from .events import Place, Pose
from .layout import blueprint, plan_of
from .recording import Recording

#: Most pieces of a track.
PIECES = 1500
#: Name of the application in the viewer; layouts that a user keeps go by it.
APPLICATION = "rheotaxis"


def convert(source, target, truth=False, until_s=None, tell=lambda line: None, view="all"):
    """Draws the recording at `source` into the file `target`; returns whether it was whole, and its last time, s.

    `until_s` ends it early, s. `tell` gets a line for each thing that is missing or wrong.
    """
    contents = inside.look_into(source)
    recording = Recording(contents, until_s)
    events = recording.events()
    missing, waiting = [], []
    if contents.scene is not None:
        scene = scenes.read(contents.scene)
    else:
        missing.append(
            "the recording has no scene.json (it is of an older version): no bed, bodies, solids and sources."
        )
        waiting, scene = _without(events, contents)
    for line in missing:
        tell(f"{source}: {line}")
    flags = {
        "map": contents.has("/map"),
        "pictures": contents.has("camera/compressed"),
        "layers": contents.has("/layers"),
    }
    end = contents.last_s if until_s is None else min(until_s, contents.last_s)
    flags["span_s"] = (min(contents.first_s, end), end)
    plan = plan_of(scene, contents.machines(), **flags)
    stream = rr.RecordingStream(APPLICATION, recording_id=contents.name())
    stream.save(str(target), default_blueprint=blueprint(plan, view))
    stream.send_recording_name(contents.name())
    drawing = Drawing(stream, scene, truth, max(1.0, contents.duration_s / PIECES), missing)
    last = 0.0
    for e in waiting:
        drawing.event(e)
    for e in events:
        last = max(last, e.t_s)
        drawing.event(e)
    drawing.end(last)
    stream.disconnect()
    whole = recording.whole and contents.whole
    if not whole:
        tell(f"{source}: the recording is cut off; what can be read ends at {last:.1f} s and is shown.")
    return whole, last


def _without(events, contents):
    """The events up to where it is known where the run happens, and a scene from them."""
    waiting, places = [], []
    for e in events:
        waiting.append(e)
        if isinstance(e, (Pose, Place)):
            places.append(e.position)
        if len(places) > 200 or len(waiting) > 5000:
            break
    return waiting, scenes.without_document(np.array(places) if places else np.zeros((0, 3)), contents.name())
