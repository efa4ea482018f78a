// Cyclone DDS with its defaults: KEEP_LAST 1, best effort or reliable (MODE "reliable"); MODE
// "paced": best effort, bulk in pieces.
// SPDX-License-Identifier: Apache-2.0
#include <dds/dds.h>

#include <algorithm>
#include <array>
#include <vector>

#include <vehicle_state.h>
#include "tests/benchmarks/protocol_comparison/peers/peer.hpp"

namespace pitwall::peers {
namespace {

constexpr Duration kBlocking = milliseconds(100);  // DDS's own default of reliable writers

dds_entity_t made(dds_entity_t entity) {
  if (entity < 0) {
    std::fprintf(stderr, "cyclone_dds: %s\n", dds_strretcode(-entity));
    std::exit(1);
  }
  return entity;
}

struct Topics {
  dds_entity_t participant, state, bulk;
  dds_qos_t* quality;
};

Topics join(const Call& call) {
  const dds_entity_t participant =
      made(dds_create_participant(DDS_DOMAIN_DEFAULT, nullptr, nullptr));
  dds_qos_t* quality = dds_create_qos();
  dds_qset_reliability(
      quality, call.mode == "reliable" ? DDS_RELIABILITY_RELIABLE : DDS_RELIABILITY_BEST_EFFORT,
      kBlocking.ns);
  dds_qset_history(quality, DDS_HISTORY_KEEP_LAST, 1);
  return {
      participant,
      made(dds_create_topic(participant, &comparison_VehicleState_desc, "state", quality, nullptr)),
      made(dds_create_topic(participant, &comparison_Bulk_desc, "bulk", quality, nullptr)),
      quality};
}

void drive(const Topics& topics, const Call& call) {
  const dds_entity_t state_writer =
      made(dds_create_writer(topics.participant, topics.state, topics.quality, nullptr));
  const dds_entity_t bulk_writer =
      made(dds_create_writer(topics.participant, topics.bulk, topics.quality, nullptr));
  // RTPS header, timestamp and DATA around a sample, IP and UDP; as bench codec counts them.
  constexpr std::size_t kAround = 56 + 28, kStateBytes = 388 + kAround;
  const BulkPlan plan =
      call.mode == "paced" ? paced(kStatePeriod, kStateBytes, kAround + 4) : BulkPlan{};
  std::vector<std::uint8_t> bytes(plan.bytes, 'b');
  comparison_Bulk bulk{};
  bulk.data._buffer = bytes.data();
  bulk.data._length = bulk.data._maximum = static_cast<std::uint32_t>(plan.bytes);
  send_until_end(
      call, kStatePeriod, plan,
      [&](Instant now) {
        const VehicleState state = state_at(now);
        comparison_VehicleState message{};
        message.made_ns = state.made_ns;
        std::ranges::copy(state.floats, message.floats);
        std::ranges::copy(state.integers, message.integers);
        std::ranges::copy(state.flags, message.flags);
        dds_write(state_writer, &message);
      },
      [&](Instant) { dds_write(bulk_writer, &bulk); });
}

// The newest of a reader; none: nothing new.
template <class Message, class Use>
void take(dds_entity_t reader, Use&& use) {
  std::array<void*, 1> sample{nullptr};
  std::array<dds_sample_info_t, 1> info{};
  while (dds_take(reader, sample.data(), info.data(), 1, 1) > 0) {
    if (info[0].valid_data) use(*static_cast<const Message*>(sample[0]));
    dds_return_loan(reader, sample.data(), 1);
    sample[0] = nullptr;
  }
}

void listen(const Topics& topics, const Call& call) {
  const dds_entity_t state_reader =
      made(dds_create_reader(topics.participant, topics.state, topics.quality, nullptr));
  const dds_entity_t bulk_reader =
      made(dds_create_reader(topics.participant, topics.bulk, topics.quality, nullptr));
  const dds_entity_t waitset = made(dds_create_waitset(topics.participant));
  for (const dds_entity_t reader : {state_reader, bulk_reader}) {
    dds_set_status_mask(reader, DDS_DATA_AVAILABLE_STATUS);
    dds_waitset_attach(waitset, reader, reader);
  }
  while (transport::monotonic_now() < call.end) {
    dds_waitset_wait(waitset, nullptr, 0, DDS_MSECS(50));
    take<comparison_VehicleState>(state_reader, [](const auto& m) { note_arrival(m.made_ns); });
    take<comparison_Bulk>(bulk_reader, [](const auto& m) { note_bulk(m.data._length); });
  }
}

}  // namespace
}  // namespace pitwall::peers

int main(int argc, char** argv) {
  const auto call = pitwall::peers::call_of(argc, argv);
  const pitwall::peers::Topics topics = pitwall::peers::join(call);
  call.car ? pitwall::peers::drive(topics, call) : pitwall::peers::listen(topics, call);
  dds_delete(topics.participant);
  return 0;
}
