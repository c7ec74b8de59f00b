"""Small whole pictures of every format that `segment` reads, and surfaces as STL; by hand, so that nothing need be installed."""

import base64
import struct
import zlib

W, H = 24, 18


def colour(x, y):
    """Light water with dye and a dark body in it."""
    if 12 <= x < 20 and 3 <= y < 8:
        return 230, 90, 100
    if 3 <= x < 9 and 6 <= y < 14:
        return 20, 25, 60
    return 110, 170, 175


RGB = b"".join(bytes(colour(x, y)) for y in range(H) for x in range(W))


def chunk(name, data):
    return struct.pack(">I", len(data)) + name + data + struct.pack(">I", zlib.crc32(name + data))


def png(depth=8, kind=2, rows=None, size=(W, H), interlaced=0):
    """A PNG of those raw rows."""
    if rows is None:
        rows = b"".join(b"\0" + RGB[3 * W * y : 3 * W * (y + 1)] for y in range(H))
    head = struct.pack(">IIBBBBB", *size, depth, kind, 0, 0, interlaced)
    return b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", head) + chunk(b"IDAT", zlib.compress(rows)) + chunk(b"IEND", b"")


def damaged_png(rng, data):
    """Damaged behind checksums that are right again."""
    way = rng.randrange(4)
    if way == 0:
        size = [rng.choice([0, 1, 7, 24, 4096, 32768, 32769, 65535, 2**31 - 1, 2**31, 2**32 - 1]) for _ in "wh"]
        return png(size=size)
    if way == 1:
        return png(rng.choice([1, 2, 4, 8, 16, 3]), rng.choice([0, 2, 3, 4, 6, 5]), interlaced=rng.choice([0, 1, 2]))
    if way == 2:
        rows = bytes(rng.randrange(256) for _ in range(rng.choice([0, 10, 1314, 100000])))
        return png(rows=rows)
    parts, at = [], 8
    while at + 8 <= len(data):
        length = struct.unpack(">I", data[at : at + 4])[0]
        parts.append((data[at + 4 : at + 8], bytearray(data[at + 8 : at + 8 + length])))
        at += 12 + length
    name, body = rng.choice(parts)
    if body:
        body[rng.randrange(len(body))] = rng.randrange(256)
    parts.insert(rng.randrange(len(parts) + 1), rng.choice(parts))
    if rng.random() < 0.3:
        extra = [b"tRNS", b"PLTE", b"gAMA", b"iCCP", b"acTL", b"fcTL", b"tEXt", b"eXIf"]
        odd = (rng.choice(extra), bytes(rng.randrange(256) for _ in range(rng.choice([0, 3, 26]))))
        parts.insert(1, odd)
    return data[:8] + b"".join(chunk(name, bytes(body)) for name, body in parts)


def bmp():
    rows = b"".join(
        b"".join(bytes(colour(x, y)[::-1]) for x in range(W)) + b"\0" * (-3 * W % 4) for y in reversed(range(H))
    )
    head = struct.pack("<IiiHHIIiiII", 40, W, H, 1, 24, 0, len(rows), 2835, 2835, 0, 0)
    return b"BM" + struct.pack("<IHHI", 54 + len(rows), 0, 0, 54) + head + rows


def tiff():
    tags = [(256, 3, 1, W), (257, 3, 1, H), (258, 3, 3, 146), (259, 3, 1, 1), (262, 3, 1, 2), (273, 4, 1, 152),
            (277, 3, 1, 3), (278, 3, 1, H), (279, 4, 1, len(RGB)), (284, 3, 1, 1)]
    body = b"".join(struct.pack("<HHII", *tag) for tag in tags)
    head = b"II*\0" + struct.pack("<I", 8) + struct.pack("<H", len(tags)) + body + struct.pack("<I", 0)
    return head.ljust(146, b"\0") + struct.pack("<HHH", 8, 8, 8) + RGB


def pnm(kind):
    if kind == 6:
        return b"P6\n%d %d\n255\n" % (W, H) + RGB
    if kind == 5:
        return b"P5 %d %d 65535\n" % (W, H) + b"\x12\x34" * (W * H)
    if kind == 7:
        head = b"P7\nWIDTH %d\nHEIGHT %d\nDEPTH 3\nMAXVAL 255\nTUPLTYPE RGB\nENDHDR\n" % (W, H)
        return head + RGB
    return b"P3\n%d %d\n255\n" % (W, H) + b" ".join(b"%d" % b for b in RGB)


