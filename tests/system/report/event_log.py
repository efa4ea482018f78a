"""Event logs of the bench, read and rewritten by a second hand: MCAP records from its specification
(https://mcap.dev/spec), samples as CDR. Only what the report's test needs: unchunked or chunked
without compression.
"""
# SPDX-License-Identifier: Apache-2.0
import pathlib
import struct
import zlib

MAGIC = b"\x89MCAP0\r\n"
FOOTER, SCHEMA, CHANNEL, MESSAGE, CHUNK, METADATA, DATA_END = 2, 3, 4, 5, 6, 12, 15


def records(data):
    at = 0
    while at < len(data):
        opcode, length = struct.unpack_from("<BQ", data, at)
        yield opcode, data[at + 9:at + 9 + length]
        at += 9 + length


def record(opcode, content):
    return struct.pack("<BQ", opcode, len(content)) + content


def text_at(data, at):
    (length,) = struct.unpack_from("<I", data, at)
    return data[at + 4:at + 4 + length].decode(), at + 4 + length


def chunk_parts(content):
    compression, at = text_at(content, 28)
    assert compression == "", compression
    return content[:20], content[at + 8:]


def channel_of(content):
    (number,) = struct.unpack_from("<H", content)
    return number, text_at(content, 4)[0]


def truth_speeds(path):
    """(time in s, speed in m/s) of every sample of the truth."""
    data = pathlib.Path(path).read_bytes()[len(MAGIC):-len(MAGIC)]
    truth, speeds = None, []

    def take(opcode, content):
        nonlocal truth
        if opcode == CHANNEL and channel_of(content)[1] == "/truth":
            truth = channel_of(content)[0]
        if opcode == MESSAGE and struct.unpack_from("<H", content)[0] == truth:
            (logged_ns,) = struct.unpack_from("<Q", content, 6)
            vx, vy = struct.unpack_from("<dd", content, 22 + 4 + 3 * 8)
            speeds.append((logged_ns * 1e-9, (vx * vx + vy * vy) ** 0.5))

    for opcode, content in records(data):
        if opcode == CHUNK:
            for inner in records(chunk_parts(content)[1]):
                take(*inner)
        else:
            take(opcode, content)
    return speeds


def pair_text(value):
    return struct.pack("<I", len(value)) + value.encode()


def as_live(source, target):
    """The same log as a live run leaves it: mode live, and nothing of the car's own view."""
    data = pathlib.Path(source).read_bytes()[len(MAGIC):-len(MAGIC)]
    out, car = [], None

    def kept(opcode, content):
        nonlocal car
        if opcode == CHANNEL and channel_of(content)[1] == "/car":
            car = channel_of(content)[0]
        return not (opcode == MESSAGE and struct.unpack_from("<H", content)[0] == car)

    for opcode, content in records(data):
        if opcode == CHUNK:
            head, inside = chunk_parts(content)
            inside = b"".join(record(*inner) for inner in records(inside) if kept(*inner))
            content = (head[:16] + struct.pack("<QI", len(inside), zlib.crc32(inside)) +
                       pair_text("") + struct.pack("<Q", len(inside)) + inside)
        elif opcode == METADATA:
            content = content.replace(pair_text("lockstep"), pair_text("live"))
            name, at = text_at(content, 0)
            pairs = content[at + 4:]
            content = pair_text(name) + struct.pack("<I", len(pairs)) + pairs
        elif opcode not in (1, SCHEMA, CHANNEL, MESSAGE) or not kept(opcode, content):
            if opcode == DATA_END:
                break
            continue
        else:
            kept(opcode, content)
        out.append(record(opcode, content))
    out.append(record(DATA_END, struct.pack("<I", 0)))
    out.append(record(FOOTER, struct.pack("<QQI", 0, 0, 0)))
    with open(target, "wb") as file:
        file.write(MAGIC + b"".join(out) + MAGIC)
