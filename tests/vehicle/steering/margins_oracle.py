#!/usr/bin/python3
"""Margins of the steering law on linear cars, for margins_test.cpp.

In, by lines: constants of the car; parameters of the law; one case each. Out, one line for a case:
phase margin [rad], gain up, gain down, delay [s], largest sensitivity. The law is that of
vehicle/steering/path_steering.hpp on a straight as transfer functions of the tick, the car its
differential equations with the forces of the tyres as states.
"""
# SPDX-License-Identifier: Apache-2.0
import sys

import numpy as np
from scipy.optimize import brentq, minimize_scalar
from scipy.signal import cont2discrete

TICK_S = 0.01
MASS, INERTIA, FRONT, REAR, REAR_SLOPE, FRICTION, RELAXATION, COMPUTER_S = map(
    float, sys.stdin.readline().split())
(WHEELBASE, UNDERSTEER, W, DAMPING, LEAD, GAIN_SHARE, OBSERVER_S, OBSERVER_SHARE, TRIM,
 LAG_S) = map(float, sys.stdin.readline().split())
SPEED_OF_LEAD = 25.0


def low_pass(time_s):
    return 1.0 - np.exp(-TICK_S / time_s)


def car(v, understeer, friction, front_share, rear_share, lag_s):
    """Steering command to distance, course and yaw rate, held over the tick."""
    rear = REAR_SLOPE * friction / FRICTION
    front = front_share / (understeer * (FRONT + REAR) / MASS / REAR + FRONT / REAR / rear)
    rear *= rear_share
    rate = v / RELAXATION
    # y, yaw, lateral speed, yaw rate, force in front, force behind, angle
    a = np.array([
        [0, v, 1, 0, 0, 0, 0],
        [0, 0, 0, 1, 0, 0, 0],
        [0, 0, 0, -v, 1 / MASS, 1 / MASS, 0],
        [0, 0, 0, 0, FRONT / INERTIA, -REAR / INERTIA, 0],
        [0, 0, -rate * front / v, -rate * front * FRONT / v, -rate, 0, rate * front],
        [0, 0, -rate * rear / v, rate * rear * REAR / v, 0, -rate, 0],
        [0, 0, 0, 0, 0, 0, -1 / lag_s]])
    b = np.array([[0, 0, 0, 0, 0, 0, 1 / lag_s]]).T
    c = np.array([[1, 0, 0, 0, 0, 0, 0], [0, 1, 1 / v, 0, 0, 0, 0], [0, 0, 0, 1, 0, 0, 0]])
    a, b, c, _, _ = cont2discrete((a, b, c, np.zeros((3, 1))), TICK_S)

    def response(z):
        z = np.atleast_1d(z)
        return (c @ np.linalg.solve(z[:, None, None] * np.eye(7) - a, b[None]))[:, :, 0].T
    return response


def law(v, learned):
    """Of distance, course and yaw rate: three responses, the observer's own loop closed."""
    all_learned = UNDERSTEER + learned
    per_curvature = WHEELBASE + max(UNDERSTEER + GAIN_SHARE * max(learned, 0.0), 0.0) * v * v
    lead = LEAD * min(v / SPEED_OF_LEAD, 1.0)

    def response(z):
        back = 1.0 / z
        observer = OBSERVER_SHARE * low_pass(OBSERVER_S) / (1 - (1 - low_pass(OBSERVER_S)) * back)
        commanded = low_pass(LAG_S) * back / (1 - (1 - low_pass(LAG_S)) * back)
        trim = -TRIM * per_curvature * W * W / v**2 * TICK_S * back / (1 - back)
        distance = -per_curvature * W * W / v**2 + trim
        course = -per_curvature * (W * W * lead * v + 2 * DAMPING * W * v) / v**2
        yaw_rate = (-per_curvature * 2 * DAMPING * W * v * lead / v**2
                    - observer * (WHEELBASE / v + all_learned * v))
        return np.array([distance, course + 0 * z, yaw_rate]) / (1 - observer * commanded)
    return response


def margins(loop):
    w = np.geomspace(0.005, np.pi / TICK_S, 6000)
    at = loop(w)

    def one(f):
        return lambda x: float(f(loop(np.array([x]))[0]))

    def crossings(f):
        values = f(at)
        return [brentq(one(f), w[i], w[i + 1], xtol=1e-12)
                for i in np.flatnonzero(np.sign(values[:-1]) != np.sign(values[1:]))]
    lags = [(x, np.angle(-loop(np.array([x]))[0])) for x in crossings(lambda g: np.abs(g) - 1)]
    phase = min(abs(lag) for _, lag in lags)
    delay = min((lag % (2 * np.pi)) / x for x, lag in lags)
    real = [loop(np.array([x]))[0].real for x in crossings(np.imag)]
    factors = [-1 / r for r in real if r < 0]
    up = min((f for f in factors if f > 1), default=np.inf)
    down = max((f for f in factors if f < 1), default=0.0)
    peak = int(np.argmin(np.abs(1 + at)))
    nearest = minimize_scalar(one(lambda g: np.abs(1 + g)), method="bounded",
                              bounds=(w[max(peak - 1, 0)], w[min(peak + 1, len(w) - 1)]),
                              options={"xatol": 1e-10})
    return phase, up, down, delay, 1 / nearest.fun


for line in sys.stdin:
    v, understeer, friction, front, rear, delay_s, lag_s, learned = map(float, line.split())
    plant = car(v, understeer, friction, front, rear, lag_s)
    steering = law(v, understeer - UNDERSTEER if learned else 0.0)
    ticks = round((delay_s + COMPUTER_S) / TICK_S)

    def loop(w):
        z = np.exp(1j * w * TICK_S)
        return -np.sum(steering(z) * plant(z), axis=0) * z**-ticks
    print(*margins(loop))