def whole():
    """One of each."""
    return {
        "png": png(), "bmp": bmp(), "tiff": tiff(), "ppm": pnm(6), "ppm_text": pnm(3), "pgm16": pnm(5), "pam": pnm(7),
        "jpeg": base64.b64decode(JPEG), "webp": base64.b64decode(WEBP),
    }


def stl(obj, binary):
    """An OBJ surface as STL."""
    points, faces = [], []
    for line in obj.decode().splitlines():
        words = line.split()
        if words[:1] == ["v"]:
            points.append([float(w) for w in words[1:4]])
        elif words[:1] == ["f"]:
            corners = [int(w.split("/")[0]) for w in words[1:]]
            faces += [(corners[0], a, b) for a, b in zip(corners[1:], corners[2:])]
    corners = [[points[k - 1 if k > 0 else k] for k in face] for face in faces]
    if binary:
        records = (struct.pack("<12fH", 0, 0, 0, *(v for p in face for v in p), 0) for face in corners)
        return b"made for the tests".ljust(80) + struct.pack("<I", len(corners)) + b"".join(records)
    lines = ["solid x"]
    for face in corners:
        lines += ["facet normal 0 0 0", "outer loop", *("vertex %r %r %r" % tuple(p) for p in face), "endloop", "endfacet"]
    return ("\n".join(lines) + "\nendsolid x\n").encode()


JPEG = """
/9j/4AAQSkZJRgABAgAAAQABAAD/wAARCAASABgDAREAAhEBAxEB/9sAQwAIBgYHBgUIBwcHCQkICgwUDQwLCwwZEhMPFB0aHx4dGhwcICQuJyAiLCMc
HCg3KSwwMTQ0NB8nOT04MjwuMzQy/9sAQwEJCQkMCwwYDQ0YMiEcITIyMjIyMjIyMjIyMjIyMjIyMjIyMjIyMjIyMjIyMjIyMjIyMjIyMjIyMjIyMjIy
MjIy/8QAHwAAAQUBAQEBAQEAAAAAAAAAAAECAwQFBgcICQoL/8QAtRAAAgEDAwIEAwUFBAQAAAF9AQIDAAQRBRIhMUEGE1FhByJxFDKBkaEII0KxwRVS
0fAkM2JyggkKFhcYGRolJicoKSo0NTY3ODk6Q0RFRkdISUpTVFVWV1hZWmNkZWZnaGlqc3R1dnd4eXqDhIWGh4iJipKTlJWWl5iZmqKjpKWmp6ipqrKz
tLW2t7i5usLDxMXGx8jJytLT1NXW19jZ2uHi4+Tl5ufo6erx8vP09fb3+Pn6/8QAHwEAAwEBAQEBAQEBAQAAAAAAAAECAwQFBgcICQoL/8QAtREAAgEC
BAQDBAcFBAQAAQJ3AAECAxEEBSExBhJBUQdhcRMiMoEIFEKRobHBCSMzUvAVYnLRChYkNOEl8RcYGRomJygpKjU2Nzg5OkNERUZHSElKU1RVVldYWVpj
ZGVmZ2hpanN0dXZ3eHl6goOEhYaHiImKkpOUlZaXmJmaoqOkpaanqKmqsrO0tba3uLm6wsPExcbHyMnK0tPU1dbX2Nna4uPk5ebn6Onq8vP09fb3+Pn6
/9oADAMBAAIRAxEAPwCXUvEWlaRcLBfXXlSsgcL5bNxkjPAPoa7LHkRpykrpFr7YslvBPAQ8UyB0YgjIIBB/WubEVpUrWPYyfLKWNdRVW1y22t1v5PsS
W8zS7twHGOlGHrSqXv0DOctpYHk9m2+a+9ulvJdzivGvh3VdX1mGextfNiW3VC3mKvO5jjkj1FdaZ51CpGMbNnX6TBJbaNYwTLtlit40dc5wQoBHFSzm
m7ybRcoJCgAoAKAP/9k=
"""
WEBP = """
UklGRqoAAABXRUJQVlA4TJ4AAAAvF0AEAM1VICICHgg4CgAAAIADAAAAAAAAAAAAPAAAABAAAACAAAAAAgEAAAAAAAAAAABgA9sD4IEMGgAAAACc/wAA
AAAAAIAHAAAAAAAAAAAAAAAAAAAAAIDwAAAAAAAAAA+EnAAAAADg/A8eAAAgAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAADAAAIIh8DRr/Z5A6dwKJyRts
v5tAKw==
"""
