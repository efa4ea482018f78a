// The car's radio on real sockets of this machine, against a base's end of the same.
// SPDX-License-Identifier: Apache-2.0
#include "vehicle/io/radio.hpp"

#include <gtest/gtest.h>

#include <array>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "protocol/recorder/raw_record.hpp"
#include "protocol/recorder/segment_folder.hpp"
#include "protocol/recording/mcap_reader.hpp"
#include "protocol/telemetry/endpoint/station_endpoint.hpp"
#include "protocol/telemetry/session/crypto/keys.hpp"
#include "protocol/transport/clock.hpp"
#include "protocol/transport/file.hpp"
#include "tests/support/allocation_guard.hpp"

namespace pitwall::io {
namespace {

using telemetry::KeyFile;
using telemetry::Role;
using transport::UdpSocket;

constexpr Duration kTimeout = seconds(5);  // of a loaded machine; nothing is measured with it

class CarRadio : public ::testing::Test {
 protected:
  CarRadio() {
    telemetry::SystemRandomness randomness;
    car_keys_ = {.role = Role::kCar, .own = make_identity(randomness), .peer = {}};
    base_keys_ = {.role = Role::kBase, .own = make_identity(randomness), .peer = {}};
    car_keys_.peer = base_keys_.own.public_key;
    base_keys_.peer = car_keys_.own.public_key;
  }

  std::string file(const char* name, const std::string& text) {
    const std::string path = folder_->path() + "/" + name;
    EXPECT_TRUE(transport::write_file(path, text, 0600));
    return path;
  }
  std::string keys() { return file("car.keys", telemetry::text_of(car_keys_)); }
  std::string refusal(const RadioArguments& args, const pipeline::RadioParams& params = {}) {
    const auto radio = Radio::open(args, params, false);
    return radio ? "" : to_string(radio.error());
  }

  Result<transport::TemporaryFolder, Problem> folder_ =
      transport::TemporaryFolder::create("pitwall-radio-");
  KeyFile car_keys_, base_keys_;
};

// A base station with a socket for each path.
class Base {
 public:
  Base(const KeyFile& keys, std::size_t paths, telemetry::Stamp newest = 0) {
    telemetry::LinkEndpointConfig config;
    config.association.keys = keys;
    config.association.newest_stamp = newest;
    config.association.paths = static_cast<std::uint8_t>(paths);
    endpoint_.emplace(config, randomness_);
    for (std::size_t i = 0; i < paths; ++i) sockets_.push_back(*UdpSocket::bind({}));
  }
  std::vector<std::string> addresses() const {
    std::vector<std::string> out;
    for (const UdpSocket& socket : sockets_) out.push_back(to_string(socket.local()));
    return out;
  }
  void serve() {
    std::vector<transport::UdpDatagram> inbox(UdpSocket::kBatch);
    for (std::size_t path = 0; path < sockets_.size(); ++path)
      for (const auto& d : std::span(inbox).first(sockets_[path].receive(inbox))) {
        endpoint_->feed(d.payload(), static_cast<telemetry::PathId>(path), d.from, d.at);
        answer();
      }
    answer();
  }
  telemetry::StationEndpoint& endpoint() { return *endpoint_; }

 private:
  void answer() {
    while (const auto out = endpoint_->poll(transport::monotonic_now()))
      sockets_[out->path].send_to(out->to, out->bytes);
  }

