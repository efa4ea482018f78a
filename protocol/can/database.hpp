// The messages of one CAN database as a value, each signal with its plan.
//   in      filled by the DBC parser
//   out     messages sorted by (standard before extended, id); lookups by id and by name
//   units   physical values in the units that the file names
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "protocol/can/signal.hpp"
#include "protocol/vocabulary/result.hpp"
#include "protocol/vocabulary/time.hpp"

namespace pitwall::can {

struct ValueName {
  std::int64_t value = 0;
  std::string name;
};

// Both ends included.
struct SelectorRange {
  std::uint64_t low = 0, high = 0;
};

struct Signal {
  std::string name, unit, comment;
  SignalLayout layout;
  SignalPlan plan;
  std::vector<ValueName> values;
  std::vector<std::string> receivers;
  // Multiplexing: present only while the selector's raw value is in one of the ranges.
  bool is_selector = false;
  std::optional<std::size_t> selector;  // index in the message; absent: always present
  std::vector<SelectorRange> when;
  std::uint8_t depth = 0;  // selectors above it
  std::string place;       // "file:line:column" of its definition
};

struct Message {
  std::uint32_t id = 0;
  bool extended = false;
  bool fd = false;
  std::uint8_t length = 0;
  std::string name, sender, comment;
  Duration period{};  // of the attribute GenMsgCycleTime; zero: not given
  std::vector<Signal> signals;
  std::string place;

  const Signal* find(std::string_view signal_name) const;
  std::optional<std::size_t> index_of(std::string_view signal_name) const;
};

struct Database {
  std::string name;
  std::vector<Message> messages;

  const Message* find(std::uint32_t id, bool extended = false) const;
  const Message* find(std::string_view message_name) const;
};

// How many selectors decide on this signal; nothing where they form a circle.
std::optional<std::uint8_t> selectors_above(const Message& message, const Signal& signal);

// FNV-1a 64 of everything that decides what bits mean (not comments, units, names of values), so
// that two programs can tell whether they speak the same revision.
std::uint64_t fingerprint(const Database& database);

// The first contradiction in a message: signals outside it, equal names, bits claimed twice by
// signals that can be present together. Sorts nothing, resolves nothing.
std::optional<Problem> contradiction(const Message& message);

}  // namespace pitwall::can
