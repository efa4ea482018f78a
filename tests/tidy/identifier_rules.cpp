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
    {"AgeBook", "AgeStatistics", {}},
    {"Air", "RadioChannel", {"hil/bench", "tests/hil/bench"}},
    {"AttemptBook", "AttemptTracker", {}},
    {"AuthorityDesk", "AuthorityRegister", {}},
    {"BaseSight", "BaseStatus", {}},
    {"BenchBook", "BenchState", {}},
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
    {"CorrectionWatch", "CorrectionMonitor", {}},
    {"Deed", "ProcessAction", {}},
    {"Desk", "what it is: server, register, transmitter, queue", {}},
    {"DeskServer", "BenchSocket", {}},
    {"Doing", "the handler of the command", {}},
    {"Ear", "ArrivalRecorder", {"vehicle/safety", "tests/vehicle/safety"}},
    {"Ears", "observer or decoder", {}},
    {"Eyes", "StateSource", {}},
    {"Falsehoods", "ContentErrors", {}},
    {"Finder", "CauseCollector", {"vehicle/safety"}},
    {"FuelBook", "FuelEstimator", {}},
    {"Guarded", "GuardianLink", {}},
    {"Heard", "Received", {}},
    {"HeardCar", "ReceivedCommands", {}},
    {"HeardMessage", "ReceivedMessage", {}},
    {"HeldPath", "PathDeviation", {}},
    {"ImuWitness", "ImuReference", {}},
    {"Judgement", "Evaluation", {"basestation/alarms", "tests/basestation/alarms"}},
    {"LcmTwin", "LcmSegmentWriter", {}},
    {"LinkNews", "LinkEvents", {}},
    {"LinkWatch", "LinkStateMonitor", {}},
    {"Looking", "FakeStateSource", {}},
    {"OperatorWishes", "OperatorInputs", {}},
    {"OperatorWord", "OperatorText", {}},
    {"PathBook", "PathState", {}},
    {"RadioDesk", "RadioAdapter", {}},
    {"RadioLadder", "LinkLossPolicy", {}},
    {"RadioLadderOutput", "LinkLossOutput", {}},
    {"RadioLadderParams", "LinkLossParams", {}},
    {"RadioLadderState", "LinkLossState", {}},
    {"RadioRung", "LinkLossLevel", {}},
    {"ReactionBook", "ReactionMonitor", {}},
    {"ReceiptBook", "ReceivedPackets", {}},
    {"ReceiverEars", "ReceiverDecoder", {}},
    {"ReceiverSpeech", "ReceiverEncoder", {}},
    {"Reported", "GuardianRecord", {"vehicle/pipeline"}},
    {"Rim", "CarIo, GuardianIo or SocketIo", {}},
    {"RimCounters", "IoCounters", {}},
    {"RoomCounters", "RequestCounters", {}},
    {"Said", "the record that it is", {}},
    {"SayLine", "PrintLine", {}},
    {"SchemaClaim", "SchemaDescription", {}},
    {"SchemaTalk", "SchemaExchange", {}},
    {"SenderHabits", "SenderTiming", {}},
    {"SentBook", "SentPackets", {}},
    {"Sight", "BaseStatus or CarStatus", kBase},
    {"SignalPicture", "SignalPlot", {}},
    {"SocketRim", "SocketIo", {}},
    {"StandIn", "GuardianControl", {}},
    {"StopDesk", "StopTransmitter", {}},
    {"StopWish", "StopRequest", {}},
    {"Storm", "StressLoad", {"tests/benchmarks"}},
    {"TapInputs", "TelemetryInputs", {}},
    {"TokenBook", "TokenStore", {}},
    {"Told", "the message that it is", {}},
    {"UdpIntake", "UdpReceiver", {}},
    {"Understudy", "Standby", {}},
    {"UnixBusWishes", "UnixBusOptions", {}},
    {"VectorNavVoice", "VectorNavEncoder", {}},
    {"WaitingRoom", "PendingConnections", {}},
    {"Wall", "the console service", {}},
    {"Wanted", "PlannedMotion", {"vehicle/safety"}},
    // Functions and variables.
    {"acquitted", "period_confirmed", {}},
    {"ask_to_end", "request_end", {}},
    {"astray_", "out_of_sync_", {}},
    {"base_hears", "base_receives", {}},
    {"be_somewhere", "set_position", {}},
    {"bell_", "wake_fd_", {}},
    {"blamed", "faulty", {"vehicle", "tests/vehicle"}},
    {"body_again", "reencode_body", {}},
    {"books", "monitors", kBase},
    {"car_hears", "car_receives", {}},
    {"comings_", "activations_", {}},
    {"conduit", "endpoint", {}},
    {"confess", "report_lost", {}},
    {"deed", "action", {}},
    {"deeds", "actions", {}},
    {"descend", "apply_link_loss_policy", {"vehicle/safety", "tests/vehicle/safety"}},
    {"desk", "what it is: server, register, transmitter, queue", {}},
    {"desk_", "what it is: server, register, transmitter, queue", {}},
    {"dog", "watchdog", {"vehicle/safety", "tests/vehicle/safety"}},
    {"ears", "decoder", kProduct},
    {"ears_", "decoder_", {}},
    {"errands", "command handlers", {}},
    {"exec_words", "exec_arguments", {}},
    {"eyes", "source", kBase},
    {"failed_to_hear", "note_receive_error", {}},
    {"fall_silent", "stop or go_bus_off", {"hil", "tests/benchmarks", "tests/system"}},
    {"flags_let_roll", "flags_allow_motion", {}},
    {"gave_back", "try_hand_back", {}},
    {"give_way", "lower_priority", {}},
    {"go_on_behind", "resume_after", {}},
    {"hear", "receive", {}},
    {"hear_bus", "receive_frames", {}},
    {"hear_forces", "store_accelerations", {}},
    {"hear_imu", "apply_imu", {}},
    {"hear_steering", "receive_steering", {}},
    {"hear_wheels", "receive_wheel_speeds", {}},
    {"heard", "received", {}},
    {"hears", "record or receive", {"vehicle", "tests/vehicle"}},
    {"heed", "apply or arbitrate", {}},
    {"heed_guardian", "apply_guardian", {}},
    {"heed_operator", "apply_operator", {}},
    {"hindrance", "takeover_obstacle", {}},
    {"incidents", "derived signals", {}},
    {"kBrakeStrays", "kBrakeDeviates", {}},
    {"kCarSpeaks", "kCarSends", {}},
    {"kHoweverLong", "kNoTimeout", {}},
    {"kLadderRungs", "kLinkLossLevels", {}},
    {"kLook", "kPollPeriod", {}},
    {"kLookEvery", "kPollPeriod", {}},
    {"kMostOfAPath", "kAddressesPerPathMax", {}},
    {"kOverslept", "kPauseMin", {}},
    {"kPardonMax", "kDiscountMax", {}},
    {"kPatience", "kTimeout", {}},
    {"kRoomToCome", "kMemoryToAccept", {}},
    {"kRoomToStay", "kMemoryToKeep", {}},
    {"kSayingAgain", "kLogRepeatPeriod", {}},
    {"kSpeakEvery", "kSendPeriod", {}},
    {"kSteeringStrays", "kSteeringDeviates", {}},
    {"kTell", "kNotify", {}},
    {"kTellEvery", "kPublishPeriod", {}},
    {"kTending", "kHousekeepingPeriod", {}},
    {"kThrottleStrays", "kThrottleDeviates", {}},
    {"kVoids", "kRevokes", {}},
    {"kWordEvery", "kReportPeriod", {}},
    {"keep_guardian", "record_guardian", {}},
    {"keep_link", "record_link", {}},
    {"keep_operator", "record_operator", {}},
    {"kept_from_others", "safety_reserve", {}},
    {"knock", "send_opening", {}},
    {"knows_time", "has_time", {}},
    {"ladder", "link_loss", {"vehicle", "tests/vehicle"}},
    {"lately_", "recent_", {}},
    {"less_the_way", "subtract_path", {}},
    {"let_go_on", "resume", {}},
    {"let_idle_bits_pass", "count_idle_bits", {}},
    {"liar", "faulty_unit", {"vehicle", "tests/vehicle"}},
    {"lies_about_time", "has_wrong_time", {}},
    {"look_after_bench", "check_bench", {}},
    {"look_again", "refresh or reopen", {}},
    {"look_again_and_again", "refresh_periodically", {}},
    {"next_news", "next_event", {}},
    {"next_speech", "next_send", {}},
    {"nobody_obeys", "drive_by_wire_gone", {}},
    {"obey", "execute", {}},
    {"outlet", "publisher", {}},
    {"outlets", "publishers", {}},
    {"overhear", "observe", {}},
    {"overheard", "observed", {}},
    {"overslept", "paused", {}},
    {"own_will", "brakes_itself", {}},
    {"pardon", "discount_pause", {}},
    {"pardoned", "discounted", {}},
    {"pass_over", "skip_damaged", {}},
    {"peer_knows", "sendable_groups", {}},
    {"pushes_on", "throttle_stuck_open", {}},
    {"put_out", "queue_datagram", {}},
    {"recall", "restore", {}},
    {"remember", "store", {}},
    {"rim", "io", {"vehicle", "tests/vehicle"}},
    {"rim_", "io_", {}},
    {"run_terminal", "run_event_loop", {}},
    {"rung", "level", {"vehicle", "tests/vehicle"}},
    {"said", "what it is: output, text, entry", {}},
    {"say_bytes", "send_bytes", {}},
    {"says_nothing_new", "is_redundant", {}},
    {"see_jump", "count_jump", {}},
    {"seems_to_stand", "is_at_standstill", {}},
    {"sight", "status", kBase},
    {"silenced_", "listen_only_drops_", {"vehicle"}},
    {"slept", "pause", {"vehicle/safety", "vehicle/guardian"}},
    {"some_state", "sample_state", {}},
    {"speaks", "sends", {"vehicle", "tests/vehicle"}},
    {"speech", "encoder", kProduct},
    {"stands_in", "is_substitute", {"vehicle", "tests/vehicle"}},
    {"steering_strayed", "steering_deviated", {}},
    {"stranger", "judge_unlisted", {"vehicle/safety"}},
    {"straying", "excess_deviation", {}},
    {"take_caller", "accept_client", {}},
    {"take_up", "restore_newest", {}},
    {"tell", "publish", kProduct},
    {"tell_all", "send_to_all", {}},
    {"tell_error", "send_error", {}},
    {"tell_health", "put_health", {}},
    {"tell_history", "send_history", {}},
    {"tell_judge", "apply_judge_input", {}},
    {"teller", "sink", {}},
    {"tend", "run_housekeeping", {"basestation"}},
    {"told", "reported", {}},
    {"understudies", "standbys", {}},
    {"understudy", "standby", {}},
    {"unheard", "undelivered", {}},
    {"unseen_", "unacknowledged_", {}},
    {"unsettled_", "settings_pending_", {}},
    {"voice", "encoder", {"protocol", "vehicle", "hil"}},
    {"voids_arming", "revokes_arming", {}},
    {"warden_", "cleanup_process_", {}},
    {"was_blind", "had_no_guidance", {}},
    {"watch_over", "run_ticks", {}},
    {"ways_", "lanes_", {}},
    {"wind", "control_playback", kBase},
    {"wish", "request", {}},
    {"wishes", "inputs, options", {}},
    {"witness", "reference", {"vehicle/autonomy", "tests/vehicle/autonomy"}},
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

// The console's own modules; scripts of tests are no product.
bool is_of_console(const SourceFile& file) {
  return lies_in(file.path, "basestation/console/src") &&
         (file.path.ends_with(".ts") || file.path.ends_with(".tsx"));
}

bool is_include(std::string_view line) {
  const std::size_t first = line.find_first_not_of(" \t");
  return first != std::string_view::npos && line[first] == '#';
}

}  // namespace

std::vector<Finding> check_identifiers(const SourceFile& file) {
  std::vector<Finding> findings;
  if (!is_cpp(file) && !is_of_console(file)) return findings;
  const std::vector<std::string> code =
      split_lines(is_cpp(file) ? file.code : blank_comments_and_literals(file.text));
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
