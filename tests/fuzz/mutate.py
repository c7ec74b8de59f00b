"""Damage to texts and bytes. Every function takes a random.Random, so that a case can be repeated."""

import re

# Numbers as they stand in scenario files, grids, meshes and URDF; not those within names such as `auv0`.
NUMBER = re.compile(r"(?<![\w.])[-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?(?![\w.])")
NAME = re.compile(r"(?<![\w\"])[A-Za-z_]\w*")
VARIANT = re.compile(r"(?<![\w\"])[A-Z]\w*(?=\s*\()")
FIELD = re.compile(r"(?<![\w\"])([a-z_]\w*)\s*:")

EXTREMES = [
    "0", "-0.0", "1", "-1", "2", "0.5", "3", "7", "100", "255", "256", "65535", "65536", "1000000", "2147483647",
    "2147483648", "4294967295", "4294967296", "9007199254740993", "9223372036854775807", "9223372036854775808",
    "18446744073709551615", "18446744073709551616", "-2147483649", "340282366920938463463374607431768211456",
    "5e-324", "1e-310", "2.2250738585072014e-308", "1e-154", "1e-38", "1e-30", "1e-12", "1e-9", "1e-6", "1e-4", "1e-3",
    "1e3", "1e4", "1e5", "1e6", "1e7", "1e8", "1e9", "1e10", "1e12", "1e15", "1e18", "1e19", "1e30", "1e38", "1e39",
    "3.5e38", "1e77", "1e100", "1e154", "1e155", "1e200", "1e300", "1e306", "1.7976931348623157e308", "1e308", "1e309",
    "-1e-9", "-1e3", "-1e9", "-1e300", "-1e309", "NaN", "inf", "-inf", "90", "180", "360", "-360", "1e-400",
    "0.1", "0.01", "1.0000000001", "0.9999999999", "000", "1_000", "0x10", "1e", ".", "--1", "+5",
]


def number(rng, old):
    """Another number in the place of `old`."""
    way = rng.random()
    if way < 0.45:
        return rng.choice(EXTREMES)
    try:
        value = float(old)
    except ValueError:
        return rng.choice(EXTREMES)
    if way < 0.75:
        value *= 10.0 ** rng.choice([-9, -6, -4, -3, -2, -1, 1, 2, 3, 4, 5, 6, 9, 12])
    elif way < 0.85:
        value *= rng.choice([-1.0, 1.0 + 1e-9, 0.0, 2.0, 0.5, 3.0])
    elif way < 0.95:
        value = rng.choice([-1.0, 1.0, 1.0]) * 10.0 ** rng.uniform(-20.0, 20.0)
    else:
        value = rng.choice([-1.0, 1.0]) * 10.0 ** rng.uniform(-323.0, 308.0)
    if "." not in old and "e" not in old.lower() and rng.random() < 0.5 and abs(value) < 1e18:
        return str(int(value))
    return repr(value)


def replaced(text, span, new):
    return text[: span[0]] + new + text[span[1] :]


def numbers(rng, text, most=3):
    """One to `most` numbers changed."""
    for _ in range(rng.choice([1, 1, 1, 2, most])):
        found = [m.span() for m in NUMBER.finditer(text)]
        if not found:
            return text
        span = rng.choice(found)
        text = replaced(text, span, number(rng, text[slice(*span)]))
    return text


def entries(text):
    """Spans of `name: value` and of list entries, by brackets; strings and comments are stepped over."""
    spans, open_at, start, k = [], [], 0, 0
    while k < len(text):
        c = text[k]
        if c == '"':
            end = text.find('"', k + 1)
            k = len(text) if end < 0 else end
        elif text.startswith("//", k):
            end = text.find("\n", k)
            k = len(text) if end < 0 else end
        elif c in "([{":
            open_at.append(start)
            start = k + 1
        elif c in ")]},":
            if text[start:k].strip():
                spans.append((start, k))
            if c != ",":
                start = open_at.pop() if open_at else 0
            else:
                start = k + 1
        k += 1
    return spans


def nested(rng):
    n = rng.choice([10, 100, 129, 1000, 20000])
    open_, close = rng.choice([("(", ")"), ("[", "]"), ("Some(", ")"), ("(a: ", ")"), ("/*", "*/"), ("{", "}")])
    return open_ * n + rng.choice(["", "1"]) + close * rng.choice([n, n, 0])


