#!/usr/bin/env python3
"""Check that subscribers see a run whole and cannot change it.

    pip install -r requirements.txt
    python check_live.py [--binary target/release/rheotaxis] [--speed 50] SCENARIO.ron

Runs the scenario once without zenoh, then once with `subscribe.py` started before, during and after
the mission, one of them killed and one stopped (a stalled subscriber). Every one that was left alone
must have seen all schemas, a state and the end; the digests of both runs must be equal.
"""
import argparse
import json
import pathlib
import signal
import socket
import subprocess
import sys
import tempfile
import time

HERE = pathlib.Path(__file__).resolve().parent
TOPICS = ["clock", "truth", "estimate", "behaviour", "joints", "probes", "spikes", "gantry_behaviour", "plume",
          "scenario", "version", "digest", "schema"]
LINGER_S = 8


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("scenario")
    parser.add_argument("--binary", default="target/release/rheotaxis")
    parser.add_argument("--speed", default="50", help="slow enough for clients to come and go")
    parser.add_argument("--patience", type=float, default=600.0, help="longest wall time of a run, s")
    args = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        check(args, pathlib.Path(folder))
    print("live state: seen whole before, during and after; killed and stalled subscribers changed nothing")


def check(args, folder):
    deadline = time.monotonic() + 2 * args.patience
    alone = run(args, folder / "alone", "max", ["--no-zenoh"])
    alone.wait(args.patience)

    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        endpoint = f"tcp/127.0.0.1:{probe.getsockname()[1]}"
    before, killed, stopped = (Client(folder, name, endpoint) for name in ("before", "killed", "stopped"))
    clients = [before, killed, stopped]
    watched = run(args, folder / "watched", args.speed,
                  ["--zenoh-listen", endpoint, "--zenoh-linger", str(LINGER_S)])
    try:
        for client in clients:
            client.wait_until(lambda c: c.of("/clock"), "a state", deadline, watched)
        killed.process.kill()
        stopped.process.send_signal(signal.SIGSTOP)
        must(not before.ended(), "the run was over before the others came: give it a lower --speed")
        during = Client(folder, "during", endpoint)
        clients.append(during)
        during.wait_until(lambda c: c.of("/clock"), "a state", deadline, watched)
        must(not during.of("/clock")[0]["ended"], "the run was over before `during` came: lower --speed")
        before.wait_until(Client.ended, "the end", deadline, watched)
        after = Client(folder, "after", endpoint)
        clients.append(after)
        watched.wait(args.patience)
        whole = [before, during, after]
        for client in whole:
            # They stop by themselves when the run is gone.
            client.process.wait(30)
        digest = summary(folder / "watched")["digest"]
        for client in whole:
            client.check(digest)
        must(not killed.ended(), "the killed subscriber lived on")
        must(alone.returncode == watched.returncode,
             f"exit codes differ: {alone.returncode} alone, {watched.returncode} watched")
        must(summary(folder / "alone")["digest"] == digest, "subscribers changed the digest")
    finally:
        for process in [watched] + [c.process for c in clients]:
            process.kill()
            process.wait()


def run(args, out, speed, more):
    return subprocess.Popen([args.binary, "run", args.scenario, "--seed", "1", "--out", str(out),
                             "--quiet", "--no-cache", "--speed", speed, *more])


def summary(out):
    return json.loads((out / "summary.json").read_text())


def must(holds, text):
    if not holds:
        sys.exit(f"live state: {text}")


class Client:
    """subscribe.py in a process of its own, its output in a file."""

    def __init__(self, folder, name, endpoint):
        self.name = name
        self.log = folder / f"{name}.log"
        with open(self.log, "w") as log:
            self.process = subprocess.Popen(
                [sys.executable, str(HERE / "subscribe.py"), endpoint], stdout=log)

    def messages(self):
        # The last line may still be in the making.
        for line in self.log.read_text().rpartition("\n")[0].splitlines():
            key, _, text = line.partition(" ")
            yield key, json.loads(text)

    def of(self, end):
        return [value for key, value in self.messages() if key.endswith(end) and "/schema/" not in key]

    def ended(self):
        return any(clock["ended"] for clock in self.of("/clock"))

    def wait_until(self, seen, what, deadline, watched):
        while not seen(self):
            must(time.monotonic() < deadline, f"`{self.name}` never saw {what}")
            must(watched.poll() is None or seen(self), f"the run is gone and `{self.name}` never saw {what}")
            time.sleep(0.1)

    def check(self, digest):
        schemas = {key.rpartition("/")[2]: value for key, value in self.messages() if "/meta/schema/" in key}
        must(set(TOPICS) <= set(schemas), f"`{self.name}` misses schemas: {sorted(schemas)}")
        for key, value in self.messages():
            parts = key.split("/")
            if parts[-1].isdigit():
                parts.pop()  # a declaration's number
            name = "schema" if "/meta/schema/" in key else parts[-1]
            if "/gantry/" in key and f"gantry_{name}" in schemas:
                name = f"gantry_{name}"  # a vehicle has its own
            missing = set(schemas[name]["required"]) - set(value)
            must(not missing, f"`{self.name}`: {key} lacks {missing}")
        vehicle = self.of("/truth") and self.of("/estimate")
        gantry = self.of("/joints") and self.of("/probes") and self.of("/spikes")
        must(vehicle or gantry, f"`{self.name}` saw no state")
        must(self.ended(), f"`{self.name}` saw no end")
        must({"digest": digest} in self.of("/meta/digest"), f"`{self.name}` saw another digest")


if __name__ == "__main__":
    main()
