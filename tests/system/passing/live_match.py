#!/usr/bin/env python3
"""Two full stacks race the attempts of one bracket in lockstep, live on Unix-socket buses at full
rates, and live over SocketCAN, one base station connected to both: live_match.py BENCH OUT

The match sheet's verdicts are the same in all three. At full rates the run keeps its time, no frame
is lost, and the base hears both cars under their own keys; over SocketCAN (a guest with one
processor, where bench time stands often) the verdicts alone are judged.
"""
# SPDX-License-Identifier: Apache-2.0
import json
import subprocess
import sys
from pathlib import Path

BENCH, OUT = sys.argv[1], Path(sys.argv[2]).resolve()
TREE = Path(__file__).resolve().parents[3]
MATCH = "hil/scenarios/matches/match_two_stacks.yaml"
SENSORS = "vehicle/config/sensors/av21.yaml"
PATIENCE_S = 3600
MISSED_MOST = 0.01


def run(name, *options):
    folder = OUT / name
    folder.mkdir(parents=True, exist_ok=True)
    result = folder / "run.json"
    result.unlink(missing_ok=True)
    command = [BENCH, "run", MATCH, "--json", str(result), *options]
    print(f"$ {' '.join(command)}", flush=True)
    ran = subprocess.run(command, cwd=TREE, timeout=PATIENCE_S, check=False)
    if not result.is_file():
        sys.exit(f"FAILED: {name}: code {ran.returncode}, and no result")
    return json.loads(result.read_text())


def live(name, interface):
    return run(name, "--live", "--sensors", SENSORS, "--interface", interface, "--out",
               str(OUT / name))


def verdicts(result):
    match = result["match"]
    return [(a["round_speed_mph"], a["attacker"], a["ending"], a["score"])
            for a in match["attempts"]], match["result"]


def faults_at_full_rates(result, folder):
    yield from (f"{place}: {n} frames lost" for place, n in
                [("own", result["can"]["lost"])] +
                [(o["car"], o["can"]["lost"]) for o in result["others"]] if n != 0)
    for car in [result, *result["others"]]:
        time = car["real_time"]
        if time["missed_deadlines"] > MISSED_MOST * time["ticks"]:
            yield f"{time['missed_deadlines']} of {time['ticks']} ticks missed"
    for base in (folder / "base.json", folder / "rival/base.json"):
        heard = json.loads(base.read_text())
        if heard["packets"] == 0 or heard["refused"] != 0:
            yield f"{base}: {heard['packets']} packets, {heard['refused']} refused"


def main():
    lockstep = run("lockstep")
    unix = live("unix", f"unix:{OUT}/unix/bus")
    faults = [f"unix: {fault}" for fault in faults_at_full_rates(unix, OUT / "unix")]
    socketcan = live("socketcan", "vcan0")
    for name, result in (("lockstep", lockstep), ("unix", unix), ("socketcan", socketcan)):
        print(f"{name}: {verdicts(result)}, {result['simulated_s']:.1f} s in "
              f"{result['wall_s']:.0f} s")
        if verdicts(result) != verdicts(lockstep):
            faults.append(f"{name}: the match sheet is not that of lockstep")
    if not verdicts(lockstep)[0]:
        faults.append("lockstep: no attempt was made")
    for fault in faults:
        print(f"FAILED: {fault}")
    print("ok" if not faults else f"{len(faults)} faults")
    sys.exit(1 if faults else 0)


if __name__ == "__main__":
    main()