def structure(rng, text, others):
    """Fields dropped, doubled, moved in from other files, renamed; variants exchanged."""
    for _ in range(rng.choice([1, 1, 2, 3])):
        spans = entries(text)
        if not spans:
            return text
        span = rng.choice(spans)
        part = text[slice(*span)]
        other = rng.choice(others)
        way = rng.randrange(8)
        if way == 0:
            text = text[: span[0]] + text[span[1] :].lstrip(",")
        elif way == 1:
            text = replaced(text, span, part + "," + part)
        elif way == 2:
            name = FIELD.match(part.strip())
            same = [s for s in entries(other) if name and other[slice(*s)].strip().startswith(name.group(1) + ":")]
            source = same or entries(other)
            text = replaced(text, span, other[slice(*rng.choice(source))] if source else "")
        elif way == 3:
            found = [m.span() for m in VARIANT.finditer(text)]
            names = VARIANT.findall(other)
            if found and names:
                text = replaced(text, rng.choice(found), rng.choice(names))
        elif way == 4:
            found = [m.span() for m in NAME.finditer(text)]
            span = rng.choice(found)
            old = text[slice(*span)]
            k = rng.randrange(len(old))
            text = replaced(text, span, rng.choice([old[:k] + old[k + 1 :], old + "x", old.upper(), ""]))
        elif way == 5:
            to = rng.choice(spans)
            text = replaced(text, to, part)
        elif way == 6:
            value = rng.choice(["()", "[]", "None", "Some(1)", '""', "true", "(1, 2)", "'a'", '"x"', nested(rng), "{}"])
            text = replaced(text, span, re.sub(r":.*", ": " + value.replace("\\", ""), part, count=1, flags=re.S))
        else:
            times = rng.choice([2, 10, 300])
            text = replaced(text, span, ",".join([part] * times))
    return text


ODD = ["\0", "\u2212", "\ufeff", "\u00e9", "\u202e", "\x1b[31m", "\r", "\t", "\"", "'", "\\", "(", ")", "[", "]", ",", ":",
       "/*", "*/", "//", "#", "r#\"", "\U0001f41f", "\x7f", "{", "}", "<", ">", "&", "%s", "$(id)"]


def damage(rng, data):
    """A text as bytes, damaged."""
    way = rng.randrange(9)
    at = rng.randrange(len(data) + 1)
    if way == 0:
        return data[:at]
    if way == 1:
        return data[:at] + rng.choice(ODD).encode() + data[at:]
    if way == 2:
        return data[:at] + bytes(rng.randrange(256) for _ in range(rng.choice([1, 3, 40]))) + data[at:]
    if way == 3:
        end = rng.choice([b"\r\n", b"\r", b"\n\r", b"", b"\n" * 200])
        return data.replace(b"\n", end)
    if way == 4:
        return data[:at] + nested(rng).encode() + data[at:]
    if way == 5:
        return data[:at] + rng.choice([b"9" * 400, b"1e" + b"9" * 30, b" " * 100000, b"a" * 70000]) + data[at:]
    if way == 6:
        return rng.choice([b"", b"\n", b"\xff\xfe" + data.decode("utf-8", "replace").encode("utf-16-le"),
                           b"\xef\xbb\xbf" + data, data * 2, data.replace(b" ", b"\xc2\xa0")])
    if way == 7:
        other = rng.randrange(len(data) + 1)
        low, high = min(at, other), max(at, other)
        return data[:low] + data[high:]
    return flipped(rng, data)


def flipped(rng, data):
    """Bytes changed, cut out, doubled, cut off."""
    data = bytearray(data)
    for _ in range(rng.choice([1, 1, 2, 8, 64])):
        if not data:
            break
        at = rng.randrange(len(data))
        way = rng.randrange(8)
        if way < 3:
            data[at] = rng.randrange(256)
        elif way == 3:
            data[at] ^= 1 << rng.randrange(8)
        elif way == 4:
            data[at] = rng.choice([0, 1, 127, 128, 255])
        elif way == 5:
            del data[at : at + rng.choice([1, 4, 100])]
        elif way == 6:
            data[at:at] = data[at : at + rng.choice([1, 4, 100])]
        elif rng.random() < 0.3:
            del data[at:]
        else:
            data[at : at + 4] = rng.choice([b"\xff\xff\xff\xff", b"\0\0\0\0", b"\x7f\xff\xff\xff", b"\0\0\0\x80"])
    return bytes(data)
