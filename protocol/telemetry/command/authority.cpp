// SPDX-License-Identifier: Apache-2.0
#include "protocol/telemetry/command/authority.hpp"

#include <algorithm>

#include "protocol/vocabulary/sequence.hpp"

namespace pitwall::telemetry {
namespace {

constexpr FieldIndex kHolder = field("authority.holder"), kEpoch = field("authority.epoch"),
                     kRenewal = field("authority.renewal"),
                     kRenewalAge = field("authority.renewal_age");
constexpr auto kNumbers = static_cast<std::uint32_t>(kFields[kEpoch].quantized().count());
static_assert(kNumbers == kFields[kRenewal].quantized().count() && kNumbers <= 65'536);

constexpr std::uint16_t after(std::uint16_t number) {
  return static_cast<std::uint16_t>((number + 1U) % kNumbers);
}

// In the field's steps, rounded up: a renewal is never taken for younger than it is.
double rounded_up_ms(Duration age) {
  const auto step = static_cast<std::int64_t>(kFields[kRenewalAge].resolution * 1e6);
  return static_cast<double>((age.ns + step - 1) / step * step) * 1e-6;
}

struct Statement {
  HolderId holder;
  std::uint16_t epoch, renewal;
};
std::optional<Statement> statement_in(const Values& values) {
  const double holder = values[kHolder], epoch = values[kEpoch], renewal = values[kRenewal];
  if (!(holder >= 0 && epoch >= 0 && renewal >= 0)) return std::nullopt;  // unset
  return Statement{static_cast<HolderId>(holder), static_cast<std::uint16_t>(epoch),
                   static_cast<std::uint16_t>(renewal)};
}

// When the console renewed, never later than the truth.
std::optional<Instant> renewal_time(const Values& values, const Received& received) {
  const double age_ms = values[kRenewalAge];
  if (!received.sent_earliest || !(age_ms >= 0)) return std::nullopt;
  return std::min(*received.sent_earliest, received.at) - from_seconds(age_ms * 1e-3);
}

}  // namespace

bool AuthorityRegister::take(HolderId who, Instant now) {
  if (who == 0) return false;
  const HolderId present = holder(now);
  if (present == who) return renew(who, now);
  if (present != 0) return false;
  begin(who, now);
  return true;
}

bool AuthorityRegister::renew(HolderId who, Instant now) {
  if (who == 0 || holder(now) != who) return false;
  renewal_ = after(renewal_);
  renewed_ = now;
  return true;
}

bool AuthorityRegister::hand_over(HolderId from, HolderId to, Instant now) {
  if (from == 0 || to == 0 || holder(now) != from) return false;
  begin(to, now);
  return true;
}

void AuthorityRegister::drop(HolderId who, Instant now) {
  if (who != 0 && holder(now) == who) begin(0, now);
}

HolderId AuthorityRegister::holder(Instant now) const {
  return now - renewed_ < kAuthorityExpiry ? holder_ : HolderId{0};
}

void AuthorityRegister::put(Values& values, Instant now) const {
  const HolderId present = holder(now);
  values[kHolder] = present;
  values[kEpoch] = epoch_;
  values[kRenewal] = renewal_;
  values[kRenewalAge] = present == 0 ? kUnset : rounded_up_ms(now - renewed_);
}

void AuthorityRegister::begin(HolderId who, Instant now) {
  holder_ = who;
  epoch_ = after(epoch_);
  renewal_ = after(renewal_);
  renewed_ = now;
}

void AuthorityView::receive(const Values& values, const Received& received) {
  const auto statement = statement_in(values);
  if (!statement) return;
  const bool silent = !received_at_ || received.at - *received_at_ > kAuthorityExpiry;
  if (silent || is_newer(statement->epoch, epoch_, kNumbers)) {
    *this = {};
    holder_ = statement->holder;
    epoch_ = statement->epoch;
  } else if (statement->epoch != epoch_) {
    return;
  }
  received_at_ = received_at_ ? std::max(*received_at_, received.at) : received.at;
  if (statement->holder == 0) holder_ = 0;  // this epoch is over, whatever comes late
  if (holder_ == 0 || holder_ != statement->holder) return;
  if (renewed_ && !is_newer(statement->renewal, renewal_, kNumbers)) return;
  // One whose time cannot be told yet counts when a copy of it can be.
  if (const auto renewed = renewal_time(values, received)) {
    renewed_ = *renewed;
    renewal_ = statement->renewal;
  }
}

HolderId AuthorityView::holder(Instant now) const {
  return renewed_ && now - *renewed_ < kAuthorityExpiry ? holder_ : HolderId{0};
}

Instant AuthorityView::until() const {
  // The last moment at which holder() still names one.
  return (renewed_ ? *renewed_ : kNeverSampled) + (kAuthorityExpiry - nanoseconds(1));
}

bool AuthorityView::allows(const Command& command, Instant now) const {
  if (!row_of(command.type).needs_authority) return true;
  return command.issuer != 0 && holder(now) == command.issuer;
}

}  // namespace pitwall::telemetry
