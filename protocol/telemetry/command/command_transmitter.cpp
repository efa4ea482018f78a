// SPDX-License-Identifier: Apache-2.0
#include "protocol/telemetry/command/command_transmitter.hpp"

#include <algorithm>

#include "protocol/telemetry/command/command_record.hpp"

namespace pitwall::telemetry {

template <std::size_t Kept>
CommandTransmitterOf<Kept>::CommandTransmitterOf(std::uint64_t own_boot)
    : run_(short_boot(own_boot)) {}

template <std::size_t Kept>
void CommandTransmitterOf<Kept>::set_peer_boot(std::uint64_t car_boot, Instant now) {
  const std::uint32_t boot = short_boot(car_boot);
  if (car_boot_ && *car_boot_ != boot) car_restarted(now);
  car_boot_ = boot;
}

template <std::size_t Kept>
void CommandTransmitterOf<Kept>::car_restarted(Instant now) {
  for (Entry& entry : kept_) {
    if (entry.open()) decide(entry, Outcome::kOtherRun, now);
  }
}

template <std::size_t Kept>
std::optional<CommandId> CommandTransmitterOf<Kept>::issue(const Command& command, Instant now) {
  const CommandRow& row = row_of(command.type);
  if (!(command.argument >= row.min && command.argument <= row.max)) return std::nullopt;
  // An open one in the way keeps the car's memory, which has as many places, ahead of ours.
  if (!car_boot_ || open_ == kOpen || place_of(newest_ + 1).open()) return std::nullopt;
  const auto quantized = row.quantized();
  Entry& entry = place_of(++newest_);
  entry = {};
  entry.car_boot = *car_boot_;
  entry.progress.id = newest_;
  entry.progress.issued = now;
  entry.progress.command = command;
  entry.progress.command.argument = quantized.decode(quantized.encode(command.argument).step);
  ++open_;
  return newest_;
}

template <std::size_t Kept>
std::size_t CommandTransmitterOf<Kept>::wanted() const {
  return open_ * BodyWriter::record_size(kCommandSize) +
         acks_due_.size() * BodyWriter::record_size(kResultAckSize);
}

template <std::size_t Kept>
void CommandTransmitterOf<Kept>::fill(BodyWriter& body, Instant now) {
  // First, and once each: while the car repeats what we know, it has no room for what we ask.
  for (const CommandId id : acks_due_) {
    // One that finds no room is not lost: its result comes again.
    if (!body.add_record(RecordType::kCommandResultAck, to_bytes(ResultAckRecord{id, run_}))) break;
  }
  acks_due_.clear();
  // From the oldest on, so that the car learns of them in the order in which they were given.
  for (std::size_t i = 1; open_ > 0 && i <= Kept; ++i) {
    Entry& entry = kept_[(newest_ + i) % Kept];
    if (!entry.open()) continue;
    CommandProgress& one = entry.progress;
    const auto& row = row_of(one.command.type);
    const CommandRecord record{
        .number = one.id,
        .base_run = run_,
        .car_boot = entry.car_boot,
        .type = static_cast<std::uint8_t>(one.command.type),
        .step = static_cast<std::uint16_t>(row.quantized().encode(one.command.argument).step),
        .age = now - one.issued,
        .issuer = one.command.issuer};
    if (!body.add_record(RecordType::kCommand, to_bytes(record))) break;
    if (!one.sent) one.sent = now;
  }
}

template <std::size_t Kept>
bool CommandTransmitterOf<Kept>::take(const Record& record, const Received& received) {
  const auto result = parse_result(record.payload);
  if (record.type != RecordType::kCommandResult || !result) return false;
  if (result->base_run != run_) return true;  // of another run of ours: nobody asks any more
  if (result->number > newest_) return false;
  Entry& entry = place_of(result->number);
  if (entry.progress.id == result->number && !entry.progress.received) {
    entry.progress.received = received.at;
  }
  if (!is_final(result->outcome)) return true;
  if (entry.progress.id == result->number && entry.open()) {
    decide(entry, result->outcome, received.at);
  }
  if (std::find(acks_due_.begin(), acks_due_.end(), result->number) == acks_due_.end()) {
    (void)acks_due_.push(result->number);
  }
  return true;
}

template <std::size_t Kept>
void CommandTransmitterOf<Kept>::confirm(CommandId id, Instant now) {
  Entry& entry = place_of(id);
  if (id == 0 || entry.progress.id != id || entry.progress.outcome != Outcome::kApplied) return;
  if (!entry.progress.confirmed) entry.progress.confirmed = now;
}

template <std::size_t Kept>
const CommandProgress* CommandTransmitterOf<Kept>::progress(CommandId id) const {
  const Entry& entry = kept_[id % Kept];
  return id != 0 && entry.progress.id == id ? &entry.progress : nullptr;
}

template <std::size_t Kept>
const CommandProgress* CommandTransmitterOf<Kept>::newest(CommandType type) const {
  const CommandProgress* found = nullptr;
  for (const Entry& entry : kept_) {
    const CommandProgress& one = entry.progress;
    if (one.id == 0 || one.command.type != type) continue;
    if (!found || one.id > found->id) found = &one;
  }
  return found;
}

template <std::size_t Kept>
void CommandTransmitterOf<Kept>::decide(Entry& entry, Outcome outcome, Instant now) {
  entry.progress.outcome = outcome;
  entry.progress.decided = now;
  --open_;
}

template class CommandTransmitterOf<256>;
template class CommandTransmitterOf<4>;  // small enough that every state of it can be visited

}  // namespace pitwall::telemetry
