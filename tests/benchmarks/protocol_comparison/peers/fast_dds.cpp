// Fast DDS over UDP: KEEP_LAST 1, asynchronous, best effort or reliable (MODE "reliable"); the rest
// as it comes. MODE "controlled": best effort, both writers on one flow controller of the tuned
// share of the link, state before bulk; messages small enough to go one after the other. Types
// written by hand on fastcdr, as fastddsgen would write them.
// SPDX-License-Identifier: Apache-2.0
#include <fastcdr/Cdr.h>
#include <fastcdr/FastBuffer.h>
#include <fastdds/rtps/transport/UDPv4TransportDescriptor.h>
#include <fastdds/dds/domain/DomainParticipant.hpp>
#include <fastdds/dds/domain/DomainParticipantFactory.hpp>
#include <fastdds/dds/publisher/DataWriter.hpp>
#include <fastdds/dds/publisher/Publisher.hpp>
#include <fastdds/dds/subscriber/DataReader.hpp>
#include <fastdds/dds/subscriber/DataReaderListener.hpp>
#include <fastdds/dds/subscriber/SampleInfo.hpp>
#include <fastdds/dds/subscriber/Subscriber.hpp>
#include <fastdds/dds/topic/TopicDataType.hpp>

#include <memory>
#include <thread>
#include <vector>

#include "tests/benchmarks/protocol_comparison/peers/peer.hpp"

