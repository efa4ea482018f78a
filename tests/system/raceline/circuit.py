"""A circuit for the tests of racelines: straights, hairpins and corners to both sides.

Its second half is the first turned by half a turn, so that it closes exactly. Curvature is linear
between knots; corners have ramps.
"""
# SPDX-License-Identifier: Apache-2.0
import math

import numpy as np

RAMP_M = 30.0
FINE = 400  # steps of integration between two points of the reference line
LEFT_M, RIGHT_M = 6.0, 5.0  # from the reference line to the walls
# Straight before the corner, m; turn, degrees, positive left; radius, m.
HALF = [(350.0, 150.0, 35.0), (150.0, -60.0, 60.0), (120.0, 90.0, 45.0)]


def knots():
    """Station and curvature of each knot, and the length of the lap."""
    rows, s = [], 0.0
    for straight, turn_deg, radius in HALF + HALF:
        curvature = math.copysign(1.0 / radius, turn_deg)
        arc = abs(math.radians(turn_deg)) * radius - RAMP_M  # the ramps turn half as much
        for length, here in ((straight, 0.0), (RAMP_M, curvature), (arc, curvature), (RAMP_M, 0.0)):
            s += length
            rows.append((s, here))
    length = rows.pop()[0]
    return [(0.0, 0.0)] + rows, length


def reference_line(step):
    """Points and headings at even stations, about a step apart; the last is before the first."""
    rows, length = knots()
    count = round(length / step)
    s = np.linspace(0.0, length, count * FINE + 1)
    stations, curvatures = zip(*rows, (length, 0.0))
    curvature = np.interp(s, stations, curvatures)
    ds = s[1] - s[0]
    turn = 0.5 * ds * (curvature[1:] + curvature[:-1])
    yaw = np.concatenate([[0.0], np.cumsum(turn)])
    middle = 0.5 * (yaw[1:] + yaw[:-1])
    x = np.concatenate([[0.0], np.cumsum(ds * np.cos(middle))])
    y = np.concatenate([[0.0], np.cumsum(ds * np.sin(middle))])
    if np.hypot(x[-1], y[-1]) > 0.01:
        raise ValueError(f"the circuit does not close: {x[-1]}, {y[-1]}")
    return x[:-1:FINE], y[:-1:FINE], yaw[:-1:FINE]


def yaml_text():
    rows, length = knots()
    lines = ["name: circuit", f"length_m: {length!r}",
             "datum: {latitude_deg: 45.0, longitude_deg: 9.0, height_m: 100.0}",
             "start: {x_m: 0.0, y_m: 0.0, yaw_deg: 0.0}", "knots:"]
    for s, curvature in rows:
        lines.append(f"  - {{s_m: {s!r}, curvature_per_m: {curvature!r}, bank_deg: 0.0, "
                     f"width_left_m: {LEFT_M}, width_right_m: {RIGHT_M}}}")
    return "\n".join(lines) + "\n"
