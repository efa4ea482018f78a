"""What the camera's trunk should say of an image, cars in what it says, and their score. The rules
of vehicle/autonomy/perception/camera/image_decoder.hpp, written a second time.

source  X. Zhou et al.: Objects as points, 2019, sections 3 and 4
SPDX-License-Identifier: Apache-2.0
"""
import numpy as np
import torch

from camera_network import STRIDE
from camera_scenes import COLUMNS, ROWS
from decoding import around, peaks_of
from targets import loss_of

SIZE_PX = np.array([32.0, 16.0])  # of a box: its logarithm is 0
UPRIGHT_PX = 16.0
PIXELS_LEAST = 30  # of a car that is asked for
SPREAD = 0.12  # of a car's peak, in its box, at least one cell
NEAR = 0.15  # of its box, about the middle: cells that tell of the car; at least one around it
BOUNDS_M = (0.0, 60.0, 100.0)
PAIR = 0.6  # of the true box: further off, a box is of another car


def targets(cars, rows, columns, first_row_px=0, first_column_px=0):
    """planes: 0 peak of each car, 1 where it is judged, 2 to 6 the figures, 7 where these are."""
    planes = np.zeros((8, rows, columns), np.float32)
    planes[1] = 1.0
    row, column = np.mgrid[0:rows, 0:columns]
    for u_px, v_px, width_px, height_px, _, pixels, upright_px in sorted(cars, key=lambda c: c[5]):
        at = np.array([v_px - first_row_px, u_px - first_column_px]) / STRIDE
        size = np.array([height_px, width_px]) / STRIDE
        away = np.stack([row + 0.5 - at[0], column + 0.5 - at[1]])
        is_within = (np.abs(away) < np.maximum(0.5 * size, 2.0)[:, None, None]).all(axis=0)
        centre = np.floor(at).astype(int)
        if not (0 <= centre[0] < rows and 0 <= centre[1] < columns) or pixels < PIXELS_LEAST:
            planes[1][is_within] = 0.0
            continue
        planes[1][centre[0], centre[1]] = 1.0
        spread = np.maximum(SPREAD * size, 0.8)
        off = np.stack([row - centre[0], column - centre[1]])
        peak = np.exp(-0.5 * ((off[0] / spread[0]) ** 2 + (off[1] / spread[1]) ** 2))
        planes[0] = np.maximum(planes[0], peak)
        near = (np.abs(off) <= np.maximum(NEAR * size, 1.0)[:, None, None]).all(axis=0)
        planes[2][near], planes[3][near] = -away[1][near], -away[0][near]
        planes[4][near], planes[5][near] = np.log(np.array([width_px, height_px]) / SIZE_PX)
        planes[6][near] = np.log(upright_px / UPRIGHT_PX)
        planes[7][near] = 1.0
    return planes


def loss(out, target):
    return loss_of(out, target, (0.5, 0.5, 0.5, 0.5, 2.0))


def decode(planes, confidence_least=0.5):
    """Rows of u_px, v_px, width_px, height_px, upright_px, confidence; the surest first."""
    boxes = []
    for row, column, confidence in peaks_of(planes[0], confidence_least):
        at, (_, u, v, width, height, upright) = around(planes, row, column)
        at = (at[::-1] + 0.5 + (u, v)) * STRIDE
        size = SIZE_PX * np.exp([width, height])
        boxes.append([*at, *size, UPRIGHT_PX * np.exp(upright), confidence])
    kept = []
    for box in sorted(boxes, key=lambda b: -b[5]):
        if not any(is_same_place(other, box) for other in kept):
            kept.append(box)
    return np.array(kept).reshape(-1, 6)


def is_same_place(car, other):
    """Whether the middle of one lies in the inner half of the other."""
    return (np.abs(np.subtract(other[:2], car[:2])) < 0.5 * np.multiply(0.5, car[2:4])).all()


class Score:
    """By depth: cars with enough pixels, those found, their errors."""

    def __init__(self):
        self.cars, self.found = np.zeros(2, int), np.zeros(2, int)
        self.depth_squares, self.side_squares_px2 = np.zeros(2), np.zeros(2)
        self.false, self.scenes = 0, 0

    def add(self, true_cars, boxes):
        self.scenes += 1
        pairs = sorted(
            (np.abs((box[:2] - car[:2]) / np.maximum(car[2:4], 8.0)).max(), t, b)
            for t, car in enumerate(true_cars)
            for b, box in enumerate(boxes)
        )
        car_of, taken = {}, {}
        for apart, t, b in pairs:
            if apart < PAIR and t not in taken and b not in car_of:
                car_of[b], taken[t] = t, b
        self.false += len(boxes) - len(car_of)
        for t, car in enumerate(true_cars):
            k = np.searchsorted(BOUNDS_M, car[4], side="right") - 1
            if not is_asked_for(car) or k > 1:
                continue
            self.cars[k] += 1
            if t in taken:
                box = boxes[taken[t]]
                self.found[k] += 1
                self.depth_squares[k] += (car[6] / box[4] - 1.0) ** 2
                self.side_squares_px2[k] += (box[0] - car[0]) ** 2

    def figures(self):
        def of_both(values, digits):
            return dict(zip(("to_60_m", "to_100_m"), values.round(digits).tolist()))

        found = np.maximum(self.found, 1)
        return {
            "found": of_both(self.found / np.maximum(self.cars, 1), 4),
            "depth_rms": of_both(np.sqrt(self.depth_squares / found), 4),
            "side_rms_px": of_both(np.sqrt(self.side_squares_px2 / found), 3),
            "false_per_image": round(self.false / max(self.scenes, 1), 4),
            "cars": self.cars.tolist(),
            "images": self.scenes,
        }


def is_asked_for(car):
    """With enough pixels, and its middle in the image."""
    return car[5] >= PIXELS_LEAST and 0 <= car[0] < COLUMNS and 0 <= car[1] < ROWS
