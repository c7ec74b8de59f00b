"""PNG files of eight bits a channel, read and written with the standard library alone."""

import struct
import zlib

SIGNATURE = b"\x89PNG\r\n\x1a\n"
# Channels by colour type: grey, RGB, palette, grey with alpha, RGB with alpha.
CHANNELS = {0: 1, 2: 3, 3: 1, 4: 2, 6: 4}


def _chunks(data):
    if data[:8] != SIGNATURE:
        raise ValueError("not a PNG file")
    at = 8
    while at + 8 <= len(data):
        length, kind = struct.unpack(">I4s", data[at : at + 8])
        yield kind, data[at + 8 : at + 8 + length]
        at += 12 + length


def _unfiltered(raw, stride, step):
    """Rows of bytes; `step` is the number of bytes of a pixel."""
    rows, above = [], bytearray(stride)
    for start in range(0, len(raw), stride + 1):
        kind, row = raw[start], bytearray(raw[start + 1 : start + 1 + stride])
        if kind == 1:
            for i in range(step, stride):
                row[i] = (row[i] + row[i - step]) & 255
        elif kind == 2:
            row = bytearray((a + b) & 255 for a, b in zip(row, above))
        elif kind == 3:
            for i in range(stride):
                left = row[i - step] if i >= step else 0
                row[i] = (row[i] + (left + above[i]) // 2) & 255
        elif kind == 4:
            for i in range(stride):
                a, b, c = (row[i - step], above[i], above[i - step]) if i >= step else (0, above[i], 0)
                p = a + b - c
                near = min((abs(p - a), 0, a), (abs(p - b), 1, b), (abs(p - c), 2, c))
                row[i] = (row[i] + near[2]) & 255
        rows.append(row)
        above = row
    return rows


def read(path):
    """(width, height, rows), each row a bytes object of red, green, blue for each pixel, laid on white."""
    data, head, palette, alphas = b"", None, b"", b""
    with open(path, "rb") as file:
        for kind, body in _chunks(file.read()):
            if kind == b"IHDR":
                head = struct.unpack(">IIBBBBB", body)
            elif kind == b"PLTE":
                palette = body
            elif kind == b"tRNS":
                alphas = body
            elif kind == b"IDAT":
                data += body
    width, height, depth, colour, _, _, interlaced = head
    if depth != 8 or interlaced:
        raise ValueError(f"{path}: {depth} bits a channel, interlaced {interlaced}: only 8 and 0 are read")
    n = CHANNELS[colour]
    rows = _unfiltered(zlib.decompress(data), width * n, n)
    return width, height, [_rgb(row, colour, palette, alphas) for row in rows]


def _rgb(row, colour, palette, alphas):
    if colour == 2:
        return bytes(row)
    out = bytearray(3 * (len(row) // CHANNELS[colour]))
    if colour == 3:
        alpha = alphas + b"\xff" * 256
        lut = [palette[3 * i : 3 * i + 3] for i in range(len(palette) // 3)]
        lut = [bytes((v * alpha[i] + 255 * (255 - alpha[i]) + 127) // 255 for v in c) for i, c in enumerate(lut)]
        return b"".join(lut[i] for i in row)
    grey = colour in (0, 4)
    step = CHANNELS[colour]
    for k in range(3):
        out[k::3] = row[0::step] if grey else row[k::step]
    if colour in (4, 6):
        cover = row[step - 1 :: step]
        if cover.count(255) != len(cover):
            for i, a in enumerate(cover):
                if a < 255:
                    for k in range(3 * i, 3 * i + 3):
                        out[k] = (out[k] * a + 255 * (255 - a) + 127) // 255
    return bytes(out)


def write(path, width, rows):
    """Writes rows of red, green, blue, each as what it differs by from the row above."""

    def chunk(kind, body):
        return struct.pack(">I", len(body)) + kind + body + struct.pack(">I", zlib.crc32(kind + body))

    head = struct.pack(">IIBBBBB", width, len(rows), 8, 2, 0, 0, 0)
    above = [bytes(3 * width), *rows]
    lines = (b"\2" + bytes((a - b) & 255 for a, b in zip(row, up)) for row, up in zip(rows, above))
    data = zlib.compress(b"".join(lines), 9)
    with open(path, "wb") as file:
        file.write(SIGNATURE + chunk(b"IHDR", head) + chunk(b"IDAT", data) + chunk(b"IEND", b""))


def smaller(width, rows, columns, lines):
    """The picture in so many columns and lines, each pixel the mean of those that it covers."""
    height, out = len(rows), []
    xs = [(i * width // columns, max((i + 1) * width // columns, i * width // columns + 1)) for i in range(columns)]
    for j in range(lines):
        top = j * height // lines
        band = rows[top : max((j + 1) * height // lines, top + 1)]
        line = bytearray()
        for a, b in xs:
            n = (b - a) * len(band)
            for k in range(3):
                line.append((sum(sum(row[3 * a + k : 3 * b : 3]) for row in band) + n // 2) // n)
        out.append(bytes(line))
    return out
