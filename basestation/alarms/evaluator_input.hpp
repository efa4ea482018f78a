// Inputs of the alarm evaluator beside the vehicle state, as values. A recording keeps them; a
// replay that gives the same inputs at the same times gets the same alarms.
//   units  as in the structs
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <variant>

#include "basestation/alarms/engine.hpp"
#include "basestation/alarms/limits.hpp"
#include "basestation/state/known.hpp"

namespace pitwall::alarms {

// A packet without new states has arrived.
struct PacketReceived {
  Instant at{};
};

// Action of an operator on an alarm of the list.
struct AlarmAction {
  enum class Kind : std::uint8_t { kAcknowledge, kShelve, kUnshelve, kReset };
  Kind kind = Kind::kAcknowledge;
  AlarmId alarm = 0;
  Duration length{};  // of shelving
  std::string by{}, reason{};

  bool operator==(const AlarmAction&) const = default;
};

// Decision of an operator on a draft for race control.
struct NoticeAction {
  std::uint32_t notice = 0;
  bool reported = false;  // to race control; false: not needed
  std::string by{};

  bool operator==(const NoticeAction&) const = default;
};

using EvaluatorInput =
    std::variant<PacketReceived, state::LinkFigures, state::BaseFigures, state::Expectations,
                 AlarmAction, NoticeAction, LimitEdit, AlarmEdit>;

}  // namespace pitwall::alarms
