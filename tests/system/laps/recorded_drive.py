"""A drive around a track whose way over time is known in closed form, as a recording of a base:
MCAP written by a second hand, from https://mcap.dev/spec. And the samples of any such recording.
"""
# SPDX-License-Identifier: Apache-2.0
import pathlib
import struct

import numpy as np

MAGIC = b"\x89MCAP0\r\n"
HEADER, FOOTER, SCHEMA, CHANNEL, MESSAGE, CHUNK, METADATA, DATA_END = 1, 2, 3, 4, 5, 6, 12, 15
UTC_MINUS_BASE_NS = 1_700_000_000 * 10**9
BEGIN_S = 5_000.0  # on the clock of the base

# Channel: its fields, and when they are sampled.
TICK_S = 0.06
CHANNELS = {"track": (("station", "lap"), 0.0), "ego": (("vx",), 0.02)}

MEAN_MPS, SWING_MPS, TURN_PER_S = 50.0, 10.0, 2 * np.pi / 23
STATION_STEP_M = 0.1  # of the registry


def way_m(t_s, begin_m):
    """Since the line that the first lap begins at."""
    return begin_m + MEAN_MPS * t_s + SWING_MPS / TURN_PER_S * (1 - np.cos(TURN_PER_S * t_s))


def speed_mps(t_s):
    return MEAN_MPS + SWING_MPS * np.sin(TURN_PER_S * t_s)


def time_of(way, begin_m):
    low, high = np.zeros_like(way), np.full_like(way, 10_000.0)
    for _ in range(80):
        middle = (low + high) / 2
        below = way_m(middle, begin_m) < way
        low, high = np.where(below, middle, low), np.where(below, high, middle)
    return low


def record(opcode, content):
    return struct.pack("<BQ", opcode, len(content)) + content


def text(value):
    return struct.pack("<I", len(value)) + value.encode()


def pairs(values):
    content = b"".join(text(key) + text(value) for key, value in values.items())
    return struct.pack("<I", len(content)) + content


def write_segment(path, times_s, length_m, begin_m):
    out = [record(HEADER, text("") + text("second hand")),
           record(METADATA, text("run") + pairs({"utc_minus_base_ns": str(UTC_MINUS_BASE_NS),
                                                     "boot": "of the drive"}))]
    for number, (group, (fields, _)) in enumerate(CHANNELS.items(), 1):
        schema = "".join(f"float64 {field}\n" for field in fields)
        names = ",".join(f"{group}.{field}" for field in fields)
        out.append(record(SCHEMA, struct.pack("<H", number) + text(f"pitwall_msgs/msg/{group}") +
                          text("ros2msg") + text(schema)))
        out.append(record(CHANNEL, struct.pack("<HH", number, number) + text(f"/car/{group}") +
                          text("cdr") + pairs({"fields": names})))
    for at_s in times_s:
        for number, (group, (_, after_s)) in enumerate(CHANNELS.items(), 1):
            sampled_s = at_s + after_s
            way = way_m(sampled_s, begin_m)
            station = np.round((way % length_m) / STATION_STEP_M) * STATION_STEP_M
            values = {"track": (station % length_m, way // length_m),
                      "ego": (speed_mps(sampled_s),)}[group]
            published_ns = UTC_MINUS_BASE_NS + round((BEGIN_S + sampled_s) * 1e9)
            logged_ns = UTC_MINUS_BASE_NS + round((BEGIN_S + at_s + TICK_S / 2) * 1e9)
            out.append(record(MESSAGE, struct.pack("<HIQQ", number, 0, logged_ns, published_ns) +
                              b"\0\1\0\0" + struct.pack(f"<{len(values)}d", *values)))
    out += [record(DATA_END, struct.pack("<I", 0)), record(FOOTER, struct.pack("<QQI", 0, 0, 0))]
    path.write_bytes(MAGIC + b"".join(out) + MAGIC)


def records(data):
    at = 0
    while at + 9 <= len(data):
        opcode, length = struct.unpack_from("<BQ", data, at)
        yield opcode, data[at + 9:at + 9 + length]
        at += 9 + length


def text_at(data, at):
    (length,) = struct.unpack_from("<I", data, at)
    return data[at + 4:at + 4 + length].decode(), at + 4 + length


class Recording:
    """Samples of the channels of a folder: times on the clock of the base, in s."""

    def __init__(self, folder):
        self.samples, self.shift_ns = {}, None
        for path in sorted(pathlib.Path(folder).glob("*.mcap")):
            self.schemas, self.channels = {}, {}
            for opcode, content in records(path.read_bytes()[len(MAGIC):-len(MAGIC)]):
                if opcode == CHUNK:
                    compression, at = text_at(content, 28)
                    assert compression == "", compression
                    for inner in records(content[at + 8:]):
                        self.take(*inner)
                else:
                    self.take(opcode, content)

    def take(self, opcode, content):
        if opcode == SCHEMA:
            (number,) = struct.unpack_from("<H", content)
            at = text_at(content, text_at(content, 2)[1])[1]
            lines = text_at(content, at)[0].splitlines()
            self.schemas[number] = [line.split()[1] for line in lines if
                                    line.startswith("float64 ")]
        elif opcode == CHANNEL:
            number, schema = struct.unpack_from("<HH", content)
            self.channels[number] = text_at(content, 4)[0], schema
        elif opcode == METADATA and self.shift_ns is None:
            at = text_at(content, 0)[1] + 4
            while at < len(content):
                key, at = text_at(content, at)
                value, at = text_at(content, at)
                if key == "utc_minus_base_ns":
                    self.shift_ns = int(value)
        elif opcode == MESSAGE:
            number, _, _, published_ns = struct.unpack_from("<HIQQ", content)
            topic, schema = self.channels[number]
            if topic.startswith("/car/"):
                fields = self.schemas[schema]
                values = np.frombuffer(content, "<f8", len(fields), 26)
                self.samples.setdefault(topic[5:], []).append((published_ns, values, fields))

    def column(self, path):
        """Times and values of a field, each newer than the one before."""
        group, field = path.split(".")
        rows = self.samples.get(group, [])
        t = np.array([(published_ns - self.shift_ns) * 1e-9 for published_ns, _, _ in rows])
        value = np.array([values[fields.index(field)] for _, values, fields in rows])
        newest = np.concatenate([[-np.inf], np.maximum.accumulate(t)[:-1]])
        keep = (t > newest) & np.isfinite(value)
        return t[keep], value[keep]
