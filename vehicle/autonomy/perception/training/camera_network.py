"""Trunk of the camera's network: convolutions from three colours to 6 planes, at a quarter of the
resolution. Built as network.py, with one stride more before it.

SPDX-License-Identifier: Apache-2.0
"""
import torch
from torch import nn

from network import RARE, Layer, stage

OUTPUTS = 6
STRIDE = 4


class CameraTrunk(nn.Module):
    def __init__(self):
        super().__init__()
        self.stem = Layer(3, 16, stride=2)
        self.fine = stage(16, 24, 1)
        self.middle = stage(24, 48, 3)
        self.coarse = stage(48, 80, 4)
        self.coarse_to_middle = Layer(80, 48, size=1)
        self.at_middle = Layer(48, 48)
        self.middle_to_fine = Layer(48, 24, size=1)
        self.at_fine = Layer(24, 32)
        self.head = nn.Conv2d(32, OUTPUTS, 1)
        with torch.no_grad():
            self.head.bias[0] = RARE

    def forward(self, planes):
        fine = self.fine(self.stem(planes))
        middle = self.middle(fine)
        coarse = self.coarse(middle)
        double = nn.functional.interpolate
        up = double(self.coarse_to_middle(coarse), scale_factor=2.0, mode="nearest")
        middle = self.at_middle(middle + up)
        up = double(self.middle_to_fine(middle), scale_factor=2.0, mode="nearest")
        return self.head(self.at_fine(fine + up))
