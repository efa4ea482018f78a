# SPDX-License-Identifier: Apache-2.0
"""Reads receivers' messages with Python's struct, zlib and binascii: a second implementation.

receiver_oracle.py < messages

Each line is "<kind> <hex of the bytes> [<hex of the same log in ASCII>]" with the kind N (NovAtel)
or V (VectorNav). For each, in order, one line comes back: "ok <number of values compared or read>"
or what is wrong.
  N  checksums of both forms by zlib, header and every field by the layouts of NovAtel's driver
     (novatel_oem7_driver, oem7_messages.h) and the manual; the two forms must say the same, floats
     to the bit, names only where they are numbers
  V  checksum by binascii, length and every field by the layouts of VectorNav's SDK; all are printed
"""
import binascii
import math
import struct
import sys
import zlib

QUALITY = "4sff8B"
BASELINE = "IIffffff"
SAMPLE = "I6i"
CONFIG = "IBBHIIIIIIBBH6I"
OFFSET = "II6fI"
# Number of the log: name, layout of the body, places of hexadecimal fields.
LOGS = {
    42: ("BESTPOS", "IIdddfIfff" + QUALITY, {17, 18, 19, 20}),
    93: ("RXSTATUS", "22I", set(range(22)) - {1}),
    99: ("BESTVEL", "IIffdddf", set()),
    101: ("TIME", "IdddI4BII", set()),
    268: ("RAWIMU", "Id" + SAMPLE, {2}),
    325: ("RAWIMUS", "Id" + SAMPLE, {2}),
    507: ("INSPVA", "Id9dI", set()),
    508: ("INSPVAS", "Id9dI", set()),
    726: ("BESTUTM", "IIIIdddfIfff" + QUALITY, {19, 20, 21, 22}),
    812: ("CORRIMUDATA", "Id6d", set()),
    813: ("CORRIMUDATAS", "Id6d", set()),
    1335: ("HEADING2", BASELINE + "4s4s8B", {14, 15, 16, 17}),
    1362: ("IMURATECORRIMUS", "Id6d", set()),
    1457: ("INSATTX", "IIddd3fIH", {8}),
    1461: ("RAWIMUX", "BBHd" + SAMPLE, {0, 4}),
    1462: ("RAWIMUSX", "BBHd" + SAMPLE, {0, 4}),
    1465: ("INSPVAX", "IIdddfdddddd9fIH", {21}),
    1945: ("INSCONFIG", CONFIG, {5, 9}),
    2042: ("DUALANTENNAHEADING", BASELINE + "4s8B", {13, 14, 15, 16}),
    2051: ("INSSTDEV", "9fIHHII", {9, 12}),
    2052: ("INSSTDEVS", "9fIHHII", {9, 12}),
    2264: ("CORRIMUS", "I6dfI", set()),
}


def checksum(data):
    """NovAtel's: the polynomial of zlib without its two inversions."""
    return zlib.crc32(data, 0xFFFFFFFF) ^ 0xFFFFFFFF


def spread(layout):
    """One letter a value: "4s" is one, "3f" is three."""
    letters, count = [], ""
    for c in layout:
        if c.isdigit():
            count += c
            continue
        letters += [count + c] if c == "s" else [c] * int(count or 1)
        count = ""
    return letters


def fields_of(text):
    fields, quoted, field = [], False, ""
    for c in text:
        quoted ^= c == '"'
        if c == "," and not quoted:
            fields.append(field)
            field = ""
        else:
            field += c
    return fields + [field]


def same(letter, is_hex, value, field):
    if letter.endswith("s"):
        return '"' + value.split(b"\0")[0].decode("ascii") + '"' == field
    if letter == "d":
        return struct.pack("<d", float(field)) == struct.pack("<d", value)
    if letter == "f":
        return struct.pack("<f", float(field)) == struct.pack("<f", value)
    if is_hex:
        return int(field, 16) == value
    try:
        return int(field) == value
    except ValueError:
        return field.replace("_", "A").isupper() or len(field) == 1  # a name or a letter


