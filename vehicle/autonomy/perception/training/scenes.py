"""Scenes of `pitwall-hil scenes` for training: input planes and true cars, as tensors.

in   folders of arrays; their shapes: hil/scenes/pillar_scenes.hpp
out  Scenes: planes (features x rows x columns, float32), cars (ahead_m, n_m, yaw_rad, length_m,
     width_m, returns)
SPDX-License-Identifier: Apache-2.0
"""
import pathlib
import sys

import numpy as np

ROWS, COLUMNS = 768, 96
CELL_M = np.array([0.4, 0.25])  # along, across
FIRST_M = np.array([-102.4, -12.0])  # of the first row and column
LEFT = 5  # feature: mean place in the cell, across


def refuse(why):
    print(f"error: {why}", file=sys.stderr)
    sys.exit(2)


def load(folder, name, memory_map=False):
    try:
        return np.load(pathlib.Path(folder) / f"{name}.npy", "r" if memory_map else None)
    except (OSError, ValueError) as error:
        refuse(error)


class Scenes:
    def __init__(self, folders):
        def joined(name):
            return np.concatenate([load(folder, name) for folder in folders])

        counts = joined("counts").astype(np.int64)
        self.cells = joined("cells").astype(np.int64)
        self.features = joined("features")
        self.true_cars = joined("cars")
        scales = [load(folder, "scales") for folder in folders]
        self.least, self.step = scales[0].T
        self.begin = np.concatenate([np.zeros((1, 2), np.int64), np.cumsum(counts, axis=0)])
        if tuple(self.begin[-1]) != (len(self.cells), len(self.true_cars)):
            refuse(f"{folders}: counts.npy does not fit the other arrays")
        if any((scale != scales[0]).any() for scale in scales):
            refuse(f"{folders}: features of different scales")

    def __len__(self):
        return len(self.begin) - 1

    def cars(self, i):
        return self.true_cars[self.begin[i, 1] : self.begin[i + 1, 1]]

    def planes(self, i):
        of_scene = slice(self.begin[i, 0], self.begin[i + 1, 0])
        planes = np.zeros((len(self.least), ROWS * COLUMNS), np.float32)
        planes[:, self.cells[of_scene]] = (
            self.least[:, None] + self.features[of_scene].T * self.step[:, None]
        )
        return planes.reshape(-1, ROWS, COLUMNS)


def mirrored(planes, cars):
    """The same scene with left and right exchanged."""
    planes = planes[:, :, ::-1].copy()
    planes[LEFT] = -planes[LEFT]
    cars = cars.copy()
    cars[:, 1:3] = -cars[:, 1:3]
    return planes, cars
