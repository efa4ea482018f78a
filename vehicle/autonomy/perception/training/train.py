#!/usr/bin/python3
"""Trains the pillar network on scenes of `pitwall-hil scenes`.

in     --scenes FOLDER... of the training, --held-back FOLDER for the figures, --seed, --epochs
out    --out FILE.onnx, and beside it FILE.json: figures on the held-back scenes, seed, hash; with
       --stored FOLDER the boxes that it finds in these scenes, as boxes.npy in the folder
cost   0.05 s a scene and epoch on one processor
exit   0 written; 1 worse than 0.9 of the figures in --reference FILE.json; 2 the command line or a
       folder is wrong
SPDX-License-Identifier: Apache-2.0
"""
import argparse
import hashlib
import json
import pathlib
import sys
import time

import numpy as np
import torch

import decoding
import network
import targets
from scenes import COLUMNS, ROWS, Scenes, mirrored

CROP_ROWS = 384  # of a scene, drawn anew each time
BATCH = 8
RATE = 3e-3
DECAY = 1e-4
SHARE = 0.9  # of a reference's figures
FALSE_MORE = 0.005  # false cars a sweep: two in 400 are chance
# Half precision, where the processor has units for it: three times as fast.
HALF = "amx_bf16" in pathlib.Path("/proc/cpuinfo").read_text()


def drawn_batch(scenes, indices, random):
    planes, wanted = [], []
    for i in indices:
        of_scene, cars = scenes.planes(i), scenes.cars(i)
        if random.random() < 0.5:
            of_scene, cars = mirrored(of_scene, cars)
        first = 2 * int(random.integers(0, (ROWS - CROP_ROWS) // 2 + 1))
        planes.append(of_scene[:, first : first + CROP_ROWS])
        wanted.append(targets.targets(cars, CROP_ROWS // 2, COLUMNS // 2, first // 2))
    return torch.from_numpy(np.stack(planes)), torch.from_numpy(np.stack(wanted))


def output(trunk, scenes, i):
    trunk.eval()
    with torch.no_grad():
        return trunk(torch.from_numpy(scenes.planes(i))[None])[0].numpy()


def score(trunk, scenes):
    sums = decoding.Score()
    for i in range(len(scenes)):
        sums.add(scenes.cars(i), decoding.decode(output(trunk, scenes, i)))
    return sums.figures()


def store_boxes(trunk, folder):
    """What the product has to find with the same weights: rows of scene and box."""
    scenes, rows = Scenes([folder]), []
    for i in range(len(scenes)):
        rows += [[i, *box] for box in decoding.decode(output(trunk, scenes, i))]
    np.save(pathlib.Path(folder) / "boxes.npy", np.array(rows, np.float32).reshape(-1, 7))


def is_as_good(figures, reference):
    """Whether it reaches SHARE of what the reference does, for cars to 60 m and to 100 m."""
    found, rms_m = figures["found"], figures["position_rms_m"]
    return figures["false_per_sweep"] <= reference["false_per_sweep"] / SHARE + FALSE_MORE and all(
        found[k] >= SHARE * reference["found"][k]
        and rms_m[k] <= reference["position_rms_m"][k] / SHARE
        for k in found
    )


def fit(trunk, count, args, batch_of, loss):
    """`batch_of`(indices of the `count` scenes, random): planes and what is wanted of them."""
    random = np.random.default_rng(args.seed)
    steps = count // BATCH * args.epochs
    optimizer = torch.optim.AdamW(trunk.parameters(), RATE, weight_decay=DECAY)
    schedule = torch.optim.lr_scheduler.OneCycleLR(optimizer, RATE, total_steps=steps)
    trunk.to(memory_format=torch.channels_last)
    begun = time.monotonic()
    for epoch in range(args.epochs):
        trunk.train()
        order, sum_of_losses = random.permutation(count), 0.0
        for k in range(count // BATCH):
            planes, wanted = batch_of(order[k * BATCH : (k + 1) * BATCH], random)
            with torch.autocast("cpu", torch.bfloat16, enabled=HALF):
                out = trunk(planes.contiguous(memory_format=torch.channels_last))
            off = loss(out.float(), wanted)
            optimizer.zero_grad()
            off.backward()
            torch.nn.utils.clip_grad_norm_(trunk.parameters(), 10.0)
            optimizer.step()
            schedule.step()
            sum_of_losses += off.item()
        mean = sum_of_losses / max(count // BATCH, 1)
        print(f"epoch {epoch + 1}: loss {mean:.3f}, {time.monotonic() - begun:.0f} s", flush=True)
    trunk.to(memory_format=torch.contiguous_format)


def write(trunk, shape, figures, args):
    """The network and, beside it, its record; ends the program where it is worse than asked."""
    out = pathlib.Path(args.out)
    network.export(trunk, str(out), shape)
    record = {
        "simulation": True,
        "seed": args.seed,
        "epochs": args.epochs,
        "parameters": sum(p.numel() for p in trunk.parameters()),
        "sha256": hashlib.sha256(out.read_bytes()).hexdigest(),
        "held_back": figures,
    }
    out.with_suffix(".json").write_text(json.dumps(record, indent=1) + "\n")
    print(json.dumps(record, indent=1))


def judge(figures, args, is_as_good):
    if args.reference:
        reference = json.loads(pathlib.Path(args.reference).read_text())["held_back"]
        if not is_as_good(figures, reference):
            sys.exit(f"worse than {SHARE} of {args.reference}: {reference}")


def arguments(what):
    parser = argparse.ArgumentParser(description=what)
    parser.add_argument("--scenes", required=True, nargs="+")
    parser.add_argument("--held-back", required=True)
    parser.add_argument("--out", required=True)
    parser.add_argument("--stored")
    parser.add_argument("--reference")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--epochs", type=int, default=20)
    return parser.parse_args()


def main():
    args = arguments("trains the pillar network")
    torch.manual_seed(args.seed)
    scenes, trunk = Scenes(args.scenes), network.Trunk()

    def batch_of(indices, random):
        return drawn_batch(scenes, indices, random)

    fit(trunk, len(scenes), args, batch_of, targets.loss)
    figures = score(trunk, Scenes([args.held_back]))
    write(trunk, (network.FEATURES, ROWS, COLUMNS), figures, args)
    if args.stored:
        store_boxes(trunk, args.stored)
    judge(figures, args, is_as_good)


if __name__ == "__main__":
    main()
