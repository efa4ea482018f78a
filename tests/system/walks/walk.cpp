// One value's walk through the product, for callgrind to follow (walks_test.cpp): the car's own bus
// socket, pipeline and radio, the base's own session, event loop and console server, in one process
// on loopback. Only the walk itself is instrumented.
//   in     "frame": a wheel-speed frame from the bus to a console's socket
//          "command": the exclusion of a sensor from a console's socket to the car
//   out    exit code 0 where the value arrived; what went wrong on stderr
// SPDX-License-Identifier: Apache-2.0
#include <sys/eventfd.h>
#include <unistd.h>
#include <valgrind/callgrind.h>

#include <array>
#include <atomic>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "basestation/link/key_pair.hpp"
#include "basestation/publishers/web/web_server.hpp"
#include "basestation/service/event_loop.hpp"
#include "basestation/session/car_session.hpp"
#include "basestation/session/plan.hpp"
#include "protocol/can/av21.hpp"
#include "protocol/can/encode.hpp"
#include "protocol/json/json_value.hpp"
#include "protocol/telemetry/registry/registry.hpp"
#include "protocol/transport/can/unix_can_hub.hpp"
#include "protocol/transport/clock.hpp"
#include "protocol/transport/file.hpp"
#include "tests/support/web_client.hpp"
#include "vehicle/io/black_box.hpp"
#include "vehicle/io/car_io.hpp"
#include "vehicle/io/radio.hpp"
#include "vehicle/parameters/car_file.hpp"
#include "vehicle/parameters/track_file.hpp"
#include "vehicle/pipeline/radio_adapter.hpp"
#include "vehicle/pipeline/step.hpp"
#include "vehicle/pipeline/telemetry_mapper.hpp"
#include "vehicle/pipeline/tick_log.hpp"

namespace pitwall {
namespace {

namespace web = publishers::web;

constexpr int kAttempts = 50;
constexpr Duration kTimeout = seconds(20);  // under callgrind, on a loaded machine
constexpr Duration kTick = milliseconds(10);

[[noreturn]] void give_up(const std::string& why) {
  std::fprintf(stderr, "walk: %s\n", why.c_str());
  std::fflush(stderr);
  _exit(1);
}
template <class T>
T had(Result<T, Problem>&& result) {
  if (!result) give_up(to_string(result.error()));
  return *std::move(result);
}

std::string root() { return PITWALL_SOURCE_DIR; }

// The base as `pitwall-base --web 0` has it, turn by turn.
class Base {
 public:
  explicit Base(const std::string& folder)
      : plan_(had(session::plan_of(arguments(folder), [](const std::string&) {}))),
        stop_(::eventfd(1, EFD_NONBLOCK)) {
    server_ = had(web::WebServer::start({}, session::served({&plan_, 1})));
    session_ = had(session::CarSession::open(std::move(plan_)));
    had(session_->begin(server_.get(), [](const std::string&) {}));
  }
  // One turn of the loop: what is there is taken, what is due is sent.
  void turn() {
    const service::CarLoop car = session_->loop();
    service::run_event_loop({&car, 1}, {}, Duration{}, stop_.get());
  }
  std::string radio_address() { return to_string(session_->loop().radio[0].local()); }
  web::WebServer& server() { return *server_; }
  service::CarService& service() { return session_->service(); }

 private:
  static settings::Arguments arguments(const std::string& folder) {
    settings::Arguments a;
    a.car = 7;
    a.keys = folder + "/" + link::kBaseKeys;
    a.listen = {"127.0.0.1:0"};
    a.web_port = 0;
    a.track = "lvms";
    return a;
  }

  session::Plan plan_;
  transport::FileDescriptor stop_;  // always readable
  std::unique_ptr<web::WebServer> server_;
  std::unique_ptr<session::CarSession> session_;
};

// The car as pitwall-vehicle has it, tick by tick, and the hub of its bus.
class Car {
 public:
  Car(const std::string& folder, const std::string& base)
      : hub_(had(transport::UnixCanHub::open("unix:" + folder + "/bus"))),
        wheels_(had(transport::CanSocket::open("unix:" + folder + "/bus"))),
        setup_(made_setup()),
        car_io_(had(io::CarIo::open(arguments(folder), setup_.params.receivers))),
        box_(had(io::BlackBox::open("", {}))),
        radio_(had(
            io::Radio::open({{base}, folder + "/" + link::kCarKeys}, setup_.params.radio, true))) {}

