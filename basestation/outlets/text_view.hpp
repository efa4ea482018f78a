// The picture as one screen of text: who is heard (a real car or a simulation), the link, and every
// field with value, unit and age. A function of its arguments: the caller prints.
//   marks  ' ' fresh, '~' late, '!' stale (dimmed with ANSI), '-' never heard
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "basestation/intake/link_stats.hpp"
#include "basestation/intake/state_intake.hpp"
#include "basestation/picture/picture.hpp"
#include "protocol/vocabulary/time.hpp"

namespace pitwall::outlets {

struct ViewOptions {
  bool ansi = false;  // colours, and the cursor home at the start
};

std::string text_view(const picture::Picture& picture, const intake::IntakeCounters& counters,
                      const intake::LinkStats& link, Instant now, const ViewOptions& options);

}  // namespace pitwall::outlets
