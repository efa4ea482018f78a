// Cars in the output of the camera's network.
//   in     planes of CameraOutput
//   out    boxes in pixels of the trunk's image, the surest first
//   law    a car is where its figure is the greatest of its cell and the eight around it; of two of
//          which one's middle lies in the inner half of the other, the surer is kept
//   source X. Zhou, D. Wang, P. Kraehenbuehl: Objects as points, 2019, section 4
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "protocol/vocabulary/units.hpp"

namespace pitwall::perception {

struct ImageBox {
  double u_px = kUnset, v_px = kUnset;           // of the middle of the car
  double width_px = kUnset, height_px = kUnset;  // of the whole car, whatever hides it
  double upright_px = kUnset;                    // height of the car, upright in its middle
  double confidence = kUnset;
};

std::vector<ImageBox> decode_image(std::span<const float> planes, double confidence_least);

}  // namespace pitwall::perception
