// Sender and receiver of one kind of delivery, with a packet each way every 20 ms over a lossy
// channel.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <vector>

#include "protocol/telemetry/packet/body.hpp"
#include "tests/support/lossy_channel.hpp"

namespace pitwall::telemetry {

using Bytes = std::vector<std::uint8_t>;

// A packet with the content that `fill` writes, of at most `room` bytes.
template <class Fill>
Bytes packet_of(Instant now, std::size_t room, Fill&& fill) {
  Bytes buffer(room);
  BodyWriter writer(buffer, room, Direction::kDown);
  writer.begin(now, 1);
  fill(writer);
  return {writer.bytes().begin(), writer.bytes().end()};
}

template <class Taker>
void take_all(Taker& taker, const Bytes& packet, Instant sent, Instant at) {
  const auto body = parse_body(packet, Direction::kDown);
  ASSERT_TRUE(body);
  const Received received{.at = at,
                          .sent_earliest = sent,
                          .tx_time_100us = body->tx_time_100us,
                          .sequence = 0,
                          .path = 0};
  for (const Record& record : body->records) EXPECT_TRUE(taker.take(record, received));
}

template <class Sender, class Receiver>
struct DeliveryRig {
  Sender sender;
  Receiver receiver;
  testing::LossyChannel there, back;
  std::size_t room = 600;
  Instant now{1'000'000'000'000};

  explicit DeliveryRig(testing::LossyChannelParams params)
      : there(params), back([&] {
          params.seed += 1'000;
          return params;
        }()) {}

  template <class Fill>
  void slot(Fill&& fill) {
    there.send(packet_of(now, room, fill), now);
    back.send(packet_of(now, room, [&](BodyWriter& body) { receiver.fill(body, now); }), now);
    now += milliseconds(20);
    there.arrive(now, [&](const Bytes& packet, Instant sent, Instant at) {
      take_all(receiver, packet, sent, at);
    });
    back.arrive(now, [&](const Bytes& packet, Instant sent, Instant at) {
      take_all(sender, packet, sent, at);
    });
  }
  // Drops the packets under way, because they belong to the session that ends.
  void new_session() {
    there.forget();
    back.forget();
  }
};

inline testing::LossyChannelParams rough(double loss, std::uint32_t seed) {
  return {.loss = loss,
          .twice = 0.1,
          .delay_min = milliseconds(3),
          .delay_max = milliseconds(90),
          .seed = seed};
}

}  // namespace pitwall::telemetry
