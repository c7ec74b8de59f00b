"""The kinds of input: each writes a damaged one into a fresh folder and says which commands read it."""

import os
import re
import shutil
import socket
import subprocess
from pathlib import Path

import mutate
import pictures
from judge import Command, estimate_s

ROOT = Path(__file__).resolve().parents[2]
CATALOG = ROOT / "scenarios" / "catalog"
CAMPAIGN_ENDS = (0, 1, 2, 3, 75, 130)
LIVE = ["--no-zenoh", "--quiet"]


class Base:
    """Whole inputs that are damaged."""

    def __init__(self, binary, folder):
        self.scenarios = {p.stem: p.read_text() for p in sorted(CATALOG.glob("*.ron"))}
        self.campaigns = {p.stem: p.read_text() for p in sorted((CATALOG / "campaigns").glob("*.ron"))}
        self.rows = {p.stem: p.read_text() for p in sorted((ROOT / "tests/reference/rows").glob("*.ron"))}
        self.files = {p.name: p.read_bytes() for p in (CATALOG / "meshes").iterdir()}
        urdfs = [ROOT / "robots/urdf/crab_gantry.urdf", ROOT / "robots/vehicles/remus100/remus100.urdf"]
        self.files |= {p.name: p.read_bytes() for p in urdfs}
        self.vehicles = {p.name: p for p in sorted((ROOT / "robots/vehicles").iterdir()) if (p / "vehicle.ron").is_file()}
        self.pictures = pictures.whole()
        self.campaign = folder / "campaign"
        self.campaign.mkdir()
        (self.campaign / "s.ron").write_text(shortened(None, self.scenarios["uniform_channel"]))
        (self.campaign / "c.ron").write_text(SMALL)
        args = [binary, "campaign", "run", "c.ron", "--out", "out", "--block", "4", "--quiet", "--jobs", "1"]
        subprocess.run(args, cwd=self.campaign, check=True)
        self.whole = folder / "whole"
        shutil.copytree(self.campaign, self.whole, ignore=shutil.ignore_patterns("out"))
        (self.whole / "row.ron").write_text(re.sub(r'scenario: "[^"]*"', 'scenario: "s.ron"', self.rows["duck_st"]))
        for args in (["run", "s.ron", *LIVE, "--out", "out"],
                     ["reproduce", "row.ron", "--seeds", "3", "--keep", "kept", "--out", "o", "--jobs", "1", "--quiet"]):
            subprocess.run([binary, *args], cwd=self.whole, stdout=subprocess.DEVNULL)

    def some(self, rng):
        """A scenario's name and text, more often a small one."""
        small = ["uniform_channel", "remus_zigzag", "remus_dive", "flume_crab", "wp_dead_end", "block_in_channel"]
        name = rng.choice(small) if rng.random() < 0.3 else rng.choice(list(self.scenarios))
        return name, self.scenarios[name]

    def lay(self, folder):
        """The files that scenarios name."""
        (folder / "meshes").mkdir()
        for name, data in self.files.items():
            (folder / "meshes" / name).write_bytes(data)


SMALL = """(version: 2, title: "t", base: "s.ron", seeds: 4,
    arms: [(name: "a"), (name: "b", set: [("robots[0].strategy.speed_m_s", "1.2")])],
    conditions: Grid([("water.currents[0].speed_m_s", ["0.15"])]))
"""


def shortened(rng, text):
    """The same scenario, over in seconds."""
    for name, values in (("limit_s", ["2", "5", "10"]), ("spin_up_s", ["0", "5", "20"])):
        value = rng.choice(values) if rng else values[-1]
        text = re.sub(rf"\b{name}:\s*[^,()\s]+", f"{name}: {value}", text)
    return text


def check(do, names, path="case.ron"):
    return do(Command(["check", path], names))


