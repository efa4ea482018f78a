// Handover of the authority between consoles: request, grant, refusal.
//   in     acts of consoles, time
//   out    the holder, a request that waits; lines for the audit log
//   invariants
//          a free authority is taken at once. A held one is asked for: its holder has kAnswer to
//          refuse; who says nothing has granted. One request waits at a time; the holder's expiry
//          grants it at once, his renewals do not refuse it
//          renewing, dropping and expiry are telemetry::AuthorityRegister's
//   errors Problem with the console as place: somebody else holds it, nobody asked, not the holder
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "basestation/command/audit.hpp"
#include "basestation/command/person.hpp"
#include "protocol/telemetry/command/authority.hpp"
#include "protocol/vocabulary/result.hpp"
#include "protocol/vocabulary/time.hpp"

namespace pitwall::command {

struct AuthorityRequest {
  Person by;
  Instant until{};  // granted then
};

class AuthorityHandover {
 public:
  static constexpr Duration kAnswer = seconds(5);

  AuthorityHandover(telemetry::AuthorityRegister& authority, Audit& audit)
      : authority_(&authority), audit_(&audit) {}

  Result<bool, Problem> take(const Person& who, Instant now);
  Result<bool, Problem> renew(const Person& who, Instant now);  // leaves no line
  Result<bool, Problem> drop(const Person& who, Instant now);
  Result<bool, Problem> request(const Person& who, Instant now);
  Result<bool, Problem> grant(const Person& who, Instant now);
  Result<bool, Problem> refuse(const Person& who, Instant now);
  // The console is gone: its request falls, its authority expires as anybody's.
  void left(const Person& who, Instant now);
  void advance(Instant now);  // before anything is shown

  telemetry::HolderId holder(Instant now) const { return authority_->holder(now); }
  const Person& holder_person() const { return person_; }  // of the newest holder
  const std::optional<AuthorityRequest>& waiting() const { return waiting_; }
  // It expired, and nobody has taken, dropped or handed it over since.
  bool lost() const { return lost_; }
  // Rises with every change of holder or request.
  std::uint64_t revision() const { return revision_; }

 private:
  // `why_not`: nullptr where it was done.
  Result<bool, Problem> say(const Person& who, const char* what, const char* why_not, Instant now);
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
