// pitwall-base: the base station of one or several cars: radio, console, publishers, operators'
// commands; makes the keys of car and base. Wiring only.
// SPDX-License-Identifier: Apache-2.0
#include <sys/signalfd.h>

#include <csignal>
#include <cstdio>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "basestation/link/key_pair.hpp"
#include "basestation/publishers/console/recording_list.hpp"
#include "basestation/publishers/console/replay_console.hpp"
#include "basestation/publishers/metrics/board.hpp"
#include "basestation/publishers/metrics/exposition.hpp"
#include "basestation/publishers/ros_view/package.hpp"
#include "basestation/publishers/text/terminal.hpp"
#include "basestation/publishers/web/web_server.hpp"
#include "basestation/service/event_loop.hpp"
#include "basestation/service/recorded/alarm_check.hpp"
#include "basestation/session/car_session.hpp"
#include "basestation/session/plan.hpp"
#include "basestation/session/roster.hpp"
#include "basestation/session/tools.hpp"
#include "basestation/settings/arguments.hpp"
#include "basestation/settings/cars_file.hpp"
#include "protocol/recorder/segment_folder.hpp"
#include "protocol/telemetry/export/export.hpp"
#include "protocol/transport/clock.hpp"
#include "protocol/transport/posix_call.hpp"

