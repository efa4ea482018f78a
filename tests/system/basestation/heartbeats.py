#!/usr/bin/env python3
"""The real pitwall-base process and a car that this file plays: heartbeats.py BASE GOLDEN_PACKET

The car's packet is the golden one with run, sequence and time of sending written over; heartbeats
are taken apart by struct and zlib, from the layout in protocol/telemetry/heartbeat.hpp alone.
"""
# SPDX-License-Identifier: Apache-2.0
import json
import re
import signal
import socket
import struct
import subprocess
import sys
import tempfile
import time
import zlib
from pathlib import Path

BASE, GOLDEN = sys.argv[1:3]
STATE = bytes.fromhex("".join(Path(GOLDEN).read_text().split()))
HEARTBEAT = struct.Struct("<2sBBIIQIIQI")
PATIENCE_S = 20.0  # a loaded machine is slow; what is tested is what happens, not how fast


def expect(condition, what):
    if not condition:
        sys.exit(f"FAILED: {what}")


class Car:
    def __init__(self, port, run):
        self.socket = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        self.socket.bind(("127.0.0.1", 0))
        self.base, self.run, self.sequence, self.sent = ("127.0.0.1", port), run, 0, {}

    def say(self):
        self.sequence += 1
        self.sent[self.sequence] = time.monotonic_ns() // 1000
        body = (STATE[:8] + struct.pack("<IIQ", self.run, self.sequence, self.sent[self.sequence])
                + STATE[24:-4])
        self.socket.sendto(body + struct.pack("<I", zlib.crc32(body)), self.base)

    def heard(self):
        """What came since the last look, taken apart; nothing but heartbeats may come."""
        beats = []
        self.socket.settimeout(0)
        while True:
            try:
                data, sender = self.socket.recvfrom(2048)
            except (BlockingIOError, ConnectionRefusedError):
                return beats
            expect(sender == self.base, "the answer comes from where the telemetry goes")
            expect(len(data) == HEARTBEAT.size + 4, f"{len(data)} bytes: no heartbeat")
            body, (crc,) = data[:-4], struct.unpack("<I", data[-4:])
            expect(zlib.crc32(body) == crc, "the checksum")
            beat = dict(zip(("magic", "version", "flags", "run", "sequence", "sent", "heard_run",
                             "heard_sequence", "heard_sent", "held"), HEARTBEAT.unpack(body)))
            expect((beat["magic"], beat["version"], beat["flags"]) == (b"PH", 1, 0), str(beat))
            expect(beat["heard_run"] == self.run, "it answers this run of this car")
            expect(self.sent.get(beat["heard_sequence"]) == beat["heard_sent"],
                   "number and time are those of one packet that was sent")
            beats.append(beat)

    def drive(self, seconds, speak=True):
        beats, end = [], time.monotonic() + seconds
        while time.monotonic() < end:
            if speak:
                self.say()
            time.sleep(0.02)
            beats += self.heard()
        return beats

    def drive_until(self, enough, what):
        beats, end = [], time.monotonic() + PATIENCE_S
        while not enough(beats):
            expect(time.monotonic() < end, what)
            beats += self.drive(0.05)
        return beats


