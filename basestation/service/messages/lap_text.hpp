// Table of the laps of a car as a JSON message to consoles, as PROTOCOL.md describes it.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "basestation/state/laps/lap_log.hpp"

namespace pitwall::service {

std::string laps_text(const state::LapLog& log);

}  // namespace pitwall::service
