"""The envelope that pitwall-raceline exports, and a lap on it, written anew for the tests.

Limits are interpolated from the table; a lap is the greatest profile that no corner, no engine and
no brake forbids. It is found by lowering speeds until none has to be lowered any more, in any order
that comes, not in the order of the program.
"""
# SPDX-License-Identifier: Apache-2.0
import math

import numpy as np

G = 9.80665


class Envelope:
    """Largest lateral demand, acceleration and deceleration by speed, bank and demand."""

    def __init__(self, path):
        self.head, rows = {}, []
        for line in path.read_text().splitlines():
            if line.startswith("#"):
                words = line[1:].split()
                try:
                    self.head[words[0]] = [float(word) for word in words[1:]]
                except ValueError:
                    pass  # a sentence
            elif not line.startswith("speed_mps"):
                rows.append([float(cell) for cell in line.split(",")])
        rows = np.array(rows)
        self.speeds, self.banks = np.unique(rows[:, 0]), np.unique(rows[:, 1])
        shape = (len(self.speeds), len(self.banks), -1)
        lateral = rows[:, 2].reshape(shape)
        self.most = lateral[:, :, -1]
        usable = np.argwhere(self.most > 1.0)[0]
        self.shares = lateral[tuple(usable)] / self.most[tuple(usable)]
        self.accel, self.brake = rows[:, 3].reshape(shape), rows[:, 4].reshape(shape)
        self.speed_max = self.head["speed_max_mps"][0]
        self.drag = self.head["drag_per_m"][0]
        self.shift_s = self.head.get("shift_s", [0.0])[0]
        self.up = self.head.get("up_above_mps", [])
        self.down = self.head.get("down_below_mps", [])

    @staticmethod
    def between(rows, value):
        """Row below, and the share of the way to the next, of each value."""
        if len(rows) == 1:
            return np.zeros(np.shape(value), int), np.zeros(np.shape(value))
        i = np.clip(np.searchsorted(rows, value, side="right") - 1, 0, len(rows) - 2)
        return i, np.clip((value - rows[i]) / (rows[i + 1] - rows[i]), 0.0, 1.0)

    def lateral(self, speed, curvature, bank):
        return speed**2 * curvature * np.cos(bank) - G * np.sin(bank)

    def largest(self, speed, curvature, bank):
        demand = self.lateral(speed, curvature, bank)
        i, t = self.between(self.speeds, speed)
        j, u = self.between(self.banks, np.where(demand < 0.0, -bank, bank))
        k = np.minimum(j + 1, len(self.banks) - 1)
        low = self.most[i, j] * (1 - u) + self.most[i, k] * u
        high = self.most[i + 1, j] * (1 - u) + self.most[i + 1, k] * u
        return low * (1 - t) + high * t

    def limits(self, speed, curvature, bank):
        """Acceleration and deceleration."""
        demand = self.lateral(speed, curvature, bank)
        most = self.largest(speed, curvature, bank)
        share = np.minimum(np.abs(demand) / np.maximum(most, 1e-300), 1.0)
        i, t = self.between(self.speeds, speed)
        j, u = self.between(self.banks, np.where(demand < 0.0, -bank, bank))
        k = np.minimum(j + 1, len(self.banks) - 1)
        m, w = self.between(self.shares, share)
        found = []
        for table in (self.accel, self.brake):
            def at(row, column):
                return table[row, column, m] * (1 - w) + table[row, column, m + 1] * w
            low = at(i, j) * (1 - u) + at(i, k) * u
            high = at(i + 1, j) * (1 - u) + at(i + 1, k) * u
            found.append(low * (1 - t) + high * t)
        return found

    def corner_speeds(self, curvature, bank):
        """By bisection, from the speed at which gravity turns the car."""
        with np.errstate(divide="ignore", invalid="ignore"):
            neutral = np.sqrt(np.where(curvature * bank > 0.0, G * np.tan(bank) / curvature, 0.0))
        good = np.minimum(neutral, self.speed_max)
        bad = np.full_like(good, self.speed_max)

        def carried(v):
            return np.abs(self.lateral(v, curvature, bank)) <= self.largest(v, curvature, bank)
        everywhere = carried(bad)
        for _ in range(45):
            middle = 0.5 * (good + bad)
            is_good = carried(middle)
            good, bad = np.where(is_good, middle, good), np.where(is_good, bad, middle)
        return np.where(everywhere, self.speed_max, good)


def lap(envelope, curvature, bank, step, cap=None, with_shifts=True):
    """Speeds at the points and the time of the lap."""
    count = len(curvature)
    limit = envelope.corner_speeds(curvature, bank)
    if cap is not None:
        limit = np.minimum(limit, cap)
    # Brakes: all points at once, as often as any speed falls.
    while True:
        after = np.roll(limit, -1)
        brake = envelope.limits(after, np.roll(curvature, -1), np.roll(bank, -1))[1]
        lowered = np.minimum(limit, np.sqrt(after**2 + 2.0 * step * brake))
        if np.max(limit - lowered) < 1e-10:
            break
        limit = lowered
    # Drive, from the slowest point, with the gears on the way.
    start = int(np.argmin(limit))
    speed = np.array(limit)
    for _ in range(60):
        begin, gear, cut_left = speed[start], 1 + sum(speed[start] > up for up in envelope.up), 0.0
        for k in range(count):
            i, after = (start + k) % count, (start + k + 1) % count
            v = speed[i]
            accel = float(envelope.limits(v, curvature[i], bank[i])[0])
            lasts = step / v
            cut = min(cut_left, lasts)
            cut_left -= cut
            net = (accel * (lasts - cut) - envelope.drag * v * v * cut) / lasts
            speed[after] = min(limit[after], math.sqrt(max(v * v + 2.0 * step * net, 1.0)))
            while with_shifts and gear <= len(envelope.up) and speed[after] > envelope.up[gear - 1]:
                gear, cut_left = gear + 1, cut_left + envelope.shift_s
            while gear > 1 and envelope.down and speed[after] < envelope.down[gear - 2]:
                gear, cut_left = gear - 1, 0.0
        if abs(begin - speed[start]) < 1e-9:
            break
    return speed, float(np.sum(2.0 * step / (speed + np.roll(speed, -1))))
