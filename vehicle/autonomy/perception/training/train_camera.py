#!/usr/bin/python3
"""Trains the camera's network on scenes of `pitwall-hil scenes --camera`.

in     --scenes FOLDER... of the training, --held-back FOLDER for the figures, --seed, --epochs
out    --out FILE.onnx, and beside it FILE.json: figures on the held-back scenes, seed, hash
cost   0.03 s an image and epoch on one processor
exit   0 written; 1 worse than 0.9 of the figures in --reference FILE.json; 2 the command line or a
       folder is wrong
SPDX-License-Identifier: Apache-2.0
"""
import numpy as np
import torch

import camera_task
from camera_network import STRIDE, CameraTrunk
from camera_scenes import COLUMNS, ROWS, CameraScenes, mirrored
from train import FALSE_MORE, SHARE, arguments, fit, judge, write

CROP_ROWS, CROP_COLUMNS = 192, 336  # of an image, drawn anew each time


def drawn_crop(scenes, i, random):
    """About a car for three of four that have one, anywhere for the rest."""
    cars = scenes.cars(i)
    middle = np.array([random.integers(0, ROWS), random.integers(0, COLUMNS)])
    if len(cars) and random.random() < 0.75:
        car = cars[random.integers(len(cars))]
        middle = car[1::-1] + random.uniform(-0.4, 0.4, 2) * (CROP_ROWS, CROP_COLUMNS)
    first = np.clip(middle - (CROP_ROWS / 2, CROP_COLUMNS / 2), 0,
                    (ROWS - CROP_ROWS, COLUMNS - CROP_COLUMNS)).astype(int)  # fmt: skip
    planes = scenes.planes(i, *first, CROP_ROWS, CROP_COLUMNS)
    cars = cars.copy()
    cars[:, :2] -= first[::-1]
    if random.random() < 0.5:
        planes, cars = mirrored(planes, cars)
    planes = planes * np.float32(random.uniform(0.85, 1.15)) + np.float32(random.uniform(-0.2, 0.2))
    return planes, camera_task.targets(cars, CROP_ROWS // STRIDE, CROP_COLUMNS // STRIDE)


def score(trunk, scenes):
    sums = camera_task.Score()
    trunk.eval()
    with torch.no_grad():
        for i in range(len(scenes)):
            out = trunk(torch.from_numpy(scenes.planes(i))[None])[0].numpy()
            sums.add(scenes.cars(i), camera_task.decode(out))
    return sums.figures()


def is_as_good(figures, reference):
    """Whether it reaches SHARE of what the reference does, for cars to 60 m and to 100 m."""
    found, errors = figures["found"], ("depth_rms", "side_rms_px")
    return figures["false_per_image"] <= reference["false_per_image"] / SHARE + FALSE_MORE and all(
        found[k] >= SHARE * reference["found"][k]
        and all(figures[e][k] <= reference[e][k] / SHARE for e in errors)
        for k in found
    )


def main():
    args = arguments("trains the camera's network")
    torch.manual_seed(args.seed)
    scenes, trunk = CameraScenes(args.scenes), CameraTrunk()

    def batch_of(indices, random):
        drawn = [drawn_crop(scenes, i, random) for i in indices]
        return tuple(torch.from_numpy(np.stack(part)) for part in zip(*drawn))

    fit(trunk, len(scenes), args, batch_of, camera_task.loss)
    figures = score(trunk, CameraScenes([args.held_back]))
    write(trunk, (3, ROWS, COLUMNS), figures, args)
    judge(figures, args, is_as_good)


if __name__ == "__main__":
    main()
