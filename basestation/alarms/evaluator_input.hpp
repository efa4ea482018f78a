// Inputs of the alarm evaluator beside the vehicle state, as values: a recording keeps them, and a
// replay that gives the same at the same times judges the same.
//   units  as the structs have them
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <variant>

#include "basestation/alarms/engine.hpp"
#include "basestation/alarms/limits.hpp"
#include "basestation/state/known.hpp"

namespace pitwall::alarms {

// A packet that told nothing new came.
struct PacketReceived {
  Instant at{};
};

// What a person does with an alarm of the list.
struct AlarmAction {
  enum class Kind : std::uint8_t { kAcknowledge, kShelve, kUnshelve, kReset };
  Kind kind = Kind::kAcknowledge;
  AlarmId alarm = 0;
  Duration length{};  // shelved for so long
  std::string by{}, reason{};

  bool operator==(const AlarmAction&) const = default;
};

// And with a draft for race control.
struct NoticeAction {
  std::uint32_t notice = 0;
  bool reported = false;  // to race control; else it need not be
  std::string by{};

  bool operator==(const NoticeAction&) const = default;
};

using EvaluatorInput =
    std::variant<PacketReceived, state::LinkFigures, state::BaseFigures, state::Expectations,
                 AlarmAction, NoticeAction, LimitEdit, AlarmEdit>;

}  // namespace pitwall::alarms
