#!/usr/bin/env python3
"""Foxglove, LCM and Prometheus attach to a real base: tools.py BASE CAR TREE"""
# SPDX-License-Identifier: Apache-2.0
import json
import os
import re
import signal
import socket
import struct
import subprocess
import sys
import tempfile
import time
from contextlib import suppress
from pathlib import Path

from attached import (BASE, LCM_GROUP, LCM_PORT, TREE, Base, expect, foxglove, keys_in, start_car,
                      start_lcm_logger, until, value)

sys.path.insert(0, str(TREE / "tests/system/recorder"))
import lcm_oracle  # noqa: E402


def prometheus_reads_it(base):
    metrics = until("the car in the metrics", lambda: (
        lambda text: text if value(text, "pitwall_field_meters_per_second", field="vx") else None)(
            base.metrics()))
    checked = subprocess.run(["promtool", "check", "metrics"], input=metrics, capture_output=True,
                             text=True)
    expect(checked.returncode == 0 and not checked.stderr + checked.stdout,
           f"promtool: {checked.stdout}{checked.stderr}")
    vx = value(metrics, "pitwall_field_meters_per_second", car="7", group="ego", field="vx")
    expect(abs(vx - 50.5) < 0.1, f"vx {vx}")
    pressure = value(metrics, "pitwall_field_pascals", group="tyres", field="pressure_rear_left")
    expect(abs(pressure - 152_500) < 1000, f"pressure {pressure}")
    expect(value(metrics, "pitwall_car_info", car="7", name="Seven", mode="HIL") == 1, "info")
    expect(value(metrics, "pitwall_group_age_seconds", group="ego") < 2, "age")
    expect(value(metrics, "pitwall_field_meters", group="ego", field="y") is None,
           "what the car does not know has no sample")
    return len(metrics.splitlines())


def what_foxglove_did_is_counted(base):
    metrics = until("the refusals", lambda: (
        lambda text: text if value(text, "pitwall_publisher_refused_total", publisher="foxglove",
                                   what="clientPublish") else None)(base.metrics()))
    for what, least in (("clientPublish", 2), ("setParameters", 1), ("services", 1),
                        ("subscribe", 1), ("playbackControl", 1), ("malformed", 200), ("http", 2)):
        count = value(metrics, "pitwall_publisher_refused_total", publisher="foxglove", what=what)
        expect(count and count >= least, f"{count} {what} refused")
    expect(value(metrics, "pitwall_commands_total") == 0, "nothing became a command")


def sockets_of(process):
    """Local ports of the UDP sockets of a process."""
    descriptors = []
    for descriptor in Path(f"/proc/{process.pid}/fd").iterdir():
        with suppress(FileNotFoundError):  # closed since it was listed
            descriptors.append(str(descriptor.readlink()))
    inodes = {m.group(1) for d in descriptors if (m := re.match(r"socket:\[(\d+)\]", d))}
    rows = [line.split() for line in Path("/proc/net/udp").read_text().splitlines()[1:]]
    return {int(row[1].split(":")[1], 16) for row in rows if row[9] in inodes}


def an_lcm_flood_is_not_even_heard(base):
    expect(LCM_PORT not in sockets_of(base.process), "nothing of the base listens to LCM")
    before = base.metrics()
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as flood:
        for number in range(20_000):
            if number % 2:
                packet = os.urandom(number % 900)
            else:
                packet = struct.pack(">4sI", b"LC02", number) + b"/car/command\0" + bytes(64)
            flood.sendto(packet, (LCM_GROUP, LCM_PORT))
    packets = value(before, "pitwall_packets_total")
    after = until("packets of the car after the flood", lambda: (
        lambda text: text if value(text, "pitwall_packets_total") > packets + 50 else None)(
            base.metrics()))
    for name in ("pitwall_commands_total", "pitwall_requests_refused_total",
                 "pitwall_packets_lost_total", "pitwall_records_malformed_total",
                 "pitwall_sessions_total"):
        expect(value(before, name) == value(after, name), f"{name} is as before the flood")
    for line in after.splitlines():
        if line.startswith("pitwall_datagrams_refused_total"):
            expect(line.endswith(" 0"), f"no datagram of the flood came in: {line}")


def lcm_decodes_it(log, folder):
    types, seen, count = lcm_oracle.types_of(BASE, folder), set(), 0
    for _, channel, data in lcm_oracle.events_of(log):
        group = channel.split("/")[2] if channel.count("/") == 2 else ""
        if channel.startswith("/car/") and not hasattr(types, group + "_t"):
            continue  # of the flood
        name = group + "_t" if channel.startswith("/car/") else "text_t"
        try:
            message = getattr(types, name).decode(data)
        except (ValueError, struct.error):
            expect(channel == "/car/command", f"{channel} is decoded")
            continue  # of the flood
        expect(abs(message.utime / 1e6 - time.time()) < 120, f"{channel} has the time of now")
        if name == "ego_t":
            expect(abs(message.vx - 50.5) < 0.1, f"a speed of {message.vx}")
        if name == "text_t":
            expect(json.loads(message.json)["type"] == group, f"{channel} is its text")
        seen.add(channel)
        count += 1
    expect({"/car/ego", "/car/tyres", "/base/link", "/base/hello"} <= seen, f"channels {seen}")
    return count


def mistakes_are_named(folder):
    keys = ["--keys", str(folder / "keys/base.keys"), "--listen", "127.0.0.1:0", "--duration", "5"]
    for flags, what in ((["--lcm", "file:///tmp/x"], "udpm://"),
                        (["--lcm", f"udpm://{LCM_GROUP}:{LCM_PORT}?ttl=1"], "--network"),
                        (["--lcm", "udpm://127.0.0.1:7667"], "multicast"),
                        (["--foxglove", "99999"], "--foxglove")):
        done = subprocess.run([BASE, *keys, *flags], capture_output=True, text=True, timeout=20)
        expect(done.returncode != 0 and what in done.stderr, f"{flags}: {done.stderr}")


def main():
    folder = Path(tempfile.mkdtemp(prefix="pitwall_tools_"))
    base_keys, car_keys = keys_in(folder / "keys")
    mistakes_are_named(folder)
    log = folder / "lcm.log"
    logger = start_lcm_logger(log)
    base = Base("--keys", base_keys, "--listen", "127.0.0.1:0", "--web", "0",
                "--foxglove", "0", "--lcm", "--track", "lvms", "--car", "7", "--car-name", "Seven",
                "--record", str(folder / "rec"))
    car = start_car(car_keys, base.at["radio"])
    lines = prometheus_reads_it(base)
    told = foxglove("live", base.at["foxglove"])
    what_foxglove_did_is_counted(base)
    an_lcm_flood_is_not_even_heard(base)
    until("the flood in the logger", lambda: log.exists() and log.stat().st_size > 100_000)
    base.end()
    car.kill()
    car.wait()
    logger.send_signal(signal.SIGTERM)
    logger.wait(timeout=20)
    events = lcm_decodes_it(log, folder)
    again = Base("--replay", str(folder / "rec"), "--web", "0", "--foxglove", "0")
    wound = foxglove("replay", again.at["foxglove"])
    again.end()
    subprocess.run(["rm", "-r", str(folder)], check=True)
    print(f"{lines} lines of metrics; Foxglove: {told}, {wound}; LCM: {events} messages")


main()
