// pitwall-base: the base's end of the radio: shows what the car says, tells it what the operator
// wants; makes the keys for both. Wiring only.
// SPDX-License-Identifier: Apache-2.0
#include <sys/signalfd.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "basestation/intake/key_pair.hpp"
#include "basestation/intake/operator_script.hpp"
#include "basestation/intake/station.hpp"
#include "basestation/outlets/summary.hpp"
#include "basestation/outlets/terminal.hpp"
#include "protocol/telemetry/export/export.hpp"
#include "protocol/transport/clock.hpp"
#include "protocol/transport/file.hpp"
#include "protocol/transport/posix_call.hpp"
#include "protocol/transport/udp_socket.hpp"

namespace pitwall {
namespace {

constexpr int kDone = 0, kFailed = 1, kMistake = 2;  // exit codes
constexpr std::uint16_t kDefaultPort = 23'431;
constexpr std::uint32_t kLoopbackNet = 127U << 24U, kNetMask = 0xFF00'0000U;
constexpr double kMaxDuration_s = 1e6, kMinRefresh_hz = 0.1, kMaxRefresh_hz = 100.0;
constexpr double kBytesPerKbit = 125.0, kMinBudget_kbit = 64.0, kMaxBudget_kbit = 100'000.0;

struct Arguments {
  std::vector<std::string> listen;
  std::string keys, command_file, json_path;
  int operator_port = 0;
  bool text = false, plain = false, all = false, network = false, signed_only = false;
  double duration_s = 0.0, refresh_hz = 10.0, budget_kbit = 256.0;
  std::string keygen_folder, export_kind;
};

std::string kinds() {
  std::string text;
  for (const std::string_view kind : telemetry::kExportKinds) {
    text += (text.empty() ? "" : ", ") + std::string{kind};
  }
  return text;
}

void describe(CLI::App& app, Arguments& a) {
  app.add_option("--keys", a.keys, "The base's keys, as keygen makes them");
  app.add_option("--listen", a.listen, "UDP address of a radio; twice for two")
      ->expected(1)
      ->take_all();
  app.add_flag("--network", a.network, "Allow --listen to be reached by other machines");
  app.add_flag("--signed", a.signed_only, "Authenticated but readable packets; the car must agree");
  app.add_option("--budget", a.budget_kbit, "kbit/s that may go up each radio")
      ->check(CLI::Range(kMinBudget_kbit, kMaxBudget_kbit))
      ->capture_default_str();
  app.add_option("--command", a.command_file, "What the operator says: lines AT_SECONDS WORDS");
  app.add_option("--operator-port", a.operator_port,
                 "Loopback UDP port for the operator's words, a line each")
      ->check(CLI::Range(1, 65'535));
  app.add_flag("--text", a.text, "Show the picture as text on the terminal");
  app.add_flag("--all", a.all, "Show every group");
  app.add_flag("--plain", a.plain, "No colours, one screen after the other");
  app.add_option("--duration", a.duration_s, "Stop after this many seconds")
      ->check(CLI::Range(0.0, kMaxDuration_s));
  app.add_option("--refresh", a.refresh_hz, "Screens per second")
      ->check(CLI::Range(kMinRefresh_hz, kMaxRefresh_hz))
      ->capture_default_str();
  app.add_option("--json", a.json_path, "Write a summary of the run to this file");
  CLI::App* const keygen = app.add_subcommand("keygen", "Make the keys of a car and its base");
  keygen->add_option("--out", a.keygen_folder, "Folder for car.keys and base.keys")->required();
  CLI::App* const exporting =
      app.add_subcommand("export", "Print what the radio says, as " + kinds());
  exporting->add_option("KIND", a.export_kind, kinds())->required();
}

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
  if (!text) return complain(kMistake, "export " + kind + ": one of " + kinds());
  return std::fwrite(text->data(), 1, text->size(), stdout) == text->size() ? kDone : kFailed;
}

// Everything that a run needs, found wrong before it begins.
struct Plan {
  std::vector<transport::UdpAddress> listen;
  intake::OperatorScript script;
  telemetry::ConduitConfig config;
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
  return plan;
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
  outlets::run_terminal({.radio = radio,
                         .words = words.empty() ? nullptr : &words.front(),
                         .script = &plan.script,
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
  CLI::App app{"Shows what the car says over the radio, and tells it what the operator wants",
               "pitwall-base"};
  Arguments arguments;
  describe(app, arguments);
  try {
    app.parse(argc, argv);
  } catch (const CLI::CallForHelp& help) {
    return app.exit(help);
  } catch (const CLI::ParseError& mistake) {
    return complain(kMistake, mistake.what());
  }
  if (!arguments.keygen_folder.empty()) return make_keys(arguments.keygen_folder);
  if (!arguments.export_kind.empty()) return print_export(arguments.export_kind);
  if (!std::isfinite(arguments.duration_s) || !std::isfinite(arguments.refresh_hz)) {
    return complain(kMistake, "--duration and --refresh are numbers");
  }
  auto plan = plan_of(arguments);
  if (!plan) return complain(kMistake, plan.error());
  return run(arguments, *plan);
}
