// SPDX-License-Identifier: Apache-2.0
#include "basestation/session/car_session.hpp"

#include <utility>

#include "basestation/inputs/joystick_device.hpp"
#include "basestation/link/stamp_file.hpp"
#include "basestation/publishers/bench/bench_link.hpp"
#include "basestation/publishers/recorder/journal.hpp"
#include "basestation/publishers/text/summary.hpp"
#include "basestation/service/recorded/recording.hpp"
#include "protocol/transport/clock.hpp"
#include "protocol/transport/file.hpp"

namespace pitwall::session {
namespace {

std::string word_of(state::LinkState state) {
  switch (state) {
    case state::LinkState::kNone:
      return {};
    case state::LinkState::kGood:
      return "good";
    case state::LinkState::kDegraded:
      return "degraded";
    case state::LinkState::kLost:
      return "lost";
  }
  return {};
}

// Keeps the car's newest stamp in its file.
class StampKeeper : public service::Publisher {
 public:
  StampKeeper(const std::string& path, telemetry::Stamp known, LogLine log)
      : file_(path, known), log_(std::move(log)) {}

  void publish(const service::CarService& car, Instant /*now*/) override {
    file_.keep(car.link().endpoint().newest_stamp());
    if (const auto problem = file_.take_problem()) {
      log_("stamp file not written: " + to_string(*problem) +
           "; a base that starts again begins without it");
    }
  }
  Instant due() const override { return Instant::max(); }

 private:
  link::StampFile file_;
  LogLine log_;
};

// The operator's joystick, and its samples for the recorder where there is one.
class JoystickInput : public service::Publisher {
 public:
  JoystickInput(inputs::JoystickDevice device, inputs::JoystickDevice::Sink recorder)
      : device_(std::move(device)), recorder_(std::move(recorder)) {}

  void submit(service::CarService& car, Instant now) override {
    device_.read(now, [&](const telemetry::JoystickSample& sample, Instant at) {
      car.requests().steer(sample, {.console = kConsole, .name = "joystick"}, at);
      if (recorder_) recorder_(sample, at);
    });
  }
  void publish(const service::CarService&, Instant) override {}
  Instant due() const override { return device_.due(); }
  int fd() const override { return device_.fd(); }

  command::JoystickState state(Instant now) const {
    using enum command::JoystickState;
    if (device_.lost(now)) return kLost;
    return device_.reports().enabled() ? kInUse : kReleased;
  }

 private:
  static constexpr telemetry::HolderId kConsole = 4;

  inputs::JoystickDevice device_;
  inputs::JoystickDevice::Sink recorder_;
};

}  // namespace

Result<std::unique_ptr<CarSession>, Problem> CarSession::open(Plan plan) {
  std::unique_ptr<CarSession> session{new CarSession(std::move(plan))};
  const auto opened = session->open_sockets();
  if (!opened) return Unexpected{opened.error()};
  session->service_ = std::make_unique<service::CarService>(
      session->plan_.service, session->plan_.config, session->randomness_);
  return session;
}

Result<bool, Problem> CarSession::open_sockets() {
  for (const UdpAddress& address : plan_.listen) {
    auto socket = transport::UdpSocket::bind(address);
    if (!socket) return Unexpected{socket.error()};
    radio_.push_back(*std::move(socket));
  }
  if (!plan_.arguments.command_socket.empty()) {
    auto socket = inputs::CommandSocket::open(plan_.arguments.command_socket);
    if (!socket) return Unexpected{socket.error()};
    commands_.emplace(*std::move(socket));
  }
  if (plan_.arguments.stop_port == 0) return true;
  auto socket =
      transport::UdpSocket::bind({.port = static_cast<std::uint16_t>(plan_.arguments.stop_port)});
  if (!socket) return Unexpected{socket.error()};
  stop_port_.emplace(*std::move(socket));
  return true;
}

std::string CarSession::title() const {
  const settings::Arguments& a = plan_.arguments;
  return "CAR " + std::to_string(a.car) + (a.car_name.empty() ? "" : " " + a.car_name);
}

std::string CarSession::listening() const {
  std::string line = "listening at ";
  for (const transport::UdpSocket& socket : radio_) {
    line += (&socket == &radio_.front() ? "" : " and ") + to_string(socket.local());
  }
  return line;
}

Result<bool, Problem> CarSession::begin(publishers::web::WebServer* server, const LogLine& log) {
  if (server != nullptr) begin_consoles(*server);
  if (!plan_.stamp_file.empty()) {
    attach(std::make_unique<StampKeeper>(plan_.stamp_file, plan_.config.association.newest_stamp,
                                         log));
  }
  const auto begun = begin_recording(log);
  return begun ? begin_joystick() : begun;
}

void CarSession::begin_consoles(publishers::web::WebServer& server) {
  auto consoles = std::make_unique<publishers::console::ConsoleService>(std::move(plan_.console),
                                                                        *service_, server);
  std::unique_ptr<publishers::bench::BenchLink> bench;
  if (!plan_.arguments.bench.empty()) {
    bench = std::make_unique<publishers::bench::BenchLink>(plan_.arguments.bench);
    consoles->attach(*bench);
  }
  attach(std::move(consoles));
  if (bench) attach(std::move(bench));
}

Result<bool, Problem> CarSession::begin_recording(const LogLine& log) {
  const settings::Arguments& a = plan_.arguments;
  if (a.record_folder.empty()) return true;
  auto started = service::start_recording(
      a.record_folder, service::run_metadata(a.car, a.car_name, a.judgement_file), *service_, log);
  if (!started) return Unexpected{started.error()};
  recording_ = *std::move(started);
  service_->link().observe(recorder::observer_of_datagrams(*recording_));
  attach(std::make_unique<recorder::Journal>(*recording_));
  return true;
}

Result<bool, Problem> CarSession::begin_joystick() {
  if (plan_.arguments.joystick.empty()) return true;
  auto opened = inputs::JoystickDevice::open(plan_.arguments.joystick, plan_.joystick);
  if (!opened) return Unexpected{opened.error()};
  auto joystick = std::make_unique<JoystickInput>(
      *std::move(opened),
      recording_ ? recorder::observer_of_joystick(*recording_) : inputs::JoystickDevice::Sink{});
  service_->watch_joystick([device = joystick.get()](Instant now) { return device->state(now); });
  attach(std::move(joystick));
  return true;
}

void CarSession::attach(std::unique_ptr<service::Publisher> publisher) {
  publishers_.push_back(publisher.get());
  owned_.push_back(std::move(publisher));
}

service::CarLoop CarSession::loop() {
  return {.service = service_.get(),
          .title = title(),
          .radio = radio_,
          .stop_port = stop_port_ ? &*stop_port_ : nullptr,
          .commands = commands_ ? &*commands_ : nullptr,
          .script = &plan_.script,
          .publishers = publishers_};
}

Result<bool, Problem> CarSession::write_summary() {
  if (plan_.arguments.json_path.empty()) return true;
  const Instant now = transport::monotonic_now();
  return transport::write_file(plan_.arguments.json_path,
                               publishers::json_summary(*service_, now, transport::bench_pause()));
}

CarStatus CarSession::status() const {
  return {.number = plan_.arguments.car,
          .name = plan_.arguments.car_name,
          .mode = service_->identity().mode,
          .link = word_of(service_->evaluator().link_state())};
}

}  // namespace pitwall::session