  // A wheel-speed frame reaches the car's socket.
  void turn_wheels(double kmph) {
    can::av21::WheelSpeedReport m;
    m.wheel_speed_FL = m.wheel_speed_FR = m.wheel_speed_RL = m.wheel_speed_RR = kmph;
    can::Frame frame;
    can::EncodeCounters counters;
    if (!can::av21::encode(m, frame, counters)) give_up("no wheel-speed frame");
    if (wheels_.send({&frame, 1}) != 1) give_up("the bus takes no frame");
    for (int i = 0; i < 4; ++i) hub_->serve(Instant{});
  }

  void tick() {
    const io::CarIo::Received received = car_io_.read(box_);
    radio_.receive(box_);
    const Instant now = transport::monotonic_now();
    pipeline::Inputs in{.now = now,
                        .dt = now - last_,
                        .can = received.can,
                        .sensors = received.sensors,
                        .requests = {},
                        .may_arm = !car_io_.listen_only(),
                        .link = received.link};
    adapter_.fill(radio_.endpoint(), in);
    const pipeline::Outputs out = pipeline::step(setup_, *car_, in);
    car_io_.write(out.passed.frames.span(), now);
    last_ = now;
    log_->note(in, out, setup_.track.length_m());
    adapter_.take(radio_.endpoint(), setup_, *car_, out, now);
    if (!radio_.due(now)) return;
    pipeline::IoCounters counters;
    adapter_.show(radio_.endpoint(), counters, now);
    radio_.send(
        pipeline::map_telemetry(
            {.setup = setup_, .car = *car_, .out = out, .log = *log_, .io = counters, .now = now}),
        now, box_);
  }
  bool due() const { return radio_.due(transport::monotonic_now()); }
  int excluded() const { return car_->orders.use.excluded; }

 private:
  static io::Arguments arguments(const std::string& folder) {
    io::Arguments a;
    a.can_interface = "unix:" + folder + "/bus";
    return a;
  }
  static pipeline::Setup made_setup() {
    const std::string car = root() + "/vehicle/config/cars/av21.yaml";
    const std::string track = root() + "/vehicle/config/tracks/lvms.yaml";
    const auto read = parameters::load_car(
        car, [](const std::string& path) { return transport::read_file(path); });
    if (!read) give_up(to_string(read.error()));
    return had(pipeline::prepare(
        read->params, had(parameters::read_track(had(transport::read_file(track)), track))));
  }

  std::unique_ptr<transport::UnixCanHub> hub_;
  transport::CanSocket wheels_;
  pipeline::Setup setup_;
  io::CarIo car_io_;
  io::BlackBox box_;
  io::Radio radio_;
  pipeline::RadioAdapter adapter_;
  std::unique_ptr<pipeline::Car> car_ = std::make_unique<pipeline::Car>();
  std::unique_ptr<pipeline::TickLog> log_ = std::make_unique<pipeline::TickLog>();
  Instant last_{};
};

// What a console was told last: fields and texts.
class Console {
 public:
  void open(std::uint16_t port) {
    if (web_client_.open(port) != 101) give_up("the console is refused");
    reader_ = std::thread([this] {
      while (const auto received = web_client_.receive()) take(*received);
    });
    reader_.detach();
  }
  void say(const std::string& text) { web_client_.send_text(text); }
  double value(telemetry::FieldIndex field) const { return values_[field]; }
  std::optional<json::JsonValue> text(const std::string& type) {
    const std::lock_guard lock(texts_lock_);
    const auto found = texts_.find(type);
    return found == texts_.end() ? std::nullopt : std::optional{found->second};
  }

 private:
  void take(const web::WebClient::Received& received) {
    if (received.text) {
      const auto value = json::JsonValue::parse(received.bytes, "text");
      const std::lock_guard lock(texts_lock_);
      if (value) texts_.insert_or_assign(value->text("type"), *value);
      return;
    }
    const std::string& frame = received.bytes;
    for (std::size_t at = web::kFrameHeader; at + web::kSnapshotEntry <= frame.size();
         at += web::kSnapshotEntry) {
      std::uint16_t id = 0;
      float value = 0.0F;
      std::memcpy(&id, frame.data() + at, sizeof id);
      std::memcpy(&value, frame.data() + at + 4, sizeof value);
      if (id < values_.size()) values_[id] = value;
    }
  }

