#!/usr/bin/python3
"""Gains of the lateral law lqr_ff by SciPy, for lqr_gains_test.cpp.

In, by lines: mass, yaw inertia, axle distances, cornering stiffnesses; delay in ticks, lag, share
of the stiffness; then a speed and its weights each. Out, one line for a speed: gains of e1, e1',
e2, e2', the angle of the road wheels, and the commands within the delay, newest first.
"""
# SPDX-License-Identifier: Apache-2.0
import sys

import numpy as np
from scipy.linalg import expm, solve_continuous_are

TICK_S = 0.01
MASS, INERTIA, FRONT, REAR, FRONT_SLOPE, REAR_SLOPE = map(float, sys.stdin.readline().split())
DELAY, LAG, SHARE = map(float, sys.stdin.readline().split())
front, rear = SHARE * FRONT_SLOPE, SHARE * REAR_SLOPE

for line in sys.stdin:
    v, turn, angle = map(float, line.split())
    # Lateral speed and yaw rate of the single track, Rajamani eq. 2.31; then e1' = vy + v e2.
    track = np.array([
        [-(front + rear) / MASS / v, -v - (front * FRONT - rear * REAR) / MASS / v],
        [-(front * FRONT - rear * REAR) / INERTIA / v,
         -(front * FRONT**2 + rear * REAR**2) / INERTIA / v]])
    a = np.zeros((5, 5))  # e1, e2, vy, r, wheels
    a[0, 1], a[0, 2], a[1, 3] = v, 1.0, 1.0
    a[2:4, 2:4] = track
    a[2, 4], a[3, 4], a[4, 4] = front / MASS, front * FRONT / INERTIA, -1.0 / LAG
    b = np.array([[0, 0, 0, 0, 1.0 / LAG]]).T
    q = np.diag([1.0, 0.0, 0.0, turn * v * v, 0.0])
    x = solve_continuous_are(a, b, q, np.array([[angle]]))
    k = (b.T @ x / angle)[0]
    whole = expm(TICK_S * np.block([[a, b], [np.zeros((1, 6))]]))
    tick, held = whole[:5, :5], whole[:5, 5]
    sent = []
    for _ in range(int(DELAY)):
        sent.append(k @ held)
        k = k @ tick
    # In e1, e1', e2, e2': vy = e1' - v e2.
    print(k[0], k[2], k[1] - v * k[2], k[3], k[4], *sent)
