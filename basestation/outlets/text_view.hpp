// The picture as one screen of text: who is heard (a real car or a simulation) or lost, the link
// both ways, and every field with value, unit and age. A function of its arguments: the caller
// prints.
//   marks  ' ' fresh, '~' late, '!' stale (dimmed with ANSI), '-' never heard
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "basestation/intake/station.hpp"
#include "protocol/vocabulary/time.hpp"

namespace pitwall::outlets {

struct ViewOptions {
  bool ansi = false;  // colours, and the cursor home at the start
};

std::string text_view(const intake::Station& station, Instant now, const ViewOptions& options);

}  // namespace pitwall::outlets