def short_runs(rng, do, end, names):
    """What can be done with a scenario that `check` calls fine."""
    if end.code != 0:
        return
    said = estimate_s(end.out)
    others = [
        ["statistics", "case.ron", "--quiet", "--seconds", "2", "--out", "out"],
        ["picture", "case.ron", "--at", "0,0,-1", "--out", "seen.png", "--truth", "truth.png"],
    ]
    args = rng.choice(others) if rng.random() < 0.15 else ["run", "case.ron", *LIVE, "--out", "out"]
    # What else can be wrong with a picture or with statistics hangs on no file.
    ended = do(Command(args, names if args[0] == "run" else (), run=True), said)
    # `check` cannot know whether a place lies outside the water, and whether a searcher outside will be allowed.
    if args[0] == "run" and ended.code == 1 and "panicked" not in ended.said and "--allow-control" not in ended.said:
        ended.faults.append("`check` calls it fine, `run` does not: " + ended.said.strip()[:200])


def scenario(rng, base, at, do):
    """Scenarios with changed numbers, fields and variants; a share of them is run."""
    name, text = base.some(rng)
    base.lay(at)
    runs = rng.random() < 0.35
    if runs:
        text = shortened(rng, text)
    others = list(base.scenarios.values()) + list(base.campaigns.values())
    if rng.random() < 0.6:
        text = mutate.numbers(rng, text)
    else:
        text = mutate.structure(rng, text, others)
    if runs and rng.random() < 0.9:
        text = shortened(rng, text)
    (at / "case.ron").write_text(text, encoding="utf-8")
    end = check(do, ("case.ron",))
    if runs:
        short_runs(rng, do, end, ("case.ron", "out", "seen.png", "truth.png", "camera"))


def text(rng, base, at, do):
    """Scenarios damaged as text and bytes."""
    base.lay(at)
    (at / "case.ron").write_bytes(long(rng) if rng.random() < 0.05 else mutate.damage(rng, base.some(rng)[1].encode()))
    check(do, ("case.ron",))


