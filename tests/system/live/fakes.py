#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""fakes.py BUILD [--only TEST]...: a test of the live tests.

Each runs with a bench or a car that has a fault (fake_bench.py), and must fail at once, not be
called late; and with one that has none, and must pass. Exit code 0 if all did. Takes about a
quarter of an hour.
"""
import argparse
import os
import subprocess
import sys
import time
from pathlib import Path

TREE = Path(__file__).resolve().parents[3]
FAKE = Path(__file__).resolve().parent / "fake_bench.py"
PASSED, ONLY_LATE = 0, 75
ON_BUS = ["{hil}", "bus", "exec", "--auto", "--timeout", "340", "--"]
SYSTEM = "{build}/tests/system/"
# Name: the command; the variable that names what is faked, and what that is; its faults.
TESTS = {
    "unix_bus/live": ([SYSTEM + "unix_bus/test_system_unix_bus", "--gtest_filter=LiveRun.*"],
                      "PITWALL_BENCH_PROGRAM", "hil", ("verdicts", "frames", "values")),
    "live/demo": ([SYSTEM + "live/test_system_live"],
                  "PITWALL_BENCH_PROGRAM", "hil", ("verdicts", "frames", "values")),
    "live/process_faults": ([SYSTEM + "live/test_system_process_faults"],
                            "PITWALL_BENCH_PROGRAM", "hil", ("verdicts", "values")),
    "live/bench_killed": ([*ON_BUS, SYSTEM + "live/test_system_bench_killed"],
                          "PITWALL_VEHICLE_PROGRAM", "vehicle", ("blocks",)),
    "live/bench_killed, its result": ([*ON_BUS, SYSTEM + "live/test_system_bench_killed"],
                                      "PITWALL_BENCH_PROGRAM", "hil", ("values",)),
    "gateway/load": ([SYSTEM + "gateway/test_system_gateway"],
                     "PITWALL_BENCH_PROGRAM", "hil", ("verdicts", "frames", "values")),
    "vcan/bench_replay": ([SYSTEM + "vcan/test_system_bench_replay"],
                          "PITWALL_REPLAY_PROGRAM", "hil", ("verdicts", "frames", "values")),
}


def run(build, name, fault):
    """The exit code of the test, and what it said."""
    command, variable, faked, _ = TESTS[name]
    programs = {"hil": f"{build}/hil/pitwall-hil", "vehicle": f"{build}/vehicle/pitwall-vehicle"}
    places = {"build": build, **programs}
    environment = {**os.environ, "PITWALL_BENCH_PROGRAM": programs["hil"],
                   "PITWALL_BASE_PROGRAM": f"{build}/basestation/pitwall-base",
                   "PITWALL_VEHICLE_PROGRAM": programs["vehicle"],
                   "PITWALL_FAKE": fault, "PITWALL_FAKE_REAL": programs[faked],
                   variable: str(FAKE)}
    done = subprocess.run([word.format(**places) for word in command], cwd=TREE, env=environment,
                          capture_output=True, text=True, check=False)
    return done.returncode, done.stdout + done.stderr


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("build")
    parser.add_argument("--only", action="append", choices=TESTS)
    arguments = parser.parse_args()
    unlike = 0
    for name in arguments.only or TESTS:
        for fault in ("nothing", *TESTS[name][3]):
            begun = time.monotonic()
            code, said = run(arguments.build, name, fault)
            red = code not in (PASSED, ONLY_LATE)
            as_wanted = red != (fault == "nothing")
            unlike += not as_wanted
            print(f"{'ok  ' if as_wanted else 'NOT '} {name:<30} {fault:<9} exit {code:>3} "
                  f"{time.monotonic() - begun:5.0f} s", flush=True)
            if not as_wanted:
                print(said)
    print(f"{unlike} of the live tests' answers are not what they should be")
    return 1 if unlike else 0


if __name__ == "__main__":
    sys.exit(main())
