// Staged operator commands and their life cycle: staged, sent, acknowledged, applied.
//
//   staged -> gated -> sent -> received -> applied
//                |       |         `-> refused | expired | superseded
//                `-------`-> refused (gates, or cancelled), expired (not sent in time)
//
//   in     what operators stage, send and cancel; the vehicle state; answers of the car
//   out    tickets with every step and its time; commands given to the radio's transmitter; audit
//          lines
//   invariants
//          gates are judged when a command is staged and again when it is sent, because a gate may
//          refuse by then. A command that a gate refuses is sent only with a reason and by a second
//          person, and never past a gate that cannot be overridden
//          a stop needs no ticket, no gate and no authority; it is sent at once, and repeated
//          a ticket is sent once; nothing waits for the link to come back
//   errors Problem with the ticket or the command as place; a refusal is in the audit log too
//   bound  kKept tickets; staged ones expire after kStagedFor
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "basestation/command/audit.hpp"
#include "basestation/command/gates.hpp"
#include "protocol/telemetry/endpoint/station_endpoint.hpp"
#include "protocol/vocabulary/result.hpp"
#include "protocol/vocabulary/time.hpp"

namespace pitwall::command {

enum class Step : std::uint8_t {
  kStaged,
  kGated,
  kSent,
  kReceived,
  kApplied,
  kRefused,
  kExpired,
  kSuperseded
};
inline constexpr std::size_t kSteps = 8;
std::string_view text_of(Step step);
constexpr bool is_final(Step step) { return step >= Step::kApplied; }

using TicketId = std::uint32_t;  // from 1

struct StopPress {
  std::string by;
  Instant at{};
};

// Override of gates: a reason, and the second person, whom the caller has identified by a token.
struct Override {
  std::string reason;
  Person second;
};

struct Ticket {
  TicketId id = 0;
  telemetry::Command command;
  Person by;
  Step step = Step::kStaged;
  std::array<std::optional<Instant>, kSteps> at{};
  std::vector<Gate> gates;
  std::optional<Override> overridden;
  std::optional<telemetry::CommandId> number;          // on the radio
  std::optional<telemetry::CommandProgress> progress;  // on the radio, as last known
  std::string text;                                    // why it ended in this step
  bool echoed = false;                                 // the car's state shows its effect
  std::uint64_t revision = 0;                          // of the queue, at the ticket's last change
};

class CommandQueue {
 public:
  static constexpr std::size_t kKept = 200;
  static constexpr Duration kStagedFor = seconds(30);

  // `second_person`: operators have tokens, so that an override needs a second person and a reason;
  // otherwise a reason is enough.
  CommandQueue(const GateParams& params, bool second_person, Audit& audit)
      : params_(params), second_person_(second_person), audit_(&audit) {}

  Result<TicketId, Problem> stage(const Person& by, telemetry::CommandType type, double argument,
                                  const GateInputs& inputs);
  Result<bool, Problem> send(TicketId id, const Person& by,
                             const std::optional<Override>& overriding, const GateInputs& inputs,
                             telemetry::StationEndpoint& radio);
  // Stages and sends at once; if a gate refuses, the ticket ends as refused.
  Result<bool, Problem> issue(const Person& by, telemetry::CommandType type, double argument,
                              const std::optional<Override>& overriding, const GateInputs& inputs,
                              telemetry::StationEndpoint& radio);
  Result<bool, Problem> cancel(TicketId id, const Person& by, Instant now);
  void stop(telemetry::StopLevel level, telemetry::StopReason reason, const Person& by, Instant now,
            telemetry::StationEndpoint& radio);

  // The newest stop that an operator pressed at this base.
  const std::optional<StopPress>& pressed() const { return pressed_; }

  // Takes over the progress that the car reports; staged tickets expire after kStagedFor. Call it
  // after every packet, and before the tickets are shown.
  void follow(const state::VehicleState& vehicle, const telemetry::StationEndpoint& radio,
              Instant now);

  const std::deque<Ticket>& tickets() const { return tickets_; }
  const Ticket* ticket(TicketId id) const;
  std::uint64_t revision() const { return revision_; }  // rises with each change of a ticket
  std::uint64_t issued() const { return issued_; }      // commands given to the radio

 private:
  Ticket* find(TicketId id);
  void reach(Ticket& ticket, Step step, Instant now);
  Unexpected<Problem> refuse(const Person& by, const std::string& what, std::string why,
                             Instant now);
  void end(Ticket& ticket, Step step, std::string text, Instant now);
  void follow(Ticket& ticket, const telemetry::CommandProgress& progress);

  GateParams params_;
  bool second_person_;
  Audit* audit_;
  std::deque<Ticket> tickets_;
  std::optional<StopPress> pressed_;
  std::uint64_t revision_ = 0, issued_ = 0;
  TicketId newest_ = 0;
};

}  // namespace pitwall::command
