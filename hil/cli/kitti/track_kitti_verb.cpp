// SPDX-License-Identifier: Apache-2.0
#include "hil/cli/kitti/track_kitti_verb.hpp"

#include <algorithm>
#include <cstdio>
#include <numeric>
#include <set>

#include "hil/cli/command_line.hpp"
#include "hil/cli/kitti/kitti_tracking.hpp"
#include "protocol/transport/file.hpp"
#include "protocol/vocabulary/quantile.hpp"

namespace pitwall::cli {
namespace {

constexpr int kCoastMost = 50;  // frames

struct KittiOptions {
  std::string detections, tracker, out;
  int coast_frames = 1;  // as AB3DMOT with a max_age of 2
};

void print_summary(const KittiOptions& options, const KittiDetections& in, KittiRun run) {
  std::set<std::uint32_t> ids;
  for (const KittiTrack& track : run.tracks) ids.insert(track.id);
  std::ranges::sort(run.took_us);
  const double sum_us = std::accumulate(run.took_us.begin(), run.took_us.end(), 0.0);
  const std::size_t frames = run.took_us.size();
  std::printf(
      "%s: %zu frames, %zu detections, %zu tracks in %zu lines\n"
      "tracker %s, us of processor time a frame: mean %.1f, p99 %.1f, worst %.1f\n",
      options.out.c_str(), frames, in.boxes.size(), ids.size(), run.tracks.size(),
      options.tracker.c_str(), sum_us / static_cast<double>(frames),
      run.took_us[nearest_rank(0.99, frames)], run.took_us.back());
  if (run.left_out > 0)
    std::fprintf(stderr, "%zu detections left out: a frame has room for %zu\n", run.left_out,
                 world::kDetectionsMax);
}

}  // namespace

int track_kitti_verb(std::span<const std::string> args) {
  KittiOptions options;
  CommandLine app{"pitwall-hil track-kitti: the car's tracker on detections of KITTI"};
  app.option("DETECTIONS", options.detections,
             "frame,type,x1,y1,x2,y2,score,h,w,l,x,y,z,rot_y,alpha; one sequence")
      .required();
  app.option("--tracker", options.tracker, "paper or road").required();
  app.option("--out", options.out, "tracks in KITTI's tracking format").required();
  app.option("--coast", options.coast_frames,
             "frames without a detection in which a track is still written")
      .range(0, kCoastMost)
      .shows_default();
  if (const auto code = app.ended_by(args)) return *code;
  const auto* const method = std::ranges::find(tracking::kMethodNames, options.tracker);
  if (method == tracking::kMethodNames.end())
    return refuse({"--tracker", "is \"" + options.tracker + "\", expected paper or road"});
  const auto text = transport::read_file(options.detections, kMaxKittiBytes);
  if (!text) return refuse(text.error());
  const auto detections = read_kitti_detections(*text, options.detections);
  if (!detections) return refuse(detections.error());
  const auto number = static_cast<std::size_t>(method - tracking::kMethodNames.begin());
  KittiRun run = track_kitti(*detections, kitti_params(static_cast<tracking::Method>(number)),
                             static_cast<std::uint32_t>(options.coast_frames));
  const auto written = transport::write_file(options.out, kitti_text(detections->type, run.tracks));
  if (!written) return refuse(written.error());
  print_summary(options, *detections, std::move(run));
  return kExitPass;
}

}  // namespace pitwall::cli
