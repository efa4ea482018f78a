// Handover of the command authority between consoles: request, grant, refusal.
//   in     actions of consoles, time
//   out    the holder, the waiting request; lines for the audit log
//   invariants
//          a free authority is taken at once. A held one must be requested: the holder has kAnswer
//          to refuse; no answer grants the request. One request waits at a time; expiry of the
//          holder grants it at once, a renewal by the holder does not refuse it
//          renewal, drop and expiry follow telemetry::AuthorityRegister
//   errors Problem with the console as place: another console holds it, no request waits, not the
//          holder
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "basestation/command/audit.hpp"
#include "protocol/telemetry/command/authority.hpp"
#include "protocol/vocabulary/result.hpp"
#include "protocol/vocabulary/time.hpp"

namespace pitwall::command {

struct AuthorityRequest {
  Person by;
  Instant until{};  // it is granted at this time
};

class AuthorityHandover {
 public:
  static constexpr Duration kAnswer = seconds(5);

  AuthorityHandover(telemetry::AuthorityRegister& authority, Audit& audit)
      : authority_(&authority), audit_(&audit) {}

  Result<bool, Problem> take(const Person& who, Instant now);
  Result<bool, Problem> renew(const Person& who, Instant now);  // leaves no audit line
  Result<bool, Problem> drop(const Person& who, Instant now);
  Result<bool, Problem> request(const Person& who, Instant now);
  Result<bool, Problem> grant(const Person& who, Instant now);
  Result<bool, Problem> refuse(const Person& who, Instant now);
  // The console has disconnected: its request is withdrawn, its authority expires as usual.
  void left(const Person& who, Instant now);
  void advance(Instant now);  // call it before anything is shown

  telemetry::HolderId holder(Instant now) const { return authority_->holder(now); }
  const Person& holder_person() const { return person_; }  // of the newest holder
  const std::optional<AuthorityRequest>& waiting() const { return waiting_; }
  // The authority has expired, and no console has taken, dropped or handed it over since.
  bool lost() const { return lost_; }
  // Rises with every change of holder or request.
  std::uint64_t revision() const { return revision_; }

 private:
  // `refusal`: the reason of a refusal; nullptr if the action was done.
  Result<bool, Problem> log_result(const Person& who, const char* what, const char* refusal,
                                   Instant now);
  const char* why_not_answer(const Person& who, Instant now);
  void hold(const Person& who);
  void give(Instant now);

  telemetry::AuthorityRegister* authority_;
  Audit* audit_;
  Person person_;
  std::optional<AuthorityRequest> waiting_;
  bool lost_ = false;
  std::uint64_t revision_ = 0;
};

}  // namespace pitwall::command
