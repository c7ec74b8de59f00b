"""Shows a mission in three dimensions, live or from its recording, in the Rerun viewer.

`python -m rheotaxis.look --help` explains its use. Readers (`recording`, `live`) turn what a run wrote or says into
`events`; `drawing` turns events into what the viewer shows. The viewer runs in a process of its own, behind a queue in
which the newest value replaces older ones, so that neither holds back the other.
"""
