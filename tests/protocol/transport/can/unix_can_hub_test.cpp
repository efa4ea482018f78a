// SPDX-License-Identifier: Apache-2.0
#include "protocol/transport/can/unix_can_hub.hpp"

#include <gtest/gtest.h>

#include <csignal>
#include <filesystem>
#include <map>
#include <random>

#include "protocol/transport/process.hpp"
#include "tests/support/comes_true.hpp"
#include "tests/support/unix_bus_bench.hpp"

namespace pitwall::transport {
namespace {

using testing::numbered;
using testing::Packet;
using testing::RawClient;
using testing::wire_of;

class UnixCanHubOnBench : public testing::UnixBusBench {};

// What a wire can carry, said once more and otherwise than the code under test says it: by bytes.
bool wire_could_carry(const Packet& p) {
  if (p.size() != 16 && p.size() != 72) return false;
  const bool long_id = (p[3] & 0x80) != 0, remote = (p[3] & 0x40) != 0, error = (p[3] & 0x20) != 0;
  if (error) return p.size() == 16 && p[4] <= 8 && !long_id && !remote;
  if (!long_id && ((p[3] & 0x1F) != 0 || p[2] != 0 || (p[1] & 0xF8) != 0)) return false;
  if (p.size() == 16) return p[4] <= 8;
  constexpr std::uint8_t kLengths[] = {0, 1, 2, 3, 4, 5, 6, 7, 8, 12, 16, 20, 24, 32, 48, 64};
  return !remote && std::find(std::begin(kLengths), std::end(kLengths), p[4]) != std::end(kLengths);
}

Packet any_packet(std::mt19937_64& random, std::size_t length) {
  Packet out(length);
  for (auto& byte : out) byte = static_cast<std::uint8_t>(random());
  if (length > 4 && random() % 2 == 0) out[4] = static_cast<std::uint8_t>(random() % 10);
  if (length > 4 && random() % 2 == 0) out[3] = static_cast<std::uint8_t>(random() % 8 * 0x20);
  return out;
}

TEST_F(UnixCanHubOnBench, AllHearTheSameFramesOnceInOneOrder) {
  constexpr std::size_t kClients = 6;
  std::vector<RawClient> clients;
  for (std::size_t i = 0; i < kClients; ++i) clients.emplace_back(bus_);
  RawClient witness(bus_);  // sends nothing, hence hears the whole order
  std::mt19937_64 random(11);
  std::vector<std::uint32_t> sent(kClients);
  std::vector<std::vector<Packet>> received(kClients);
  std::vector<Packet> order;
  for (int i = 0; i < 20'000; ++i) {
    const std::size_t who = random() % kClients;
    ASSERT_TRUE(clients[who].send(
        numbered(static_cast<std::uint32_t>(who), sent[who]++, random() % 4 == 0)));
    if (random() % 50 == 0) hub_->serve(Instant{});
    if (random() % 100 != 0) continue;
    const std::size_t reader = random() % kClients;
    for (Packet& packet : clients[reader].read(random() % 300))
      received[reader].push_back(std::move(packet));
    if (i % 7 == 0) serve();
    for (Packet& packet : witness.read()) order.push_back(std::move(packet));
  }
  serve();
  for (Packet& packet : witness.read()) order.push_back(std::move(packet));
  ASSERT_EQ(order.size(), 20'000u);
  std::vector<std::uint32_t> next(kClients);
  for (const Packet& packet : order)  // each sender's frames in the order they were sent
    ASSERT_EQ(testing::number_in(packet), next[wire_of(packet).can_id]++);
  for (std::size_t i = 0; i < kClients; ++i) {
    for (Packet& packet : clients[i].read()) received[i].push_back(std::move(packet));
    std::vector<Packet> others;
    for (const Packet& packet : order)
      if (wire_of(packet).can_id != i) others.push_back(packet);
    ASSERT_EQ(received[i], others) << "client " << i;
  }
  EXPECT_EQ(hub_->counters().relayed, 20'000u);
  EXPECT_EQ(hub_->counters().delivered, 20'000u * kClients);
  EXPECT_EQ(hub_->counters().dropped, 0u);
}

TEST_F(UnixCanHubOnBench, WhoeverHasConnectedHearsWhatIsSentAfterwards) {
  RawClient sender(bus_);
  serve();
  std::vector<RawClient> late;
  for (std::uint32_t i = 0; i < 40; ++i) {
    late.emplace_back(bus_);
    ASSERT_TRUE(sender.send(numbered(1, i)));
    if (i % 3 == 0) hub_->serve(Instant{});
  }
  serve();
  // Those who connected between two rounds may hear a little of before, never miss of after.
  for (std::uint32_t i = 0; i < late.size(); ++i) {
    const auto received = late[i].read();
    ASSERT_GE(received.size(), late.size() - i);
    EXPECT_EQ(testing::number_in(received.back()), late.size() - 1);
    EXPECT_EQ(testing::number_in(received.front()), late.size() - received.size());
  }
}

// A reader's view of the law: after each notice, the numbers missing so far are exactly as many as
// it says.
struct Follower {
  std::uint32_t next = 0, missing = 0, reported = 0;
  std::size_t read = 0;

  void follow(const Packet& packet) {
    if (const auto lost = read_loss_notice(wire_of(packet), packet.size())) {
      ASSERT_GT(*lost, reported);
      reported = *lost;
      return;
    }
    const std::uint32_t number = testing::number_in(packet);
    missing += number - next;
    next = number + 1;
    ++read;
    ASSERT_EQ(missing, reported);  // told before the first frame after the gap
  }
};

TEST_F(UnixCanHubOnBench, ASlowClientIsToldExactlyWhatItLostAndDelaysNobody) {
  start({.queue_bytes = 1});  // the least that the kernel grants: a few frames
  std::mt19937_64 random(5);
  RawClient sender(bus_);
  std::vector<RawClient> readers;
  for (int i = 0; i < 4; ++i) readers.emplace_back(bus_);
  std::vector<Follower> followers(readers.size());
  constexpr std::uint32_t kFrames = 5'000;
  const auto let_read = [&](std::size_t i, std::size_t most) {
    for (const Packet& packet : readers[i].read(most)) followers[i].follow(packet);
  };
  for (std::uint32_t n = 0; n < kFrames; ++n) {
    ASSERT_TRUE(sender.send(numbered(7, n)));
    if (random() % 4 == 0) hub_->serve(Instant{});
    let_read(0, SIZE_MAX);
    let_read(1, random() % 3);
    if (random() % 20 == 0) let_read(2, SIZE_MAX);
    if (n % 100 == 99) serve();  // the last one reads nothing until the end
  }
  std::uint64_t missing = 0, read = 0;
  for (std::size_t i = 0; i < readers.size(); ++i) {
    for (std::size_t before = SIZE_MAX; before != followers[i].read + followers[i].reported;) {
      before = followers[i].read + followers[i].reported;
      serve();
      let_read(i, SIZE_MAX);
    }
    EXPECT_EQ(followers[i].read + followers[i].reported, kFrames) << "reader " << i;
    missing += followers[i].reported;
    read += followers[i].read;
  }
  EXPECT_GT(followers[3].reported, kFrames * 9 / 10);
  EXPECT_EQ(hub_->counters().relayed, kFrames);
  EXPECT_EQ(hub_->counters().delivered, read);
  EXPECT_EQ(hub_->counters().dropped, missing);
  EXPECT_EQ(hub_->counters().worst_dropped, followers[3].reported);
  EXPECT_EQ(hub_->counters().worst_process, getpid());
}

TEST_F(UnixCanHubOnBench, WhatIsNoFrameIsRefusedAndCountedWhateverItsLength) {
  RawClient sender(bus_), reader(bus_);
  std::mt19937_64 random(17);
  std::vector<Packet> expected;
  std::uint64_t malformed = 0;
  for (int round = 0; round < 60; ++round) {
    for (std::size_t i = 0; i <= 140; ++i) {  // every length, and the two right ones more often
      Packet packet = any_packet(random, i <= 100 ? i : (i % 2 == 0 ? 16 : 72));
      ASSERT_TRUE(sender.send(packet));
      if (wire_could_carry(packet)) {
        packet[6] = 0;  // the hub's own mark is nobody else's to set
        expected.push_back(std::move(packet));
      } else {
        ++malformed;
      }
    }
    for (const bool error : {false, true}) {
      expected.push_back(numbered(error ? CAN_ERR_FLAG | CAN_ERR_BUSOFF : 0x123, 5));
      ASSERT_TRUE(sender.send(expected.back()));
    }
    serve();
  }
  EXPECT_EQ(reader.read(), expected);
  EXPECT_EQ(hub_->counters().malformed, malformed);
  EXPECT_EQ(hub_->counters().relayed, expected.size());
  EXPECT_GT(expected.size(), 300u);
  EXPECT_EQ(hub_->clients(), 2u);  // a packet of no bytes is not the end of a client
}

std::size_t open_descriptors() {
  const std::filesystem::directory_iterator all("/proc/self/fd");
  return static_cast<std::size_t>(std::distance(begin(all), end(all)));
}

TEST_F(UnixCanHubOnBench, ADescriptorThatAClientPassesIsNotTakenIn) {
  RawClient sender(bus_), reader(bus_);
  serve();
  const std::size_t before = open_descriptors();
  for (int i = 0; i < 100; ++i) {
    Packet packet = numbered(1, 1);
    iovec slice{.iov_base = packet.data(), .iov_len = packet.size()};
    alignas(cmsghdr) std::array<std::uint8_t, CMSG_SPACE(sizeof(int))> control{};
    msghdr message{};
    message.msg_iov = &slice;
    message.msg_iovlen = 1;
    message.msg_control = control.data();
    message.msg_controllen = control.size();
    cmsghdr* head = CMSG_FIRSTHDR(&message);
    head->cmsg_level = SOL_SOCKET;
    head->cmsg_type = SCM_RIGHTS;
    head->cmsg_len = CMSG_LEN(sizeof(int));
    const int passed = 1;
    std::memcpy(CMSG_DATA(head), &passed, sizeof passed);
    ASSERT_EQ(sendmsg(sender.fd(), &message, MSG_NOSIGNAL), 16);
  }
  serve();
  EXPECT_EQ(open_descriptors(), before);
  EXPECT_EQ(hub_->counters().malformed, 100u);
  EXPECT_TRUE(reader.read().empty());
}

TEST_F(UnixCanHubOnBench, AClientThatOnlySendsIsSentNothingAndKeepsNobodyBusy) {
  RawClient send_only(bus_, ReceiveMode::kNothing), reader(bus_), sender(bus_);
  for (std::uint32_t i = 0; i < 1'000; ++i) {
    ASSERT_TRUE(sender.send(numbered(1, i)));
    hub_->serve(Instant{});
  }
  ASSERT_TRUE(send_only.send(numbered(2, 0)));
  serve();
  EXPECT_EQ(reader.read().size(), 1'001u);
  EXPECT_EQ(sender.read().size(), 1u);
  EXPECT_EQ(hub_->counters().dropped, 0u);
  const Instant deadline = monotonic_now() + milliseconds(50);
  hub_->serve(deadline);  // nothing to do: it sleeps to the end
  EXPECT_GE(monotonic_now(), deadline);
}

TEST_F(UnixCanHubOnBench, ClientsBeyondTheLimitAreTurnedAwayAndCounted) {
  start({.clients_max = 3});
  std::vector<RawClient> clients;
  for (int i = 0; i < 5; ++i) clients.emplace_back(bus_);
  serve();
  EXPECT_EQ(hub_->clients(), 3u);
  EXPECT_EQ(hub_->counters().refused, 2u);
  clients.erase(clients.begin());
  serve();
  clients.emplace_back(bus_);
  serve();
  EXPECT_EQ(hub_->clients(), 3u);
  EXPECT_EQ(hub_->counters().joined, 4u);
  EXPECT_EQ(hub_->counters().left, 1u);
}

TEST_F(UnixCanHubOnBench, WhatAClientSentBeforeItDiedWithUnreadFramesIsRelayed) {
  RawClient reader(bus_);
  for (std::uint32_t round = 1; round <= 20; ++round) {
    RawClient victim(bus_);
    ASSERT_TRUE(reader.send(numbered(1, round)));
    serve();  // now it has a frame to read, and never will
    for (std::uint32_t i = 0; i < 10; ++i) ASSERT_TRUE(victim.send(numbered(2, i)));
    victim.leave();
    serve();
    ASSERT_EQ(reader.read().size(), 10u);
    ASSERT_EQ(hub_->counters().left, round);
  }
}

TEST(UnixCanHubPath, InUseIsRefusedWithTheBusAsItsPlace) {
  auto folder = TemporaryFolder::create("pitwall-unix-bus-");
  ASSERT_TRUE(folder);
  const std::string bus = "unix:" + folder->path() + "/bus";
  const auto first = UnixCanHub::open(bus);
  ASSERT_TRUE(first);
  const auto second = UnixCanHub::open(bus);
  ASSERT_FALSE(second);
  EXPECT_EQ(second.error().place, bus);
  EXPECT_EQ(second.error().what, "in use");
}

// Another program, in another language, that knows nothing of ours but the kernel's layout.
constexpr const char* kPython = "/usr/bin/python3";
constexpr const char* kEcho = R"(
import socket, struct, sys
bus = socket.socket(socket.AF_UNIX, socket.SOCK_SEQPACKET)
bus.connect(sys.argv[1])
bus.send(struct.pack("=IB3x8s", 0x7FF, 0, b""))          # ready
for _ in range(int(sys.argv[2])):
    packet = bus.recv(256)
    if len(packet) == 16:
        id, length, data = struct.unpack("=IB3x8s", packet)
        bus.send(struct.pack("=IB3x8s", id ^ 1, length, bytes(b ^ 0xFF for b in data)))
    else:
        id, length, flags, data = struct.unpack("=IBB2x64s", packet)
        bus.send(struct.pack("=IBB2x64s", id ^ 1, length, flags, bytes(b ^ 0xFF for b in data)))
)";

TEST_F(UnixCanHubOnBench, AnIndependentClientReadsAndWritesTheKernelsLayout) {
  RawClient ours(bus_);
  constexpr std::size_t kFrames = 500;
  auto python = Process::spawn({.argv = {kPython, "-c", kEcho, path(), std::to_string(kFrames)}});
  ASSERT_TRUE(python) << to_string(python.error());
  std::vector<Packet> received;
  const auto receive = [&](std::size_t count) {
    return testing::comes_true([&] {
      hub_->serve(Instant{});
      for (Packet& packet : ours.read()) received.push_back(std::move(packet));
      return received.size() >= count;
    });
  };
  ASSERT_TRUE(receive(1));
  std::mt19937_64 random(23);
  std::vector<Packet> expected = received;
  for (std::size_t i = 0; i < kFrames; ++i) {
    CanWire wire{};
    const bool fd = random() % 3 == 0;
    wire.can_id = static_cast<std::uint32_t>(random() % 0x400) * 2;
    wire.len = static_cast<std::uint8_t>(random() % 9);
    wire.flags = fd ? CANFD_BRS : std::uint8_t{0};
    for (std::size_t k = 0; k < (fd ? 64U : 8U); ++k)
      wire.data[k] = static_cast<std::uint8_t>(random());
    ASSERT_TRUE(ours.send(testing::packet_of(wire, fd ? kCanFdWireBytes : kCanWireBytes)));
    wire.can_id ^= 1;
    for (std::size_t k = 0; k < (fd ? 64U : 8U); ++k)
      wire.data[k] = static_cast<std::uint8_t>(~wire.data[k]);
    expected.push_back(testing::packet_of(wire, fd ? kCanFdWireBytes : kCanWireBytes));
    if (i % 50 == 49) serve();
  }
  EXPECT_TRUE(receive(kFrames + 1));
  EXPECT_EQ(received, expected);
  EXPECT_TRUE(python->wait().success());
}

constexpr const char* kFlood = R"(
import socket, struct, sys
bus = socket.socket(socket.AF_UNIX, socket.SOCK_SEQPACKET)
bus.connect(sys.argv[1])
number = 0
while True:
    bus.send(struct.pack("=IB3xII", int(sys.argv[2]), 8, number, 0))
    number += 1
)";

TEST_F(UnixCanHubOnBench, ClientsKilledInTheMiddleLeaveTheOthersInOrder) {
  RawClient reader(bus_);
  std::mt19937_64 random(29);
  std::map<std::uint32_t, std::uint32_t> next;
  std::uint64_t received = 0;
  const auto receive = [&] {
    hub_->serve(monotonic_now() + milliseconds(1));
    for (const Packet& packet : reader.read()) {
      ASSERT_EQ(testing::number_in(packet), next[wire_of(packet).can_id]++);
      ++received;
    }
  };
  for (std::uint32_t victim = 1; victim <= 6; ++victim) {
    auto flood = Process::spawn({.argv = {kPython, "-c", kFlood, path(), std::to_string(victim)}});
    ASSERT_TRUE(flood);
    ASSERT_TRUE(testing::comes_true([&] {
      receive();
      return next[victim] > 200 + random() % 300;
    }));
    flood->kill(SIGKILL);  // with whatever it has sent and not read
    flood->wait();
    ASSERT_TRUE(testing::comes_true([&] {
      receive();
      return hub_->clients() == 1;
    }));
  }
  EXPECT_EQ(hub_->counters().left, 6u);
  EXPECT_EQ(hub_->counters().dropped, 0u);
  EXPECT_EQ(hub_->counters().relayed, received);  // what was sent before the end is not lost
  EXPECT_EQ(hub_->counters().malformed, 0u);
}

}  // namespace
}  // namespace pitwall::transport
