#!/usr/bin/env python3
"""Two bases in front of the same car, one without consoles, one with every publisher: they judge,
record and publish the same alarms, and each recording judged again gives them once more.
alike.py BASE CAR TREE"""
# SPDX-License-Identifier: Apache-2.0
import json
import re
import socket
import subprocess
import sys
import tempfile
import time
from collections import defaultdict
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parents[2] / "support"))
sys.path.insert(0, str(Path(__file__).parents[1] / "report"))
import event_log  # noqa: E402
import test_clock  # noqa: E402

BASE, CAR, TREE = sys.argv[1:4]
PUBLISHERS = {"without consoles": ["--ros"],
              "with everything": ["--ros", "--lcm", "--foxglove", "0", "--web", "0"]}
PATIENCE_S = 60


def expect(condition, what):
    if not condition:
        sys.exit(f"FAILED: {what}")


def drive(folder, address, length_s):
    words = [CAR, str(folder / "keys/car.keys"), address, str(length_s)]
    subprocess.run(words, check=True, capture_output=True, timeout=PATIENCE_S)


class Commands:
    """The command socket of a base: a line, and its answer."""

    def __init__(self, path):
        self.socket = socket.socket(socket.AF_UNIX, socket.SOCK_STREAM)
        self.socket.settimeout(PATIENCE_S)
        self.socket.connect(str(path))
        self.lines = self.socket.makefile()

    def ask(self, line):
        self.socket.sendall(line.encode() + b"\n")
        return self.lines.readline().strip()

    def until_done(self, line):
        limit = time.monotonic() + PATIENCE_S
        while (answer := self.ask(line)) != "done":
            expect(time.monotonic() < limit, f"{line}: {answer}")
            time.sleep(0.05)


def alarm_events(folder):
    """Of each alarm: how it came and went, and by whom."""
    events = defaultdict(list)
    for segment in sorted(folder.glob("*.mcap")):
        channels = {}
        for opcode, content in event_log.records(segment.read_bytes()[len(event_log.MAGIC):]):
            if opcode == event_log.CHUNK:
                for inner, part in event_log.records(event_log.chunk_parts(content)[1]):
                    take(inner, part, channels, events)
            else:
                take(opcode, content, channels, events)
            if opcode == event_log.DATA_END:
                break
    return dict(events)


def take(opcode, content, channels, events):
    if opcode == event_log.CHANNEL:
        number, topic = event_log.channel_of(content)
        channels[number] = topic
    if opcode != event_log.MESSAGE:
        return
    if channels.get(int.from_bytes(content[:2], "little")) != "/base/alarm_event":
        return
    event = json.loads(content[22:])
    events[event["key"]].append((event["from"], event["to"], event.get("by")))


def race(folder, name, flags):
    """The car drives, is silent until its loss is acknowledged, and drives again."""
    recording, commands = folder / name, folder / "commands"
    process = subprocess.Popen(
        [BASE, "--keys", str(folder / "keys/base.keys"), "--listen", "127.0.0.1:0", *flags,
         "--record", str(recording), "--command-socket", str(commands), "--stamp-file", "none",
         *test_clock.FLAGS], stderr=subprocess.PIPE, text=True)  # fmt: skip
    address = re.search(r"127\.0\.0\.1:\d+", process.stderr.readline()).group(0)
    drive(folder, address, 2.0)
    operator = Commands(commands)
    operator.until_done("ack link_lost")
    expect(operator.ask("ack no_such_alarm").startswith("refused: "), "what is no alarm")
    drive(folder, address, 3.0)
    expect(operator.ask("ack all") == "done", "and the rest is acknowledged")
    process.terminate()
    _, said = process.communicate(timeout=PATIENCE_S)
    expect(process.returncode == 0, f"{name}: exit code {process.returncode}: {said}")
    judged = subprocess.run([BASE, "judge", str(recording)], capture_output=True, text=True)
    expect(judged.returncode == 0 and ", 0 differ" in judged.stdout,
           f"{name}, judged again: {judged.stdout}{judged.stderr}")
    return alarm_events(recording)


def main():
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        subprocess.run([BASE, "keygen", "--out", str(folder / "keys")], check=True,
                       capture_output=True)
        races = {which: race(folder, which.replace(" ", "_"), flags)
                 for which, flags in PUBLISHERS.items()}
    alone, crowded = races.values()
    lost = alone.get("link_lost", [])
    expect([to for _, to, _ in lost] == ["unack", "acked", "normal"], f"link_lost: {lost}")
    expect(lost[1][2] == "command socket", f"by whom: {lost}")
    expect(len(alone) >= 2, f"more than one alarm, not {alone}")
    for key in sorted({*alone, *crowded}):
        expect(alone.get(key) == crowded.get(key),
               f"{key}: {alone.get(key)} without consoles, {crowded.get(key)} with everything")
    print(f"{sum(map(len, alone.values()))} changes of {len(alone)} alarms are alike")


main()