def novatel(binary, ascii_form):
    short = binary[2] == 0x13
    if short:
        length, number, week, ms = struct.unpack_from("<BHHI", binary, 3)
        at = 12
    else:
        at, number = binary[3], struct.unpack_from("<H", binary, 4)[0]
        length, = struct.unpack_from("<H", binary, 8)
        week, ms = struct.unpack_from("<HI", binary, 14)
    name, layout, hexes = LOGS[number]
    if len(binary) != at + length + 4:
        return "length"
    if checksum(binary[:-4]) != struct.unpack("<I", binary[-4:])[0]:
        return "checksum of the binary form"
    if number == 1945:  # two lists, each with its length in front
        for _ in range(2):
            count, = struct.unpack_from("<I", binary, at + struct.calcsize("<" + layout))
            layout += "I" + OFFSET * count
    letters = spread(layout)
    if number == 93:  # says itself how many words follow
        letters = letters[: (length // 4)]
    values = struct.unpack("<" + "".join(letters), binary[at:-4])
    if not ascii_form.endswith(b"\r\n"):
        return "line end"
    covered, digits = ascii_form[1:-2].rsplit(b"*", 1)
    if checksum(covered) != int(digits, 16) or len(digits) != 8:
        return "checksum of the ASCII form"
    header, body = covered.decode("ascii").split(";", 1)
    words = header.split(",")
    if words[0] != name + "A" or (ascii_form[:1] == b"%") != short:
        return "name"
    if int(words[1 if short else 5]) != week:
        return "week"
    if round(float(words[2 if short else 6]) * 1e3) != ms:
        return "time"
    fields = fields_of(body)
    if len(fields) != len(values):
        return f"{len(fields)} fields, not {len(values)}"
    for i, (letter, value, field) in enumerate(zip(letters, values, fields)):
        if not same(letter, i in hexes, value, field):
            return f"{name} field {i}: {value!r} is not {field!r}"
    return f"ok {len(values)}"


UTC = "bBBBBBH"
GNSS = {0: UTC, 1: "Q", 2: "H", 3: "B", 4: "B", 5: "ddd", 6: "ddd", 7: "fff", 8: "fff", 9: "fff",
        10: "f", 11: "f", 12: "Bb", 13: "7f", 17: "H", 18: "d"}
GROUPS = [
    {0: "Q", 1: "Q", 2: "Q", 3: "fff", 4: "4f", 5: "fff", 6: "ddd", 7: "fff", 8: "fff", 9: "6f",
     10: "5f", 11: "7f", 12: "H", 13: "I", 14: "Q"},
    {0: "Q", 1: "Q", 2: "Q", 3: "H", 4: "Q", 5: "Q", 6: UTC, 7: "I", 8: "I", 9: "B"},
    {0: "H", 1: "fff", 2: "fff", 3: "fff", 4: "f", 5: "f", 6: "4f", 7: "fff", 8: "fff", 9: "fff",
     10: "fff", 11: "H"},
    GNSS,
    {0: "H", 1: "fff", 2: "4f", 3: "9f", 4: "fff", 5: "fff", 6: "fff", 7: "fff", 8: "fff",
     13: "f"},
    {0: "H", 1: "ddd", 2: "ddd", 3: "fff", 4: "fff", 5: "fff", 6: "fff", 7: "fff", 8: "fff",
     9: "f", 10: "f"},
    GNSS,
]


def vectornav(data):
    if data[0] != 0xFA or binascii.crc_hqx(data[1:], 0) != 0:
        return "checksum"
    at, layout = 2, "<"
    for group in range(7):
        if not data[1] >> group & 1:
            continue
        mask, shift = 0, 0
        while True:
            word, = struct.unpack_from("<H", data, at)
            mask |= (word & 0x7FFF) << shift
            at, shift = at + 2, shift + 16
            if not word & 0x8000:
                break
        layout += "".join(GROUPS[group][bit] for bit in range(32) if mask >> bit & 1)
    if struct.calcsize(layout) != len(data) - at - 2:
        return "length"
    values = struct.unpack(layout, data[at:-2])
    if not all(math.isfinite(v) for v in values):
        return "not finite"
    # As numbers that both sides print alike: floats by their bits.
    printed = []
    for letter, value in zip(spread(layout[1:]), values):
        if letter in "fd":
            value = int.from_bytes(struct.pack("<" + letter, value), "little")
        printed.append(str(value))
    return "ok " + " ".join(printed)


for line in sys.stdin:
    kind, *forms = line.split()
    data = [bytes.fromhex(f) for f in forms]
    print(novatel(*data) if kind == "N" else vectornav(*data))
