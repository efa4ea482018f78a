// Rules of restamping from the manifest of a car: which messages have a rolling counter or a
// checksum, and how their senders count.
//   in     manifest and database, which must not contradict each other; recorded frames of one bus
//   out    a rule for each such message; the range of its counter
//   errors Problem: a contradiction, or a manifest without counters and checksums
//   source the protection profile of a message defines where its counter wraps. Without a profile
//          the recording decides: the most frequent wrap to 0 or 1, if it occurs at least twice;
//          else the counter uses all values of the field
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "protocol/can/database.hpp"
#include "protocol/can/frame.hpp"
#include "protocol/can/manifest.hpp"
#include "protocol/vocabulary/result.hpp"

namespace pitwall::replay {

struct RestampRule {
  std::uint32_t id = 0;
  bool extended = false;
  std::uint8_t length = 0;
  std::uint8_t counter_start = 0;  // bit position, Intel
  std::uint8_t counter_bits = 0;   // 0: none
  can::ProtectionRule protection{};

  std::uint32_t counter_of(const can::Frame& frame) const;
  // Overwrites counter and checksum of the frame, which must have the length of the rule.
  void stamp(can::Frame& frame, std::uint32_t counter) const;
};

struct RestampRules {
  std::string name;  // of the manifest
  std::vector<RestampRule> rules;

  static Result<RestampRules, Problem> make(const can::Manifest& manifest,
                                            const can::Database& database);
  static constexpr std::size_t kNone = SIZE_MAX;
  // Index of the rule of a frame; kNone: it has neither counter nor checksum.
  std::size_t place_of(const can::Frame& frame) const;
  // False for a frame of another length than its message, or a remote frame: it cannot be stamped.
  static bool fits(const RestampRule& rule, const can::Frame& frame);
};

// From `bottom` to `top`, both included.
struct CounterRange {
  std::uint32_t bottom = 0, top = 0;

  std::uint32_t length() const { return top - bottom + 1; }
};

// Observed counting of the senders of one bus.
class CounterHistory {
 public:
  explicit CounterHistory(const RestampRules& rules) : rules_(&rules), seen_(rules.rules.size()) {}

  void observe(const can::Frame& frame);
  CounterRange range_of(std::size_t rule) const;

 private:
  struct Seen {
    bool ever = false;
    std::uint32_t last = 0;
    // from, to: number of occurrences
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> wraps{};
  };
  static constexpr std::uint32_t kMinWraps = 2;

  const RestampRules* rules_;
  std::vector<Seen> seen_;
};

}  // namespace pitwall::replay
