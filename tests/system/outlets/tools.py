#!/usr/bin/env python3
"""Foxglove, LCM and Prometheus attach to a real base: tools.py BASE CAR TREE"""
# SPDX-License-Identifier: Apache-2.0
import atexit
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
import urllib.request
from pathlib import Path

BASE, CAR, TREE = sys.argv[1], sys.argv[2], Path(sys.argv[3])
sys.path.insert(0, str(TREE / "tests/system/recorder"))
import lcm_oracle  # noqa: E402

ORACLES = TREE / "tests/support/oracles"
GROUP, PORT = "239.255.76.67", 7667
RUN_S = 40  # the car's, longer than what attaches


STARTED = []


@atexit.register
def end_all():
    for process in STARTED:
        process.kill()


def start(words, **pipes):
    STARTED.append(subprocess.Popen(words, **{"stdout": subprocess.DEVNULL, **pipes}))
    return STARTED[-1]


def expect(condition, what):
    if not condition:
        sys.exit(f"FAILED: {what}")


class Base:
    """A pitwall-base, with the addresses that it says."""

    def __init__(self, *flags):
        self.process = start([BASE, *flags], stderr=subprocess.PIPE, text=True)
        self.said, self.at = "", {}
        names = {"radio": r"listening at ([\d.:]+)", "web": r"console at (http://[\d.:]+)",
                 "foxglove": r"Foxglove at (ws://[\d.:]+)"}
        while "foxglove" not in self.at or "web" not in self.at:
            line = self.process.stderr.readline()
            expect(line, f"the addresses are said: {self.said}")
            self.said += line
            for name, pattern in names.items():
                if found := re.search(pattern, self.said):
                    self.at[name] = found.group(1)

    def metrics(self):
        with urllib.request.urlopen(self.at["web"] + "/metrics", timeout=10) as answer:
            expect(answer.headers["Content-Type"].startswith("text/plain; version=0.0.4"), "type")
            return answer.read().decode()

    def end(self):
        self.process.send_signal(signal.SIGTERM)
        _, errors = self.process.communicate(timeout=30)
        expect(self.process.returncode == 0, f"exit code {self.process.returncode}: {errors}")


def value(metrics, metric, /, **labels):
    """Of the only sample with these labels; None: there is none."""
    for line in metrics.splitlines():
        found = re.fullmatch(rf"{metric}(?:{{(.*)}})? (\S+)", line)
        if not found:
            continue
        told = dict(re.findall(r'(\w+)="((?:[^"\\]|\\.)*)"', found.group(1) or ""))
        if labels.items() <= told.items():
            return float(found.group(2))
    return None


def foxglove(mode, base):
    node = ORACLES / "node_modules/.bin/node"
    expect(node.exists(), "the npm packages of the tests are installed (./pitwall setup)")
    done = subprocess.run([node, ORACLES / "foxglove_client.mjs", mode, base.at["foxglove"]],
                          capture_output=True, text=True, timeout=90)
    expect(done.returncode == 0, f"Foxglove's client, {mode}: {done.stdout}{done.stderr}")
    return done.stdout.strip()


def until(what, find, patience_s=15):
    end = time.monotonic() + patience_s
    while time.monotonic() < end:
        if found := find():
            return found
        time.sleep(0.1)
    return expect(False, f"waited in vain for {what}")


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
        lambda text: text if value(text, "pitwall_outlet_refused_total", outlet="foxglove",
                                   what="clientPublish") else None)(base.metrics()))
    for what, least in (("clientPublish", 2), ("parameters", 1), ("services", 1), ("subscribe", 1),
                        ("playbackControl", 1), ("malformed", 200), ("http", 2)):
        count = value(metrics, "pitwall_outlet_refused_total", outlet="foxglove", what=what)
        expect(count and count >= least, f"{count} {what} refused")
    expect(value(metrics, "pitwall_commands_total") == 0, "nothing became a command")


def sockets_of(process):
    """Local ports of the UDP sockets of a process."""
    descriptors = [str(fd.readlink()) for fd in Path(f"/proc/{process.pid}/fd").iterdir()]
    inodes = {m.group(1) for d in descriptors if (m := re.match(r"socket:\[(\d+)\]", d))}
    rows = [line.split() for line in Path("/proc/net/udp").read_text().splitlines()[1:]]
    return {int(row[1].split(":")[1], 16) for row in rows if row[9] in inodes}


def an_lcm_flood_is_not_even_heard(base):
    expect(PORT not in sockets_of(base.process), "nothing of the base listens to LCM")
    before = base.metrics()
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as flood:
        for number in range(20_000):
            if number % 2:
                packet = os.urandom(number % 900)
            else:
                packet = struct.pack(">4sI", b"LC02", number) + b"/car/command\0" + bytes(64)
            flood.sendto(packet, (GROUP, PORT))
    packets = value(before, "pitwall_packets_total")
    after = until("packets of the car after the flood", lambda: (
        lambda text: text if value(text, "pitwall_packets_total") > packets + 50 else None)(
            base.metrics()))
    for name in ("pitwall_commands_total", "pitwall_words_refused_total",
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
                        (["--lcm", f"udpm://{GROUP}:{PORT}?ttl=1"], "--network"),
                        (["--lcm", "udpm://127.0.0.1:7667"], "multicast"),
                        (["--foxglove", "99999"], "--foxglove")):
        done = subprocess.run([BASE, *keys, *flags], capture_output=True, text=True, timeout=20)
        expect(done.returncode != 0 and what in done.stderr, f"{flags}: {done.stderr}")


def main():
    folder = Path(tempfile.mkdtemp(prefix="pitwall_tools_"))
    subprocess.run([BASE, "keygen", "--out", str(folder / "keys")], check=True, capture_output=True)
    mistakes_are_named(folder)
    log = folder / "lcm.log"
    logger = start(["lcm-logger", "--quiet", f"--lcm-url=udpm://{GROUP}:{PORT}?ttl=0", str(log)])
    base = Base("--keys", str(folder / "keys/base.keys"), "--listen", "127.0.0.1:0", "--web", "0",
                "--foxglove", "0", "--lcm", "--track", "lvms", "--car", "7", "--car-name", "Seven",
                "--record", str(folder / "rec"))
    car = start([CAR, str(folder / "keys/car.keys"), base.at["radio"], str(RUN_S)])
    lines = prometheus_reads_it(base)
    told = foxglove("live", base)
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
    wound = foxglove("replay", again)
    again.end()
    subprocess.run(["rm", "-r", str(folder)], check=True)
    print(f"{lines} lines of metrics; Foxglove: {told}, {wound}; LCM: {events} messages")


main()
