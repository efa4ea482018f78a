// Score of a tracker by CLEAR MOT: which track is which object, what is missed, what is false, how
// often an object gets another track.
//   in     per frame the true objects and the tracks, both with a number that stays
//   out    counts; pairs of the newest frame
//   invariants
//          a pair of the frame before stays one while it is within the gate; the rest are paired
//          nearest first. An object that need not be found is no miss, its track is not false, and
//          a track that comes to it later is no switch when it was let go
//   source Bernardin and Stiefelhagen, "Evaluating Multiple Object Tracking Performance" (2008)
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <vector>

namespace pitwall::tracking_bench {

struct Spot {
  std::uint32_t id = 0;
  double x_m = 0.0, y_m = 0.0;
  bool is_required = true;  // of objects
};

struct SpotPair {
  std::size_t object = 0, track = 0;  // places in the frame
};

class ClearMot {
 public:
  explicit ClearMot(double gate_m) : gate_m_(gate_m) {}

  const std::vector<SpotPair>& add(std::span<const Spot> objects, std::span<const Spot> tracks);
  // The object was out of sight: another track may come to it.
  void let_go(std::uint32_t object) { track_of_.erase(object); }

  std::size_t objects() const { return objects_; }  // required, over all frames
  std::size_t misses() const { return misses_; }
  std::size_t false_tracks() const { return false_; }
  std::size_t switches() const { return switches_; }
  const std::vector<std::uint32_t>& switched() const { return switched_; }  // objects, newest frame
  double mota() const;                                                      // NaN without an object

 private:
  double gate_m_;
  std::map<std::uint32_t, std::uint32_t> track_of_;   // newest track of an object
  std::map<std::uint32_t, std::uint32_t> object_of_;  // newest object of a track
  std::vector<SpotPair> pairs_;
  std::vector<std::uint32_t> switched_;
  std::size_t objects_ = 0, misses_ = 0, false_ = 0, switches_ = 0;
};

}  // namespace pitwall::tracking_bench
