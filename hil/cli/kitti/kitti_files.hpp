// Text files of KITTI's tracking benchmark: the detections that AB3DMOT reads, the tracks that its
// evaluation reads.
//   in     a line per detection: frame,type,x1,y1,x2,y2,score,h,w,l,x,y,z,rot_y,alpha; one class
//          and one sequence in a file, frames in order
//   out    a line per track: frame id type 0 0 alpha x1 y1 x2 y2 h w l x y z rot_y score
//   frames the left camera: x right, y down, z forward; x, y, z is the middle of the bottom of the
//          box; rot_y turns from x towards -z, alpha is rot_y seen from the camera
//   errors Problem with file:line: a field that is missing, too many, no number or out of its range
//   source github.com/xinshuoweng/AB3DMOT (AB3DMOT_libs/io.py); KITTI's devkit_tracking
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "protocol/vocabulary/result.hpp"
#include "protocol/vocabulary/units.hpp"

namespace pitwall::cli {

inline constexpr std::size_t kMaxKittiBytes = std::size_t{64} << 20U;
inline constexpr std::uint32_t kKittiFramesMax = 100'000;

enum class KittiType : std::uint8_t { kPedestrian = 1, kCar = 2, kCyclist = 3 };

struct KittiBox {
  std::uint32_t frame = 0;
  std::array<double, 4> image{};  // x1, y1, x2, y2, pixels
  double score = kUnset;
  double height_m = kUnset, width_m = kUnset, length_m = kUnset;
  double x_m = kUnset, y_m = kUnset, z_m = kUnset;
  double rot_y_rad = kUnset, alpha_rad = kUnset;
};

struct KittiDetections {
  KittiType type = KittiType::kCar;
  std::vector<KittiBox> boxes;
};

struct KittiTrack {
  std::uint32_t id = 0;
  KittiBox box;
};

Result<KittiDetections, Problem> read_kitti_detections(std::string_view text,
                                                       const std::string& name);

std::string kitti_text(KittiType type, std::span<const KittiTrack> tracks);

}  // namespace pitwall::cli
