#!/usr/bin/env python3
"""Check that what `rheotaxis run --ros2` publishes is what nodes of ROS 2 expect, without ROS.

    pip install -r requirements-ros2.txt          # Python 3.11 or newer
    python check_ros2.py [--binary target/release/rheotaxis] [--speed 20] SCENARIO.ron ...

Two clients of rmw_zenoh's layout that know nothing of us, zenoh-ros2-sdk and pyzeros, list the graph and
listen to topics; `rosbags` reads every message and writes it again to the same bytes. Positions must be
those of our own live state, and the digest that of a run without zenoh.
"""
import argparse
import asyncio
import json
import math
import os
import pathlib
import socket
import subprocess
import sys
import tempfile
import threading
import time

# Where a dependency of pyzeros keeps what it generates; otherwise in the folder where this is started.
os.environ.setdefault("CYDR_CACHE_DIR", str(pathlib.Path(sys.prefix) / "cydr_cache"))

import numpy
import pyzeros
import zenoh
from pyzeros.utils import rmw_zenoh_gid
from ros2_pyterfaces.cyclone.nav_msgs.msg import Odometry
from ros2_pyterfaces.cyclone.rosgraph_msgs.msg import Clock
from rosbags.typesys import Stores, get_types_from_msg, get_typestore
from zenoh_ros2_sdk import ROS2Subscriber, get_topic_names_and_types
from zenoh_ros2_sdk.attachment import Attachment
from zenoh_ros2_sdk.entity import EndpointEntity, EntityKind, NodeEntity
from zenoh_ros2_sdk.keyexpr import endpoint_liveliness_keyexpr, node_liveliness_keyexpr
from zenoh_ros2_sdk.qos import QosDurability, QosProfile, QosReliability
from zenoh_ros2_sdk.session import ZenohSession

DOMAIN = 42
LINGER_S = 60
JAZZY = get_typestore(Stores.ROS2_JAZZY)
QOS = {
    "best effort, depth 1": QosProfile(reliability=QosReliability.BEST_EFFORT, history_depth=1),
    "best effort, depth 5": QosProfile(reliability=QosReliability.BEST_EFFORT, history_depth=5),
    "reliable, depth 10": QosProfile(history_depth=10),
    "reliable, transient local, depth 1": QosProfile(durability=QosDurability.TRANSIENT_LOCAL, history_depth=1),
}


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("scenarios", nargs="+")
    parser.add_argument("--binary", default="target/release/rheotaxis")
    parser.add_argument("--speed", default="20", help="slow enough for clients to come during the run")
    parser.add_argument("--patience", type=float, default=300.0, help="longest wall time of a run, s")
    args = parser.parse_args()
    table = topics(args.binary)
    check_types(args.binary, {kind for kind, _ in table.values()})
    # zenoh-ros2-sdk keeps one session for good, so all runs listen at the same port.
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        port = probe.getsockname()[1]
    heard = set()
    try:
        for scenario in args.scenarios:
            with tempfile.TemporaryDirectory() as folder:
                heard |= check_run(args, scenario, pathlib.Path(folder), port, table)
    finally:
        # Its threads would keep this process alive.
        if ZenohSession._instance:
            ZenohSession._instance.close()
    missing = ", ".join(sorted(set(table) - heard)) or "none"
    print(f"ROS 2: {len(heard)} of {len(table)} topics heard, as zenoh-ros2-sdk, pyzeros and rosbags read them;"
          f" not in these scenarios: {missing}")


def must(holds, text):
    if not holds:
        raise AssertionError(text)


def topics(binary):
    """The table of `rheotaxis topics --ros2`: type and QoS of each name."""
    said = subprocess.run([binary, "topics", "--ros2"], capture_output=True, text=True, check=True).stdout
    table = {}
    for line in said.splitlines():
        if line.startswith("/"):
            name, kind, qos = line.split("  ")
            table[name] = (kind, QOS[qos.strip("()")])
    must(table, "`topics --ros2` lists nothing")
    return table


