#!/usr/bin/env python3
"""long_sweeps.py PITWALL_HIL: real sweeps of many cases, on this machine

The same event logs in 100 of 100 runs, whatever the number of processes; and a case of a thousand
costs what one of a hundred costs, within a tenth, in processor time. Exit code 1: not so.
"""
# SPDX-License-Identifier: Apache-2.0
import resource
import sqlite3
import subprocess
import sys
import tempfile
from pathlib import Path

PROGRAM = sys.argv[1]
TREE = Path(__file__).resolve().parents[3]
PROCESSES, CASES = (1, 2, 3, 5, 8), 20
MANY, FEW = 1000, 100
SHARE = 0.1
PLAN = """schema: 1
name: long
scenario: tests/system/sweep/any_speed.yaml
seed: {seed}
combine: draw
cases: {cases}
parameters:
  - {{path: duration_s, values: [{duration_s}]}}
  - {{path: perturb.wind_mps, from: 0, to: 8}}
  - {{path: perturb.mass_kg, from: -50, to: 100}}
"""


def processor_s():
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def sweep(folder, name, cases, *options, duration_s, seed=1):
    """Runs it; the file of its results, and its seconds of processor."""
    plan = folder / f"{name}.yaml"
    plan.write_text(PLAN.format(seed=seed, cases=cases, duration_s=duration_s))
    out, before = folder / name, processor_s()
    ran = subprocess.run([PROGRAM, "sweep", str(plan), "--out", str(out), "--pages", "0",
                          *options], cwd=TREE,
                         text=True, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, check=False)
    took = processor_s() - before
    if ran.returncode not in (0, 1):  # 1: a case failed
        sys.exit(f"FAILED: {ran.stdout}")
    file = out / "results.sqlite"
    with sqlite3.connect(file) as results:
        found = results.execute("SELECT count(*), count(digest) FROM run").fetchone()
    if found != (cases, cases):
        sys.exit(f"FAILED: {found[0]} results and {found[1]} logs of {cases} cases")
    return file, took


def same_logs(folder):
    of, files = {}, set()
    for processes in PROCESSES:
        file, _ = sweep(folder, f"with_{processes}", CASES, "--processes", str(processes),
                        duration_s=30)
        with sqlite3.connect(file) as results:
            for number, digest in results.execute("SELECT number, digest FROM run"):
                of.setdefault(number, []).append(digest)
        files.add(file.read_bytes())
    runs = sum(map(len, of.values()))
    same = sum(len(digests) for digests in of.values() if len(set(digests)) == 1)
    print(f"{same} of {runs} runs have the event log of their case, with {PROCESSES} processes; "
          f"{len(files)} kind of result file", flush=True)
    return same == runs and len(of) == CASES and len(files) == 1


def same_cost(folder):
    each = {}
    for name, cases in (("few", FEW), ("many", MANY), ("few_again", FEW)):
        _, took = sweep(folder, name, cases, duration_s=6, seed=2)
        each.setdefault(cases, []).append(1e3 * took / cases)
        print(f"{cases} cases: {each[cases][-1]:.1f} ms of a processor each", flush=True)
    ratio = each[MANY][0] / (sum(each[FEW]) / len(each[FEW]))
    print(f"one of {MANY} costs {ratio:.3f} of one of {FEW} ({1 - SHARE:.1f} to {1 + SHARE:.1f})")
    return abs(ratio - 1.0) <= SHARE


def main():
    with tempfile.TemporaryDirectory(prefix="pitwall-sweeps-") as name:
        holds = [same_logs(Path(name)), same_cost(Path(name))]
    sys.exit(0 if all(holds) else 1)


main()
