// pitwall-base: the base's end of the radio: shows what the car says, tells it what the operator
// wants; makes the keys for both. Wiring only.
// SPDX-License-Identifier: Apache-2.0
#include <sys/signalfd.h>

#include <algorithm>
#include <csignal>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "basestation/intake/key_pair.hpp"
#include "basestation/intake/operator_script.hpp"
#include "basestation/intake/station.hpp"
#include "basestation/outlets/joystick_feed.hpp"
#include "basestation/outlets/recorder/journal.hpp"
#include "basestation/outlets/summary.hpp"
#include "basestation/outlets/terminal.hpp"
#include "basestation/outlets/wall/catalogue_text.hpp"
#include "basestation/outlets/wall/data_files.hpp"
#include "basestation/outlets/wall/judge_again.hpp"
#include "basestation/outlets/wall/recording.hpp"
#include "basestation/outlets/wall/replay_wall.hpp"
#include "basestation/outlets/wall/track_document.hpp"
#include "basestation/outlets/wall/wall.hpp"
#include "basestation/outlets/web/web_server.hpp"
#include "basestation/settings/arguments.hpp"
#include "basestation/settings/judgement_file.hpp"
#include "protocol/recorder/segment_folder.hpp"
#include "protocol/telemetry/export/export.hpp"
#include "protocol/transport/clock.hpp"
#include "protocol/transport/file.hpp"
#include "protocol/transport/posix_call.hpp"
#include "protocol/transport/udp_socket.hpp"