def check_types(binary, used):
    """Our definitions have our hashes, and both are those of ROS."""
    said = subprocess.run([binary, "topics", "--ros2", "--schema"], capture_output=True, text=True, check=True).stdout
    schemas = json.loads(said)
    must(used <= set(schemas), f"types without a definition: {used - set(schemas)}")
    for name, ours in schemas.items():
        store = get_typestore(Stores.EMPTY)
        store.register(get_types_from_msg(ours["definition"], name))
        must(store.hash_rihs01(name) == ours["hash"], f"{name}: our definition has another hash")
        for distribution in (Stores.ROS2_JAZZY, Stores.ROS2_KILTED, Stores.ROS2_LYRICAL):
            theirs = get_typestore(distribution).hash_rihs01(name)
            must(theirs == ours["hash"], f"{name}: another hash in {distribution.value}")


def start(args, scenario, out, more):
    return subprocess.Popen([args.binary, "run", scenario, "--seed", "1", "--out", str(out), "--quiet",
                             "--no-cache", "--no-record", *more])


def summary(out):
    return json.loads((out / "summary.json").read_text())


def check_run(args, scenario, folder, port, table):
    alone = start(args, scenario, folder / "alone", ["--no-zenoh"])
    must(alone.wait(args.patience) in (0, 3), "the run alone failed")
    endpoint = f"tcp/127.0.0.1:{port}"
    listener = Listener(endpoint)
    shown = start(args, scenario, folder / "shown",
                  ["--ros2", "--ros-domain", str(DOMAIN), "--zenoh-listen", endpoint,
                   "--zenoh-linger", str(LINGER_S), "--speed", args.speed])
    try:
        deadline = time.monotonic() + args.patience
        listener.wait(lambda: "/clock" in listener.names(), "the clock", deadline, shown)
        machines = listener.machines()
        sdk, subscribers = listen_with_sdk(machines, table, port)
        asyncio.run(listen_with_pyzeros(machines, endpoint, listener))
        listener.wait(lambda: all(sdk[topic] for topic in sdk), f"something on each of {list(sdk)}", deadline, shown)
        for subscriber in subscribers:
            subscriber.close()
        listener.wait(listener.ended, "the end", deadline, shown)
        must(shown.poll() is None, "the run did not linger")
        check_graph(listener, table, port)
        check_late(machines, table, port, endpoint)
        heard = check_messages(listener, table)
        check_against_own(listener, machines)
        check_tree(listener, machines)
        shown.terminate()
        shown.wait(args.patience)
        must(summary(folder / "shown")["digest"] == summary(folder / "alone")["digest"], "--ros2 changed the digest")
        return heard
    finally:
        shown.kill()
        shown.wait()
        listener.close()


