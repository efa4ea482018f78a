// SPDX-License-Identifier: Apache-2.0
#include "tests/tidy/identifier_rules.hpp"

#include <algorithm>
#include <string>
#include <string_view>

namespace pitwall::tidy {
namespace {

using Folders = std::vector<std::string_view>;

struct PrivateName {
  std::string_view name;
  std::string_view instead;
  Folders folders;  // where it is one; none: everywhere
};

const Folders kProduct{"protocol", "vehicle", "basestation", "hil"};
const Folders kHil{"hil", "tests/hil"};
const Folders kBase{"basestation", "tests/basestation"};

const std::vector<PrivateName> kPrivateNames{
    // Types.
    {"Air", "RadioChannel", {"hil/bench", "tests/hil/bench"}},
    {"AuthorityDesk", "AuthorityRegister", {}},
    {"BaseSight", "BaseStatus", {}},
    {"BenchWish", "BenchRequest", {}},
    {"Books", "MonitorState", {}},
    {"CarSight", "CarStatus", {}},
    {"CarStand", "CarSession", {}},
    {"Cast", "ProcessSupervisor", kHil},
    {"CommandDesk", "CommandTransmitter", {}},
    {"CommandDeskOf", "CommandTransmitterOf", {}},
    {"Conduit", "LinkEndpoint", {}},
    {"ConduitConfig", "LinkEndpointConfig", {}},
    {"ConsoleRoom", "ClientRegistry", {}},
    {"Contest", "Comparison", {}},
    {"Contestant", "Peer", {}},
    {"Deed", "ProcessAction", {}},
    {"Desk", "what it is: server, register, transmitter, queue", {}},
    {"DeskServer", "BenchSocket", {}},
    {"Doing", "the handler of the command", {}},
    {"Ears", "observer or decoder", {}},
    {"Eyes", "StateSource", {}},
    {"Heard", "Received", {}},
    {"HeardCar", "ReceivedCommands", {}},
    {"HeardMessage", "ReceivedMessage", {}},
    {"HeldPath", "PathDeviation", {}},
    {"OperatorWishes", "OperatorInputs", {}},
    {"OperatorWord", "OperatorText", {}},
    {"RadioDesk", "RadioAdapter", {}},
    {"RadioLadder", "LinkLossPolicy", {}},
    {"RadioLadderOutput", "LinkLossOutput", {}},
    {"RadioLadderParams", "LinkLossParams", {}},
    {"RadioLadderState", "LinkLossState", {}},
    {"ReceiverEars", "ReceiverDecoder", {}},
    {"ReceiverSpeech", "ReceiverEncoder", {}},
    {"Said", "the record that it is", {}},
    {"Sight", "BaseStatus or CarStatus", kBase},
    {"StopDesk", "StopTransmitter", {}},
    {"StopWish", "StopRequest", {}},
    {"Storm", "StressLoad", {"tests/benchmarks"}},
    {"Told", "the message that it is", {}},
    {"UdpIntake", "UdpReceiver", {}},
    {"Understudy", "Standby", {}},
    {"UnixBusWishes", "UnixBusOptions", {}},
    {"VectorNavVoice", "VectorNavEncoder", {}},
    {"Wall", "the console service", {}},
    // Functions and variables.
    {"books", "monitors", kBase},
    {"conduit", "endpoint", {}},
    {"deed", "action", {}},
    {"deeds", "actions", {}},
    {"desk", "what it is: server, register, transmitter, queue", {}},
    {"desk_", "what it is: server, register, transmitter, queue", {}},
    {"ears", "decoder", kProduct},
    {"ears_", "decoder_", {}},
    {"errands", "command handlers", {}},
    {"hear", "receive", {}},
    {"heard", "received", {}},
    {"heed", "apply or arbitrate", {}},
    {"heed_guardian", "apply_guardian", {}},
    {"heed_operator", "apply_operator", {}},
    {"incidents", "derived signals", {}},
    {"knock", "send_opening", {}},
    {"nobody_obeys", "drive_by_wire_gone", {}},
    {"obey", "execute", {}},
    {"outlet", "publisher", {}},
    {"outlets", "publishers", {}},
    {"overhear", "observe", {}},
    {"overheard", "observed", {}},
    {"recall", "restore", {}},
    {"remember", "store", {}},
    {"run_terminal", "run_event_loop", {}},
    {"said", "what it is: output, text, entry", {}},
    {"sight", "status", kBase},
    {"speech", "encoder", kProduct},
    {"tell", "publish", kProduct},
    {"teller", "sink", {}},
    {"told", "reported", {}},
    {"understudy", "standby", {}},
    {"voice", "encoder", kProduct},
    {"wish", "request", {}},
    {"wishes", "inputs, options", {}},
};

bool applies(const PrivateName& entry, const std::string& path) {
  return entry.folders.empty() || std::ranges::any_of(entry.folders, [&](std::string_view folder) {
           return lies_in(path, folder);
         });
}

// The identifiers of a line of code, each once for each time it stands there.
std::vector<std::string_view> identifiers_of(std::string_view line) {
  std::vector<std::string_view> found;
  for (std::size_t at = 0; at < line.size();) {
    if (!is_word(line[at])) {
      ++at;
      continue;
    }
    std::size_t end = at;
    while (end < line.size() && is_word(line[end])) ++end;
    found.push_back(line.substr(at, end - at));
    at = end;
  }
  return found;
}

bool is_include(std::string_view line) {
  const std::size_t first = line.find_first_not_of(" \t");
  return first != std::string_view::npos && line[first] == '#';
}

}  // namespace

std::vector<Finding> check_identifiers(const SourceFile& file) {
  std::vector<Finding> findings;
  if (!is_cpp(file)) return findings;
  const std::vector<std::string> code = split_lines(file.code);
  for (std::size_t i = 0; i < code.size(); ++i) {
    if (is_include(code[i])) continue;
    for (const std::string_view name : identifiers_of(code[i])) {
      const auto entry = std::ranges::find(kPrivateNames, name, &PrivateName::name);
      if (entry == kPrivateNames.end() || !applies(*entry, file.path)) continue;
      findings.push_back(
          {file.path, i + 1,
           std::string{name} + " is a private name: write " + std::string{entry->instead}});
    }
  }
  return findings;
}

}  // namespace pitwall::tidy
