// SPDX-License-Identifier: Apache-2.0
#include "vehicle/io/guardian_link.hpp"

#include "protocol/transport/clock.hpp"

namespace pitwall::io {

Result<GuardianLink, Problem> GuardianLink::open(const std::string& name, bool arm) {
  GuardianLink link;
  if (name.empty()) return link;
  auto shared = SharedStop::open(name);
  if (!shared) return Unexpected{shared.error()};
  link.shared_.emplace(*std::move(shared));
  link.reported_ = std::make_unique<pipeline::GuardianRecord>();
  link.arm_ = arm;
  link.run_ = static_cast<std::uint64_t>(transport::utc_now().ns);  // no two starts share it
  const auto found = std::make_unique<guardian::CarRecord>();
  if (link.shared_->read(*found)) link.barred_ = arm && pipeline::ended_armed(*found);
  return link;
}

pipeline::GuardianView GuardianLink::view(Instant now) {
  if (!shared_) return {};
  received_ = shared_->read(status_) || received_;
  return received_ ? pipeline::view_of(status_, run_, now) : pipeline::GuardianView{};
}

void GuardianLink::publish(const pipeline::Setup& setup, const pipeline::Car& car,
                           const pipeline::Outputs& out, bool reset, Instant now) {
  if (!shared_) return;
  ever_armed_ |= out.chosen.actuate;
  barred_ = barred_ && !ever_armed_;  // somebody has looked, and armed it anew
  const bool unarmed_start = !arm_ && !ever_armed_;
  pipeline::publish(setup, car, out,
                    {.id = run_, .reset = reset || unarmed_start, .barred = barred_}, now,
                    *reported_);
  shared_->write(reported_->record);
}

void GuardianLink::finish() {
  if (!shared_) return;
  pipeline::finish(*reported_);
  shared_->write(reported_->record);
}

}  // namespace pitwall::io