  web::WebClient web_client_;
  std::thread reader_;
  std::array<std::atomic<float>, telemetry::kFieldCount> values_{};
  std::mutex texts_lock_;
  std::map<std::string, json::JsonValue> texts_;
};

class Walk {
 public:
  explicit Walk(const std::string& folder) : base_(folder), car_(folder, base_.radio_address()) {
    run_until("a session", [&] {
      return base_.service().link().endpoint().report(transport::monotonic_now()).sessions > 0;
    });
    console_.open(base_.server().local().port);
    run_until("the wheels at rest at the console", [&] { return wheels_mps() == 0.0 && far(1); });
    run_until("a good link", [&] { return far(300); });
  }

  void frame() {
    try_until("the wheel speed at the console", [this](int attempt) {
      const double speed_kmph = 3.6 * (1 + attempt % 3);  // no wheel jumps by more
      run_until("the car's slot", [this] { return car_.due(); });
      car_.turn_wheels(speed_kmph);
      follow(
          [this] {
            car_.tick();
            base_.turn();
          },
          [&] { return std::abs(wheels_mps() - speed_kmph / 3.6) < 0.5; });
      return arrived_;
    });
  }

  void command() {
    try_until("the exclusion in the car", [this](int attempt) {
      const int excluded = 1 + attempt % 2;
      const std::string ticket = staged(excluded);
      const std::uint64_t received = base_.server().counters().texts_received;
      follow(
          [&] {
            console_.say(R"({"type":"send","ticket":)" + ticket + "}");
            while (base_.server().counters().texts_received == received) std::this_thread::yield();
            base_.turn();
            transport::sleep_until(base_.service().link().due());
            base_.turn();
            car_.tick();
          },
          [&] { return car_.excluded() == excluded; });
      return arrived_;
    });
  }

 private:
  // Only what `walk` and the web server's thread do meanwhile is followed.
  template <class Steps, class Holds>
  void follow(const Steps& steps, const Holds& holds) {
    CALLGRIND_ZERO_STATS;
    CALLGRIND_START_INSTRUMENTATION;
    steps();
    const Instant end = transport::monotonic_now() + milliseconds(300);
    while (!(arrived_ = holds()) && transport::monotonic_now() < end) std::this_thread::yield();
    CALLGRIND_STOP_INSTRUMENTATION;
  }
  // One turn may fall between two slots: it is tried again, with another value.
  template <class Attempt>
  void try_until(const char* what, const Attempt& attempt) {
    for (int i = 0; i < kAttempts; ++i) {
      if (attempt(i)) return;
      turn();
    }
    give_up(std::string{what} + " did not come");
  }
  template <class Holds>
  void run_until(const char* what, const Holds& holds) {
    const Instant end = transport::monotonic_now() + kTimeout;
    while (!holds()) {
      if (transport::monotonic_now() > end) {
        const auto error = console_.text("error");
        give_up(std::string{what} + " did not come" +
                (error ? ": " + error->text("place") + ": " + error->text("what") : ""));
      }
      turn();
    }
  }
  void turn() {
    car_.turn_wheels(0.0);
    car_.tick();
    base_.turn();
    ++turns_;
    transport::sleep_until(transport::monotonic_now() + kTick);
  }
  bool far(int turns) const { return turns_ >= turns; }
  std::string staged(int excluded) {
    console_.say(R"({"type":"authority","do":"take"})");
    console_.say(R"({"type":"stage","name":"sensors excluded","argument":)" +
                 std::to_string(excluded) + "}");
    double ticket = 0.0;
    run_until("a ticket", [&] {
      const auto reported = console_.text("command");
      if (reported) ticket = reported->number("ticket");
      return reported && reported->text("step") == "staged" && ticket > ticket_;
    });
    ticket_ = ticket;
    return std::to_string(static_cast<int>(ticket));
  }
  double wheels_mps() const { return console_.value(telemetry::field("wheels.front_left")); }

  Base base_;
  Car car_;
  Console console_;
  int turns_ = 0;
  double ticket_ = 0.0;
  bool arrived_ = false;
};

int run(const std::string& which) {
  const auto folder = had(transport::TemporaryFolder::create("pitwall-walk-"));
  telemetry::SystemRandomness randomness;
  had(link::write_key_pair(folder.path(), link::make_key_pair(randomness, false)));
  Walk walk{folder.path()};
  if (which == "frame") walk.frame();
  if (which == "command") walk.command();
  std::filesystem::remove_all(folder.path());
  std::fflush(nullptr);
  _exit(0);  // the console's reader waits for the server
}

}  // namespace
}  // namespace pitwall

int main(int argc, char** argv) {
  if (argc != 2) return 2;
  return pitwall::run(argv[1]);
}