class Listener:
    """Everything on the wire, with zenoh alone, before the run begins."""

    def __init__(self, endpoint):
        self.lock = threading.Lock()
        self.samples, self.own, self.tokens = [], [], {}
        config = zenoh.Config.from_json5(f"""{{ mode: "peer", listen: {{ endpoints: [] }},
            scouting: {{ multicast: {{ enabled: false }} }},
            connect: {{ endpoints: ["{endpoint}"], retry: {{ period_init_ms: 200, period_max_ms: 1000 }} }} }}""")
        self.session = zenoh.open(config)
        self.subscribers = [
            # As rmw_zenoh's subscribers of latched topics: what was said before they came is asked for.
            zenoh.ext.declare_advanced_subscriber(
                self.session, f"{DOMAIN}/**", self.hear,
                history=zenoh.ext.HistoryConfig(detect_late_publishers=True)),
            self.session.declare_subscriber("rheotaxis/**", self.hear_own),
            self.session.liveliness().declare_subscriber(f"@ros2_lv/{DOMAIN}/**", self.see, history=True),
        ]

    def hear(self, sample):
        attachment = sample.attachment.to_bytes() if sample.attachment else b""
        with self.lock:
            self.samples.append((str(sample.key_expr), sample.payload.to_bytes(), attachment))

    def hear_own(self, sample):
        with self.lock:
            self.own.append((str(sample.key_expr), (sample.attachment or sample.payload).to_string()))

    def see(self, token):
        with self.lock:
            self.tokens[str(token.key_expr)] = token.kind == zenoh.SampleKind.PUT

    def messages(self):
        """Name, type, hash, payload and attachment of all that was heard."""
        with self.lock:
            samples = list(self.samples)
        for key, payload, attachment in samples:
            _, *name, dds, type_hash = key.split("/")
            package, _, _, kind = dds.split("::")
            yield "/" + "/".join(name), f"{package}/msg/{kind.rstrip('_')}", type_hash, payload, attachment

    def names(self):
        return {name for name, *_ in self.messages()}

    def decoded(self, wanted):
        return [JAZZY.deserialize_cdr(payload, kind) for name, kind, _, payload, _ in self.messages() if name == wanted]

    def states(self, end):
        """Our own messages on keys with this end, by their time, ns."""
        with self.lock:
            own = [json.loads(text) for key, text in self.own if key.endswith(end) and "/meta/" not in key]
        return {round(value["t_s"] * 1e9): value for value in own}

    def machines(self):
        """Names of robots, then of gantries."""
        described = {n.split("/")[1] for n in self.names() if n.endswith("/robot_description")}
        must(described, "nobody is described")
        gantries = {n.split("/")[1] for n in self.names() if n.endswith("/joint_states")}
        return sorted(described - gantries), sorted(gantries)

    def ended(self):
        return any(clock["ended"] for clock in self.states("/clock").values())

    def wait(self, seen, what, deadline, run):
        while not seen():
            must(time.monotonic() < deadline, f"never saw {what}")
            must(run.poll() is None or seen(), f"the run is gone and nobody saw {what}")
            time.sleep(0.1)

    def close(self):
        for subscriber in self.subscribers:
            subscriber.undeclare()
        self.session.close()


def pattern(name, machines):
    """The row of the table that a topic belongs to."""
    robots, gantries = machines
    first, *rest = name.strip("/").split("/")
    if rest and rest[0] == "probes":
        return "/<gantry>/probes/<probe>"
    if first in gantries and rest == ["joint_states"]:
        return "/<gantry>/joint_states"
    return "/".join(["", "<robot>" if first in robots + gantries else first, *rest])


def stamp_ns(stamp):
    return stamp.sec * 10**9 + stamp.nanosec


def definition(kind):
    return JAZZY.generate_msgdef(kind, ros_version=2)[0]


def listen_with_sdk(machines, table, port):
    """zenoh-ros2-sdk, which finds topics by the hash that it is given by rosbags."""
    robots, gantries = machines
    wanted = ["/clock", "/plume"] + [f"/{r}/odom" for r in robots] + [f"/{g}/joint_states" for g in gantries]
    heard = {topic: [] for topic in wanted}
    return heard, [subscribed(topic, machines, table, port, heard[topic]) for topic in wanted]


def subscribed(topic, machines, table, port, heard):
    kind, qos = table[pattern(topic, machines)]
    return ROS2Subscriber(topic, kind, heard.append, definition(kind), domain_id=DOMAIN, router_port=port,
                          type_hash=JAZZY.hash_rihs01(kind), qos=qos)


