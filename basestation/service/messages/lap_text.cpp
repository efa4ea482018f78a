// SPDX-License-Identifier: Apache-2.0
#include "basestation/service/messages/lap_text.hpp"

#include "protocol/json/json_text.hpp"

namespace pitwall::service {

std::string laps_text(const state::LapLog& log) {
  json::Array list;
  for (const state::Lap& lap : log.laps()) {
    list.json(json::Object{}
                  .number("id", lap.id)
                  .number("number", lap.number)
                  .number("begin_ms", lap.begin.milliseconds())
                  .number("end_ms", lap.running ? kUnset : lap.end.milliseconds())
                  .number("time_s", lap.time_s())
                  .flag("start_seen", lap.start_seen)
                  .flag("finish_seen", lap.finish_seen)
                  .number("gap_s", lap.gap.seconds())
                  .str());
  }
  const state::Lap* const best = log.best();
  return json::Object{}
      .text("type", "laps")
      .number("length_m", log.length_m())
      .number("step_m", log.step_m())
      .number("best", best != nullptr ? static_cast<double>(best->id) : kUnset)
      .json("laps", list.str())
      .str();
}

}  // namespace pitwall::service
