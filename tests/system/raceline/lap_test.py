#!/usr/bin/env python3
"""Lap times against a profile of our own: lap_test.py PROGRAM TREE

Lines of the banks of the tracks that ship, and of the circuit of circuit.py, on warm and on cold
tyres: the lap of envelope.py on the exported table and on the points of the bank takes the
same time to a millisecond. A bank whose speeds the tyres do not carry is refused.
"""
# SPDX-License-Identifier: Apache-2.0
import json
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np

import circuit
from envelope import Envelope, lap

PROGRAM, TREE = sys.argv[1], Path(sys.argv[2])
CAR = TREE / "vehicle/config/cars/av21.yaml"
TRACKS = TREE / "vehicle/config/tracks"
LAP_OFF_S = 1e-3
SPEED_OFF_MPS = 1e-2   # a line of the file has its curvature to 1e-9 1/m
PIT_MPS = 20.1         # the limit of the tracks that ship


def expect(condition, what):
    if not condition:
        sys.exit(f"FAILED: {what}")


def program(track, *arguments):
    return subprocess.run([PROGRAM, track, "--car", CAR, *arguments], capture_output=True,
                          text=True, timeout=60)


def compare(track, folder, names, *tyres):
    bank_file, table = folder / "bank.json", folder / "envelope.csv"
    done = program(track, "--out", bank_file, "--envelope", table, *tyres)
    expect(done.returncode == 0, done.stderr)
    bank, envelope = json.loads(bank_file.read_text()), Envelope(table)
    lines = [line for line in bank["lines"] if not names or line["name"] in names]
    expect(len(lines) >= len(names) and lines, f"{track}: lines are missing")
    for line in lines:
        name = f"{track.stem} {' '.join(tyres)} {line['name']}"
        points = np.array(line["points"])
        cap = None
        if line["region"] == "pit":  # in the pit lane the program drives at its limit
            cap = np.where(points[:, 5] <= PIT_MPS + 1e-6, PIT_MPS, np.inf)
            expect(np.count_nonzero(cap == PIT_MPS) > 300, f"{name}: no pit lane")
        speed, time = lap(envelope, points[:, 3], points[:, 4], line["length_m"] / len(points), cap)
        worst = np.max(np.abs(speed - points[:, 5]))
        print(f"{name:45s} lap {line['lap_s']:.4f} s, ours {time:.4f} s, speeds within {worst:.1e}")
        expect(abs(time - line["lap_s"]) <= LAP_OFF_S, f"{name}: {line['lap_s']} s and {time} s")
        expect(worst <= SPEED_OFF_MPS, f"{name}: a speed is {worst} m/s off")
    return bank_file


def refuse_too_fast(track, bank_file):
    """A speed a little above what the tyres carry, at the slowest point of a line."""
    bank = json.loads(bank_file.read_text())
    line = bank["lines"][3]
    slowest = min(range(len(line["points"])), key=lambda i: line["points"][i][5])
    line["points"][slowest][5] += 0.5
    bank_file.write_text(json.dumps(bank))
    done = program(track, "--check", bank_file)
    station = slowest * line["length_m"] / len(line["points"])
    expect(done.returncode == 2, done.stdout)
    expect(f"{line['name']}: s = {station:.1f} m: error: a speed of "
           f"{line['points'][slowest][5]:.3f} m/s needs " in done.stderr, done.stderr)
    print("refused: " + done.stderr.strip())


def main():
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        track = folder / "circuit.yaml"
        track.write_text(circuit.yaml_text())
        compare(TRACKS / "lvms.yaml", folder, [])
        compare(TRACKS / "lvms.yaml", folder, ["inner/centre", "outer/apex"], "--tyre-c", "30")
        for other in ("ims.yaml", "tms.yaml"):
            compare(TRACKS / other, folder, ["outer/apex", "track/minimum_curvature", "pit/centre"])
        compare(track, folder, ["outer/apex"], "--tyre-c", "55")
        bank_file = compare(track, folder, [])
        done = program(track, "--check", bank_file)
        expect(done.returncode == 0, done.stderr)
        done = program(track, "--tyre-c", "40", "--check", bank_file)
        expect(done.returncode == 2 and " m/s2 " in done.stderr, "warm speeds on cold tyres")
        refuse_too_fast(track, bank_file)


main()
