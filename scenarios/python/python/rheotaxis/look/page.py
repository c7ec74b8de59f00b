"""What the viewer's page says of itself: whether it runs, what went wrong, and up to when it has the run."""

import base64
from dataclasses import dataclass

from .canvas import TIMELINE

#: Asked in the page: what it says in its middle, whether the viewer runs, and its state (`GetStateResponse`).
_ASK = """(() => {
  const said = document.getElementById("center_text"), viewer = window._handle;
  let state = null;
  try { state = btoa(String.fromCharCode(...viewer.viewer_state())); } catch (e) {}
  return { said: said && said.classList.contains("visible") ? said.innerText : "", runs: !!viewer, state };
})()"""
#: Parts of the page's own messages after which it never draws anything.
_FAILED = ("error", "crashed", "too old")


@dataclass
class Page:
    """A page at one moment."""

    #: What went wrong, in the page's own words, or None.
    failure: str | None = None
    #: Whether the viewer runs.
    runs: bool = False
    #: Last time of the run that it has, s; -inf while it has nothing, None if this viewer does not say.
    until_s: float | None = None


def read(browser):
    """What the page in a browser says now."""
    said = browser.value(_ASK) or {}
    words = " ".join(str(said.get("said") or "").split())
    state = said.get("state")
    return Page(
        failure=words if any(part in words.lower() for part in _FAILED) else None,
        runs=bool(said.get("runs")),
        until_s=last_time(base64.b64decode(state)) if state else None,
    )


def last_time(state):
    """The end of the timeline in a viewer's state, s; -inf if there is none in it.

    The state is a message of protobuf: field 3 is the recording, in it field 2 each timeline, with its name in 1.1 and
    its end, ns, in 3.2.
    """
    try:
        for recording in _fields(state).get(3, []):
            for timeline in _fields(recording).get(2, []):
                parts = _fields(timeline)
                if _fields(parts[1][0])[1][0] == TIMELINE.encode():
                    return 1e-9 * _signed(_fields(parts[3][0])[2][0])
    except (KeyError, IndexError, TypeError, ValueError):
        pass
    return float("-inf")


def _fields(message):
    """The fields of a message by their number: whole numbers, or bytes."""
    fields, at = {}, 0
    while at < len(message):
        key, at = _number(message, at)
        if key & 7 == 0:
            value, at = _number(message, at)
        elif key & 7 == 2:
            size, at = _number(message, at)
            value, at = message[at : at + size], at + size
        elif key & 7 in (1, 5):
            size = 8 if key & 7 == 1 else 4
            value, at = message[at : at + size], at + size
        else:
            raise ValueError("no message of protobuf")
        fields.setdefault(key >> 3, []).append(value)
    return fields


def _number(message, at):
    """A whole number of seven bits a byte, and where it ends."""
    value = shift = 0
    while True:
        byte = message[at]
        value, at, shift = value | (byte & 127) << shift, at + 1, shift + 7
        if byte < 128:
            return value, at


def _signed(value):
    """Of 64 bits, as a number with a sign."""
    return value - (1 << 64) if value >= 1 << 63 else value
