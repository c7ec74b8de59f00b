#!/usr/bin/env python3
"""Decide for a robot of a rheotaxis run: obliquely up-flow in the plume, back across it when it is lost, then declare.

    pip install eclipse-zenoh==1.10.2
    rheotaxis run duck_external --allow-control &
    python controller.py [ENDPOINT]                  # else all runs at tcp/127.0.0.1:7447 to 7510

The run asks once a period and waits; docs/interfaces.md has the fields of a question and of an answer.
"""
import json, math, sys, time
import zenoh

# Where runs listen: the first of these ports that is free when they start.
endpoints = sys.argv[1:2] or [f"tcp/127.0.0.1:{port}" for port in range(7447, 7511)]
minds = {}  # of each robot of each run: times and places of detections; which way it crosses the plume

def decide(seen, hits, state):
    t, here, gathered = seen["t_s"], seen["estimate"]["position_m"], seen["gathered"]
    flow = seen.get("flow", {"velocity_m_s": [0.0, -1.0]})["velocity_m_s"]
    up_flow = math.atan2(-flow[0], -flow[1])  # a compass heading: atan2(east, north)
    if gathered["detections"]:
        hits.append((t, here))
    lost_s = t - hits[-1][0] if hits else t
    if hits and lost_s > 300:  # the plume has ended: its source is where it was met farthest up-flow
        best = max(hits, key=lambda hit: -hit[1][0] * flow[0] - hit[1][1] * flow[1])
        return {"declare": {"position_m": best[1], "rule": "surge_cast"}, "end": "completed"}
    if lost_s <= 5:  # in the plume: obliquely up-flow, towards the other edge than last time
        turn = state["side"] * 20
    else:  # out of it: back across it, and after 25 s to the other side
        state["side"] *= -1 if state["in"] else 1
        turn = state["side"] * (70 if (lost_s - 5) % 75 < 25 else -70)
    state["in"], heading = lost_s <= 5, up_flow + math.radians(turn)
    course = {"course": {"heading_rad": heading % math.tau}}
    goal = {"manoeuvre": course, "altitude_m": 2.0, "speed_m_s": 2.0}
    return {"goal": goal, "behaviour": "surge" if lost_s <= 5 else "cast"}

def answer(query):
    seen = json.loads(query.payload.to_string())
    if seen["number"] == 0:  # the beginning of a run
        minds.pop(str(query.key_expr), None)
    hits, state = minds.setdefault(str(query.key_expr), ([], {"side": 1, "in": False}))
    query.reply(query.key_expr, json.dumps({"number": seen["number"], **decide(seen, hits, state)}))

config = zenoh.Config.from_json5(f"""{{ mode: "peer", listen: {{ endpoints: [] }},
    scouting: {{ multicast: {{ enabled: false }}, gossip: {{ enabled: false }} }},
    connect: {{ endpoints: {json.dumps(endpoints)}, retry: {{ period_init_ms: 200, period_max_ms: 1000 }} }} }}""")
with zenoh.open(config) as session:
    asked = session.declare_queryable("rheotaxis/*/ask/*", answer)
    runs = session.liveliness().declare_subscriber("rheotaxis/*/@live/sim", history=True)
    there, left_s = set(), math.inf  # how long it waits for another run, or for one that was only out of reach
    while left_s > 0:
        run = runs.try_recv()
        if run is None:
            time.sleep(0.1)
            left_s -= 0.1
        elif run.kind == zenoh.SampleKind.PUT:
            there.add(str(run.key_expr))
            left_s = math.inf
        else:
            there.discard(str(run.key_expr))
            left_s = math.inf if there else 2.0
