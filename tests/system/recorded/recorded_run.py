#!/usr/bin/env python3
"""A recorded run, driven again: played live to the car over a bus of a Unix socket, and as a
scenario of its own in lockstep: recorded_run.py BENCH

The car that made the recording drives the same modes and commands within the tolerances; a car
with less throttle does not. The scenario has the verdict and the modes of the one that was
recorded.
"""
# SPDX-License-Identifier: Apache-2.0
import json
import re
import subprocess
import sys
import tempfile
from pathlib import Path

BENCH = sys.argv[1]
TREE = Path(__file__).resolve().parents[3]
PATIENCE_S = 200
CAR = "vehicle/config/cars/av21.yaml"


def expect(condition, what):
    if not condition:
        sys.exit(f"FAILED: {what}")


def run(code, *arguments):
    ran = subprocess.run([BENCH, *arguments], cwd=TREE, text=True, timeout=PATIENCE_S, check=False,
                         stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
    print(f"$ {' '.join(arguments)}\n{ran.stdout}", flush=True)
    expect(ran.returncode == code, f"{arguments[0]}: code {ran.returncode}, not {code}")
    return ran.stdout


def record(folder, name, scenario, *options):
    run(0, "run", scenario, "--live", "--interface", f"unix:{folder}/bus", "--record",
        str(folder / name), "--out", str(folder / "run"), *options)


def compare(folder, name, code, *options):
    out = folder / "differences.json"
    text = run(code, "compare", str(folder / name), "--live", "--interface",
               f"unix:{folder}/bus", "--out", str(folder / "out"), "--json", str(out), *options)
    return text, json.loads(out.read_text())


def modes_of(progress):
    lines = [json.loads(line) for line in progress.read_text().splitlines()]
    return [line["text"] for line in lines if line.get("kind") == "mode"]


def drive_as_scenario(folder):
    made = folder / "made.yaml"
    run(0, "scenario", "from", str(folder / "record"), "--out", str(made))
    text = made.read_text()
    expect(f"# Made of the recording {folder}/record" in text, "it names its source")
    expect("track: green, round_target_speed_mph: 80}" in text, "race control's last flag")
    run(0, "run", str(made), "--progress", str(folder / "made.jsonl"))
    recorded, again = modes_of(folder / "recorded.jsonl"), modes_of(folder / "made.jsonl")
    expect(len(recorded) >= 2 and again == recorded, f"modes {again}, not {recorded}")


def operate(folder):
    """What the operator said is said again, to a base station with keys of its own."""
    record(folder, "operated", str(TREE / "tests/system/recorded/operator_stops.yaml"))
    text, same = compare(folder, "operated", 0)
    expect(": 0 signals differ" in text, "no signal differs where an operator stops the car")
    expect(same["modes"] >= 4, "disarmed, stands by, drives, stops")


def main():
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        record(folder, "record", "hil/scenarios/launch_and_stop.yaml", "--duration", "15", "--cut",
               "--progress", f"{name}/recorded.jsonl")

        text, same = compare(folder, "record", 0)
        expect(": 0 signals differ" in text, "no signal differs")
        expect(re.search(r"tolerances: 70 ms, acc_pedal_cmd \S+, brake_pressure_cmd", text),
               "the tolerances are named")
        expect(same["modes"] >= 3, "the car was disarmed, stood by and drove")
        expect(same["commands"] > 3000, "four commands a tick, while it was armed")
        expect(same["compared_s"] > 14, "the whole run")
        expect(same["not_played"] == 0 and same["played_frames"] > 10000, "all frames are played")

        car = folder / "weaker.yaml"
        weaker = (TREE / CAR).read_text().replace("throttle_max: 1.0\n", "throttle_max: 0.05\n")
        car.write_text(weaker)
        text, other = compare(folder, "record", 1, "--car", str(car))
        expect("weaker.yaml: not the file that the run was driven with" in text, "another file")
        found = {d["signal"]: d for d in other["differences"]}
        expect("accelerator_cmd.acc_pedal_cmd" in found, "the limit is found in the accelerator")
        expect(found["accelerator_cmd.acc_pedal_cmd"]["first"]["at_s"] > 5,
               "not before the car is let go")
        drive_as_scenario(folder)
        operate(folder)


if __name__ == "__main__":
    main()
