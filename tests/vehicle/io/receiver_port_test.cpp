// SPDX-License-Identifier: Apache-2.0
#include "vehicle/io/receiver_port.hpp"

#include <gtest/gtest.h>

#include <array>

#include "protocol/gnss/novatel_codec.hpp"
#include "protocol/transport/clock.hpp"
#include "protocol/yaml/strict_map.hpp"
#include "tests/support/allocation_guard.hpp"
#include "tests/support/pty.hpp"
#include "tests/support/tcp_server.hpp"

namespace pitwall::io {
namespace {

struct Message {
  std::array<std::uint8_t, gnss::kMaxEncodedBytes> data{};
  std::size_t length = 0;

  std::span<const std::uint8_t> span() const { return std::span(data).first(length); }
};

Message some_heading(std::uint32_t ms) {
  gnss::NovatelHeader header;
  header.week = 2190, header.milliseconds = ms;
  gnss::Heading2 heading{.solution_status = 0, .position_type = 50};
  heading.heading_deg = 90.0F;
  Message message;
  message.length = gnss::encode(header, heading, message.data);
  return message;
}

ReceiverPort open(const ReceiverLink& link) {
  auto port = ReceiverPort::open(link, 1, {});
  CHECK(port.has_value());
  return *std::move(port);
}

template <class Say>
void hears_three(ReceiverPort& port, Say&& say) {
  EXPECT_FALSE(port.byte_at());
  world::SensorInput out;
  std::vector<std::uint8_t> sent, observed;
  for (std::uint32_t k = 0; k < 3; ++k) {
    const Message message = some_heading(1'000 * (k + 1));
    sent.insert(sent.end(), message.span().begin(), message.span().end());
    say(message.span());
  }
  const Instant limit = transport::monotonic_now() + seconds(10);
  while (out.headings.size() < 3 && transport::monotonic_now() < limit) {
    port.read(out, transport::monotonic_now(), [&](Instant, std::span<const std::uint8_t> bytes) {
      observed.insert(observed.end(), bytes.begin(), bytes.end());
    });
  }
  ASSERT_EQ(out.headings.size(), 3U);
  EXPECT_EQ(observed, sent) << "every byte, in order";
  EXPECT_EQ(out.headings[2].unit, 1);
  ASSERT_TRUE(port.byte_at());
  EXPECT_LE(*port.byte_at(), transport::monotonic_now());
  EXPECT_EQ(port.counters().garbage_bytes, 0U);
  const auto json = yaml::load_text(port.json(), "receiver.json");
  ASSERT_TRUE(json) << port.json();
  yaml::StrictMap map = json->root();
  EXPECT_EQ(map.integer("headings", 0, 1'000), 3);
}

TEST(ReceiverPort, HearsDatagrams) {
  auto sender = transport::UdpSocket::bind({});
  ASSERT_TRUE(sender);
  std::uint16_t free = 0;
  {
    const auto other = transport::UdpSocket::bind({});
    ASSERT_TRUE(other);
    free = other->local().port;
  }
  ReceiverPort port = open(UdpReceiver{{.port = free}});
  hears_three(port, [&](std::span<const std::uint8_t> bytes) {
    EXPECT_TRUE(sender->send_to({.port = free}, bytes));
  });
}

TEST(ReceiverPort, HearsASerialLine) {
  const support::Pty pty;
  ReceiverPort port = open(transport::SerialDevice{pty.path(), transport::kReceiverBaud});
  world::SensorInput none;
  port.read(none, transport::monotonic_now());
  // In pieces, as a slow line brings them.
  hears_three(port, [&](std::span<const std::uint8_t> bytes) {
    pty.say(bytes.first(7));
    pty.say(bytes.subspan(7));
  });
}

TEST(ReceiverPort, HearsAConnection) {
  support::TcpServer server;
  ReceiverPort port = open(transport::TcpAddress{.port = server.port()});
  world::SensorInput none;
  port.read(none, transport::monotonic_now());
  server.accept();
  hears_three(port, [&](std::span<const std::uint8_t> bytes) { server.say(bytes); });
}

TEST(ReceiverPort, TakesNothingFromTheHeap) {
  const support::Pty pty;
  std::vector<ReceiverPort> ports;
  ports.push_back(open(UdpReceiver{}));
  ports.push_back(open(transport::SerialDevice{pty.path(), transport::kReceiverBaud}));
  ports.push_back(open(transport::TcpAddress{.port = 1}));  // nobody is there
  world::SensorInput out;
  const auto read_all = [&] {
    for (ReceiverPort& port : ports) port.read(out, transport::monotonic_now());
  };
  read_all();
  pty.say(some_heading(1'000).span());
  EXPECT_EQ(testing::allocations_of([&] {
              for (int k = 0; k < 20; ++k) read_all();
            }),
            0U);
  EXPECT_EQ(out.headings.size(), 1U);
}

TEST(ReceiverPort, ADeviceThatIsNotThereAtTheStartIsNamed) {
  const auto port = ReceiverPort::open(transport::SerialDevice{"/dev/no_such_tty", 115'200}, 0, {});
  ASSERT_FALSE(port);
  EXPECT_EQ(port.error().place, "/dev/no_such_tty");
}

TEST(ReceiverPort, APortThatIsTakenIsNamed) {
  const auto taken = transport::UdpSocket::bind({});
  ASSERT_TRUE(taken);
  const auto port = ReceiverPort::open(UdpReceiver{taken->local()}, 0, {});
  ASSERT_FALSE(port);
  EXPECT_EQ(port.error().place, to_string(taken->local()));
}

}  // namespace
}  // namespace pitwall::io
