"""What the trunk should say of a scene, and how far it is off.

source  H. Law, J. Deng: CornerNet, ECCV 2018, equation 1 (focal loss); X. Zhou et al.: Objects as
        points, 2019, section 3
SPDX-License-Identifier: Apache-2.0
"""
import numpy as np
import torch

from scenes import CELL_M, FIRST_M

STRIDE = 2
CELL = STRIDE * CELL_M
CAR_M = np.array([4.92, 1.89])
SPREAD = np.array([1.2, 1.0])  # of a car's peak, in cells
RETURNS_LEAST = 5  # of a car that is asked for
NEAR = 1  # cells about the middle that tell of the car
PLACE, SIZE, TURN = slice(1, 3), slice(3, 5), slice(5, 7)


def targets(cars, rows, columns, first_row=0):
    """planes: 0 peak of each car, 1 where it is judged, 2 to 7 the figures, 8 where these are."""
    planes = np.zeros((9, rows, columns), np.float32)
    planes[1] = 1.0
    row, column = np.mgrid[0:rows, 0:columns]
    for ahead_m, n_m, yaw_rad, length_m, width_m, returns in cars:
        at = (np.array([ahead_m, n_m]) - FIRST_M) / CELL - (first_row, 0)
        centre = np.floor(at).astype(int)
        if not (0 <= centre[0] < rows and 0 <= centre[1] < columns):
            continue
        away = np.stack([row - centre[0], column - centre[1]])
        if returns < RETURNS_LEAST:
            planes[1][(np.abs(away[0]) < 5) & (np.abs(away[1]) < 4)] = 0.0
            continue
        peak = np.exp(-0.5 * ((away[0] / SPREAD[0]) ** 2 + (away[1] / SPREAD[1]) ** 2))
        planes[0] = np.maximum(planes[0], peak)
        near = (np.abs(away) <= NEAR).all(axis=0)
        planes[2][near] = at[0] - row[near] - 0.5
        planes[3][near] = at[1] - column[near] - 0.5
        planes[4][near], planes[5][near] = np.log(np.array([length_m, width_m]) / CAR_M)
        planes[6][near], planes[7][near] = np.sin(2 * yaw_rad), np.cos(2 * yaw_rad)
        planes[8][near] = 1.0
    return planes


def loss(out, target):
    return loss_of(out, target, (1.0, 1.0, 0.3, 0.3, 0.5, 0.5))


def loss_of(out, target, weights):
    """`weights`: of the figures, planes 2 to the last but one of the target."""
    peak, judged, figures, is_judged = target[:, 0], target[:, 1], target[:, 2:-1], target[:, -1:]
    logit = out[:, 0]
    car = torch.sigmoid(logit)
    is_middle = (peak == 1.0).float()
    of_middle = -nn_log_sigmoid(logit) * (1 - car) ** 2 * is_middle
    of_rest = -nn_log_sigmoid(-logit) * car**2 * (1 - peak) ** 4 * (1 - is_middle)
    count = is_middle.sum().clamp(min=1.0)
    found = ((of_middle + of_rest) * judged).sum() / count
    off = torch.abs(out[:, 1:] - figures) * is_judged
    cells = is_judged.sum().clamp(min=1.0)
    weights = out.new_tensor(weights).view(1, -1, 1, 1)
    return found + (off * weights).sum() / cells


def nn_log_sigmoid(logit):
    return torch.nn.functional.logsigmoid(logit)
