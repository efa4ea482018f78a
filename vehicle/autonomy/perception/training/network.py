"""Trunk of the pillar network: convolutions from 10 planes to 7, at half of the resolution.

Three strides, the coarser ones added to the finer: a car is seen as a whole and placed exactly.
Only operators that OpenCV 4.6 imports.
SPDX-License-Identifier: Apache-2.0
"""
import torch
from torch import nn
from torch.nn.utils.fusion import fuse_conv_bn_eval

FEATURES, OUTPUTS = 10, 7
RARE = -4.0  # logit of a car before training: one cell of many has one


class Layer(nn.Sequential):
    def __init__(self, inputs, outputs, size=3, stride=1):
        super().__init__(
            nn.Conv2d(inputs, outputs, size, stride, size // 2, bias=False),
            nn.BatchNorm2d(outputs),
            nn.ReLU(),
        )


def stage(inputs, outputs, layers):
    first = Layer(inputs, outputs, stride=2)
    return nn.Sequential(first, *(Layer(outputs, outputs) for _ in range(layers)))


class Trunk(nn.Module):
    def __init__(self):
        super().__init__()
        self.fine = stage(FEATURES, 16, 2)
        self.middle = stage(16, 32, 3)
        self.coarse = stage(32, 64, 4)
        self.coarse_to_middle = Layer(64, 32, size=1)
        self.at_middle = Layer(64, 32)
        self.middle_to_fine = Layer(32, 16, size=1)
        self.at_fine = Layer(32, 32)
        self.head = nn.Conv2d(32, OUTPUTS, 1)
        with torch.no_grad():
            self.head.bias[0] = RARE

    def forward(self, planes):
        fine = self.fine(planes)
        middle = self.middle(fine)
        coarse = self.coarse(middle)
        double = nn.functional.interpolate
        up = double(self.coarse_to_middle(coarse), scale_factor=2.0, mode="nearest")
        middle = self.at_middle(torch.cat([middle, up], 1))
        up = double(self.middle_to_fine(middle), scale_factor=2.0, mode="nearest")
        return self.head(self.at_fine(torch.cat([fine, up], 1)))


def fused(trunk):
    """The same function without batch norms. Each tensor differs from all others: OpenCV 4.6 does
    not read a network in which two layers share one."""
    trunk.eval()
    for module in trunk.modules():
        if isinstance(module, Layer):
            module[0] = fuse_conv_bn_eval(module[0], module[1])
            module[1] = nn.Identity()
    return trunk


def export(trunk, path, shape):
    """`shape`: planes, rows and columns of the input."""
    planes = torch.zeros(1, *shape)
    torch.onnx.export(fused(trunk), planes, path, opset_version=11, input_names=["planes"],
                      output_names=["cars"])  # fmt: skip
