// Person at a console, and the audit log of what persons did: operator, action, time and outcome,
// also of refused actions.
//   bound  the newest kKept lines are kept, all are counted; the recorder keeps them all
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <deque>
#include <string>

#include "protocol/telemetry/command/command_table.hpp"
#include "protocol/vocabulary/time.hpp"

namespace pitwall::command {

// Operator or viewer at a console of the base station.
struct Person {
  telemetry::HolderId console = 0;  // 1 .. 254; 0: nobody
  std::string name;

  bool operator==(const Person&) const = default;
};

struct AuditLine {
  std::uint64_t number = 0;  // from 1
  Instant at{};
  std::string who, what, result;

  bool operator==(const AuditLine&) const = default;
};

class Audit {
 public:
  static constexpr std::size_t kKept = 1'000;

  void add(Instant at, std::string who, std::string what, std::string result);
  const std::deque<AuditLine>& lines() const { return lines_; }
  std::uint64_t count() const { return count_; }

 private:
  std::deque<AuditLine> lines_;
  std::uint64_t count_ = 0;
};

}  // namespace pitwall::command