  telemetry::SystemRandomness randomness_;
  std::optional<telemetry::StationEndpoint> endpoint_;
  std::vector<UdpSocket> sockets_;
};

telemetry::Snapshot driving_at(double speed_mps, Instant now) {
  telemetry::Snapshot snapshot;
  snapshot.values[telemetry::field("ego.vx")] = speed_mps;
  snapshot.at(telemetry::Group::kEgo) = now;
  return snapshot;
}

// Datagrams that a black box has kept, by path.
struct Received {
  std::array<std::uint64_t, telemetry::kPaths> down{}, up{};
};
Received received_by(const std::string& folder) {
  Received incoming;
  const auto paths = recorder::segments_of(folder);
  EXPECT_TRUE(paths);
  for (const std::string& path : *paths) {
    const auto file = transport::read_file(path);
    const auto* const bytes = reinterpret_cast<const std::uint8_t*>(file->data());
    recording::McapReader reader{{bytes, file->size()}};
    while (const auto message = reader.next()) {
      const std::string& topic = reader.channels().at(message->channel).topic;
      if (!topic.starts_with("/radio/")) continue;
      const auto datagram = recorder::decode_datagram(message->data);
      EXPECT_TRUE(datagram && !datagram->bytes.empty() && datagram->port != 0);
      if (datagram) ++(topic == "/radio/down" ? incoming.down : incoming.up).at(datagram->path);
    }
  }
  return incoming;
}

// Ticks of the car and the base until it holds; what the car's ticks took from the heap.
struct Ticked {
  bool held = false;
  std::size_t allocations = 0;
};

Ticked tick_until(Radio& radio, Base& base, const std::function<bool()>& condition,
                  BlackBox box = *BlackBox::open("", {})) {
  Ticked out;
  const Instant limit = transport::monotonic_now() + kTimeout;
  while (!(out.held = condition()) && transport::monotonic_now() < limit) {
    base.serve();
    out.allocations += testing::allocations_of([&] {
      radio.receive(box);
      const Instant now = transport::monotonic_now();
      if (radio.due(now)) radio.send(driving_at(61.5, now), now, box);
    });
    transport::sleep_until(transport::monotonic_now() + milliseconds(2));
  }
  return out;
}

TEST_F(CarRadio, SendsAndReceivesOverOnePathAndOverTwo) {
  for (const std::size_t paths : {1U, 2U}) {
    Base base(base_keys_, paths);
    auto radio = Radio::open({base.addresses(), keys()}, {}, true);
    ASSERT_TRUE(radio) << to_string(radio.error());
    base.endpoint().stop().demand(telemetry::StopLevel::kControlled,
                                  telemetry::StopReason::kOperator);
    const Ticked ticked = tick_until(
        *radio, base,
        [&] {
          const auto view = radio->endpoint().view(transport::monotonic_now());
          return view.stop == telemetry::StopLevel::kControlled && view.alive_at &&
                 base.endpoint().state().values[telemetry::field("ego.vx")] > 0.0;
        },
        *BlackBox::open(folder_->path() + "/box" + std::to_string(paths), {}));
    EXPECT_TRUE(ticked.held) << paths;
    EXPECT_TRUE(radio->endpoint().schema_agrees());
    EXPECT_NEAR(base.endpoint().state().values[telemetry::field("ego.vx")], 61.5, 0.05);
    for (std::size_t path = 0; path < paths; ++path)
      EXPECT_GT(radio->counters(path).sent, 0u) << path;
    if (testing::kAllocationsCounted) {
      EXPECT_EQ(ticked.allocations, 0u) << "with a black box that records";
    }
    // What the sockets say, the black box has, by path.
    const Received incoming = received_by(folder_->path() + "/box" + std::to_string(paths));
    for (std::size_t path = 0; path < paths; ++path) {
      EXPECT_EQ(incoming.down.at(path), radio->counters(path).sent) << path;
      EXPECT_EQ(incoming.up.at(path), radio->counters(path).received) << path;
    }
  }
}

TEST_F(CarRadio, TakesNothingFromTheHeapUnderAFlood) {
  Base base(base_keys_, 1);
  auto radio = Radio::open({base.addresses(), keys()}, {}, false);
  ASSERT_TRUE(radio) << to_string(radio.error());
  ASSERT_TRUE(tick_until(*radio, base, [&] { return radio->counters(0).sent > 3; }).held);
  // Whoever sees where the car sends from can send to it.
  UdpSocket stranger = *UdpSocket::bind({});
  std::vector<std::uint8_t> noise(900, 0x5A);
  const std::uint64_t before = radio->counters(0).received;
  for (int i = 0; i < 300; ++i) {
    noise[0] = static_cast<std::uint8_t>(i);
    stranger.send_to(radio->local(0), noise);
  }
  const Ticked ticked =
      tick_until(*radio, base, [&] { return radio->counters(0).received >= before + 300; });
  EXPECT_TRUE(ticked.held);
  if (testing::kAllocationsCounted) {
    EXPECT_EQ(ticked.allocations, 0u);
  }
  EXPECT_TRUE(tick_until(*radio, base, [&] {
                return radio->endpoint().view(transport::monotonic_now()).alive_at.has_value();
              }).held);
}

telemetry::Stamp utc_stamp() { return static_cast<telemetry::Stamp>(transport::utc_now().ns); }

TEST_F(CarRadio, StampsItsOpeningsByTheCalendar) {
  Base base(base_keys_, 1);
  const telemetry::Stamp before = utc_stamp();
  auto radio = Radio::open({base.addresses(), keys()}, {}, false);
  ASSERT_TRUE(radio) << to_string(radio.error());
  ASSERT_TRUE(
      tick_until(*radio, base, [&] { return base.endpoint().report({}).sessions > 0; }).held);
  EXPECT_GE(base.endpoint().newest_stamp(), before);
  EXPECT_LE(base.endpoint().newest_stamp(), utc_stamp());
}

// The clock of the car went back, or the base's memory is of a year to come.
TEST_F(CarRadio, ExceedsTheStampThatItsBaseRemembers) {
  const telemetry::Stamp far = utc_stamp() + static_cast<telemetry::Stamp>(seconds(40'000'000).ns);
  Base base(base_keys_, 1, far);
  auto radio = Radio::open({base.addresses(), keys()}, {}, false);
  ASSERT_TRUE(radio) << to_string(radio.error());
  EXPECT_TRUE(
      tick_until(*radio, base, [&] { return base.endpoint().report({}).sessions > 0; }).held);
  EXPECT_GT(base.endpoint().newest_stamp(), far);
}

TEST_F(CarRadio, FindsTheSpareBaseWhenThePreferredOneIsGone) {
  std::optional<Base> preferred{std::in_place, base_keys_, 1U};
  Base spare(base_keys_, 1);
  const std::string list = preferred->addresses()[0] + "," + spare.addresses()[0];
  auto radio = Radio::open({{list}, keys()}, {}, false);
  ASSERT_TRUE(radio) << to_string(radio.error());
  const auto is_received = [&](Base& base) {
    return base.endpoint().state().values[telemetry::field("ego.vx")] > 0.0;
  };
  ASSERT_TRUE(tick_until(*radio, *preferred, [&] { return is_received(*preferred); }).held);
  spare.serve();
  EXPECT_EQ(spare.endpoint().report({}).association.received, 0U) << "nothing goes there before";
  preferred.reset();
  const Ticked ticked = tick_until(*radio, spare, [&] { return is_received(spare); });
  EXPECT_TRUE(ticked.held);
  EXPECT_EQ(radio->endpoint().report(transport::monotonic_now()).association.roams, 1U);
  if (testing::kAllocationsCounted) {
    EXPECT_EQ(ticked.allocations, 0u);
  }
}

TEST_F(CarRadio, KeysThatAreNoneAreRefusedWithTheirPlace) {
  const std::vector<std::string> there{"127.0.0.1:23431"};
  EXPECT_NE(refusal({there, folder_->path() + "/missing"}).find("/missing"), std::string::npos);
  EXPECT_NE(refusal({there, file("noise", "hello")}).find("/noise"), std::string::npos);
  EXPECT_NE(
      refusal({there, file("base.keys", telemetry::text_of(base_keys_))}).find("the base's keys"),
      std::string::npos);
  const std::string open = folder_->path() + "/open.keys";
  ASSERT_TRUE(transport::write_file(open, telemetry::text_of(car_keys_), 0644));
  EXPECT_NE(refusal({there, open}).find("chmod"), std::string::npos);
}

TEST_F(CarRadio, KeysOfABenchAreForASimulationOnly) {
  const std::vector<std::string> there{"127.0.0.1:23431"};
  EXPECT_TRUE(Radio::open({there, keys()}, {}, true));
  car_keys_.bench = true;
  const auto simulation = Radio::open({there, keys()}, {}, false);
  ASSERT_TRUE(simulation) << to_string(simulation.error());
  EXPECT_TRUE(simulation->bench_keys());
  const auto real = Radio::open({there, keys()}, {}, true);
  ASSERT_FALSE(real);
  EXPECT_NE(to_string(real.error()).find("car.keys:6: error: keys of a bench"), std::string::npos)
      << to_string(real.error());
}

TEST_F(CarRadio, AddressesThatAreNoneAreRefused) {
  for (const char* radio :
       {"", "nowhere", "256.0.0.1:5", "127.0.0.1:", "127.0.0.1:70000", "127.0.0.1:-1",
        "localhost:23431", "127.0.0.1:23431x", ":", "127.0.0.1:0", "127.0.0.1:1,127.0.0.1:1"})
    EXPECT_NE(refusal({{radio}, keys()}).find("--radio "), std::string::npos) << radio;
  EXPECT_NE(refusal({{}, keys()}).find("--radio"), std::string::npos);
}

TEST_F(CarRadio, ABudgetThatSafetyDoesNotFitIntoIsRefused) {
  pipeline::RadioParams params;
  ASSERT_TRUE(params.paths.push(
      {.bytes_per_s = 8'000.0, .packets_per_s = 100.0, .safety_bytes_per_s = 9'000.0}));
  EXPECT_NE(refusal({{"127.0.0.1:23431"}, keys()}, params), "");
}

}  // namespace
}  // namespace pitwall::io
