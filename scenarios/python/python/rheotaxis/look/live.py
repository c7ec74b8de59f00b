"""Follows live runs over zenoh. What it hears replaces older messages of the same key: it never holds back a run."""

import threading
import time

import zenoh

from .errors import LookError
from .events import Ended, SceneSaid
from .wire import Wire

#: Where runs listen: the first of these ports that is free when they start. Only beyond them they listen elsewhere.
FIRST_PORT, PORTS = 7447, 64
#: How long to ask a run for its scene before it is shown without, s.
SCENE_S = 5.0


def configuration(where):
    """A zenoh configuration: of a file (.json5), of an endpoint, or of the ports at which runs listen here."""
    if where and where.endswith((".json5", ".json", ".yaml")):
        try:
            return zenoh.Config.from_file(where)
        except Exception as e:
            raise LookError(f"{where}: no zenoh configuration ({e}).") from e
    ends = [where] if where else [f"tcp/127.0.0.1:{FIRST_PORT + k}" for k in range(PORTS)]
    listed = ", ".join(f'"{e}"' for e in ends)
    return zenoh.Config.from_json5(
        f"""{{ mode: "peer", listen: {{ endpoints: [] }},
        scouting: {{ multicast: {{ enabled: false }}, gossip: {{ enabled: false }} }},
        connect: {{ endpoints: [{listed}], exit_on_failure: false, timeout_ms: 0,
            retry: {{ period_init_ms: 200, period_max_ms: 1000 }} }} }}"""
    )


class Live:
    """A session that hears runs; `wanted` names the one to follow, else it is the newest."""

    def __init__(self, where=None, wanted=None):
        self.wanted = wanted
        self._there = threading.Condition()
        self._runs = {}
        self._heard = {}
        self.following = None
        zenoh.init_log_from_env_or("off")
        try:
            self.session = zenoh.open(configuration(where))
            self._tokens = self.session.liveliness().declare_subscriber(
                "rheotaxis/*/@live/sim", self._token, history=True
            )
        except zenoh.ZError as e:
            raise LookError(f"zenoh: {e}. Is the endpoint right (such as tcp/127.0.0.1:7447)?") from e
        self._subscriber = None

    def close(self):
        """Ends the session."""
        self.session.close()

    def runs(self):
        """Runs that are there, oldest first, as far as that is known."""
        with self._there:
            return sorted(self._runs, key=self._runs.get)

    def wait(self, patience_s):
        """The run to follow once it is there, or None if none came in that time."""
        deadline = time.monotonic() + patience_s
        while True:
            there = [r for r in self.runs() if self.wanted in (None, r)]
            if there:
                return there[-1] if len(there) == 1 else self._newest(there)
            if time.monotonic() > deadline:
                return None
            with self._there:
                self._there.wait(0.2)

    def _newest(self, there):
        """Of several runs, the one that came last and has not ended."""
        going = []
        for run in there:
            for reply in self.session.get(f"rheotaxis/{run}/clock", timeout=1.0):
                if reply.ok is not None and b'"ended":false' in reply.ok.payload.to_bytes().replace(b" ", b""):
                    going.append(run)
        return (going or there)[-1]

    def follow(self, run):
        """Begins to hear a run, and asks for what was said before."""
        if self._subscriber is not None:
            self._subscriber.undeclare()
        with self._there:
            self._heard = {}
        self.following, prefix = run, f"rheotaxis/{run}/"
        self._wire, self._cut = Wire(), len(prefix)
        self._subscriber = self.session.declare_subscriber(f"{prefix}**", self._sample)
        document, deadline = b"", time.monotonic() + SCENE_S
        while not document and time.monotonic() < deadline:
            for reply in self.session.get(f"{prefix}**", timeout=2.0):
                if reply.ok is None:
                    continue
                if str(reply.ok.key_expr) == f"{prefix}meta/scene":
                    document = reply.ok.payload.to_bytes()
                else:
                    self._sample(reply.ok)
            if not document:
                with self._there:
                    document = self._heard.get("meta/scene", (b"",))[0]
            if not document:
                # A run of an older version says its scenario and version, and no scene.
                with self._there:
                    old = any(k.startswith("auv/") or k.startswith("gantry/") for k in self._heard)
                if old and time.monotonic() > deadline - SCENE_S + 2.0:
                    break
                time.sleep(0.2)
        return SceneSaid(float("-inf"), None, document, run)

    def hear(self, patience_s):
        """Events since the last call, after waiting for some; the last is `Ended` once the run is gone."""
        with self._there:
            if not self._heard and self.following in self._runs:
                self._there.wait(patience_s)
            heard, self._heard = self._heard, {}
            gone = self.following not in self._runs
        events = []
        for key, (payload, attachment) in heard.items():
            if not key.startswith("meta/"):
                events += self._wire.events(key, payload, attachment)
        if gone:
            events.append(Ended(float("inf"), None, "the run is gone"))
        return events

    def _sample(self, sample):
        key = str(sample.key_expr)[self._cut :]
        attachment = None if sample.attachment is None else sample.attachment.to_bytes()
        payload = sample.payload.to_bytes()
        with self._there:
            self._heard[key] = (payload, attachment)
            self._there.notify()

    def _token(self, sample):
        run = str(sample.key_expr).split("/")[1]
        with self._there:
            if sample.kind == zenoh.SampleKind.DELETE:
                self._runs.pop(run, None)
            else:
                self._runs[run] = time.monotonic()
            self._there.notify_all()
