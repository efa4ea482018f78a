"""Cars in the trunk's output, and how many of the true ones they are: the rules of
vehicle/autonomy/perception/lidar/pillars/pillar_decoder.hpp, written a second time.

SPDX-License-Identifier: Apache-2.0
"""
import numpy as np

from scenes import FIRST_M
from targets import CAR_M, CELL, RETURNS_LEAST

PAIR_M = 2.5
OVERLAP = 0.9  # of a car's length and width: closer, two are one
BOUNDS_M = (0.0, 60.0, 100.0)


def decode(planes, confidence_least=0.5):
    """Rows of ahead_m, n_m, yaw_rad, length_m, width_m, confidence; the surest first."""
    boxes = []
    for row, column, confidence in peaks_of(planes[0], confidence_least):
        at, (_, ahead, left, length, width, sine, cosine) = around(planes, row, column)
        at = (at + 0.5 + (ahead, left)) * CELL + FIRST_M
        size = CAR_M * np.exp([length, width])
        boxes.append([*at, 0.5 * np.arctan2(sine, cosine), *size, confidence])
    kept = []
    for box in sorted(boxes, key=lambda b: -b[5]):
        if not any(is_same_place(other, box) for other in kept):
            kept.append(box)
    return np.array(kept).reshape(-1, 6)


def peaks_of(logits, confidence_least):
    """Row, column and confidence where the figure is the greatest of its cell and those around."""
    logit = logits.astype(np.float64)
    rows, columns = logit.shape
    padded = np.full((rows + 2, columns + 2), -np.inf)
    padded[1:-1, 1:-1] = logit
    around = np.stack([padded[r : r + rows, c : c + columns] for r in range(3) for c in range(3)])
    least = np.log(confidence_least / (1 - confidence_least))
    peaks = (logit >= around.max(axis=0)) & (logit >= least)
    return [(r, c, 1 / (1 + np.exp(-logit[r, c]))) for r, c in zip(*np.nonzero(peaks))]


def around(planes, row, column):
    """Means over the cell and those around it, by their confidence: row and column, the figures."""
    part = (slice(max(row - 1, 0), row + 2), slice(max(column - 1, 0), column + 2))
    of_cells = planes[(slice(None), *part)].astype(np.float64)
    share = 1 / (1 + np.exp(-of_cells[0]))
    share /= share.sum()
    places = np.mgrid[: planes.shape[1], : planes.shape[2]][(slice(None), *part)]
    return (places * share).sum(axis=(1, 2)), (of_cells * share).sum(axis=(1, 2))


def is_same_place(car, other):
    ahead, left = other[0] - car[0], other[1] - car[1]
    cosine, sine = np.cos(car[2]), np.sin(car[2])
    return (
        abs(ahead * cosine + left * sine) < OVERLAP * car[3]
        and abs(left * cosine - ahead * sine) < OVERLAP * car[4]
    )


class Score:
    """By distance along the track: cars with enough returns, those found, their errors."""

    def __init__(self):
        self.cars, self.found = np.zeros(2, int), np.zeros(2, int)
        self.squares_m2 = np.zeros(2)
        self.false, self.scenes = 0, 0

    def add(self, true_cars, boxes):
        self.scenes += 1
        pairs = sorted(
            (np.hypot(*(box[:2] - car[:2])), t, b)
            for t, car in enumerate(true_cars)
            for b, box in enumerate(boxes)
        )
        car_of, taken = {}, {}
        for apart_m, t, b in pairs:
            if apart_m < PAIR_M and t not in taken and b not in car_of:
                car_of[b], taken[t] = t, apart_m
        self.false += len(boxes) - len(car_of)
        for t, car in enumerate(true_cars):
            k = np.searchsorted(BOUNDS_M, abs(car[0]), side="right") - 1
            if car[5] < RETURNS_LEAST or k > 1:
                continue
            self.cars[k] += 1
            if t in taken:
                self.found[k] += 1
                self.squares_m2[k] += taken[t] ** 2

    def figures(self):
        share = self.found / np.maximum(self.cars, 1)
        rms_m = np.sqrt(self.squares_m2 / np.maximum(self.found, 1))
        names = ("to_60_m", "to_100_m")
        return {
            "found": dict(zip(names, share.round(4).tolist())),
            "position_rms_m": dict(zip(names, rms_m.round(3).tolist())),
            "false_per_sweep": round(self.false / max(self.scenes, 1), 4),
            "cars": self.cars.tolist(),
            "sweeps": self.scenes,
        }
