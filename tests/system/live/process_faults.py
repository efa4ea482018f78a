#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""process_faults.py PITWALL_HIL [--interface unix:PATH] [--only NAME]... [--points N] [--out DIR]

Every live scenario in which a process, a clock or a disk fails, and the car's process killed at
eight points of a lap of LVMS at speed (--points; 0: none). Prints one line per run with the
tightest margin of what is expected; writes DIR/process_faults.json. Exit code 0 if all hold.
Takes about a quarter of an hour: bench time is no faster than the wall clock.
"""
import argparse
import json
import pathlib
import subprocess
import sys

SCENARIOS = ["base_killed", "base_paused", "base_restarted", "base_blink", "computer_paused",
             "computer_killed", "computer_restarted", "computer_slow",
             "computer_and_guardian_killed", "clock_stepped", "log_disk_full"]
# Of the radio; only those that --only names are run.
RADIO = ["lvms_radio_bursty", "radio_blackout", "radio_bufferbloat", "radio_two_paths",
         "operator_stop", "operator_emergency", "base_restarted_commands"]
GUEST_ONLY = {"clock_stepped", "log_disk_full"}
FAST_AT_S, LAP_S, STOP_S = 50.0, 38.0, 25.0  # at speed by then; one lap at speed; to a standstill

POINT = """schema: 1
name: {name}
seed: 40
duration_s: {end}
track: vehicle/config/tracks/lvms.yaml
car: vehicle/config/cars/av21.yaml
start: {{s_m: 2250, n_m: 0}}
tyres: {{temperature_c: 85}}
race_control:
  - {{at_s: 0.5, track: red}}
  - {{at_s: 5, track: orange}}
  - {{at_s: 11, track: yellow, round_target_speed_mph: 60}}
  - {{at_s: 12, track: green, round_target_speed_mph: 147}}
faults:
  - {{kind: computer_killed, at_s: {kill}}}
expect:
  - {{kind: within, signal: speed_mps, is: ">", value: 60, from_s: 12, until_s: {kill}}}
  - {{kind: always, signal: wall_gap_m, is: ">", value: 0.5}}
  - {{kind: within, signal: speed_mps, is: "<", value: 0.5, from_s: {kill}, until_s: {end}}}
"""


def run(arguments, name, scenario):
    folder = arguments.out / name
    folder.mkdir(parents=True, exist_ok=True)
    result = folder / "run.json"
    result.unlink(missing_ok=True)
    command = [arguments.program, "run", str(scenario), "--live", "--out", str(folder), "--json",
               str(result), "--log", str(folder / "events.mcap")]
    if arguments.interface:
        command += ["--interface", arguments.interface]
    with open(folder / "screen.txt", "w") as screen:
        code = subprocess.run(command, stdout=screen, stderr=screen, check=False).returncode
    if not result.exists():
        lines = (folder / "screen.txt").read_text().strip().splitlines()
        return {"name": name, "passed": False, "code": code, "why": lines[-1:] or ["no output"]}
    told = json.loads(result.read_text())
    return {"name": name, "passed": code == 0 and told["passed"], "code": code,
            "why": [f"{v['text']}: {v['reason']}" for v in told["verdicts"] if not v["pass"]],
            "margins": {v["text"]: v["margin"] for v in told["verdicts"]},
            "stop_time_left_s": {v["text"]: v["time_left_s"] for v in told["verdicts"]
                                 if v.get("time_left_s") is not None},
            "done": told["done"], "remarks": told["remarks"], "top_mps": told["speed_max_mps"],
            "end": told["outcome"]["text"]}


def tell(outcome):
    print(f"{'PASS' if outcome['passed'] else 'FAIL'}  {outcome['name']:<29} "
          f"top {outcome.get('top_mps', 0):4.1f} m/s; {outcome.get('end', 'no result')}",
          flush=True)
    for line in outcome["why"] + outcome.get("remarks", []):
        print(f"      {line}", flush=True)


def points(arguments):
    for k in range(arguments.points):
        kill = FAST_AT_S + k * LAP_S / arguments.points
        name = f"killed_at_{kill:.0f}_s"
        folder = arguments.out / name
        folder.mkdir(parents=True, exist_ok=True)
        scenario = folder / f"{name}.yaml"
        scenario.write_text(POINT.format(name=name, kill=kill, end=kill + STOP_S))
        yield name, scenario


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("--interface", default="")
    parser.add_argument("--only", action="append", default=[])
    parser.add_argument("--points", type=int, default=8)
    parser.add_argument("--out", type=pathlib.Path, default=pathlib.Path("out/process_faults"))
    arguments = parser.parse_args()
    unknown = set(arguments.only) - set(SCENARIOS + RADIO)
    if unknown:
        parser.error(f"--only: no such run: {', '.join(sorted(unknown))}")
    names = [name for name in SCENARIOS + RADIO if name in (arguments.only or SCENARIOS)]
    wanted = [(name, pathlib.Path("hil/scenarios") / f"{name}.yaml") for name in names]
    outcomes = []
    for name, scenario in wanted + list(points(arguments)):
        if arguments.interface.startswith("unix:") and name in GUEST_ONLY:
            print(f"left out: {name}, which is carried out in the guest only")
            continue
        outcomes.append(run(arguments, name, scenario))
        tell(outcomes[-1])
    (arguments.out / "process_faults.json").write_text(json.dumps(outcomes, indent=1) + "\n")
    failed = [o["name"] for o in outcomes if not o["passed"]]
    print(f"{len(outcomes) - len(failed)} of {len(outcomes)} hold" +
          (f"; not: {', '.join(failed)}" if failed else ""))
    return 1 if failed or not outcomes else 0


if __name__ == "__main__":
    sys.exit(main())
