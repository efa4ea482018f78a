#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""pitwall-hil, or the car, with a fault of its own: what fakes.py gives to the live tests.

PITWALL_FAKE_REAL   the program that is run, with these arguments; its exit code is ours
PITWALL_FAKE        what is wrong then: `nothing`; `verdicts`, each fails in the result; `frames`,
                    500 are lost in it; `values`, each figure of it is wrong; `blocks`, the program
                    stands for 300 ms when the bench that drives it dies
"""
import ctypes
import json
import os
import signal
import subprocess
import sys
import time
from pathlib import Path

REAL, FAULT = os.environ["PITWALL_FAKE_REAL"], os.environ["PITWALL_FAKE"]
LOST, BLOCKS_S, LOOK_S = 500, 0.3, 0.001
ARRIVED = {"to_car", "from_car", "car_received", "listener_received", "arrived", "packets"}
JUDGED = {"pass", "passed", "held", "in_order"}
NAMES = {"schema", "seed"}  # no figures


def wrong(key, value):
    """A value of the result as the fault has it."""
    if isinstance(value, dict):
        return {k: wrong(k, v) for k, v in value.items()}
    if isinstance(value, list):
        return [wrong(key, v) for v in (value[:-1] if FAULT == "values" else value)]
    if isinstance(value, bool):
        return False if FAULT == "verdicts" and key in JUDGED else value
    if not isinstance(value, (int, float)) or key in NAMES:
        return value
    if FAULT == "frames":
        return value - LOST if key in ARRIVED else value + LOST if key == "lost" else value
    return value * 2 + 7 if FAULT == "values" else value


def results(words):
    """The files in which this command leaves figures."""
    named = [Path(words[i + 1]) for i, word in enumerate(words[:-1]) if word == "--json"]
    return {path for file in named for path in (file, file.parent / "run.json",
                                                file.parent / "base.json") if path.exists()}


def benches():
    """Processes that drive a car which is not theirs."""
    found = set()
    for place in Path("/proc").iterdir():
        try:
            if place.name.isdigit() and b"\0--attach\0" in (place / "cmdline").read_bytes():
                found.add(place.name)
        except OSError:
            pass  # it has ended
    return found


def block_when_the_bench_dies(process):
    while not benches() and process.poll() is None:
        time.sleep(LOOK_S)
    bench = Path("/proc") / min(benches(), default="none")
    while bench.exists() and process.poll() is None:
        time.sleep(LOOK_S)
    process.send_signal(signal.SIGSTOP)
    time.sleep(BLOCKS_S)
    process.send_signal(signal.SIGCONT)


def die_with_parent():
    """A test that kills us means the program: PR_SET_PDEATHSIG of prctl(2)."""
    ctypes.CDLL(None).prctl(1, signal.SIGKILL)


def main():
    before = time.time()
    with subprocess.Popen([REAL, *sys.argv[1:]], preexec_fn=die_with_parent) as process:
        for name in (signal.SIGTERM, signal.SIGINT):
            signal.signal(name, lambda number, _: process.send_signal(number))
        if FAULT == "blocks":
            block_when_the_bench_dies(process)
        code = process.wait()
    for path in results(sys.argv):
        if path.stat().st_mtime >= before:
            path.write_text(json.dumps(wrong("", json.loads(path.read_text()))))
    return code


if __name__ == "__main__":
    sys.exit(main())