async def listen_with_pyzeros(machines, endpoint, listener):
    """pyzeros, with message classes and hashes of its own; what it reads is what was sent."""
    config = zenoh.Config.from_json5(f'{{ mode: "client", connect: {{ endpoints: ["{endpoint}"] }} }}')
    with zenoh.open(config) as session, pyzeros.auto_context("listener", session, domain_id=DOMAIN):
        clock = pyzeros.Sub(Clock, "/clock")
        times = [stamp_ns((await asyncio.wait_for(clock.wait_for_next(), 60)).clock) for _ in range(5)]
        must(times == sorted(set(times)), f"pyzeros: the clock does not go on: {times}")
        for robot in machines[0]:
            seen = await asyncio.wait_for(pyzeros.Sub(Odometry, f"/{robot}/odom").wait_for_next(), 60)
            when = stamp_ns(seen.header.stamp)
            same, deadline = None, time.monotonic() + 30
            while same is None:
                must(time.monotonic() < deadline, "pyzeros read an odometry that nobody else heard")
                await asyncio.sleep(0.1)
                heard = {stamp_ns(o.header.stamp): o for o in listener.decoded(f"/{robot}/odom")}
                same = heard.get(when)
            for axis in "xyz":
                theirs, ours = (getattr(o.pose.pose.position, axis) for o in (seen, same))
                must(theirs == ours, f"pyzeros: {robot} is at {theirs}, not {ours}")
            must(seen.header.frame_id in ("map", b"map"), f"pyzeros: frame {seen.header.frame_id!r}")


def check_graph(listener, table, port):
    """The graph as zenoh-ros2-sdk lists it, and each token as it would write it."""
    listed = dict(get_topic_names_and_types(DOMAIN, router_port=port, timeout=5.0))
    machines = listener.machines()
    must(set(listed) == listener.names(), f"listed and heard differ: {set(listed) ^ listener.names()}")
    for name, kinds in listed.items():
        row = pattern(name, machines)
        must(row in table, f"{name} is in no table")
        must(kinds == [table[row][0]], f"{name} is {kinds}")
    ours = listener.session.zid()
    mine = {str(ours), ZenohSession.get_instance().session_id}
    with listener.lock:
        tokens = {t for t, alive in listener.tokens.items() if alive and t.split("/")[2] not in mine}
    zids = {t.split("/")[2] for t in tokens}
    must(len(zids) == 1, f"tokens of several sessions: {zids}")
    node = NodeEntity(DOMAIN, zids.pop(), 0, "rheotaxis")
    expected = {node_liveliness_keyexpr(node)}
    for token in tokens - expected:
        parts = token.split("/")
        name = parts[9].replace("%", "/")
        kind, qos = table[pattern(name, machines)]
        package, _, short = kind.split("/")
        expected.add(endpoint_liveliness_keyexpr(EndpointEntity(
            node, int(parts[4]), EntityKind.PUBLISHER, name, f"{package}::msg::dds_::{short}_",
            JAZZY.hash_rihs01(kind), qos.encode())))
    must(tokens == expected, f"other tokens than expected: {sorted(tokens ^ expected)}")
    must(len({t.split("/")[4] for t in tokens}) == len(tokens), "two entities have the same number")
    must(len(tokens) == len(listed) + 1, "there are topics without a token")


def check_late(machines, table, port, endpoint):
    """Who comes after the end hears what is latched: by zenoh-ros2-sdk, and as rmw_zenoh does it, by zenoh-ext."""
    robots, gantries = machines
    # zenoh-ros2-sdk 0.1.8 asks for the past of topics without a namespace only.
    for topic in ["/tf_static", "/scene"]:
        heard = []
        subscribed(topic, machines, table, port, heard).close()
        must(len(heard) == 1, f"zenoh-ros2-sdk: a late subscriber hears {len(heard)} messages on {topic}")
    late = Listener(endpoint)
    deadline = time.monotonic() + 30
    latched = {"/tf_static", "/scene", *(f"/{m}/robot_description" for m in robots + gantries)}
    while not latched <= late.names():
        must(time.monotonic() < deadline, f"zenoh-ext: a late subscriber misses {latched - late.names()}")
        time.sleep(0.1)
    for machine in robots + gantries:
        urdf = late.decoded(f"/{machine}/robot_description")[0].data
        must("<robot" in urdf and "capsule" not in urdf, f"{machine}: no URDF of version 1.0")
    late.close()


