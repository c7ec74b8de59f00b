#!/usr/bin/env python3
"""Puts pictures (PNG) of one shape side by side, smaller, on one white sheet.

    tools/montage.py OUT.png COLUMNS WIDTH PICTURE.png [PICTURE.png ...]

WIDTH is that of each picture on the sheet, px.
"""

import sys

import png

GAP = 4


def main(out, columns, width, *paths):
    columns, width = int(columns), int(width)
    pictures = [png.read(path) for path in paths]
    height = round(width * pictures[0][1] / pictures[0][0])
    tiles = [png.smaller(w, rows, width, height) for w, _, rows in pictures]
    beside, whole = b"\xff" * (3 * GAP), columns * (width + GAP) - GAP
    sheet = []
    for first in range(0, len(tiles), columns):
        sheet += [b"\xff" * (3 * whole)] * (GAP if sheet else 0)
        for lines in zip(*tiles[first : first + columns]):
            sheet.append(beside.join(lines).ljust(3 * whole, b"\xff"))
    png.write(out, whole, sheet)


if __name__ == "__main__":
    if len(sys.argv) < 5:
        sys.exit(__doc__)
    main(*sys.argv[1:])