namespace pitwall::peers {
namespace {

namespace dds = eprosima::fastdds::dds;
namespace rtps = eprosima::fastrtps::rtps;
using eprosima::fastcdr::Cdr;

struct Bulk {
  std::vector<std::uint8_t> data;
};

void write(Cdr& cdr, const VehicleState& state) {
  cdr << state.made_ns;
  cdr.serializeArray(state.floats.data(), kFloats);
  cdr.serializeArray(state.integers.data(), kIntegers);
  cdr.serializeArray(state.flags.data(), kFlags);
}
void read(Cdr& cdr, VehicleState& state) {
  cdr >> state.made_ns;
  cdr.deserializeArray(state.floats.data(), kFloats);
  cdr.deserializeArray(state.integers.data(), kIntegers);
  cdr.deserializeArray(state.flags.data(), kFlags);
}
void write(Cdr& cdr, const Bulk& bulk) { cdr << bulk.data; }
void read(Cdr& cdr, Bulk& bulk) { cdr >> bulk.data; }

template <class Message>
class Type : public dds::TopicDataType {
 public:
  Type(const char* name, std::uint32_t largest) {
    setName(name);
    m_typeSize = largest + 4;  // and what tells the encoding
    m_isGetKeyDefined = false;
  }
  bool serialize(void* data, rtps::SerializedPayload_t* payload) override {
    eprosima::fastcdr::FastBuffer buffer(reinterpret_cast<char*>(payload->data), payload->max_size);
    Cdr cdr(buffer, Cdr::DEFAULT_ENDIAN, Cdr::DDS_CDR);
    payload->encapsulation = CDR_LE;
    cdr.serialize_encapsulation();
    write(cdr, *static_cast<const Message*>(data));
    payload->length = static_cast<std::uint32_t>(cdr.getSerializedDataLength());
    return true;
  }
  bool deserialize(rtps::SerializedPayload_t* payload, void* data) override {
    eprosima::fastcdr::FastBuffer buffer(reinterpret_cast<char*>(payload->data), payload->length);
    Cdr cdr(buffer, Cdr::DEFAULT_ENDIAN, Cdr::DDS_CDR);
    cdr.read_encapsulation();
    read(cdr, *static_cast<Message*>(data));
    return true;
  }
  std::function<std::uint32_t()> getSerializedSizeProvider(void*) override {
    return [this] { return m_typeSize; };
  }
  void* createData() override { return new Message; }
  void deleteData(void* data) override { delete static_cast<Message*>(data); }
  bool getKey(void*, rtps::InstanceHandle_t*, bool) override { return false; }
};

struct Domain {
  dds::DomainParticipant* participant;
  dds::Topic* state;
  dds::Topic* bulk;
};

constexpr const char* kControlled = "controlled";
constexpr const char* kController = "radio";
constexpr std::uint32_t kControlledMessage = 640;  // an RTPS message with state takes 502

// What both writers send in a period, with RTPS headers; IP and UDP take 28 bytes of a message.
// One period for each state: in a longer one bulk uses up what the next state needs.
std::shared_ptr<eprosima::fastdds::rtps::FlowControllerDescriptor> controller() {
  constexpr Duration kPeriod = kStatePeriod;
  constexpr int kIpUdp = 28;
  auto controller = std::make_shared<eprosima::fastdds::rtps::FlowControllerDescriptor>();
  controller->name = kController;
  controller->scheduler = eprosima::fastdds::rtps::FlowControllerSchedulerPolicy::HIGH_PRIORITY;
  controller->period_ms = static_cast<std::uint64_t>(kPeriod / milliseconds(1));
  controller->max_bytes_per_period =
      static_cast<std::int32_t>(kLinkBytes_per_s * kTunedShare * kPeriod.seconds()) - kIpUdp;
  return controller;
}

// -10 goes first, 10 last.
void set_priority(dds::DataWriterQos& quality, const char* priority) {
  quality.publish_mode().flow_controller_name = kController;
  quality.properties().properties().emplace_back("fastdds.sfc.priority", priority);
}

// UDP alone: shared memory would pass the radio by, because both ends are on one machine here.
Domain join(const Call& call) {
  dds::DomainParticipantQos quality = dds::PARTICIPANT_QOS_DEFAULT;
  quality.transport().use_builtin_transports = false;
  const auto udp = std::make_shared<eprosima::fastdds::rtps::UDPv4TransportDescriptor>();
  if (call.mode == kControlled) {
    udp->maxMessageSize = kControlledMessage;
    quality.flow_controllers().push_back(controller());
  }
  quality.transport().user_transports.push_back(udp);
  auto* participant = dds::DomainParticipantFactory::get_instance()->create_participant(0, quality);
  if (participant == nullptr) std::exit(1);
  dds::TypeSupport state(new Type<VehicleState>("VehicleState", 400));
  dds::TypeSupport bulk(new Type<Bulk>("Bulk", kBulkBytes + 4));
  state.register_type(participant);
  bulk.register_type(participant);
  return {participant, participant->create_topic("state", "VehicleState", dds::TOPIC_QOS_DEFAULT),
          participant->create_topic("bulk", "Bulk", dds::TOPIC_QOS_DEFAULT)};
}

dds::ReliabilityQosPolicyKind reliability_of(const Call& call) {
  return call.mode == "reliable" ? dds::RELIABLE_RELIABILITY_QOS : dds::BEST_EFFORT_RELIABILITY_QOS;
}

void drive(const Domain& domain, const Call& call) {
  dds::DataWriterQos quality = dds::DATAWRITER_QOS_DEFAULT;
  quality.reliability().kind = reliability_of(call);
  quality.history().kind = dds::KEEP_LAST_HISTORY_QOS;
  quality.history().depth = 1;
  quality.publish_mode().kind = dds::ASYNCHRONOUS_PUBLISH_MODE;
  auto* publisher = domain.participant->create_publisher(dds::PUBLISHER_QOS_DEFAULT);
  dds::DataWriterQos bulk_quality = quality;
  if (call.mode == kControlled) {
    set_priority(quality, "-10");
    set_priority(bulk_quality, "10");
  }
  auto* state_writer = publisher->create_datawriter(domain.state, quality);
  auto* bulk_writer = publisher->create_datawriter(domain.bulk, bulk_quality);
  if (state_writer == nullptr || bulk_writer == nullptr) std::exit(1);
  Bulk bulk{std::vector<std::uint8_t>(kBulkBytes, 'b')};
  send_until_end(
      call, kStatePeriod, {},
      [&](Instant now) {
        VehicleState state = state_at(now);
        state_writer->write(&state);
      },
      [&](Instant) { bulk_writer->write(&bulk); });
}

class StateListener : public dds::DataReaderListener {
 public:
  void on_data_available(dds::DataReader* reader) override {
    VehicleState state;
    dds::SampleInfo info;
    while (reader->take_next_sample(&state, &info) == ReturnCode_t::RETCODE_OK)
      if (info.valid_data) note_arrival(state.made_ns);
  }
};

class BulkListener : public dds::DataReaderListener {
 public:
  void on_data_available(dds::DataReader* reader) override {
    Bulk bulk;
    dds::SampleInfo info;
    while (reader->take_next_sample(&bulk, &info) == ReturnCode_t::RETCODE_OK)
      if (info.valid_data) note_bulk(bulk.data.size());
  }
};

void listen(const Domain& domain, const Call& call) {
  dds::DataReaderQos quality = dds::DATAREADER_QOS_DEFAULT;
  quality.reliability().kind = reliability_of(call);
  quality.history().kind = dds::KEEP_LAST_HISTORY_QOS;
  quality.history().depth = 1;
  StateListener on_state;
  BulkListener on_bulk;
  auto* subscriber = domain.participant->create_subscriber(dds::SUBSCRIBER_QOS_DEFAULT);
  auto* state_reader = subscriber->create_datareader(domain.state, quality, &on_state);
  auto* bulk_reader = subscriber->create_datareader(domain.bulk, quality, &on_bulk);
  transport::sleep_until(call.end);
  state_reader->set_listener(nullptr);
  bulk_reader->set_listener(nullptr);
}

}  // namespace
}  // namespace pitwall::peers

int main(int argc, char** argv) {
  const auto call = pitwall::peers::call_of(argc, argv);
  const pitwall::peers::Domain domain = pitwall::peers::join(call);
  call.car ? pitwall::peers::drive(domain, call) : pitwall::peers::listen(domain, call);
  domain.participant->delete_contained_entities();
  eprosima::fastdds::dds::DomainParticipantFactory::get_instance()->delete_participant(
      domain.participant);
  return 0;
}
