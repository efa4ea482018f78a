#!/usr/bin/env python3
"""A base that records is killed, starts again, and is replayed: killed.py BASE CAR TREE"""
# SPDX-License-Identifier: Apache-2.0
import json
import re
import signal
import subprocess
import sys
import tempfile
import urllib.request
from pathlib import Path

import lcm_oracle

BASE, CAR, TREE = sys.argv[1:4]
ORACLES = Path(TREE) / "tests/support/oracles"


def expect(condition, what):
    if not condition:
        sys.exit(f"FAILED: {what}")


def start(folder, *flags):
    return subprocess.Popen([BASE, "--keys", str(folder / "keys/base.keys"),
                             "--listen", "127.0.0.1:0", *flags],
                            stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)


def address_of(process):
    said = process.stderr.readline()
    found = re.search(r"127\.0\.0\.1:\d+", said)
    expect(found, f"an address is said, not: {said}")
    return found.group(0)


def drive(folder, address, length_s):
    words = [CAR, str(folder / "keys/car.keys"), address, str(length_s)]
    subprocess.run(words, check=True, capture_output=True, timeout=60)


def segments(folder):
    return sorted((folder / "rec").glob("*.mcap"))


def read_by_oracle(paths):
    node = ORACLES / "node_modules/.bin/node"
    if not node.exists():
        print("not checked by @mcap/core: its npm packages are not installed (./pitwall setup)")
        return
    checked = subprocess.run([node, ORACLES / "check_mcap.mjs", *paths],
                             check=True, capture_output=True, text=True).stdout.splitlines()
    expect(len(checked) == len(paths), f"a line for each file: {checked}")
    for topic in ("/base/link", "/base/picture", "/car/ego"):
        expect(any(topic in line for line in checked), f"{topic} is in {checked}")


def main():
    folder = Path(tempfile.mkdtemp(prefix="pitwall_killed_"))
    subprocess.run([BASE, "keygen", "--out", str(folder / "keys")], check=True, capture_output=True)
    record = ["--record", str(folder / "rec")]

    base = start(folder, *record)
    drive(folder, address_of(base), 2)
    base.send_signal(signal.SIGKILL)
    base.communicate()
    expect(len(segments(folder)) == 1, "one segment was begun")
    cut = segments(folder)[0]

    again = start(folder, *record, "--web", "0")
    address = address_of(again)
    said = [again.stderr.readline() for _ in range(3)]
    expect(any(cut.name in line and "kept" in line for line in said), f"recovery is told: {said}")
    known = [re.search(r"known again: (\d+) messages", line) for line in said]
    expect(any(k and int(k.group(1)) > 100 for k in known), f"history is known again: {said}")
    drive(folder, address, 1)
    again.send_signal(signal.SIGTERM)
    _, errors = again.communicate(timeout=30)
    expect(again.returncode == 0, f"exit code {again.returncode}: {errors}")
    expect(len(segments(folder)) == 2, "a new segment beside the old one")
    read_by_oracle(segments(folder))
    logs = [path.with_suffix(".lcm") for path in segments(folder)]
    expect(all(log.exists() for log in logs), "an LCM log beside each segment")
    decoded = lcm_oracle.check(BASE, logs, folder)
    if decoded:
        expect(decoded[0] > 500 and {"/car/ego", "/base/link"} <= decoded[1], f"LCM: {decoded}")

    bytes_of_cut = cut.read_bytes()
    cut.write_bytes(bytes_of_cut[:len(bytes_of_cut) * 2 // 3])
    bad = folder / "bad.mcap"
    bad.write_bytes(b"nothing")
    recovered = subprocess.run([BASE, "recover", str(cut), str(bad)],
                               capture_output=True, text=True)
    expect(recovered.returncode == 1, "one bad file is told by the exit code")
    expect(f"{cut}: " in recovered.stderr and "truncated" in recovered.stderr, recovered.stderr)
    expect(f"{bad}: error: not an MCAP file" in recovered.stderr, recovered.stderr)
    read_by_oracle(segments(folder))

    replay = subprocess.Popen([BASE, "--replay", str(folder / "rec"), "--web", "0"],
                              stderr=subprocess.PIPE, text=True)
    place = address_of(replay)
    catalogue = json.load(urllib.request.urlopen(f"http://{place}/api/catalogue", timeout=10))
    expect(len(catalogue["fields"]) > 300, "the replay serves consoles")
    descriptors = [str(fd.readlink()) for fd in Path(f"/proc/{replay.pid}/fd").iterdir()]
    inodes = {m.group(1) for d in descriptors if (m := re.match(r"socket:\[(\d+)\]", d))}
    udp = {line.split()[9] for line in Path("/proc/net/udp").read_text().splitlines()[1:]}
    expect(not inodes & udp, "a replay has no socket to the radio")
    replay.send_signal(signal.SIGTERM)
    expect(replay.wait(timeout=30) == 0, "a replay stops when it is asked to")
    nothing = subprocess.run([BASE, "--replay", str(folder / "keys"), "--web", "0"],
                             capture_output=True, text=True)
    expect(nothing.returncode == 2 and "no recording" in nothing.stderr, nothing.stderr)
    subprocess.run(["rm", "-r", str(folder)], check=True)
    print("killed, recovered, known again, replayed")


main()
