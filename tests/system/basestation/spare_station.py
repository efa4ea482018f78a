#!/usr/bin/env python3
"""What a base knows when it starts again, and a spare one: spare_station.py BASE VEHICLE HIL TREE

The real pitwall-base and pitwall-vehicle over loopback; the car is on a bus of its own and stands.
"""
# SPDX-License-Identifier: Apache-2.0
import atexit
import contextlib
import json
import re
import select
import shutil
import signal
import socket
import subprocess
import sys
import tempfile
import threading
import time
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parents[2] / "support"))
import test_clock  # noqa: E402

BASE, VEHICLE, HIL, TREE = sys.argv[1], sys.argv[2], sys.argv[3], Path(sys.argv[4])
PATIENCE_S = 20  # of a loaded machine
SETTLED_S = 1.5  # a stamp file is written once a second
TAKE_OVER_S = 3.0
KIND_MASK, OPENING, ANSWER = 0b11100, 0, 1 << 2  # first byte: version:3, kind:3, ...
REPLAYS = 50
OLD_STAMP = "key exchange with an old stamp"


def expect(condition, what):
    if not condition:
        sys.exit(f"FAILED: {what}")


def until(what, condition):
    end = time.monotonic() + PATIENCE_S
    while not (found := condition()):
        expect(time.monotonic() < end, f"in {PATIENCE_S} s: {what}")
        time.sleep(0.01)
    return found


def free_port():
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as one:
        one.bind(("127.0.0.1", 0))
        return one.getsockname()[1]


def stamp_in(file):
    found = re.fullmatch(r"stamp: (\d+)\n", file.read_text()) if file.exists() else None
    return int(found[1]) if found else 0


RUNNING = []


def spawn(words, **options):
    process = subprocess.Popen(words, **options)
    RUNNING.append(process)
    return process


@atexit.register
def end_what_runs():
    for process in RUNNING:
        if process.poll() is None:
            process.kill()


class Base:
    def __init__(self, keys, port, *flags):
        self.stamp_file, self.summary = keys / "base.stamp", keys / "summary.json"
        self.process = spawn(
            [BASE, "--keys", keys / "base.keys", "--listen", f"127.0.0.1:{port}", "--json",
             self.summary, *test_clock.FLAGS, *flags], stderr=subprocess.PIPE, text=True)
        self.said = []
        while "listening at" not in (line := self.process.stderr.readline()):
            expect(line, f"a base at {port} begins: {self.said}")
            self.said.append(line)

    def die(self):
        self.process.kill()
        self.process.communicate()

    def finish(self):
        self.process.send_signal(signal.SIGTERM)
        _, errors = self.process.communicate(timeout=PATIENCE_S)
        expect(self.process.returncode == 0, f"exit code {self.process.returncode}: {errors}")
        return json.loads(self.summary.read_text())


class Car:
    """Its process, on the bus of a hub that nobody else has joined."""

    def __init__(self, folder, keys, stations):
        self.summary = folder / "car.json"
        config, bus = TREE / "vehicle/config", folder / "bus"
        self.hub = spawn([HIL, "bus", "hub", bus, *test_clock.FLAGS], stderr=subprocess.DEVNULL)
        until("the bus is there", bus.exists)
        self.process = spawn(
            [VEHICLE, "--car", config / "cars/av21.yaml", "--track", config / "tracks/lvms.yaml",
             "--can", f"unix:{bus}", "--gnss", f"{free_port()},{free_port()}", "--radio", stations,
             "--keys", keys / "car.keys", "--summary", self.summary, "--simulation",
             *test_clock.FLAGS],
            stderr=subprocess.PIPE, text=True)

    def finish(self):
        self.process.send_signal(signal.SIGTERM)
        _, errors = self.process.communicate(timeout=PATIENCE_S)
        self.hub.kill()
        self.hub.wait()
        expect(self.process.returncode == 0, f"exit code {self.process.returncode}: {errors}")
        return json.loads(self.summary.read_text())["radio"], errors


class Relay(threading.Thread):
    """Between car and base; keeps the openings that pass."""

    def __init__(self, base_port):
        super().__init__(daemon=True)
        self.base, self.passes, self.openings = ("127.0.0.1", base_port), True, []
        self.to_car, self.to_base = (socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
                                     for _ in range(2))
        self.to_car.bind(("127.0.0.1", 0))
        self.to_base.bind(("127.0.0.1", 0))
        self.station = f"127.0.0.1:{self.to_car.getsockname()[1]}"
        self.start()

    def run(self):
        car = None
        while True:
            for ready in select.select([self.to_car, self.to_base], [], [])[0]:
                with contextlib.suppress(ConnectionError):  # nobody is there
                    datagram, sender = ready.recvfrom(2048)
                    if ready is self.to_car:
                        car = sender
                        if self.passes and datagram[0] & KIND_MASK == OPENING:
                            self.openings.append(datagram)
                    if not self.passes:
                        continue
                    if ready is self.to_car:
                        self.to_base.sendto(datagram, self.base)
                    elif car is not None:
                        self.to_car.sendto(datagram, car)


