// All that a Watch is told from outside beside the picture, as values: so that a recording can keep
// it, and a replay that tells the same at the same times judges the same.
//   units  as the structs have them
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <variant>

#include "basestation/picture/alarms/engine.hpp"
#include "basestation/picture/known.hpp"
#include "basestation/picture/limits.hpp"

namespace pitwall::picture {

// A packet that told nothing new came.
struct Heard {
  Instant at{};
};

// What a person does with an alarm of the list.
struct AlarmAct {
  enum class Kind : std::uint8_t { kAcknowledge, kShelve, kUnshelve, kReset };
  Kind kind = Kind::kAcknowledge;
  alarms::AlarmId alarm = 0;
  Duration length{};  // shelved for so long
  std::string by{}, reason{};

  bool operator==(const AlarmAct&) const = default;
};

// And with a draft for race control.
struct NoticeAct {
  std::uint32_t notice = 0;
  bool send = false;  // else it is dismissed
  std::string by{};

  bool operator==(const NoticeAct&) const = default;
};

using WatchInput = std::variant<Heard, LinkFigures, BaseFigures, Expectations, AlarmAct, NoticeAct,
                                LimitEdit, alarms::AlarmEdit>;

}  // namespace pitwall::picture
