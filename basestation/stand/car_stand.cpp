// SPDX-License-Identifier: Apache-2.0
#include "basestation/stand/car_stand.hpp"

#include <utility>

#include "basestation/intake/stamp_file.hpp"
#include "basestation/outlets/bench/bench_link.hpp"
#include "basestation/outlets/summary.hpp"
#include "basestation/outlets/wall/recording.hpp"
#include "protocol/transport/clock.hpp"
#include "protocol/transport/file.hpp"

namespace pitwall::stand {
namespace {

std::string word_of(picture::LinkState state) {
  switch (state) {
    case picture::LinkState::kNone:
      return {};
    case picture::LinkState::kGood:
      return "good";
    case picture::LinkState::kDegraded:
      return "degraded";
    case picture::LinkState::kLost:
      return "lost";
  }
  return {};
}

// Keeps the car's newest stamp in its file.
class StampKeeper : public outlets::Outlet {
 public:
  StampKeeper(const std::string& path, telemetry::Stamp known, Say say)
      : file_(path, known), say_(std::move(say)) {}

  void packet(const intake::Station& /*station*/, const telemetry::Arrival& /*arrival*/) override {}
  void serve(intake::Station& station, Instant /*now*/) override {
    file_.keep(station.endpoint().newest_stamp());
    if (const auto problem = file_.take_problem()) {
      say_("stamp file not written: " + to_string(*problem) +
           "; a base that starts again begins without it");
    }
  }
  Instant due() const override { return {INT64_MAX}; }

 private:
  intake::StampFile file_;
  Say say_;
};

}  // namespace

Result<std::unique_ptr<CarStand>, Problem> CarStand::open(Plan plan) {
  std::unique_ptr<CarStand> stand{new CarStand(std::move(plan))};
  const auto opened = stand->open_sockets();
  if (!opened) return Unexpected{opened.error()};
  stand->station_ = std::make_unique<intake::Station>(stand->plan_.config, stand->randomness_);
  return stand;
}

Result<bool, Problem> CarStand::open_sockets() {
  for (const transport::UdpAddress& address : plan_.listen) {
    auto socket = transport::UdpSocket::bind(address);
    if (!socket) return Unexpected{socket.error()};
    radio_.push_back(*std::move(socket));
  }
  if (plan_.arguments.operator_port == 0) return true;
  auto socket = transport::UdpSocket::bind(
      {.port = static_cast<std::uint16_t>(plan_.arguments.operator_port)});
  if (!socket) return Unexpected{socket.error()};
  words_.push_back(*std::move(socket));
  return true;
}

std::string CarStand::title() const {
  const settings::Arguments& a = plan_.arguments;
  return "CAR " + std::to_string(a.car) + (a.car_name.empty() ? "" : " " + a.car_name);
}

std::string CarStand::listening() const {
  std::string said = "listening at ";
  for (const transport::UdpSocket& socket : radio_) {
    said += (&socket == &radio_.front() ? "" : " and ") + to_string(socket.local());
  }
  return said;
}

Result<bool, Problem> CarStand::begin(outlets::web::WebServer* server, const Say& say) {
  if (server != nullptr) {
    wall_ = std::make_unique<outlets::wall::Wall>(std::move(plan_.wall), *station_, *server);
    outlets_.push_back(wall_.get());
    if (!plan_.arguments.bench.empty()) {
      auto bench = std::make_unique<outlets::bench::BenchLink>(plan_.arguments.bench);
      wall_->attach(*bench);
      attach(std::move(bench));
    }
  }
  if (!plan_.stamp_file.empty()) {
    attach(std::make_unique<StampKeeper>(plan_.stamp_file, plan_.config.association.newest_stamp,
                                         say));
  }
  const auto begun = begin_recording(say);
  return begun ? begin_joystick() : begun;
}

Result<bool, Problem> CarStand::begin_recording(const Say& say) {
  const settings::Arguments& a = plan_.arguments;
  if (a.record_folder.empty()) return true;
  auto started = outlets::wall::start_recording(
      a.record_folder, outlets::wall::run_metadata(a.car, a.car_name, a.judgement_file),
      wall_.get(), say);
  if (!started) return Unexpected{started.error()};
  recording_ = *std::move(started);
  journal_.emplace(*recording_, !wall_);
  station_->overhear(recorder::teller_of_datagrams(*recording_));
  outlets_.push_back(&*journal_);
  return true;
}

Result<bool, Problem> CarStand::begin_joystick() {
  if (plan_.arguments.joystick.empty()) return true;
  auto opened = outlets::JoystickFeed::open(plan_.arguments.joystick, plan_.joystick);
  if (!opened) return Unexpected{opened.error()};
  joystick_.emplace(*std::move(opened));
  if (recording_) joystick_->tell(recorder::teller_of_joystick(*recording_));
  outlets_.push_back(&*joystick_);
  if (wall_) wall_->watch_joystick([this](Instant now) { return joystick_state(now); });
  return true;
}

command::JoystickState CarStand::joystick_state(Instant now) const {
  using enum command::JoystickState;
  if (joystick_->lost(now)) return kLost;
  return joystick_->reports().enabled() ? kInUse : kReleased;
}

void CarStand::attach(std::unique_ptr<outlets::Outlet> outlet) {
  outlets_.push_back(outlet.get());
  attached_.push_back(std::move(outlet));
}

outlets::Lines CarStand::lines() {
  return {.station = station_.get(),
          .title = title(),
          .radio = radio_,
          .words = words_.empty() ? nullptr : &words_.front(),
          .script = &plan_.script,
          .outlets = outlets_};
}

Result<bool, Problem> CarStand::write_summary() {
  if (plan_.arguments.json_path.empty()) return true;
  const Instant now = transport::monotonic_now();
  station_->advance(now);
  return transport::write_file(plan_.arguments.json_path,
                               outlets::json_summary(*station_, now, transport::bench_pause()));
}

CarSight CarStand::sight() const {
  CarSight sight{.number = plan_.arguments.car, .name = plan_.arguments.car_name};
  sight.mode = outlets::wall::mode_of(station_->source());
  if (wall_) sight.link = word_of(wall_->watch().link_state());
  return sight;
}

}  // namespace pitwall::stand