def make_keys(folder):
    subprocess.run([BASE, "keygen", "--out", folder], check=True, capture_output=True)
    return folder


def replies_to(openings, port):
    """What comes back to a stranger who sends them."""
    replies = []
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as stranger:
        stranger.settimeout(0.5)
        for number in range(REPLAYS):
            stranger.sendto(openings[number % len(openings)], ("127.0.0.1", port))
            time.sleep(0.01)
        with contextlib.suppress(TimeoutError):
            while True:
                replies.append(stranger.recv(2048))
    return replies


def a_base_that_starts_again_knows_replayed_openings(folder):
    keys, port = make_keys(folder / "keys"), free_port()
    base = Base(keys, port)
    relay = Relay(port)
    expect(not base.stamp_file.exists(), "no car, no stamp")
    before_s = test_clock.calendar_s()
    car = Car(folder, keys, relay.station)
    until("the stamp file is there", lambda: stamp_in(base.stamp_file))
    time.sleep(SETTLED_S)
    stamp, recorded = stamp_in(base.stamp_file), list(relay.openings)
    expect(before_s < stamp / 1e9 < test_clock.calendar_s(),
           f"stamps are of the calendar, not {stamp}")
    expect(base.stamp_file.stat().st_mode & 0o777 == 0o600, "for its owner only")
    relay.passes = False
    base.die()
    expect(stamp_in(base.stamp_file) == stamp, "the file stays")

    # The car is not there: what the base knows is what the file says.
    base = Base(keys, port)
    expect(base.said == [], f"nothing is wrong with the file: {base.said}")
    replies = replies_to(recorded, port)
    heard = base.finish()
    expect(replies == [], f"no replayed opening is answered, but {len(replies)}")
    expect(heard["refused_by_kind"][OLD_STAMP] == REPLAYS, f"each is refused: {heard}")

    # The same without the memory: one is worked on and opens nothing.
    base = Base(keys, port, "--stamp-file", "none")
    replies = replies_to(recorded, port)
    heard = base.finish()
    expect([reply[0] & KIND_MASK for reply in replies[:1]] == [ANSWER], f"one answer: {replies}")
    expect(heard["sessions"] == 0, f"and no session: {heard}")
    expect(stamp_in(keys / "base.stamp") == stamp, "none is none")

    # The car is back, and its stamps are newer.
    base = Base(keys, port)
    relay.passes = True
    until("the car is back", lambda: stamp_in(base.stamp_file) > stamp)
    time.sleep(0.5)
    heard = base.finish()
    expect(heard["sessions"] == 1 and heard["packets"] > 5, f"one session: {heard}")
    a_base_without_a_file_it_can_read_says_so(keys, port)
    radio, _ = car.finish()
    expect(radio["sessions"] >= 2, f"of the first base and of those that linked: {radio}")


def a_base_without_a_file_it_can_read_says_so(keys, port):
    file = keys / "base.stamp"
    file.write_text("stamp: 17")
    base = Base(keys, port)
    expect(len(base.said) == 1 and f"stamp file unreadable: {file}:1: error:" in base.said[0],
           f"it is said: {base.said}")
    until("it is written anew", lambda: stamp_in(file))
    base.finish()


def a_spare_base_takes_over(folder):
    first_keys, spare_keys = make_keys(folder / "first"), folder / "spare"
    spare_keys.mkdir(mode=0o700)
    shutil.copy(first_keys / "base.keys", spare_keys)
    first_port, spare_port = free_port(), free_port()
    first = Base(first_keys, first_port)
    car = Car(folder, first_keys, f"127.0.0.1:{first_port},127.0.0.1:{spare_port}")
    until("the first base has the car", lambda: stamp_in(first.stamp_file))
    time.sleep(SETTLED_S)
    first.die()
    spare = Base(spare_keys, spare_port)
    began = test_clock.monotonic_s()
    until("the spare base has the car", lambda: stamp_in(spare.stamp_file))
    took_s = test_clock.monotonic_s() - began
    expect(took_s < TAKE_OVER_S, f"within {TAKE_OVER_S} s, not {took_s:.1f} s")

    # The first one is back: the car stays with whom it hears.
    first = Base(first_keys, first_port)
    time.sleep(2.0)
    heard = first.finish()
    expect(heard["packets"] == 0 and heard["refused"] == 0, f"nothing goes there: {heard}")
    heard = spare.finish()
    expect(heard["sessions"] == 1 and heard["packets"] > 20, f"one session: {heard}")
    radio, said = car.finish()
    expect(radio["sessions"] == 2, f"of the first base and of the spare one: {radio}")
    expect("seen by the car" not in said, f"and nobody attacked: {said}")
    print(f"the spare base had the car {took_s:.2f} s after its start")


with tempfile.TemporaryDirectory(prefix="pitwall_spare_") as temporary:
    for case in (a_base_that_starts_again_knows_replayed_openings, a_spare_base_takes_over):
        place = Path(temporary) / case.__name__[:12]
        place.mkdir()
        case(place)
print("spare station: all held")
