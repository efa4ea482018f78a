// SPDX-License-Identifier: Apache-2.0
#include "hil/cli/kitti/kitti_tracking.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <optional>
#include <span>

#include "protocol/transport/clock.hpp"

namespace pitwall::cli {
namespace {

constexpr Duration kFrame = milliseconds(100);
constexpr double kSameCar_m = 4.0;  // a track's place to its detection in the same frame
constexpr double kQuarter_rad = 0.5 * std::numbers::pi;

using Boxes = std::span<const KittiBox>;

world::EgoState standing(Instant now) {
  world::EgoState ego;
  ego.at = now, ego.validity = world::Validity::kGood;
  ego.x_m = ego.y_m = ego.yaw_rad = 0.0;
  ego.vx_mps = ego.vy_mps = ego.yaw_rate_rad_per_s = 0.0;
  ego.ax_mps2 = ego.ay_mps2 = 0.0;
  ego.position_sigma_m = ego.yaw_sigma_rad = 0.0;
  return ego;
}

// The best of the frame, as many as it has room for.
std::vector<KittiBox> best_of(Boxes boxes) {
  std::vector<KittiBox> best(boxes.begin(), boxes.end());
  std::ranges::stable_sort(best, std::greater{}, &KittiBox::score);
  best.resize(std::min(best.size(), world::kDetectionsMax));
  return best;
}

world::DetectionFrame frame_of(const std::vector<KittiBox>& boxes, Instant now) {
  world::DetectionFrame frame;
  frame.at = frame.received = now;
  for (const KittiBox& box : boxes) (void)frame.detections.push(body_of(box));
  return frame;
}

double apart_m(const world::Opponent& car, const KittiBox& box) {
  const world::Detection d = body_of(box);
  return std::hypot(car.x_m - d.x_m, car.y_m - d.y_m);
}

// The detection of each track in its frame: nearest pairs first, each once.
std::map<std::uint32_t, KittiBox> own_boxes(const world::Opponents& known,
                                            std::vector<KittiBox> boxes) {
  std::map<std::uint32_t, KittiBox> own;
  for (;;) {
    const world::Opponent* track = nullptr;
    auto nearest = boxes.end();
    for (const world::Opponent& car : known.cars) {
      if (car.measured_at != known.at || own.contains(car.id)) continue;
      for (auto box = boxes.begin(); box != boxes.end(); ++box) {
        const double d_m = apart_m(car, *box);
        if (d_m > kSameCar_m || (track && d_m >= apart_m(*track, *nearest))) continue;
        track = &car, nearest = box;
      }
    }
    if (!track) return own;
    own[track->id] = *nearest;
    boxes.erase(nearest);
  }
}

KittiTrack track_of(const world::Opponent& car, const KittiBox& newest, std::uint32_t frame) {
  KittiTrack track{.id = car.id, .box = newest};
  KittiBox& box = track.box;
  box.frame = frame;
  box.x_m = -car.y_m, box.z_m = car.x_m;
  box.length_m = car.length_m, box.width_m = car.width_m;
  box.rot_y_rad = wrap_pi(-car.yaw_rad - kQuarter_rad);
  box.alpha_rad = wrap_pi(box.rot_y_rad - std::atan2(box.x_m, box.z_m));
  return track;
}

}  // namespace

world::Detection body_of(const KittiBox& box) {
  world::Detection d;
  d.confidence = 1.0 / (1.0 + std::exp(-box.score));  // the scores are logits
  d.x_m = box.z_m, d.y_m = -box.x_m;
  d.yaw_rad = wrap_pi(-box.rot_y_rad - kQuarter_rad);
  d.length_m = box.length_m, d.width_m = box.width_m;
  return d;
}

tracking::Params kitti_params(tracking::Method method) {
  tracking::Params params;
  params.method = method;
  params.confidence_min = 0.0;
  return params;
}

KittiRun track_kitti(const KittiDetections& detections, const tracking::Params& params,
                     std::uint32_t coast_frames) {
  KittiRun run;
  const auto state = std::make_unique<tracking::State>();
  std::map<std::uint32_t, KittiBox> newest;  // by track
  auto from = detections.boxes.begin();
  for (std::uint32_t frame = 0; from != detections.boxes.end(); ++frame) {
    const auto to = std::find_if(from, detections.boxes.end(),
                                 [&](const KittiBox& b) { return b.frame != frame; });
    const std::vector<KittiBox> boxes = best_of({from, to});
    run.left_out += static_cast<std::size_t>(to - from) - boxes.size();
    from = to;
    const Instant now = Instant{} + kFrame * (frame + 1);
    const world::DetectionFrame seen = frame_of(boxes, now);
    const world::EgoState ego = standing(now);
    const Duration before = transport::thread_time();
    const tracking::Output out =
        tracking::step(params, *state, {.frames = {&seen, 1}, .ego = ego, .now = now});
    run.took_us.push_back((transport::thread_time() - before).seconds() * 1e6);
    for (const auto& [id, box] : own_boxes(out.opponents, boxes)) newest[id] = box;
    for (const world::Opponent& car : out.opponents.cars)
      if (now - car.measured_at <= kFrame * coast_frames && newest.contains(car.id))
        run.tracks.push_back(track_of(car, newest[car.id], frame));
  }
  return run;
}

}  // namespace pitwall::cli
