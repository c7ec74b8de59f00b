#!/usr/bin/env python3
"""Print the live state of a rheotaxis run: one line a message, key and JSON.

    pip install eclipse-zenoh==1.10.2
    python subscribe.py [ENDPOINT [KEY]]        # tcp/127.0.0.1:7447  rheotaxis/**
    python subscribe.py CONFIG.json5 [KEY]      # with TLS or a password: docs/zenoh

Start it before, during or after the mission, as long as the run is there: it waits for a run, asks
for all that was said before it came (scenario, version, schemas, newest state), prints what follows,
and stops when the run is gone. `rheotaxis topics` explains the keys. KEY narrows what follows, for
example 'rheotaxis/*/auv/*/chemical' or 'rheotaxis/*/gantry/*/probes'.
"""
import sys
import zenoh

endpoint, key = (sys.argv[1:] + ["tcp/127.0.0.1:7447", "rheotaxis/**"][len(sys.argv) - 1:])[:2]

def show(sample):  # what is no JSON (plume, map, sidescan: packed numbers; picture: JPEG) carries a JSON header as attachment
    print(f"{sample.key_expr} {(sample.attachment or sample.payload).to_string()}\n", end="", flush=True)

if endpoint.endswith(".json5"):
    config = zenoh.Config.from_file(endpoint)
else:
    config = zenoh.Config.from_json5(f"""{{ mode: "peer", listen: {{ endpoints: [] }},
        scouting: {{ multicast: {{ enabled: false }} }},
        connect: {{ endpoints: ["{endpoint}"], retry: {{ period_init_ms: 200, period_max_ms: 1000 }} }} }}""")
with zenoh.open(config) as session:
    state = session.declare_subscriber(key, show)
    runs = session.liveliness().declare_subscriber("rheotaxis/*/@live/sim", history=True)
    for run in runs:
        if run.kind == zenoh.SampleKind.DELETE:
            break
        for reply in session.get(str(run.key_expr).replace("@live/sim", "**")):
            show(reply.ok)
