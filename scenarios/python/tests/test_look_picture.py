"""When the look takes its picture: after the page has drawn the run, and never of an empty page (no browser needed)."""

import base64
import io

import numpy as np
import pytest

for needed in ("rerun", "PIL"):
    pytest.importorskip(needed, reason='the look needs: pip install "./scenarios/python[look]"')

from PIL import Image  # noqa: E402

from rheotaxis.look import colours, page, picture  # noqa: E402
from rheotaxis.look.errors import EndedError, LookError  # noqa: E402

#: The state of Rerun 0.41's viewer that has a run up to 795.58 s, shortened.
STATE = base64.b64decode(
    "CjdhYm91dDpyZWNvcmRpbmc/YXBwX2lkPXJoZW90YXhpcyZyZWNvcmRpbmdfaWQ9dDEzX3Npel8xEh1SZWNvcmRpbmc6cmhlb3RheGlzOnQxM19z"
    "aXpfMRqQAQodUmVjb3JkaW5nOnJoZW90YXhpczp0MTNfc2l6XzESIAoFCgNzaW0QAhoMCIDaxAkQgM6N4pMXIgcIgM6N4pMXGhIKBQoDc2ltEAIa"
    "BwiAzo3ikxciN2Fib3V0OnJlY29yZGluZz9hcHBfaWQ9cmhlb3RheGlzJnJlY29yZGluZ19pZD10MTNfc2l6XzEoAyIYcmVydW4raHR0cDovLzEy"
    "Ny4wLjAuMTow"
)


def shown(*boxes):
    """A picture of the page: a view with these coloured boxes (left, right) in it."""
    image = np.zeros((200, 300, 3), np.uint8)
    image[20:180] = colours.BACKGROUND
    for left, right in boxes:
        image[60:120, left:right] = (44, 98, 128)
    out = io.BytesIO()
    Image.fromarray(image).save(out, "PNG")
    return out.getvalue()


def said(runs=True, until_s=None, text=""):
    """What the page answers."""
    state = None
    if until_s is not None:
        ns, number = int(until_s * 1e9), b""
        while ns > 127:
            number, ns = number + bytes([ns & 127 | 128]), ns >> 7
        span = b"\x08\x00\x10" + number + bytes([ns])
        timeline = b"\x0a\x05\x0a\x03sim\x1a" + bytes([len(span)]) + span
        state = b"\x1a" + bytes([len(timeline) + 2]) + b"\x12" + bytes([len(timeline)]) + timeline
    return {"said": text, "runs": runs, "state": None if state is None else base64.b64encode(state).decode()}


class Browser:
    """Chromium whose page goes through moments: an answer and a picture each; the last one stays."""

    def __init__(self, moments):
        self.moments, self.taken = list(moments), 0

    def __call__(self, *_):
        return self

    def __enter__(self):
        return self

    def __exit__(self, *_):
        pass

    def open(self, address):
        pass

    def value(self, _):
        if self.taken:
            self.moments = self.moments[1:] or self.moments
        self.taken += 1
        answer = self.moments[0][0]
        if isinstance(answer, Exception):
            raise answer
        return answer

    def picture(self):
        return self.moments[0][1]


def take(monkeypatch, moments, patience_s=0.3, **how):
    monkeypatch.setattr(picture, "Chromium", Browser(moments))
    monkeypatch.setattr(picture, "PAUSE_S", 0.005)
    return picture.take("page", (300, 200), patience_s=patience_s, **how)


def test_the_viewers_state_tells_up_to_when_it_has_the_run():
    assert page.last_time(STATE) == pytest.approx(795.58)
    for nothing in (b"", b"\xff\xff", STATE[:60], STATE[:120]):
        assert page.last_time(nothing) == float("-inf")


def test_a_page_that_has_a_part_of_the_run_is_waited_for(monkeypatch):
    part, whole = shown((20, 60)), shown((20, 200))
    moments = [
        (said(runs=False), shown()),
        (LookError("Chromium refused Page.captureScreenshot: not now."), b""),
        *[(said(until_s=400.0), part)] * 5,
        *[(said(until_s=795.5), shown())] * 2,
        (said(until_s=795.5), whole),
    ]
    assert take(monkeypatch, moments, until_s=795.58) == whole
    # A viewer that does not say what it has is judged by its picture alone.
    assert take(monkeypatch, [(said(), shown()), (said(), whole)], until_s=795.58) == whole


def test_what_moves_is_taken_at_last(monkeypatch):
    moving = [(said(until_s=9.0), shown((k, k + 40))) for k in range(0, 200, 10)]
    assert take(monkeypatch, moving, until_s=9.0)


@pytest.mark.parametrize(
    ("moment", "words"),
    [
        ((said(runs=False), shown()), "the page has not started the viewer"),
        ((said(until_s=4.0), shown((0, 200))), "the page has the run up to 4.0 s, of 9.0 s"),
        ((said(until_s=9.0), shown()), "no view shows anything of it"),
        ((said(runs=False, text="Rerun has crashed.\n wgpu"), shown()), "page says: Rerun has crashed. wgpu"),
        ((EndedError("Chromium ended by itself."), b""), "Chromium ended by itself"),
    ],
)
def test_a_page_that_comes_no_further_is_an_error_that_says_where_it_stands(monkeypatch, moment, words):
    with pytest.raises(LookError, match=words):
        take(monkeypatch, [moment], until_s=9.0)


def test_what_ends_is_not_waited_for(monkeypatch):
    """These come at once, however great the patience."""
    for moment, alive in [
        ((EndedError("Chromium ended by itself."), b""), True),
        ((said(runs=False, text="An error occurred during loading: no WebGL"), b""), True),
        ((said(until_s=4.0), shown()), False),
    ]:
        with pytest.raises(LookError):
            take(monkeypatch, [moment], patience_s=1e6, until_s=9.0, alive=lambda alive=alive: alive)