def long(rng):
    """A megabyte of one thing, such as a log or a table under the wrong name, whole or within something."""
    of = rng.choice([b"the quick brown fox; ", b"(", b"]", b"(]", b"[(\n", b"\"\n", b";", b"a: 1,\n", b"(id: 3),\n", b"x"])
    before, after = rng.choice([(b"", b""), (b"(", b")"), (b"(title: [", b""), (b"(robots: [", b"])"), (b"(\n", b"\n)")])
    return before + of * (2**20 // len(of)) + after


def urdf(rng, base, at, do):
    """Robot descriptions."""
    gantry = rng.random() < 0.4
    name = "crab_gantry.urdf" if gantry else "remus100.urdf"
    base.lay(at)
    body = base.files[name]
    if not gantry and rng.random() < 0.2:
        body = re.sub(rb"<cylinder[^/]*/>", b'<mesh filename="reef.obj"/>', body)
    way = rng.random()
    if way < 0.5:
        body = mutate.numbers(rng, body.decode()).encode()
    elif way < 0.7:
        tags = [m.span() for m in re.finditer(rb"<[^!?][^>]*>", body)]
        low, high = rng.choice(tags)
        body = body[:low] + rng.choice([b"", body[low:high] * 2, body[slice(*rng.choice(tags))]]) + body[high:]
    else:
        body = mutate.damage(rng, body)
    (at / "meshes" / name).write_bytes(body)
    whole = base.scenarios["flume_crab" if gantry else "remus_zigzag"]
    given = re.sub(r"Remus100\(\)", f'Remus100(urdf: "meshes/{name}")', whole)
    given = re.sub(r"(gantry: \()", rf'\1urdf: "meshes/{name}", ', given)
    (at / "case.ron").write_text(shortened(rng, given))
    end = check(do, ("case.ron", name))
    if rng.random() < 0.3:
        short_runs(rng, do, end, ("case.ron", name, "out"))


def mesh(rng, base, at, do):
    """Surfaces in OBJ, STL of both sorts, and grids of heights."""
    base.lay(at)
    kind = rng.choice(["obj", "stl", "asc", "ascii"])
    data = base.files["mound.asc" if kind == "asc" else "reef.obj"]
    if kind in ("stl", "ascii"):
        data = pictures.stl(data, kind == "stl")
    damaged = mutate.numbers(rng, data.decode()).encode() if kind != "stl" and rng.random() < 0.5 else None
    data = damaged or (mutate.flipped if kind == "stl" else mutate.damage)(rng, data)
    name = "x." + ("stl" if kind in ("stl", "ascii") else kind)
    (at / "meshes" / name).write_bytes(data)
    whole = base.scenarios["mound" if kind == "asc" else "reef_mesh"]
    given = re.sub(r'"meshes/[^"]*"', f'"meshes/{name}"', whole)
    (at / "case.ron").write_text(shortened(rng, given))
    end = check(do, ("case.ron", name))
    if rng.random() < 0.2:
        short_runs(rng, do, end, ("case.ron", name, "out"))


def campaign_file(rng, base, at, do):
    """Campaign files."""
    base.lay(at)
    shutil.copy(base.campaign / "s.ron", at / "s.ron")
    body = rng.choice([SMALL, SMALL, *base.campaigns.values()])
    way = rng.random()
    if way < 0.45:
        body = mutate.numbers(rng, body)
    elif way < 0.8:
        body = mutate.structure(rng, body, list(base.campaigns.values()) + [SMALL])
    data = mutate.damage(rng, body.encode()) if way >= 0.8 else body.encode()
    (at / "c.ron").write_bytes(data)
    bases = re.findall(r'base: *"([^"]*)"', data.decode("utf-8", "replace"))
    names = ("c.ron", "s.ron", "(arm", "out", *bases, *base.scenarios)
    planned = do(Command(["campaign", "plan", "c.ron", "--no-probe"], names))
    if planned.code == 0 and 's.ron"' in body and rng.random() < 0.5:
        args = ["campaign", "run", "c.ron", "--out", "out", "--quiet", "--jobs", "1", "--max-wall", "1s"]
        do(Command(args, names, run=True, ends=CAMPAIGN_ENDS))


def readers(rng, do):
    """Everything that reads a campaign's folder."""
    names = ("campaign.json", "part-", "declarations-", "out", "all.parquet", "s.ron", "c.ron", "(arm", "no run")
    for args in rng.sample([["status", "out"], ["merge", "out", "-o", "all.parquet", "--csv"],
                            ["report", "out", "--out", "report"], ["rerun", "out", "--run", "1", "--quiet"],
                            ["run", "c.ron", "--out", "out", "--quiet", "--jobs", "1", "--max-wall", "1s"]], 3):
        do(Command(["campaign", *args], names, run=args[0] in ("run", "rerun"), ends=CAMPAIGN_ENDS))


def manifest(rng, base, at, do):
    """`campaign.json`."""
    shutil.copytree(base.campaign, at, dirs_exist_ok=True)
    path = at / "out" / "campaign.json"
    data = path.read_text()
    if rng.random() < 0.6:
        name = rng.choice(["block", "runs"])
        data = re.sub(rf'"{name}": \d+', f'"{name}": {mutate.number(rng, "4")}', data)
    elif rng.random() < 0.5:
        data = mutate.numbers(rng, data)
    path.write_bytes(mutate.damage(rng, data.encode()) if rng.random() < 0.3 else data.encode())
    readers(rng, do)


def block(rng, base, at, do):
    """Blocks of rows (Parquet)."""
    shutil.copytree(base.campaign, at, dirs_exist_ok=True)
    parts = sorted((at / "out").glob("*.parquet"))
    path = rng.choice(parts)
    data = path.read_bytes()
    way = rng.random()
    if way < 0.5:
        # The footer is where the structure is.
        cut = len(data) - rng.randrange(min(len(data), 3000))
        data = data[:cut] + mutate.flipped(rng, data[cut:])
    elif way < 0.95:
        data = mutate.flipped(rng, data)
    else:
        data = rng.choice(parts).read_bytes()
    path.write_bytes(data)
    readers(rng, do)


def row_file(rng, base, at, do):
    """Rows of `reproduce`."""
    base.lay(at)
    shutil.copy(base.campaign / "s.ron", at / "s.ron")
    name = rng.choice(list(base.rows))
    body = re.sub(r'scenario: "[^"]*"', 'scenario: "s.ron"', base.rows[name])
    body = re.sub(r",\s*set: \[.*?\]\)", ")", body)
    way = rng.random()
    if way < 0.4:
        body = mutate.numbers(rng, body)
    elif way < 0.8:
        body = mutate.structure(rng, body, list(base.rows.values()))
    (at / "row.ron").write_bytes(mutate.damage(rng, body.encode()) if way >= 0.8 else body.encode())
    names = ("row.ron", "s.ron", "s (arm", "out") + tuple(base.scenarios)
    do(Command(["reproduce", "row.ron", "--seeds", "1", "--jobs", "1", "--quiet", "--out", "out"], names, run=True))


def picture(rng, base, at, do):
    """Pictures for `segment`, of every format."""
    name = rng.choice(list(base.pictures))
    data = base.pictures[name]
    data = pictures.damaged_png(rng, data) if name == "png" and rng.random() < 0.6 else mutate.flipped(rng, data)
    (at / "case.any").write_bytes(data)
    do(Command(["segment", "case.any", "--out", "out"], ("case.any",)))


def vehicle(rng, base, at, do):
    """Folders of vehicles: `vehicle.ron`, the URDF and the surface that it names."""
    whole = base.vehicles[rng.choice(list(base.vehicles))]
    shutil.copytree(whole, at / "v")
    path = rng.choice([at / "v" / "vehicle.ron"] * 2 + sorted((at / "v").iterdir()))
    way = rng.random()
    text = None
    if way < 0.8:
        try:
            text = path.read_text(encoding="utf-8")
        except ValueError:
            pass
    if text is None:
        path.write_bytes(mutate.damage(rng, path.read_bytes()))
    elif way < 0.5 or path.suffix != ".ron":
        path.write_text(mutate.numbers(rng, text), encoding="utf-8")
    else:
        others = [(v / "vehicle.ron").read_text(encoding="utf-8") for v in base.vehicles.values()]
        path.write_text(mutate.structure(rng, text, others), encoding="utf-8")
    names = ("v/", "vehicle.ron")
    end = do(Command(["vehicle", "check", "v", "--out", "v.svg"], names))
    if end.code == 0 and rng.random() < 0.5:
        (at / "t.csv").write_text("t_s\n0\n")
        args = ["vehicle", "fly", "v", "--table", "t.csv", "--lasts-s", "5", "--out", "flown.csv"]
        # What is wrong with a hull beside these steps hangs on no file.
        names = (*names, "t.csv", "this hull")
        end = do(Command(args, names, run=True), 1.0)
        drives = re.search(r"needed are t_s, (.*)", end.said)
        if drives:
            columns = drives.group(1).strip().split(", ")
            row = ",".join(str(rng.choice([0, 0.3, 1, -1])) for _ in columns)
            (at / "t.csv").write_text(f"t_s,{','.join(columns)}\n0,{row}\n")
            end = do(Command(args, names, run=True), 1.0)
        flown = at / "flown.csv"
        if flown.is_file() and re.search(r"(?i)\b(nan|inf)\b", flown.read_text(errors="replace")):
            end.faults.append("`vehicle fly` writes what is no number")


def recording(rng, base, at, do):
    """Recordings (`run.mcap`)."""
    data = (base.whole / "out" / "run.mcap").read_bytes()
    data = mutate.damage(rng, data) if rng.random() < 0.4 else mutate.flipped(rng, data)
    (at / "case.mcap").write_bytes(data)
    do(Command(["rerun", "case.mcap", "--quiet", "--out", "out"], ("case.mcap", "out"), run=True), 1.0)


def kept(rng, base, at, do):
    """Kept tables of `reproduce`."""
    shutil.copytree(base.whole, at, dirs_exist_ok=True)
    path = rng.choice(sorted((at / "kept").iterdir()))
    data = path.read_bytes()
    if rng.random() < 0.5:
        data = mutate.numbers(rng, data.decode()).encode()
    else:
        data = mutate.damage(rng, data)
    # A mark of the encoding, the ends of lines and the scenario's name beside its hash decide nothing.
    named = re.compile(rb"(reproduce: scenario ).*(, hash )")
    said = lambda text: named.sub(rb"\1\2", text).removeprefix(b"\xef\xbb\xbf").replace(b"\r\n", b"\n").rstrip(b"\n")
    changed = said(data) != said(path.read_bytes())
    path.write_bytes(data)
    args = ["reproduce", "row.ron", "--seeds", "3", "--keep", "kept", "--no-runs", "--check", "0", "--out", "o", "--quiet"]
    end = do(Command(args, ("kept", path.name, "row.ron", "duck_st is out of date"), run=True), 1.0)
    if changed and end.code == 0 and not end.said.strip():
        end.faults.append("a changed table passes without a word")


SPECIAL_INPUTS = [
    ["check", "X"], ["run", "X", *LIVE, "--out", "out"], ["campaign", "plan", "X"],
    ["campaign", "run", "X", "--out", "out", "--quiet"], ["campaign", "status", "X"], ["segment", "X", "--out", "out"],
    ["reproduce", "X", "--seeds", "1", "--quiet", "--out", "out"], ["picture", "X", "--at", "0,0,-1", "--out", "p.png"],
    ["statistics", "X", "--seconds", "1", "--quiet", "--out", "out"], ["run", "s.ron", "--zenoh-config", "X", "--quiet"],
]
OUTPUTS = {
    ("run", "s.ron", *LIVE, "--out", "out"): ["out/track.csv", "out/run.mcap", "out/summary.json", "out/report.html",
                                               "out/map.svg", "out/map.png", "out/plume.csv", "out", "out/run-files.txt"],
    ("segment", "a.png", "--out", "out"): ["out/sheet.png", "out/segmentation.json", "out/left.png", "out"],
    ("picture", "s.ron", "--at", "0,0,-1", "--out", "p.png", "--truth", "t.png"): ["p.png", "t.png"],
    ("statistics", "s.ron", "--seconds", "1", "--quiet", "--out", "out"): ["out/statistics.csv"],
    ("campaign", "merge", "c", "-o", "all.parquet", "--csv"): ["all.parquet", "all.csv", "all-declarations.csv",
                                                                    "c/part-000000.parquet", "c/declarations-000000.parquet"],
    ("campaign", "report", "c", "--out", "out"): ["out/arms.csv", "out/report.html", "out/success.png"],
    ("campaign", "run", "c.ron", "--out", "c", "--quiet", "--jobs", "1"): ["c/part-000001.parquet", "c/campaign.json"],
    ("campaign", "rerun", "c", "--run", "0", "--quiet", "--out", "out"): ["out/track.csv", "out/report.html"],
    ("init", "duck_st", "p.ron"): ["p.ron"],
}


def place(rng, path):
    """Something that is no regular file, or may not be read or written; which."""
    path.parent.mkdir(parents=True, exist_ok=True)
    if path.is_dir() and not path.is_symlink():
        shutil.rmtree(path)
    elif path.is_symlink() or path.exists():
        path.unlink()
    kind = rng.choice(["pipe", "null", "zero", "full", "folder", "loop", "dangling", "socket", "closed", "link_to_pipe"])
    if kind == "pipe":
        os.mkfifo(path)
    elif kind == "link_to_pipe":
        os.mkfifo(path.parent / "the_pipe")
        path.symlink_to("the_pipe")
    elif kind in ("null", "zero", "full"):
        path.symlink_to("/dev/" + kind)
    elif kind == "folder":
        path.mkdir()
    elif kind == "loop":
        path.symlink_to(path.name)
    elif kind == "dangling":
        path.symlink_to("nowhere")
    elif kind == "socket":
        here = os.getcwd()
        listener = socket.socket(socket.AF_UNIX)
        listener.bind(os.path.relpath(path, here))
        listener.close()
    else:
        path.write_bytes(b"x")
        path.chmod(0)
    return kind


def special(rng, base, at, do):
    """Pipes, devices, folders, links in the place of inputs and outputs."""
    shutil.copy(base.campaign / "s.ron", at / "s.ron")
    shutil.copy(base.campaign / "c.ron", at / "c.ron")
    shutil.copytree(base.campaign / "out", at / "c")
    (at / "a.png").write_bytes(base.pictures["png"])
    if rng.random() < 0.4:
        place(rng, at / "case.ron")
        args = ["case.ron" if a == "X" else a for a in rng.choice(SPECIAL_INPUTS)]
        do(Command(args, ("case.ron",), run=args[0] != "check", ends=CAMPAIGN_ENDS), 1.0)
        return
    args = rng.choice(list(OUTPUTS))
    taken = rng.choice(OUTPUTS[args])
    what = place(rng, at / taken)
    before = os.lstat(at / taken)
    # A list of files that cannot be read is named instead of what it lists.
    names = (taken, os.path.dirname(taken) or taken, "no odour reached")
    end = do(Command(list(args), names, run=True, ends=CAMPAIGN_ENDS), 1.0)
    there = os.path.lexists(at / taken) and os.lstat(at / taken)
    kept = there and (there.st_mode, there.st_ino) == (before.st_mode, before.st_ino)
    if what in ("pipe", "null", "zero", "full", "folder", "socket", "loop", "link_to_pipe") and taken != "out" and not kept:
        end.faults.append(f"{what} in the place of {os.path.basename(taken)} is replaced")


NUMBERED = [
    ["run", "s.ron", *LIVE, "--out", "out", "--seed", "N"], ["run", "s.ron", *LIVE, "--out", "out", "--speed", "N"],
    ["run", "s.ron", "--quiet", "--zenoh-listen", "tcp/127.0.0.1:N"], ["campaign", "rerun", "c", "--quiet", "--run", "N"],
    ["statistics", "s.ron", "--quiet", "--out", "out", "--seconds", "N"],
    ["picture", "s.ron", "--out", "p.png", "--at", "N,N,-1"], ["picture", "s.ron", "--out", "p.png", "--at", "0,0,N"],
    ["picture", "s.ron", "--out", "p.png", "--at", "0,0,-1", "--look", "N,N"],
    ["picture", "s.ron", "--out", "p.png", "--at", "0,0,-1", "--visibility", "N"],
    ["campaign", "run", "c.ron", "--out", "o", "--quiet", "--jobs", "1", "--block", "N"],
    ["campaign", "run", "c.ron", "--out", "o", "--quiet", "--jobs", "1", "--shard", "N/N"],
    ["campaign", "run", "c.ron", "--out", "o", "--quiet", "--jobs", "N", "--max-wall", "1s"],
    ["campaign", "run", "c.ron", "--out", "o", "--quiet", "--jobs", "1", "--max-wall", "Ns"],
    ["campaign", "plan", "c.ron", "--no-probe", "--block", "N"],
    ["reproduce", "row.ron", "--quiet", "--jobs", "1", "--out", "o", "--seeds", "1", "--first-seed", "N"],
    ["reproduce", "row.ron", "--quiet", "--jobs", "1", "--out", "o", "--until-width", "N", "--max", "2"],
    ["score-vision", "--quiet", "--jobs", "1", "--out", "o", "--scenes", "1", "--width", "N"],
    ["score-vision", "--quiet", "--jobs", "1", "--out", "o", "--scenes", "1", "--width", "8", "--seed", "N"],
    *(["segment", "a.png", "--out", "o", flag, "N"] for flag in (
        "--alpha1", "--alpha2", "--beta", "--epsilon", "--plume-passes", "--source-passes")),
]


def command_line(rng, base, at, do):
    """Numbers of the command line."""
    base.lay(at)
    for name in ("s.ron", "c.ron"):
        shutil.copy(base.campaign / name, at / name)
    shutil.copytree(base.campaign / "out", at / "c")
    (at / "a.png").write_bytes(base.pictures["png"])
    row = re.sub(r'scenario: "[^"]*"', 'scenario: "s.ron"', base.rows["duck_st"])
    (at / "row.ron").write_text(row)
    value = mutate.number(rng, rng.choice(["1", "3", "0.5", "100"]))
    args = [a.replace("N", value) if "N" in a else a for a in rng.choice(NUMBERED)]
    # Who asks for a million seconds gets them, until Ctrl-C.
    patience_s = 10.0 if "--speed" in args else 0.0
    do(Command(args, run=args[0] != "segment", ends=CAMPAIGN_ENDS, patience_s=patience_s), 1e9)


# How often each is drawn.
KINDS = [(scenario, 60), (text, 14), (urdf, 6), (mesh, 5), (campaign_file, 4), (manifest, 2), (block, 4), (row_file, 2),
         (picture, 6), (special, 4), (command_line, 3), (vehicle, 10), (recording, 3), (kept, 3)]
