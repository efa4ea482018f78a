// SPDX-License-Identifier: Apache-2.0
#include "protocol/telemetry/command/command_ledger.hpp"

#include <algorithm>

namespace pitwall::telemetry {

template <std::size_t Depth>
CommandLedgerOf<Depth>::CommandLedgerOf(std::uint64_t own_boot) : boot_(short_boot(own_boot)) {}

template <std::size_t Depth>
void CommandLedgerOf<Depth>::set_peer_boot(std::uint64_t base_boot) {
  const std::uint32_t run = short_boot(base_boot);
  if (run_ == run) return;
  run_ = run;
  entries_ = {};
  newest_out_ = {};
  newest_ = 0;
}

template <std::size_t Depth>
bool CommandLedgerOf<Depth>::take(const Record& record, const Received& received,
                                  const AuthorityView& authority) {
  const bool well_formed = record.type == RecordType::kCommand
                               ? take_command(record, received, authority)
                               : take_ack(record);
  if (!well_formed) ++counters_.malformed;
  return well_formed;
}

template <std::size_t Depth>
bool CommandLedgerOf<Depth>::take_command(const Record& record, const Received& received,
                                          const AuthorityView& authority) {
  const auto request = parse_command(record.payload);
  if (!request) return false;
  if (request->base_run != run_) return ++counters_.other_base, true;
  Entry& entry = entries_[request->number % Depth];
  if (entry.number == request->number) {
    ++counters_.repeated;
    entry.result_known = false;  // it still asks
    if (entry.waits() && !entry.expires) learn_expiry(entry, *request, received);
    return true;
  }
  // What is older than memory reaches has had its answer, else the newer one were not given.
  if (request->number + std::uint64_t{Depth} <= newest_) return ++counters_.repeated, true;
  if (entry.number != 0 && !is_final(entry.outcome)) return ++counters_.full, true;
  ++counters_.received;
  newest_ = std::max(newest_, request->number);
  entry = {};
  entry.number = request->number;
  if (request->known()) {
    entry.command = request->command();
    learn_expiry(entry, *request, received);
  }
  if (const Outcome outcome = judge(*request, authority, received.at); is_final(outcome)) {
    settle(entry, outcome);
  }
  return true;
}

template <std::size_t Depth>
bool CommandLedgerOf<Depth>::take_ack(const Record& record) {
  const auto ack = parse_result_ack(record.payload);
  if (record.type != RecordType::kCommandResultAck || !ack) return false;
  if (ack->base_run != run_) return ++counters_.other_base, true;
  Entry& entry = entries_[ack->number % Depth];
  if (entry.number == ack->number && is_final(entry.outcome)) entry.result_known = true;
  return true;
}

template <std::size_t Depth>
Outcome CommandLedgerOf<Depth>::judge(const CommandRecord& record, const AuthorityView& authority,
                                      Instant at) const {
  if (record.car_boot != boot_) return Outcome::kOtherRun;
  if (!record.known()) return Outcome::kUnsupported;
  if (record.number < newest_out_[record.type]) return Outcome::kSuperseded;
  const auto& expires = entries_[record.number % Depth].expires;
  if (!expires) return Outcome::kReceived;  // neither its age nor the authority can be judged
  if (at > *expires) return Outcome::kExpired;
  if (!authority.allows(record.command(), at)) return Outcome::kNoAuthority;
  return Outcome::kReceived;
}

template <std::size_t Depth>
void CommandLedgerOf<Depth>::learn_expiry(Entry& entry, const CommandRecord& record,
                                          const Received& received) {
  if (!received.sent_earliest) return;
  // A sender whose clock stands in the future does not make its commands younger.
  const Instant sent = std::min(*received.sent_earliest, received.at);
  entry.expires = sent - record.age + row_of(entry.command.type).time_to_live;
}

template <std::size_t Depth>
void CommandLedgerOf<Depth>::expire(Instant now) {
  for (Entry& entry : entries_) {
    if (entry.waits() && entry.expires && now > *entry.expires) settle(entry, Outcome::kExpired);
  }
}

template <std::size_t Depth>
std::optional<DueCommand> CommandLedgerOf<Depth>::take_due(Instant now,
                                                           const AuthorityView& authority) {
  expire(now);
  while (Entry* const entry = oldest_due()) {
    if (is_replaced(*entry)) {
      settle(*entry, Outcome::kSuperseded);
    } else if (!authority.allows(entry->command, now)) {
      settle(*entry, Outcome::kNoAuthority);
    } else {
      const auto type = static_cast<std::size_t>(entry->command.type);
      newest_out_[type] = entry->number;
      entry->handle = ++handles_;
      if (row_of(entry->command.type).needs_authority) {
        entry->expires = std::min(*entry->expires, authority.until());
      }
      return DueCommand{entry->handle, entry->number, entry->command, *entry->expires};
    }
  }
  return std::nullopt;
}

template <std::size_t Depth>
auto CommandLedgerOf<Depth>::oldest_due() -> Entry* {
  Entry* oldest = nullptr;
  for (Entry& entry : entries_) {
    if (!entry.waits() || !entry.expires) continue;
    if (oldest == nullptr || entry.number < oldest->number) oldest = &entry;
  }
  return oldest;
}

template <std::size_t Depth>
bool CommandLedgerOf<Depth>::is_replaced(const Entry& entry) const {
  if (entry.number < newest_out_[static_cast<std::size_t>(entry.command.type)]) return true;
  return std::any_of(entries_.begin(), entries_.end(), [&](const Entry& other) {
    return other.waits() && other.command.type == entry.command.type && other.number > entry.number;
  });
}

template <std::size_t Depth>
void CommandLedgerOf<Depth>::decide(CommandId id, Outcome outcome, Instant at) {
  if (id == 0 || !is_final(outcome)) return;
  for (Entry& entry : entries_) {
    if (entry.handle != id || is_final(entry.outcome)) continue;
    const bool late = outcome == Outcome::kApplied && at > *entry.expires;
    settle(entry, late ? Outcome::kExpired : outcome);
  }
}

template <std::size_t Depth>
void CommandLedgerOf<Depth>::settle(Entry& entry, Outcome outcome) {
  entry.outcome = outcome;
  ++counters_.decided[static_cast<std::size_t>(outcome)];
  if (outcome == Outcome::kApplied) ++counters_.applied;
}

template <std::size_t Depth>
std::size_t CommandLedgerOf<Depth>::wanted() const {
  const auto reported = std::count_if(entries_.begin(), entries_.end(), [](const Entry& entry) {
    return entry.number != 0 && !entry.result_known;
  });
  return static_cast<std::size_t>(reported) * BodyWriter::record_size(kResultSize);
}

template <std::size_t Depth>
void CommandLedgerOf<Depth>::fill(BodyWriter& body, Instant now) {
  expire(now);
  for (std::size_t i = 1; i <= Depth; ++i) {  // oldest first
    const Entry& entry = entries_[(newest_ + i) % Depth];
    if (entry.number == 0 || entry.result_known) continue;
    const auto bytes = to_bytes(ResultRecord{entry.number, *run_, entry.outcome});
    if (!body.add_record(RecordType::kCommandResult, bytes)) return;
  }
}

template class CommandLedgerOf<256>;
template class CommandLedgerOf<4>;  // small enough that every state of it can be visited

}  // namespace pitwall::telemetry