namespace pitwall {
namespace {

namespace console = publishers::console;
namespace web = publishers::web;

constexpr int kDone = 0, kFailed = 1, kMistake = 2;  // exit codes

using session::CarSession;
using settings::Arguments;
using Sessions = std::vector<std::unique_ptr<CarSession>>;

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

int make_keys(const std::string& folder, bool bench) {
  telemetry::SystemRandomness randomness;
  const auto written = link::write_key_pair(folder, link::make_key_pair(randomness, bench));
  if (!written) return complain(kFailed, written.error());
  std::printf("%s/%s and %s/%s: %s\n", folder.c_str(), link::kCarKeys, folder.c_str(),
              link::kBaseKeys,
              bench ? "KEYS OF A BENCH: sessions may be logged, a real car refuses them"
                    : "secret, one for each end");
  return kDone;
}

int write_ros_package(const std::string& folder) {
  if (folder.empty()) return complain(kMistake, "export ros: needs --out FOLDER");
  const auto written = publishers::ros_view::write_package(folder);
  if (!written) return complain(kFailed, written.error());
  std::printf("%s: %zu files; colcon build in a workspace that has it below src/\n", folder.c_str(),
              *written);
  return kDone;
}

int print_export(const std::string& kind) {
  const auto text = telemetry::export_text(kind);
  if (!text) return complain(kMistake, "export " + kind + ": one of " + settings::export_kinds());
  return std::fwrite(text->data(), 1, text->size(), stdout) == text->size() ? kDone : kFailed;
}

int judge(const std::string& folder) {
  std::vector<std::string> problems;
  const auto judged = service::check_alarms(folder, problems);
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

void log_line(const std::string& line) { complain(kDone, line); }

Result<std::unique_ptr<web::WebServer>, Problem> start_web(const Arguments& a,
                                                           web::HttpConfig http) {
  const auto address =
      transport::parse_udp_address(a.web_address + ":" + std::to_string(*a.web_port));
  if (!address) return Unexpected{address.error()};
  http.log = log_line;
  auto server = web::WebServer::start(*address, std::move(http));
  if (server)
    log_line("console at " + std::string{a.web_certificate.empty() ? "http://" : "https://"} +
             to_string((*server)->local()));
  return server;
}

// Which recordings there are to be played, told to consoles as long as it lives.
std::unique_ptr<console::RecordingList> list_recordings(const Arguments& a,
                                                        web::WebServer& server) {
  std::string folder = a.recordings_folder;
  if (folder.empty()) folder = a.replay_folder.empty() ? a.record_folder : a.replay_folder;
  if (folder.empty()) return nullptr;
  return std::make_unique<console::RecordingList>(
      std::move(folder), a.track, [&server](std::string text) {
        server.show(std::string{console::kRecordingsPath}, {std::move(text), web::kJsonType});
      });
}

int play(const Arguments& arguments) {
  if (!arguments.web_port) return complain(kMistake, "--replay needs --web PORT");
  auto plan = session::plan_of_replay(arguments, log_line);
  if (!plan) return complain(kMistake, plan.error());
  service::RecordingIndex index{plan->service.evaluator.course};
  auto player = replay::Player::open(arguments.replay_folder, &index);
  if (!player) return complain(kMistake, player.error());
  for (const std::string& problem : player->problems()) log_line(problem);
  const transport::FileDescriptor stop = stop_signals();
  auto server = start_web(arguments, session::served({&*plan, 1}));
  if (!server) return complain(kFailed, server.error());
  auto foxglove = session::foxglove_of_replay(arguments, *player, log_line);
  if (!foxglove) return complain(kFailed, foxglove.error());
  const auto recordings = list_recordings(arguments, **server);
  console::ReplayConsole consoles{std::move(plan->service), *std::move(player), std::move(index),
                                  **server};
  if (*foxglove) consoles.tell_also(**foxglove);
  const auto control_playback = [&consoles](double speed, std::optional<Instant> to) {
    consoles.control_playback(speed, to);
  };
  console::run_replay(consoles, (*server)->fd(), stop.get(), from_seconds(arguments.duration_s),
                      [&](Instant now) {
                        if (*foxglove) (*foxglove)->serve(consoles.player(), control_playback, now);
                      });
  return kDone;
}

// What else shows or keeps what a car says.
Result<bool, Problem> attach_publishers(Sessions& sessions, web::WebServer* server,
                                        publishers::metrics::Board& board) {
  for (std::size_t car = 0; car < sessions.size(); ++car) {
    const auto attached = session::attach_tools(*sessions[car],
                                                {.car = car,
                                                 .cars = sessions.size(),
                                                 .board = server != nullptr ? &board : nullptr,
                                                 .server = car == 0 ? server : nullptr},
                                                log_line);
    if (!attached) return attached;
  }
  return true;
}

Result<bool, Problem> open_sessions(std::vector<session::Plan> plans, Sessions& sessions) {
  const bool several = plans.size() > 1;
  for (session::Plan& plan : plans) {
    auto opened = CarSession::open(std::move(plan));
    if (!opened) return Unexpected{opened.error()};
    log_line((several ? (*opened)->title() + " " : "") + (*opened)->listening());
    sessions.push_back(*std::move(opened));
  }
  return true;
}

void serve(const Arguments& arguments, const Sessions& sessions, web::WebServer* server, int stop) {
  std::vector<service::CarLoop> cars;
  std::vector<publishers::TerminalCar> shown;
  for (const auto& car : sessions) {
    cars.push_back(car->loop());
    shown.push_back({.service = &car->service(), .title = car->title()});
  }
  publishers::Screen screen{shown,
                            {.plain = arguments.plain,
                             .all = arguments.all,
                             .refresh = from_seconds(1.0 / arguments.refresh_hz)},
                            stdout};
  publishers::StationLog threats{shown, stderr};
  std::vector<service::LoopTask*> tasks{&threats};
  if (arguments.text) tasks = {&screen};
  std::optional<session::Roster> roster;
  if (server != nullptr) {
    roster.emplace(*server, [&sessions] {
      std::vector<session::CarStatus> statuses;
      for (const auto& car : sessions) statuses.push_back(car->status());
      return statuses;
    });
    tasks.push_back(&*roster);
  }
  service::run_event_loop(cars, tasks, from_seconds(arguments.duration_s), stop);
}

int run(const Arguments& arguments, std::vector<session::Plan> plans) {
  const transport::FileDescriptor stop = stop_signals();
  web::HttpConfig http = session::served(plans);
  publishers::metrics::Board board;  // outlives the server
  http.made[session::kMetricsPath] = [&board] {
    return web::Shown{board.text(transport::bench_pause()), publishers::metrics::kContentType};
  };
  std::unique_ptr<web::WebServer> server;  // outlives the sessions
  Sessions sessions;
  const auto opened = open_sessions(std::move(plans), sessions);
  if (!opened) return complain(kFailed, opened.error());
  if (arguments.web_port) {
    auto started = start_web(arguments, std::move(http));
    if (!started) return complain(kFailed, started.error());
    server = *std::move(started);
  }
  for (const auto& car : sessions) {
    const auto begun = car->begin(server.get(), log_line);
    if (!begun) return complain(kFailed, begun.error());
  }
  const auto recordings = server ? list_recordings(arguments, *server) : nullptr;
  const auto attached = attach_publishers(sessions, server.get(), board);
  if (!attached) return complain(kFailed, attached.error());
  if (const auto taken = transport::take_turns(); !taken) return complain(kFailed, taken.error());
  serve(arguments, sessions, server.get(), stop.get());
  int code = kDone;
  for (const auto& car : sessions) {
    const auto written = car->write_summary();
    if (!written) code = complain(kFailed, written.error());
  }
  return code;
}

}  // namespace
}  // namespace pitwall

int main(int argc, char** argv) {
  using namespace pitwall;
  const auto parsed = settings::parse_arguments(argc, argv);
  if (const auto* const leave = std::get_if<settings::Leave>(&parsed)) {
    return leave->message.empty() ? leave->code : complain(leave->code, leave->message);
  }
  const auto& arguments = std::get<settings::Arguments>(parsed);
  if (!arguments.keygen_folder.empty()) {
    return make_keys(arguments.keygen_folder, arguments.keygen_bench);
  }
  if (arguments.export_kind == "ros") return write_ros_package(arguments.export_folder);
  if (!arguments.export_kind.empty()) return print_export(arguments.export_kind);
  if (!arguments.recover_files.empty()) return recover(arguments.recover_files);
  if (!arguments.judge_folder.empty()) return judge(arguments.judge_folder);
  if (!arguments.replay_folder.empty()) return play(arguments);
  if (const auto clock = transport::use_clock(arguments.clock); !clock)
    return complain(kMistake, clock.error());
  const auto cars = settings::cars_of(arguments);
  if (!cars) return complain(kMistake, cars.error());
  auto plans = session::plans_of(*cars, log_line);
  if (!plans) return complain(kMistake, plans.error());
  return run(arguments, *std::move(plans));
}
