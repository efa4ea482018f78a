"""Images of `pitwall-hil scenes --camera` for training: colours and true cars, as tensors.

in   folders of arrays; their shapes: hil/scenes/camera_scenes.hpp
out  CameraScenes: planes (3 x rows x columns, float32, 0 is mid-grey), cars (u_px, v_px, width_px,
     height_px, depth_m, pixels, upright_px)
SPDX-License-Identifier: Apache-2.0
"""
import pathlib

import numpy as np

from scenes import load

ROWS, COLUMNS = 320, 672  # of an image
MID, STEP = 128.0, 64.0  # of a colour's bytes
WIDTH = 0  # column of a car


class CameraScenes:
    def __init__(self, folders):
        self.images = []
        for folder in folders:
            for name in sorted(path.stem for path in pathlib.Path(folder).glob("images_*.npy")):
                of_file = load(folder, name, memory_map=True)
                self.images += list(of_file.reshape(-1, ROWS, COLUMNS, 3))
        counts = np.concatenate([load(folder, "counts").ravel() for folder in folders])
        self.true_cars = np.concatenate([load(folder, "cars").reshape(-1, 7) for folder in folders])
        self.begin = np.concatenate([[0], np.cumsum(counts.astype(np.int64))])

    def __len__(self):
        return len(self.images)

    def cars(self, i):
        return self.true_cars[self.begin[i] : self.begin[i + 1]]

    def planes(self, i, first_row=0, first_column=0, rows=ROWS, columns=COLUMNS):
        below, right = first_row + rows, first_column + columns
        of_part = self.images[i][first_row:below, first_column:right]
        return ((of_part.astype(np.float32) - MID) / STEP).transpose(2, 0, 1)


def mirrored(planes, cars):
    """The same image with left and right exchanged."""
    cars = cars.copy()
    cars[:, 0] = planes.shape[2] - 1 - cars[:, 0]
    return planes[:, :, ::-1].copy(), cars
