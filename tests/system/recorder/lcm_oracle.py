"""LCM event logs of a recorder, played by lcm-logplayer and decoded by what lcm-gen makes."""
# SPDX-License-Identifier: Apache-2.0
import importlib
import math
import shutil
import struct
import subprocess
import sys

SYNC = 0xEDA1DA01
TYPES = {"base": "text_t", "radio": "datagram_t", "gnss": "bytes_t", "can": "can_frame_t"}


def events_of(path):
    """(time in us, channel, data) of each event, as lcm/eventlog.c has them."""
    data, at = path.read_bytes(), 0
    while at + 28 <= len(data):
        sync, _, utime, channel, size = struct.unpack_from(">IqqII", data, at)
        if sync != SYNC:
            sys.exit(f"FAILED: {path} has no event at byte {at}")
        at += 28
        if at + channel + size > len(data):
            return  # cut
        yield utime, data[at:at + channel].decode(), data[at + channel:at + channel + size]
        at += channel + size


def types_of(base, folder):
    """The Python package that lcm-gen makes of `pitwall-base export lcm`."""
    text = folder / "pitwall.lcm"
    text.write_text(subprocess.run([base, "export", "lcm"], check=True, capture_output=True,
                                   text=True).stdout)
    subprocess.run(["lcm-gen", "--python", "--ppath", str(folder / "types"), str(text)],
                   check=True, capture_output=True)
    sys.path.insert(0, str(folder / "types"))
    return importlib.import_module("pitwall")


def play(log, folder):
    played = folder / f"{log.stem}.played"
    subprocess.run(["lcm-logplayer", f"--lcm-url=file://{played}?mode=w", "-s", "1000", str(log)],
                   check=True, capture_output=True, timeout=60)
    return played


def check(base, logs, folder):
    """How many events of how many channels were played and decoded; none: not installed."""
    if not shutil.which("lcm-logplayer") or not shutil.which("lcm-gen"):
        print("not checked by LCM: lcm-logplayer and lcm-gen are not installed (./pitwall setup)")
        return None
    types, channels, count = types_of(base, folder), set(), 0
    for log in logs:
        events = list(events_of(log))
        if not events:
            continue  # killed before anything was written; the player takes no empty log
        played = [(channel, data) for _, channel, data in events_of(play(log, folder))]
        if played != [(channel, data) for _, channel, data in events]:
            sys.exit(f"FAILED: lcm-logplayer plays {len(played)} of {len(events)} events of {log}")
        for utime, channel, data in events:
            _, kind, rest = channel.split("/")
            name = rest + "_t" if kind == "car" else TYPES[kind]
            message = getattr(types, name).decode(data)
            if not -1e6 < message.utime - utime < 1e6:
                sys.exit(f"FAILED: {channel} of {utime} was sampled at {message.utime}")
            if name == "datagram_t" and not (message.path == 0 and message.port > 0
                                             and len(message.data) == message.size > 0):
                sys.exit(f"FAILED: no datagram of one radio: {message.path}, {message.port}")
            if name == "ego_t" and not (math.isnan(message.vx) or abs(message.vx) < 150):
                sys.exit(f"FAILED: a speed of {message.vx}")
            channels.add(channel)
            count += 1
    return count, channels
