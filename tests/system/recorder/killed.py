#!/usr/bin/env python3
"""A base that records is killed, starts again, and is replayed: killed.py BASE CAR TREE"""
# SPDX-License-Identifier: Apache-2.0
import json
import re
import signal
import struct
import subprocess
import sys
import tempfile
import time
import urllib.request
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parents[2] / "support"))
import lcm_oracle  # noqa: E402
import test_clock  # noqa: E402

BASE, CAR, TREE = sys.argv[1:4]
ORACLES = Path(TREE) / "tests/support/oracles"
KILLED_AFTER_S = (0.3, 1.1, 2.0)  # of three processes, one after the other


def expect(condition, what):
    if not condition:
        sys.exit(f"FAILED: {what}")


def start(folder, *flags):
    return subprocess.Popen([BASE, "--keys", str(folder / "keys/base.keys"),
                             "--listen", "127.0.0.1:0", *test_clock.FLAGS, *flags],
                            stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)


def address_of(process):
    said = process.stderr.readline()
    found = re.search(r"127\.0\.0\.1:\d+", said)
    expect(found, f"an address is said, not: {said}")
    return found.group(0)


def drive(folder, address, length_s):
    words = [CAR, str(folder / "keys/car.keys"), address, str(length_s)]
    subprocess.run(words, check=True, capture_output=True, timeout=60)


def newest_on_disk(path):
    """Seconds since 1970 of the newest message in a whole chunk, as in https://mcap.dev/spec."""
    data, at, newest = path.read_bytes(), 8, 0
    while at + 9 <= len(data):
        opcode, length = struct.unpack_from("<BQ", data, at)
        at += 9
        if at + length > len(data):
            break
        if opcode == 6:
            newest = max(newest, struct.unpack_from("<Q", data, at + 8)[0])
        at += length
    return newest / 1e9


def lost_by_a_kill(folder, after_s):
    """A base is killed while its car speaks: seconds between what is kept and the kill."""
    written = len(recordings(folder))
    base = start(folder, "--record", str(folder / "rec"))
    address = address_of(base)
    while len(recordings(folder)) == written:  # the machine may be slow to begin
        time.sleep(0.01)
    began = test_clock.calendar_s()
    car = subprocess.Popen([CAR, str(folder / "keys/car.keys"), address, "4"],
                           stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    time.sleep(after_s)
    killed = test_clock.calendar_s()
    base.send_signal(signal.SIGKILL)
    base.communicate()
    car.kill()
    car.wait()
    newest = max(map(newest_on_disk, segments(folder)), default=0)
    return killed - max(newest, began)


def segments(folder):
    return sorted((folder / "rec").glob("*.mcap"))


def recordings(folder):
    return [path for path in segments(folder) if path.stat().st_size > 0]


def read_by_oracle(paths):
    node = ORACLES / "node_modules/.bin/node"
    if not node.exists():
        print("not checked by @mcap/core: its npm packages are not installed (./pitwall setup)")
        return
    checked = subprocess.run([node, ORACLES / "check_mcap.mjs", *paths],
                             check=True, capture_output=True, text=True).stdout.splitlines()
    expect(len(checked) == len(paths), f"a line for each file: {checked}")
    for topic in ("/base/link", "/base/picture", "/car/ego", "/radio/down", "/radio/up"):
        expect(any(topic in line for line in checked), f"{topic} is in {checked}")


def main():
    folder = Path(tempfile.mkdtemp(prefix="pitwall_killed_"))
    subprocess.run([BASE, "keygen", "--out", str(folder / "keys")], check=True, capture_output=True)
    record = ["--record", str(folder / "rec")]

    lost = [lost_by_a_kill(folder, after_s) for after_s in KILLED_AFTER_S]
    expect(max(lost) <= 1.0, f"a kill loses {lost} s of the recording")
    before = len(segments(folder))
    cut = segments(folder)[-1]

    again = start(folder, *record, "--web", "0")
    address = address_of(again)
    said = [again.stderr.readline() for _ in range(3)]
    expect(any(cut.name in line and "kept" in line for line in said), f"recovery is told: {said}")
    known = [re.search(r"restored: (\d+) messages", line) for line in said]
    expect(any(k and int(k.group(1)) > 100 for k in known), f"history is restored: {said}")
    drive(folder, address, 1)
    again.send_signal(signal.SIGTERM)
    _, errors = again.communicate(timeout=30)
    expect(again.returncode == 0, f"exit code {again.returncode}: {errors}")
    expect(len(segments(folder)) == before + 1, "a new segment beside the old ones")
    read_by_oracle(segments(folder))
    logs = [path.with_suffix(".lcm") for path in segments(folder)]
    expect(all(log.exists() for log in logs), "an LCM log beside each segment")
    decoded = lcm_oracle.check(BASE, logs, folder)
    if decoded:
        wanted = {"/car/ego", "/base/link", "/radio/down", "/radio/up"}
        expect(decoded[0] > 500 and wanted <= decoded[1], f"LCM: {decoded}")

    judged = subprocess.run([BASE, "judge", str(folder / "rec")], capture_output=True, text=True)
    expect(judged.returncode == 0 and " 0 differ" in judged.stdout,
           f"the same alarms from the files: {judged}")

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
    print(f"killed, recovered, restored, replayed; lost {max(lost):.2f} s at most")


main()
