#!/usr/bin/env python3
"""How often pictures without dye are taken for a source that gives off dye.

    apt-get download tuxpaint-stamps-default && dpkg -x tuxpaint-stamps-default_*.deb stamps
    python3 tools/false_alarms.py --things stamps/usr/share/tuxpaint/stamps/{animals,plants,food}
    python3 tools/false_alarms.py --photographs FOLDER [--as-they-are]

Things are photographs cut out on a transparent ground: one to three of a kind are laid into drawn water over a drawn
bed. Photographs are cut to 4:3 and seen through water. Water takes red most and scatters its own colour into the way;
the camera blurs and adds noise. Pictures have 320 x 240 pixels and come from a seed. Needs numpy and Pillow; prints what
`rheotaxis segment --dehaze --give-back` says of all of them.
"""

import argparse
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np
from PIL import Image, ImageFilter

WIDTH, HEIGHT = 320, 240
# Attenuation (1/m) and scattered light of red, green and blue in clear and in green water.
WATERS = [((0.55, 0.13, 0.10), (0.03, 0.22, 0.30)), ((0.50, 0.14, 0.25), (0.05, 0.25, 0.18))]


def water(rng):
    return [np.array(v) for v in WATERS[rng.integers(len(WATERS))]]


def through(light, distance_m, attenuation, scattered):
    passed = np.exp(-attenuation * distance_m)
    return light * passed + scattered * (1 - passed)


def recorded(light, rng):
    levels = (np.clip(light, 0, 1) ** (1 / 2.2) * 255).astype("uint8")
    seen = np.asarray(Image.fromarray(levels).filter(ImageFilter.GaussianBlur(0.7))) / 255
    return Image.fromarray((np.clip(seen + rng.normal(0, 0.012, seen.shape), 0, 1) * 255).round().astype("uint8"))


def with_things(thing, rng):
    """A thing cut out, one to three times, in water over a bed."""
    attenuation, scattered = water(rng)
    y = np.arange(HEIGHT)[:, None, None]
    horizon = rng.integers(60, 140)
    grain = Image.fromarray((rng.random((HEIGHT // 6, WIDTH // 6)) * 255).astype("uint8"))
    grain = np.asarray(grain.resize((WIDTH, HEIGHT), Image.BICUBIC))[..., None] / 255
    bed = np.array([0.55, 0.50, 0.40]) * (0.7 + 0.5 * grain)
    distance_m = np.where(y > horizon, 1 + 8 * (1 - (y - horizon) / (HEIGHT - horizon)) ** 2, 30)
    scene = through(bed, distance_m, attenuation, scattered)
    for _ in range(rng.integers(1, 4)):
        width = int(WIDTH * rng.uniform(0.2, 0.6))
        height = int(thing.height * width / thing.width)
        if height > HEIGHT:
            width, height = max(8, thing.width * HEIGHT // thing.height), HEIGHT
        left, top = rng.integers(-width // 4, WIDTH - 3 * width // 4), rng.integers(0, max(1, HEIGHT - height + 1))
        cut = np.asarray(thing.resize((width, height), Image.LANCZOS)) / 255
        cut = cut[:, max(0, -left) : WIDTH - left]
        light = through(cut[..., :3] ** 2.2, rng.uniform(0.5, 3), attenuation, scattered)
        place = np.s_[top : top + height, max(0, left) : max(0, left) + cut.shape[1]]
        scene[place] += cut[..., 3:] * (light - scene[place])
    return recorded(scene, rng)


def under_water(photograph, rng):
    attenuation, scattered = water(rng)
    higher = 1 - np.linspace(0, 1, HEIGHT)[:, None, None]
    distance_m = rng.uniform(0.8, 1.5) + higher * rng.uniform(0.5, 4)
    return recorded(through((np.asarray(photograph) / 255) ** 2.2, distance_m, attenuation, scattered), rng)


def cropped(picture):
    width = min(picture.width, picture.height * 4 // 3)
    height = min(picture.height, picture.width * 3 // 4)
    left, top = (picture.width - width) // 2, (picture.height - height) // 2
    return picture.crop((left, top, left + width, top + height)).resize((WIDTH, HEIGHT), Image.LANCZOS)


def pictures_in(folders):
    kinds = {".png", ".jpg", ".jpeg", ".webp"}
    for path in sorted(p for f in folders for p in Path(f).rglob("*") if p.suffix.lower() in kinds):
        # Mirrored stamps are the same thing again, and drawings are no photographs.
        if "_mirror" in path.name or "cartoon" in str(path):
            continue
        try:
            yield Image.open(path).convert("RGBA")
        except OSError as error:
            print(f"left out: {path}: {error}", file=sys.stderr)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--things", nargs="*", default=[], metavar="FOLDER", help="photographs of things, cut out")
    parser.add_argument("--photographs", nargs="*", default=[], metavar="FOLDER", help="whole photographs")
    parser.add_argument("--as-they-are", action="store_true", help="photographs without water")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--program", default="target/release/rheotaxis", help="the program [default: %(default)s]")
    parser.add_argument("--out", help="keep the pictures in this folder")
    args = parser.parse_args()
    rng = np.random.default_rng(args.seed)
    with tempfile.TemporaryDirectory() as temporary:
        folder = Path(args.out or temporary)
        folder.mkdir(parents=True, exist_ok=True)
        made = []
        for thing in pictures_in(args.things):
            if thing.width >= 120:
                made.append(with_things(thing, rng))
        for photograph in pictures_in(args.photographs):
            photograph = cropped(photograph.convert("RGB"))
            made.append(photograph if args.as_they_are else under_water(photograph, rng))
        if not made:
            parser.error("no picture: name a folder with --things or --photographs")
        names = [str(folder / f"{n:04}.png") for n in range(len(made))]
        for name, picture in zip(names, made):
            picture.save(name)
        sys.exit(subprocess.run([args.program, "segment", *names, "--dehaze", "--give-back"]).returncode)


if __name__ == "__main__":
    main()
