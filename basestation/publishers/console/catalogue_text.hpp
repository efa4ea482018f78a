// Catalogue of fields and commands for the console, as PROTOCOL.md describes it.
//   in     the registry, the base's own fields, the limits in force, the laps of an attempt
//   out    one JSON object, type "catalogue"
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>

#include "basestation/alarms/limits.hpp"

namespace pitwall::publishers::console {

using LimitOf = std::function<const alarms::Limit&(state::FieldId)>;

std::string catalogue_text(const LimitOf& limit_of, double attempt_laps);

}  // namespace pitwall::publishers::console
