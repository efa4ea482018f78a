// SPDX-License-Identifier: Apache-2.0
#include "vehicle/autonomy/tracking/tracking.hpp"

#include "vehicle/autonomy/tracking/filter/motion.hpp"
#include "vehicle/autonomy/tracking/filter/paper_filter.hpp"
#include "vehicle/autonomy/tracking/filter/road_filter.hpp"

namespace pitwall::tracking {
namespace {

std::uint64_t& count_of(Insertion insertion, Counters& n) {
  if (insertion == Insertion::kTooOld) return n.frames_too_old;
  return insertion == Insertion::kRepeated ? n.frames_repeated : n.frames_too_many;
}

// Returns whether the filter has the frame.
bool use_frame(const Params& params, State& state, const AdmittedFrame& frame) {
  if (params.method == Method::kPaper) {
    filter_paper(params.paper, from_seconds(params.coast_s),
                 {.key = frame.key, .own = frame.own, .measurements = frame.measurements.span()},
                 state.tracks);
    return true;
  }
  const Insertion done = state.timeline.insert(frame.key, frame.own, frame.measurements.span());
  if (done == Insertion::kDone) return true;
  --state.counters.frames;
  state.counters.detections -= frame.measurements.size();
  ++count_of(done, state.counters);
  return false;
}

world::Opponent opponent_at(const Params& params, const Inputs& in, Instant from, Track track) {
  const Duration ahead = in.now - from;
  if (params.method == Method::kPaper) {
    if (ahead > Duration{}) predict_paper(params.paper, ahead.seconds(), track);
    return paper_opponent(in.track, track);
  }
  coast(params.road, in.track, ahead, track);
  return road_opponent(in.track, track);
}

void publish(const Params& params, const State& state, const Inputs& in, world::Opponents& out) {
  out.at = in.now;
  for (const Track& track : state.tracks.list) {
    if (!track.confirmed || in.now - track.newest.frame.at > from_seconds(params.coast_s)) continue;
    world::Opponent car = opponent_at(params, in, state.tracks.at, track);
    car.id = state.names.id_of(track);
    (void)out.cars.push(car);  // the oldest kOpponentsMax
  }
}

}  // namespace

Output step(const Params& params, State& state, const Inputs& in) {
  state.own.note(in.ego, in.track);
  state.timeline.forget_before(in.now - from_seconds(params.window_s));
  Output out;
  for (const world::DetectionFrame& frame : in.frames) {
    const auto admitted =
        admit(params, {.own = state.own, .track = in.track, .use = in.use, .now = in.now}, frame,
              state.counters);
    if (!admitted || !use_frame(params, state, *admitted)) continue;
    out.published = true;
    state.cameras.note(*admitted);
  }
  if (out.published) {
    if (params.method == Method::kRoad) state.timeline.settle(params, in.track, state.tracks);
    state.names.name(state.tracks);
  }
  publish(params, state, in, out.opponents);
  state.counters.too_many = state.tracks.crowded;
  out.counters = state.counters;
  return out;
}

}  // namespace pitwall::tracking
