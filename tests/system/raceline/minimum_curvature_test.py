#!/usr/bin/env python3
"""The line of minimum curvature against SciPy's: minimum_curvature_test.py PROGRAM TREE

The circuit of circuit.py is integrated here anew. SciPy moves a point on each of its normals
between the same bounds until the curvature squared, summed over the length, is least. The sum of
the program's line, where it meets the same normals, is within 1 % of that, and no bound is passed.
"""
# SPDX-License-Identifier: Apache-2.0
import json
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np
from scipy.optimize import lsq_linear

import circuit

PROGRAM, TREE = sys.argv[1], Path(sys.argv[2])
STEP_M = 4.0            # between normals, about
CAR_WIDTH_M, CLEARANCE_M = 2.0, 0.3
ROUNDS_MAX = 60
SHARE = 0.01            # that the sums may differ by
BOUND_OFF_M = 0.05      # that the line may come closer to a wall than its clearance


def expect(condition, what):
    if not condition:
        sys.exit(f"FAILED: {what}")


def bends(x, y):
    """Curvature through three neighbours times the root of the length that it stands for."""
    ax, ay = x - np.roll(x, 1), y - np.roll(y, 1)
    bx, by = np.roll(ax, -1), np.roll(ay, -1)
    a, b = np.hypot(ax, ay), np.hypot(bx, by)
    curvature = 2.0 * (ax * by - ay * bx) / (a * b * np.hypot(ax + bx, ay + by))
    return curvature * np.sqrt(0.5 * (a + b))


def slopes(fun, n):
    """The Jacobian by central differences; each value depends on an offset and its neighbours."""
    count, jacobian, step = len(n), np.zeros((len(n), len(n))), 1e-5
    for first in range(3):
        columns = np.arange(first, count - count % 3, 3)
        fill(fun, n, columns, step, jacobian)
    for column in range(count - count % 3, count):
        fill(fun, n, np.array([column]), step, jacobian)
    return jacobian


def fill(fun, n, columns, step, jacobian):
    change = np.zeros(len(n))
    change[columns] = step
    slope = (fun(n + change) - fun(n - change)) / (2.0 * step)
    for offset in (-1, 0, 1):
        rows = (columns + offset) % len(n)
        jacobian[rows, columns] = slope[rows]


def optimum(x, y, yaw, low, high):
    """Bounded linear least squares again and again, until no slope leads inward."""
    def fun(n):
        return bends(x - n * np.sin(yaw), y + n * np.cos(yaw))

    n = np.full(len(x), 0.5 * (low + high))
    start = np.abs(slopes(fun, n).T @ fun(n)).max()
    for _ in range(ROUNDS_MAX):
        jacobian = slopes(fun, n)
        found = lsq_linear(jacobian, jacobian @ n - fun(n), (low, high), tol=1e-14,
                           max_iter=300)
        n = found.x
        slope = slopes(fun, n).T @ fun(n)
        inward = np.where(n <= low + 1e-3, np.minimum(slope, 0.0),
                          np.where(n >= high - 1e-3, np.maximum(slope, 0.0), slope))
        if np.abs(inward).max() < 1e-5 * start:
            return n
    sys.exit("FAILED: SciPy found no optimum")


def offsets_of(line, x, y, yaw):
    """Where the program's line meets each normal, left positive."""
    points = np.array(line["points"])[:, :2]
    after = np.roll(points, -1, axis=0)
    offsets = []
    for px, py, heading in zip(x, y, yaw):
        along = np.array([np.cos(heading), np.sin(heading)])
        left = np.array([-along[1], along[0]])
        here, then = (points - [px, py]) @ along, (after - [px, py]) @ along
        beside = (points - [px, py]) @ left
        hits = np.flatnonzero((here <= 0.0) & (then > 0.0) & (np.abs(beside) < 10.0))
        expect(len(hits) == 1, f"the line meets a normal {len(hits)} times")
        i = hits[0]
        share = here[i] / (here[i] - then[i])
        offsets.append(((1.0 - share) * (points[i] - [px, py]) +
                        share * (after[i] - [px, py])) @ left)
    return np.array(offsets)


def main():
    with tempfile.TemporaryDirectory() as folder:
        track, bank = Path(folder, "circuit.yaml"), Path(folder, "bank.json")
        track.write_text(circuit.yaml_text())
        car = Path(folder, "car.yaml")
        av21 = (TREE / "vehicle/config/cars/av21.yaml").read_text()
        car.write_text(av21.replace("\nwidth_m: 1.93", f"\nwidth_m: {CAR_WIDTH_M}"))
        expect(f"width_m: {CAR_WIDTH_M}" in car.read_text(), "the car file has no width of 1.93 m")
        done = subprocess.run([PROGRAM, track, "--car", car, "--out", bank, "--clearance",
                               str(CLEARANCE_M)], capture_output=True, text=True, timeout=60)
        expect(done.returncode == 0, done.stderr)
        lines = {line["name"]: line for line in json.loads(bank.read_text())["lines"]}
    x, y, yaw = circuit.reference_line(STEP_M)
    margin = 0.5 * CAR_WIDTH_M + CLEARANCE_M
    low, high = margin - circuit.RIGHT_M, circuit.LEFT_M - margin
    best = optimum(x, y, yaw, low, high)

    def total(n):
        return np.sum(bends(x - n * np.sin(yaw), y + n * np.cos(yaw))**2)

    ours = offsets_of(lines["track/minimum_curvature"], x, y, yaw)
    expect(ours.min() > low - BOUND_OFF_M and ours.max() < high + BOUND_OFF_M,
           f"offsets from {ours.min():.3f} to {ours.max():.3f} m, bounds {low:.3f} to {high:.3f}")
    theirs, own, centre = total(best), total(ours), total(np.full(len(x), 0.5 * (low + high)))
    print(f"curvature squared over the lap: SciPy {theirs:.6f}, ours {own:.6f} "
          f"({100.0 * (own / theirs - 1.0):+.3f} %), centre {centre:.6f}; "
          f"offsets differ by {np.sqrt(np.mean((ours - best)**2)):.3f} m rms")
    expect(abs(own / theirs - 1.0) <= SHARE, "ours is not within 1 % of SciPy's optimum")
    expect(own < centre, "ours bends more than the centre of the road")


main()
