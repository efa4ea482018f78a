// SPDX-License-Identifier: Apache-2.0
#include "hil/bench/recorded/operator_texts.hpp"

#include <algorithm>
#include <string>

#include "protocol/telemetry/command/command_table.hpp"
#include "protocol/vocabulary/text.hpp"

namespace pitwall::bench {
namespace {

using world::OperatorCommandKind;

// What the car had has passed the gates of its day, or a person overrode them.
constexpr const char* kReason = " because recorded";
constexpr Duration kClaimBefore = seconds(2), kClaimAfter = seconds(1);

// The kinds that reach a tick stand as the commands of the radio do.
constexpr bool same(OperatorCommandKind kind, telemetry::CommandType type) {
  return static_cast<int>(kind) == static_cast<int>(type);
}
static_assert(same(OperatorCommandKind::kArm, telemetry::CommandType::kArm) &&
              same(OperatorCommandKind::kSensorsExcluded,
                   telemetry::CommandType::kSensorsExcluded) &&
              same(OperatorCommandKind::kFuelEntered, telemetry::CommandType::kFuelEntered));

std::string text_of(const world::OperatorCommand& command) {
  std::string name{telemetry::kCommandTable[static_cast<std::size_t>(command.kind)].name};
  std::ranges::replace(name, ' ', '_');
  return "command " + name + " " + shortest(command.argument) + kReason;
}

std::string text_of(world::StopRequest stop) {
  if (stop == world::StopRequest::kNone) return std::string("release") + kReason;
  return stop == world::StopRequest::kControlled ? "stop controlled" : "stop emergency";
}

}  // namespace

void OperatorTexts::add(const pipeline::Inputs& in, Duration at) {
  for (const world::OperatorCommand& command : in.commands)
    texts_.push_back({at, text_of(command)});
  if (in.operator_inputs.stop != stop_) texts_.push_back({at, text_of(in.operator_inputs.stop)});
  stop_ = in.operator_inputs.stop;
}

AuthorityClaim authority_for(const std::vector<scenario::OperatorText>& texts) {
  return {.from = std::max(Duration{}, texts.front().at - kClaimBefore),
          .until = texts.back().at + kClaimAfter};
}

std::vector<scenario::OperatorText> with_authority(std::vector<scenario::OperatorText> texts) {
  if (texts.empty()) return texts;
  const AuthorityClaim claim = authority_for(texts);
  for (Duration at = claim.from; at <= claim.until; at = at + AuthorityClaim::kEvery)
    texts.push_back({at, AuthorityClaim::kText});
  std::ranges::stable_sort(texts, {}, &scenario::OperatorText::at);
  return texts;
}

}  // namespace pitwall::bench
