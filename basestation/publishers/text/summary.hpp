// Summary of a run of the base station as one JSON document.
//   out    car ("not received yet", "received", "lost"), source, packets, lost, loss, refused
//          (total and by kind), rate_hz; silent_ms since the last packet, and up to that packet
//          age_ms of ego and ages_ms by class and by group {p50 p90 p99 max}; paths (loss, bursts,
//          one-way delay, jitter, budget); clock; commands and events with their times; loss by
//          place;
//          bench_time: total of its pauses (null: by the wall clock);
//          fields: "group.name" -> value (null if never received), unit, age_ms, quality
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include "basestation/service/car_service.hpp"
#include "protocol/transport/bench_clock/bench_pause.hpp"
#include "protocol/vocabulary/time.hpp"

namespace pitwall::publishers {

std::string json_summary(const service::CarService& car, Instant now,
                         const std::optional<transport::BenchPause>& pause = {});

}  // namespace pitwall::publishers