namespace pitwall {
namespace {

namespace wall = outlets::wall;
namespace web = outlets::web;

constexpr int kDone = 0, kFailed = 1, kMistake = 2;  // exit codes
constexpr std::uint16_t kDefaultPort = 23'431;
constexpr std::uint32_t kLoopbackNet = 127U << 24U, kNetMask = 0xFF00'0000U;
constexpr double kBytesPerKbit = 125.0;

using settings::Arguments;

int complain(int code, const std::string& what) {
  std::fprintf(stderr, "pitwall-base: %s\n", what.c_str());
  return code;
}
int complain(int code, const Problem& problem) { return complain(code, to_string(problem)); }

// SIGINT and SIGTERM become readable instead of interrupting.
transport::FileDescriptor stop_signals() {
  sigset_t set;
  sigemptyset(&set);
  sigaddset(&set, SIGINT);
  sigaddset(&set, SIGTERM);
  sigprocmask(SIG_BLOCK, &set, nullptr);
  return transport::FileDescriptor{
      transport::posix_call([&] { return ::signalfd(-1, &set, SFD_CLOEXEC | SFD_NONBLOCK); })};
}

int make_keys(const std::string& folder) {
  telemetry::SystemRandomness randomness;
  const auto written = intake::write_key_pair(folder, intake::make_key_pair(randomness));
  if (!written) return complain(kFailed, written.error());
  std::printf("%s/%s and %s/%s: secret, one for each end\n", folder.c_str(), intake::kCarKeys,
              folder.c_str(), intake::kBaseKeys);
  return kDone;
}

int print_export(const std::string& kind) {
  const auto text = telemetry::export_text(kind);
  if (!text) return complain(kMistake, "export " + kind + ": one of " + settings::export_kinds());
  return std::fwrite(text->data(), 1, text->size(), stdout) == text->size() ? kDone : kFailed;
}

// Everything that a run needs, found wrong before it begins.
struct Plan {
  std::vector<transport::UdpAddress> listen;
  intake::OperatorScript script;
  telemetry::ConduitConfig config;
  web::HttpConfig http;
  wall::WallConfig wall;
  intake::JoystickMapping joystick;
};

Result<std::vector<transport::UdpAddress>, Problem> addresses_of(const Arguments& arguments) {
  std::vector<std::string> wanted = arguments.listen;
  if (wanted.empty()) wanted.push_back(to_string(transport::UdpAddress{.port = kDefaultPort}));
  if (wanted.size() > telemetry::kPaths) {
    return Unexpected{Problem{"--listen", "at most two radios"}};
  }
  std::vector<transport::UdpAddress> addresses;
  for (const std::string& text : wanted) {
    const auto address = transport::parse_udp_address(text);
    if (!address) return Unexpected{Problem{"--listen", to_string(address.error())}};
    if ((address->ip & kNetMask) != kLoopbackNet && !arguments.network) {
      return Unexpected{Problem{"--listen " + text,
                                "open to other machines; add --network if "
                                "that is meant"}};
    }
    addresses.push_back(*address);
  }
  return addresses;
}

// A file that is not there yet is made with the first change.
Result<settings::Judgement, Problem> judgement_of(const std::string& path) {
  if (std::filesystem::exists(path)) return settings::read_judgement_file(path);
  complain(kDone, path + ": not there; limits and alarms as they came, changes go into it");
  return settings::Judgement{};
}

command::SettingsDesk::Save saver(const std::string& path) {
  return [path](const command::SettingsDesk::Wanted& wanted) {
    return transport::write_file(
        path, settings::judgement_text(wanted.derive, wanted.limits, wanted.alarms, wanted.revision,
                                       wanted.up_kbit_s));
  };
}

Result<bool, Problem> plan_web(const Arguments& a, Plan& plan) {
  plan.http.console = wall::console_folder(a.console_folder);
  plan.http.layouts = a.layouts_folder;
  web::AccessRules& access = plan.http.access;
  access.names = a.web_names;
  const bool trusted = a.default_role.empty() ? !a.network : a.default_role == "operator";
  access.default_role = trusted ? web::Role::kOperator : web::Role::kViewer;
  if (!a.tokens_file.empty()) {
    const auto text = transport::read_private_file(a.tokens_file);
    if (!text) return Unexpected{text.error()};
    auto tokens = web::Tokens::parse(*text, a.tokens_file);
    if (!tokens) return Unexpected{tokens.error()};
    access.tokens = *std::move(tokens);
  }
  if (!a.judgement_file.empty()) {
    auto judged = judgement_of(a.judgement_file);
    if (!judged) return Unexpected{judged.error()};
    plan.wall.revision = judged->revision;
    plan.wall.up_kbit_s = std::min(judged->up_kbit_s, a.budget_kbit);  // unset stays unset
    plan.wall.watch = *std::move(judged);
    plan.wall.save = saver(a.judgement_file);
  }
  plan.http.documents["/api/track"] = {};
  if (!a.track.empty()) {
    auto track = wall::read_track(wall::track_file(a.track));
    if (!track) return Unexpected{track.error()};
    plan.http.documents["/api/track"] = std::move(track->json);
    plan.wall.watch.course = std::move(track->course);
  }
  plan.wall.car = a.car;
  plan.wall.name = a.car_name;
  plan.wall.up_cap_kbit_s = a.budget_kbit;
  plan.wall.tokens = access.tokens;
  const auto& limits = plan.wall.watch.limits;
  plan.http.documents.emplace(
      "/api/catalogue", wall::catalogue_text([&](picture::FieldId id) -> const picture::Limit& {
        return limits.of(id);
      }));
  return true;
}

Result<Plan, Problem> plan_of(const Arguments& arguments) {
  Plan plan;
  auto listen = addresses_of(arguments);
  if (!listen) return Unexpected{listen.error()};
  plan.listen = *std::move(listen);
  if (arguments.keys.empty()) {
    return Unexpected{Problem{"--keys", "needed; pitwall-base keygen --out FOLDER makes them"}};
  }
  const auto keys = intake::read_keys(arguments.keys, telemetry::Role::kBase);
  if (!keys) return Unexpected{keys.error()};
  plan.config.association.keys = *keys;
  plan.config.association.greeting.signed_only = arguments.signed_only;
  plan.config.association.paths = static_cast<std::uint8_t>(plan.listen.size());
  for (telemetry::BudgetParams& budget : plan.config.budget) {
    budget.bytes_per_s = arguments.budget_kbit * kBytesPerKbit;
    const auto made = telemetry::PathBudget::make(budget);
    if (!made) return Unexpected{Problem{"--budget", made.error().what}};
  }
  if (!arguments.command_file.empty()) {
    const auto text = transport::read_file(arguments.command_file);
    if (!text) return Unexpected{text.error()};
    auto script = intake::OperatorScript::parse(*text, arguments.command_file);
    if (!script) return Unexpected{script.error()};
    plan.script = *std::move(script);
  }
  const auto axes = intake::JoystickMapping::parse(arguments.joystick_axes);
  if (!axes) return Unexpected{axes.error()};
  plan.joystick = *axes;
  if (arguments.web_port) {
    const auto planned = plan_web(arguments, plan);
    if (!planned) return Unexpected{planned.error()};
  }
  return plan;
}

int judge(const std::string& folder) {
  std::vector<std::string> problems;
  const auto judged = wall::judge_again(folder, problems);
  for (const std::string& problem : problems) complain(kDone, problem);
  if (!judged) return complain(kMistake, judged.error());
  for (const std::string& difference : judged->differences()) complain(kDone, difference);
  std::printf("%llu lists and %llu lines of alarms judged again, %llu differ\n",
              static_cast<unsigned long long>(judged->lists()),
              static_cast<unsigned long long>(judged->lines()),
              static_cast<unsigned long long>(judged->different()));
  return judged->different() == 0 ? kDone : kFailed;
}

int recover(const std::vector<std::string>& files) {
  int code = kDone;
  for (const std::string& file : files) {
    const auto line = recorder::recover_file(file);
    code = line ? complain(code, *line) : complain(kFailed, line.error());
  }
  return code;
}

Result<std::unique_ptr<web::WebServer>, Problem> start_web(const Arguments& a, Plan& plan) {
  auto server = web::WebServer::start({.ip = a.network ? transport::kAnyIp : transport::kLoopbackIp,
                                       .port = static_cast<std::uint16_t>(*a.web_port)},
                                      std::move(plan.http));
  if (server) complain(kDone, "console at http://" + to_string((*server)->local()));
  return server;
}

int play(const Arguments& arguments) {
  if (!arguments.web_port) return complain(kMistake, "--replay needs --web PORT");
  Plan plan;
  const auto planned = plan_web(arguments, plan);
  if (!planned) return complain(kMistake, planned.error());
  auto player = replay::Player::open(arguments.replay_folder);
  if (!player) return complain(kMistake, player.error());
  for (const std::string& problem : player->problems()) complain(kDone, problem);
  const transport::FileDescriptor stop = stop_signals();
  auto server = start_web(arguments, plan);
  if (!server) return complain(kFailed, server.error());
  wall::ReplayWall consoles{std::move(plan.wall), *std::move(player), **server};
  wall::run_replay(consoles, (*server)->fd(), stop.get(), from_seconds(arguments.duration_s));
  return kDone;
}

int run(const Arguments& arguments, Plan& plan) {
  const transport::FileDescriptor stop = stop_signals();
  std::vector<transport::UdpSocket> radio;
  std::string said = "listening at ";
  for (const transport::UdpAddress& address : plan.listen) {
    auto socket = transport::UdpSocket::bind(address);
    if (!socket) return complain(kFailed, socket.error());
    said += (radio.empty() ? "" : " and ") + to_string(socket->local());
    radio.push_back(*std::move(socket));
  }
  std::vector<transport::UdpSocket> words;  // none or one
  if (arguments.operator_port != 0) {
    auto socket =
        transport::UdpSocket::bind({.port = static_cast<std::uint16_t>(arguments.operator_port)});
    if (!socket) return complain(kFailed, socket.error());
    words.push_back(*std::move(socket));
  }
  complain(kDone, said);
  telemetry::SystemRandomness randomness;
  const auto station = std::make_unique<intake::Station>(plan.config, randomness);
  std::unique_ptr<recorder::Recorder> recording;  // outlives who tells it
  std::optional<recorder::Journal> journal;
  std::optional<outlets::JoystickFeed> joystick;
  std::unique_ptr<web::WebServer> server;
  std::unique_ptr<wall::Wall> consoles;
  std::vector<outlets::Outlet*> others;
  if (arguments.web_port) {
    auto started = start_web(arguments, plan);
    if (!started) return complain(kFailed, started.error());
    server = *std::move(started);
    consoles = std::make_unique<wall::Wall>(std::move(plan.wall), *station, *server);
    others.push_back(consoles.get());
  }
  if (!arguments.record_folder.empty()) {
    auto started = wall::start_recording(
        arguments.record_folder,
        wall::run_metadata(arguments.car, arguments.car_name, arguments.judgement_file),
        consoles.get(), [](const std::string& line) { complain(kDone, line); });
    if (!started) return complain(kFailed, started.error());
    recording = *std::move(started);
    journal.emplace(*recording, !consoles);
    others.push_back(&*journal);
  }
  if (!arguments.joystick.empty()) {
    auto opened = outlets::JoystickFeed::open(arguments.joystick, plan.joystick);
    if (!opened) return complain(kFailed, opened.error());
    joystick.emplace(*std::move(opened));
    if (recording) joystick->tell(recorder::teller_of_joystick(*recording));
    others.push_back(&*joystick);
    if (consoles) consoles->watch_joystick([&](Instant now) { return joystick->lost(now); });
  }
  outlets::run_terminal({.radio = radio,
                         .words = words.empty() ? nullptr : &words.front(),
                         .script = &plan.script,
                         .outlets = others,
                         .stop = stop.get()},
                        {.text = arguments.text,
                         .plain = arguments.plain,
                         .all = arguments.all,
                         .duration = from_seconds(arguments.duration_s),
                         .refresh = from_seconds(1.0 / arguments.refresh_hz)},
                        *station, stdout);
  if (arguments.json_path.empty()) return kDone;
  const Instant now = transport::monotonic_now();
  station->advance(now);
  const auto written =
      transport::write_file(arguments.json_path, outlets::json_summary(*station, now));
  return written ? kDone : complain(kFailed, written.error());
}

}  // namespace
}  // namespace pitwall

int main(int argc, char** argv) {
  using namespace pitwall;
  const auto parsed = settings::parse_arguments(argc, argv);
  if (const auto* const leave = std::get_if<settings::Leave>(&parsed)) {
    return leave->said.empty() ? leave->code : complain(leave->code, leave->said);
  }
  const auto& arguments = std::get<settings::Arguments>(parsed);
  if (!arguments.keygen_folder.empty()) return make_keys(arguments.keygen_folder);
  if (!arguments.export_kind.empty()) return print_export(arguments.export_kind);
  if (!arguments.recover_files.empty()) return recover(arguments.recover_files);
  if (!arguments.judge_folder.empty()) return judge(arguments.judge_folder);
  if (!arguments.replay_folder.empty()) return play(arguments);
  auto plan = plan_of(arguments);
  if (!plan) return complain(kMistake, plan.error());
  return run(arguments, *plan);
}
