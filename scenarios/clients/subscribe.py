#!/usr/bin/env python3
"""Print the live state of a rheotaxis run: one line a message, key and JSON.

    pip install eclipse-zenoh==1.10.2
    python subscribe.py [ENDPOINT [KEY]]        # else all runs at tcp/127.0.0.1:7447 to 7510, and rheotaxis/**
    python subscribe.py CONFIG.json5 [KEY]      # with TLS or a password: docs/zenoh

Start it before, during or after the mission, as long as the run is there: it waits for a run, asks
for all that was said before it came (scenario, version, schemas, newest state), prints what follows,
and stops when all runs that it found are gone. `rheotaxis topics` explains the keys. KEY narrows what follows, for
example 'rheotaxis/*/auv/*/chemical' or 'rheotaxis/*/gantry/*/probes'.
"""
import json
import sys
import zenoh

# Where runs listen: the first of these ports that is free when they start.
endpoints = sys.argv[1:2] or [f"tcp/127.0.0.1:{port}" for port in range(7447, 7511)]
key = (sys.argv[2:] + ["rheotaxis/**"])[0]

def show(sample):  # what is no JSON (plume, map, sidescan: packed numbers; picture: JPEG) carries a JSON header as attachment
    print(f"{sample.key_expr} {(sample.attachment or sample.payload).to_string()}\n", end="", flush=True)

if endpoints[0].endswith(".json5"):
    config = zenoh.Config.from_file(endpoints[0])
else:
    config = zenoh.Config.from_json5(f"""{{ mode: "peer", listen: {{ endpoints: [] }},
        scouting: {{ multicast: {{ enabled: false }}, gossip: {{ enabled: false }} }},
        connect: {{ endpoints: {json.dumps(endpoints)}, retry: {{ period_init_ms: 200, period_max_ms: 1000 }} }} }}""")
with zenoh.open(config) as session:
    state = session.declare_subscriber(key, show)
    runs = session.liveliness().declare_subscriber("rheotaxis/*/@live/sim", history=True)
    there = set()
    for run in runs:
        if run.kind == zenoh.SampleKind.DELETE:
            there.discard(str(run.key_expr))
            if not there:
                break
            continue
        there.add(str(run.key_expr))
        for reply in session.get(str(run.key_expr).replace("@live/sim", "**")):
            show(reply.ok)
