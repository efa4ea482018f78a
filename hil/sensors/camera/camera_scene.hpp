// Drawn images of a car's front cameras, with what is true of the cars in them: for the training
// and the test of a detector.
//   in     track, bodies of the other cars, rules, seed
//   out    one image of one camera; each car of which it shows a pixel
//   drawn  cars, dust and springs as drawn_cars.hpp, decoys as decoys.hpp; the look (draw_look());
//          in turn the left and the right camera and, if the rules say so, another place, direction
//          and focal length
//   law    the same seed gives the same scene
//   cost   0.1 s a scene
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "hil/sensors/camera/camera.hpp"
#include "hil/sensors/lidar/car_mesh.hpp"
#include "hil/sensors/lidar/decoys.hpp"

namespace pitwall::sensors {

struct SeenCar {
  double u_px = kUnset, v_px = kUnset;           // of the middle of the whole car
  double width_px = kUnset, height_px = kUnset;  // of the box about the whole car
  double depth_m = kUnset;                       // of its middle along the camera's axis
  double upright_px = kUnset;                    // height of the car, upright there
  double x_m = kUnset, y_m = kUnset;             // of its middle, Body
  std::size_t pixels = 0;                        // that show it
};

struct CameraScene {
  CameraUnit unit;
  CameraImage image;
  std::vector<SeenCar> cars;
};

struct CameraRules {
  double dust = 1.0, spun_share = 0.0;  // as drawn_cars.hpp
  bool varied = false;                  // cameras other than those of the AV-21
  DecoySet decoys = DecoySet::kNone;
};

class CameraSceneMaker {
 public:
  // `track` outlives the maker. One body for all others, or one for each of kSceneCarsMost.
  CameraSceneMaker(const world::TrackMap& track, const std::vector<CarShape>& bodies,
                   const CameraRules& rules);
  CameraScene make(std::uint64_t seed);

 private:
  const world::TrackMap* track_;
  std::vector<CarShape> bodies_;
  CameraRules rules_;
  RayScene rays_;
  Decoys decoys_;
};

}  // namespace pitwall::sensors