def start(port=0, *flags):
    process = subprocess.Popen([BASE, "--listen", f"127.0.0.1:{port}", *flags],
                               stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    said = process.stderr.readline()
    match = re.search(r"127\.0\.0\.1:(\d+)", said)
    expect(match, f"the base listens, and does not say: {said}")
    return process, int(match.group(1))


def end(process):
    process.terminate()
    out, _ = process.communicate(timeout=30)
    expect(process.returncode == 0, f"exit code {process.returncode}")
    return out


def numbers_rise(beats):
    return all(b["sequence"] == a["sequence"] + 1 and b["run"] == a["run"]
               and b["heard_sequence"] >= a["heard_sequence"] and b["sent"] > a["sent"]
               for a, b in zip(beats, beats[1:]))


def answers_ten_times_a_second():
    process, port = start()
    car = Car(port, 7)
    expect(car.drive(0.3, speak=False) == [], "a base that heard no car says nothing")
    began = time.monotonic()
    beats = car.drive_until(lambda b: len(b) >= 10, "ten heartbeats")
    took_s = time.monotonic() - began
    expect(beats[0]["sequence"] == 0 and numbers_rise(beats), "numbers from zero, one by one")
    expect(len(beats) <= 10 * took_s + 2, f"{len(beats)} heartbeats in {took_s:.2f} s")
    expect(beats[-1]["heard_sequence"] > 10, "the newest packet is answered")
    expect(all(b["held"] < 4_000_000_000 for b in beats), "held")
    end(process)


def goes_on_after_a_stop():
    process, port = start()
    car = Car(port, 8)
    before = car.drive_until(lambda b: len(b) >= 3, "heartbeats before the stop")
    process.send_signal(signal.SIGSTOP)
    time.sleep(0.1)
    car.heard()
    expect(car.drive(1.0) == [], "a stopped base is silent")
    process.send_signal(signal.SIGCONT)
    after = car.drive_until(lambda b: len(b) >= 3, "heartbeats after the stop")
    expect(after[0]["run"] == before[0]["run"], "the same run")
    expect(numbers_rise(after), "what was missed is not made up for in one burst of old numbers")
    end(process)


def a_killed_one_leaves_nothing_and_the_next_picks_the_car_up():
    process, port = start()
    car = Car(port, 9)
    runs = []
    for _ in range(3):
        beats = car.drive_until(lambda b: len(b) >= 3, "heartbeats of each run")
        expect(beats[0]["sequence"] == 0, "a new run counts from zero")
        runs.append(beats[0]["run"])
        process.kill()
        process.wait()
        car.heard()
        expect(car.drive(0.3) == [], "a dead base is silent")
        process, again = start(port)
        expect(again == port, "its port is free at once")
    expect(runs == sorted(set(runs)), f"runs rise: {runs}")
    end(process)


def a_restarted_car_is_answered_where_it_is_now():
    process, port = start()
    old, new = Car(port, 10), Car(port, 11)
    old.drive_until(lambda b: len(b) >= 3, "heartbeats for the first car process")
    new.drive_until(lambda b: len(b) >= 3, "heartbeats for the second")
    old.heard()
    new.drive(0.5)
    expect(old.heard() == [], "the old address hears nothing more")
    end(process)


def a_lost_car_is_named(folder):
    summary = folder / "lost.json"
    process, port = start(0, "--text", "--plain", "--refresh", "2", "--json", str(summary))
    car = Car(port, 12)
    beats = car.drive_until(lambda b: len(b) >= 3, "heartbeats")
    beats += car.drive(1.5, speak=False)
    expect(len(beats) > 5, "a car that fell silent is still told that its base lives")
    expect(beats[-1]["held"] > 1_000_000, f"and how long: {[b['held'] for b in beats]}")
    screens = end(process)
    beats += car.heard()
    expect("CAR LOST: not heard for" in screens, "the screen says so")
    expect("heartbeats sent" in screens and "round trip" in screens, "the uplink is shown")
    said = json.loads(summary.read_text())
    expect(said["car"] == "lost", f"the summary says {said['car']}")
    expect(said["heartbeats_sent"] == len(beats),
           f"{said['heartbeats_sent']} sent, {len(beats)} came")
    expect(said["heartbeats_not_sent"] == 0, "all went out")


with tempfile.TemporaryDirectory(prefix="pitwall_base_") as name:
    answers_ten_times_a_second()
    goes_on_after_a_stop()
    a_killed_one_leaves_nothing_and_the_next_picks_the_car_up()
    a_restarted_car_is_answered_where_it_is_now()
    a_lost_car_is_named(Path(name))
print("ok")