def check_messages(listener, table):
    """Every message: type, bytes, and what comes with it."""
    machines = listener.machines()
    with listener.lock:
        gids = {t.split("/")[9].replace("%", "/"): rmw_zenoh_gid(t) for t in listener.tokens if "/MP/" in t}
    numbers, heard = {}, set()
    for name, kind, type_hash, payload, attachment in listener.messages():
        row = pattern(name, machines)
        must(row in table and table[row][0] == kind, f"{name} is {kind}")
        must(type_hash == JAZZY.hash_rihs01(kind), f"{name}: hash {type_hash}")
        heard.add(row)
        value = JAZZY.deserialize_cdr(payload, kind)
        again = bytes(JAZZY.serialize_cdr(value, kind))
        must(again[4:] == payload[4:len(again)], f"{name}: other bytes than those of rosbags")
        must(not any(payload[len(again):]), f"{name}: {len(payload) - len(again)} bytes too many")
        must(len(attachment) == 33, f"{name}: {len(attachment)} bytes beside a message")
        beside = Attachment.from_bytes(attachment)
        must(beside.gid == gids[name], f"{name}: the id is not that of its token")
        latched = table[row][1].durability == QosDurability.TRANSIENT_LOCAL
        if not latched:
            must(beside.sequence_id > numbers.get(name, 0), f"{name}: message {beside.sequence_id} out of order")
        numbers[name] = beside.sequence_id
        must(abs(beside.timestamp_ns - time.time_ns()) < 3600e9, f"{name}: sent at {beside.timestamp_ns}")
    clocks = [stamp_ns(c.clock) for c in listener.decoded("/clock")]
    must(clocks == sorted(set(clocks)), "the clock goes back or stands")
    return heard


def check_against_own(listener, machines):
    """Odometry and truth are those of our own live state at the same time; the plume has its fields."""
    for robot in machines[0]:
        for topic, end in ((f"/{robot}/odom", f"/{robot}/estimate"), (f"/{robot}/ground_truth/odom", f"/{robot}/truth")):
            own, compared = listener.states(end), 0
            for o in listener.decoded(topic):
                state = own.get(stamp_ns(o.header.stamp))
                if state is None:
                    continue
                p = o.pose.pose.position
                compared += 1
                place = state["position_m"] if "truth" in end else [*state["position_m"], -state["depth_m"]]
                must(math.dist((p.x, p.y, p.z), place) < 1e-9, f"{topic} differs from {end}")
            must(compared > 5, f"{topic}: only {compared} states to compare")
    clouds = listener.decoded("/plume")
    fields = [f.name for f in clouds[-1].fields] if clouds else []
    must(fields == ["x", "y", "z", "size", "mass", "concentration", "stands_for"], f"the plume has {fields}")
    last = clouds[-1]
    rows = numpy.frombuffer(last.data.tobytes(), dtype="<f4").reshape(last.width, last.point_step // 4)
    must(numpy.isfinite(rows).all() and (rows[:, 5] >= 0).all(), "a concentration is negative or no number")
    must(rows[:, 5].max() > 0, "there is nothing in the water")


def check_tree(listener, machines):
    """Each frame has one parent, all hang on `map`, and messages are in frames of the tree."""
    parents = {}
    for topic in ("/tf", "/tf_static"):
        for message in listener.decoded(topic):
            for t in message.transforms:
                known = parents.setdefault(t.child_frame_id, t.header.frame_id)
                must(known == t.header.frame_id, f"{t.child_frame_id} has two parents")
                q = t.transform.rotation
                must(abs(math.hypot(q.x, q.y, q.z, q.w) - 1) < 1e-9, f"{t.child_frame_id}: no rotation")
    for frame in parents:
        seen, at = set(), frame
        while at != "map":
            must(at in parents and at not in seen, f"{frame} does not hang on map, but on {at}")
            seen.add(at)
            at = parents[at]
    for robot in machines[0]:
        must(parents.get(f"{robot}/base_link") == "map", f"{robot}/base_link is not in the tree")
    for name in listener.names():
        for message in listener.decoded(name)[-1:]:
            frame = getattr(getattr(message, "header", None), "frame_id", "map") or "map"
            must(frame in parents or frame == "map", f"{name} is in the unknown frame {frame}")


if __name__ == "__main__":
    main()
