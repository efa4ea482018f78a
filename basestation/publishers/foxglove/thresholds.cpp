// SPDX-License-Identifier: Apache-2.0
#include "basestation/publishers/foxglove/thresholds.hpp"

#include <cmath>

#include "protocol/json/json_value.hpp"

namespace pitwall::publishers::foxglove {

std::vector<Parameter> thresholds_of(std::string_view settings) {
  std::vector<Parameter> parameters;
  const auto text = json::JsonValue::parse(settings, "settings");
  if (!text) return parameters;
  for (const json::JsonValue& alarm : text->items("alarms")) {
    const std::string key = alarm.text("key");
    for (const char* const name : {"limit", "deadband", "on_s", "off_s"}) {
      const double value = alarm.number(name);
      if (!key.empty() && std::isfinite(value))
        parameters.push_back({"/alarms/" + key + "/" + name, value});
    }
  }
  return parameters;
}

}  // namespace pitwall::publishers::foxglove
