// SPDX-License-Identifier: Apache-2.0
#include "basestation/command/authority_handover.hpp"

namespace pitwall::command {

Result<bool, Problem> AuthorityHandover::log_result(const Person& who, const char* what,
                                                    const char* refusal, Instant now) {
  const bool ok = refusal == nullptr;
  audit_->add(now, who.name, what, ok ? "done" : std::string{"refused: "} + refusal);
  if (ok) return true;
  return Unexpected{Problem{"console " + std::to_string(who.console), refusal}};
}

void AuthorityHandover::hold(const Person& who) {
  person_ = who;
  lost_ = false;
  ++revision_;
}

Result<bool, Problem> AuthorityHandover::take(const Person& who, Instant now) {
  advance(now);
  if (authority_->holder(now) == who.console) return renew(who, now);
  if (!authority_->take(who.console, now)) {
    return log_result(who, "takes the authority", "somebody else holds it: ask for it", now);
  }
  waiting_.reset();  // who asked the one before asks the new one, if at all
  hold(who);
  return log_result(who, "takes the authority", nullptr, now);
}

Result<bool, Problem> AuthorityHandover::renew(const Person& who, Instant now) {
  advance(now);
  if (authority_->renew(who.console, now)) return true;
  return Unexpected{
      Problem{"console " + std::to_string(who.console), "does not hold the authority"}};
}

Result<bool, Problem> AuthorityHandover::drop(const Person& who, Instant now) {
  advance(now);
  if (authority_->holder(now) != who.console) {
    return log_result(who, "drops the authority", "does not hold it", now);
  }
  authority_->drop(who.console, now);
  hold({});
  const auto noted = log_result(who, "drops the authority", nullptr, now);
  if (waiting_) give(now);
  return noted;
}

Result<bool, Problem> AuthorityHandover::request(const Person& who, Instant now) {
  advance(now);
  const telemetry::HolderId holder = authority_->holder(now);
  if (holder == 0) return take(who, now);
  if (holder == who.console) {
    return log_result(who, "asks for the authority", "holds it already", now);
  }
  if (waiting_ && waiting_->by.console != who.console) {
    return log_result(who, "asks for the authority", "somebody else asks already", now);
  }
  if (!waiting_) {  // asking twice does not begin the time anew
    waiting_ = AuthorityRequest{who, now + kAnswer};
    ++revision_;
  }
  return log_result(who, "asks for the authority", nullptr, now);
}

Result<bool, Problem> AuthorityHandover::grant(const Person& who, Instant now) {
  if (const char* why = why_not_answer(who, now))
    return log_result(who, "grants the authority", why, now);
  const auto noted = log_result(who, "grants the authority", nullptr, now);
  give(now);
  return noted;
}

Result<bool, Problem> AuthorityHandover::refuse(const Person& who, Instant now) {
  if (const char* why = why_not_answer(who, now)) {
    return log_result(who, "refuses the authority", why, now);
  }
  waiting_.reset();
  ++revision_;
  return log_result(who, "refuses the authority", nullptr, now);
}

const char* AuthorityHandover::why_not_answer(const Person& who, Instant now) {
  advance(now);
  if (authority_->holder(now) != who.console) return "does not hold it";
  return waiting_ ? nullptr : "nobody asks for it";
}

void AuthorityHandover::left(const Person& who, Instant now) {
  advance(now);
  if (!waiting_ || waiting_->by.console != who.console) return;
  waiting_.reset();
  ++revision_;
  audit_->add(now, who.name, "asked for the authority", "left before the answer");
}

void AuthorityHandover::advance(Instant now) {
  const bool held = authority_->holder(now) != 0;
  if (person_.console != 0 && !held) {
    audit_->add(now, person_.name, "held the authority", "expired");
    hold({});
    lost_ = true;
  }
  if (waiting_ && (!held || now >= waiting_->until)) give(now);
}

// To the one who waits.
void AuthorityHandover::give(Instant now) {
  const Person to = waiting_->by;
  waiting_.reset();
  const telemetry::HolderId from = authority_->holder(now);
  const bool given =
      from == 0 ? authority_->take(to.console, now) : authority_->hand_over(from, to.console, now);
  if (given) hold(to);
  audit_->add(now, to.name, "is given the authority", given ? "done" : "refused");
}

}  // namespace pitwall::command
