// SPDX-License-Identifier: Apache-2.0
#include "protocol/dds/domain.hpp"

#include <fastdds/rtps/transport/UDPv4TransportDescriptor.h>
#include <fastdds/rtps/transport/shared_mem/SharedMemTransportDescriptor.h>
#include <fastrtps/utils/IPLocator.h>

#include <algorithm>
#include <atomic>
#include <cstring>
#include <fastdds/dds/domain/DomainParticipant.hpp>
#include <fastdds/dds/domain/DomainParticipantFactory.hpp>
#include <fastdds/dds/domain/DomainParticipantListener.hpp>
#include <fastdds/dds/log/Log.hpp>
#include <fastdds/dds/publisher/DataWriter.hpp>
#include <fastdds/dds/publisher/DataWriterListener.hpp>
#include <fastdds/dds/publisher/Publisher.hpp>
#include <fastdds/dds/subscriber/DataReader.hpp>
#include <fastdds/dds/subscriber/DataReaderListener.hpp>
#include <fastdds/dds/subscriber/SampleInfo.hpp>
#include <fastdds/dds/subscriber/Subscriber.hpp>
#include <fastdds/dds/topic/TopicDataType.hpp>
#include <map>
#include <mutex>
#include <utility>

namespace pitwall::dds {
namespace {

namespace fast = eprosima::fastdds::dds;
namespace rtps = eprosima::fastrtps::rtps;

constexpr int kBlocking_ns = 10'000'000;        // that a write may wait for a lock of Fast DDS
constexpr std::uint32_t kUsualBytes = 1'024;    // more is allocated where a sample is larger
constexpr std::uint32_t kMessagesUnderWay = 8;  // of the largest size, in shared memory

std::atomic<std::uint64_t> malformed_of_all{0}, reported_of_all{0};

// What Fast DDS would print is counted.
class CountingConsumer : public fast::LogConsumer {
 public:
  void Consume(const fast::Log::Entry& entry) override {
    const bool of_receiver = std::strcmp(entry.context.category, "RTPS_MSG_IN") == 0;
    ++(of_receiver ? malformed_of_all : reported_of_all);
  }
};

void count_instead_of_printing() {
  static std::once_flag once;
  std::call_once(once, [] {
    fast::Log::ClearConsumers();
    fast::Log::RegisterConsumer(std::make_unique<CountingConsumer>());
    fast::Log::SetVerbosity(fast::Log::Kind::Warning);
  });
}

// Any type: its samples are bytes that are CDR already.
class CdrType : public fast::TopicDataType {
 public:
  explicit CdrType(const std::string& name) {
    setName(name.c_str());
    m_typeSize = kUsualBytes;
    m_isGetKeyDefined = false;
    auto_fill_type_object(false);
    auto_fill_type_information(false);
  }
  bool serialize(void* data, rtps::SerializedPayload_t* payload) override {
    const Bytes bytes = *static_cast<const Bytes*>(data);
    if (payload->max_size < bytes.size()) return false;
    std::memcpy(payload->data, bytes.data(), bytes.size());
    payload->length = static_cast<std::uint32_t>(bytes.size());
    payload->encapsulation = CDR_LE;
    return true;
  }
  bool deserialize(rtps::SerializedPayload_t* payload, void* data) override {
    auto& bytes = *static_cast<std::vector<std::uint8_t>*>(data);
    bytes.assign(payload->data, payload->data + payload->length);
    return true;
  }
  std::function<std::uint32_t()> getSerializedSizeProvider(void* data) override {
    const auto size = static_cast<std::uint32_t>(static_cast<const Bytes*>(data)->size());
    return [size] { return size; };
  }
  void* createData() override { return new std::vector<std::uint8_t>; }
  void deleteData(void* data) override { delete static_cast<std::vector<std::uint8_t>*>(data); }
  bool getKey(void*, rtps::InstanceHandle_t*, bool) override { return false; }
};

Guid bytes_of(const rtps::GUID_t& guid) {
  Guid bytes{};
  std::copy_n(guid.guidPrefix.value, rtps::GuidPrefix_t::size, bytes.begin());
  std::copy_n(guid.entityId.value, rtps::EntityId_t::size,
              bytes.begin() + rtps::GuidPrefix_t::size);
  return bytes;
}

template <class Qos>
void set_quality(Qos& qos, const Quality& quality, const std::string& hash) {
  qos.reliability().kind =
      quality.reliable ? fast::RELIABLE_RELIABILITY_QOS : fast::BEST_EFFORT_RELIABILITY_QOS;
  qos.reliability().max_blocking_time = {0, kBlocking_ns};
  qos.durability().kind =
      quality.latched ? fast::TRANSIENT_LOCAL_DURABILITY_QOS : fast::VOLATILE_DURABILITY_QOS;
  qos.history().kind = fast::KEEP_LAST_HISTORY_QOS;
  qos.history().depth = quality.depth;
  qos.endpoint().history_memory_policy = rtps::PREALLOCATED_WITH_REALLOC_MEMORY_MODE;
  qos.data_sharing().off();
  if (hash.empty()) return;
  const std::string text = "typehash=" + hash + ";";
  qos.user_data().setValue({text.begin(), text.end()});
}

struct Counters {
  std::atomic<std::uint64_t> participants{0}, foreign_types{0}, foreign_qualities{0};
};

class WriterOfFast : public Writer, private fast::DataWriterListener {
 public:
  explicit WriterOfFast(Counters& counters) : counters_(counters) {}

  bool open(fast::Publisher& publisher, fast::Topic& topic, const fast::DataWriterQos& qos) {
    writer_ = publisher.create_datawriter(&topic, qos, this);
    return writer_ != nullptr;
  }
  bool write(Bytes cdr) override { return writer_->write(&cdr); }
  bool settle(Duration most) override {
    if (most.ns <= 0) return false;
    const eprosima::fastrtps::Duration_t wait{
        static_cast<std::int32_t>(most.ns / kNanosecondsPerSecond),
        static_cast<std::uint32_t>(most.ns % kNanosecondsPerSecond)};
    return writer_->wait_for_acknowledgments(wait) ==
           eprosima::fastrtps::types::ReturnCode_t::RETCODE_OK;
  }
  Guid guid() const override { return bytes_of(writer_->guid()); }
  int readers() const override { return readers_.load(); }

 private:
  void on_publication_matched(fast::DataWriter*,
                              const fast::PublicationMatchedStatus& status) override {
    readers_ = status.current_count;
  }
  void on_offered_incompatible_qos(fast::DataWriter*,
                                   const fast::OfferedIncompatibleQosStatus& status) override {
    counters_.foreign_qualities += static_cast<std::uint64_t>(status.total_count_change);
  }

  Counters& counters_;
  fast::DataWriter* writer_ = nullptr;
  std::atomic<int> readers_{0};
};

class ReaderOfFast : public fast::DataReaderListener {
 public:
  ReaderOfFast(Counters& counters, Domain::Take take)
      : counters_(counters), take_(std::move(take)) {}

  bool open(fast::Subscriber& subscriber, fast::Topic& topic, const fast::DataReaderQos& qos) {
    return subscriber.create_datareader(&topic, qos, this) != nullptr;
  }

 private:
  void on_data_available(fast::DataReader* reader) override {
    fast::SampleInfo info;
    while (reader->take_next_sample(&sample_, &info) == ReturnCode_t::RETCODE_OK)
      if (info.valid_data) take_(sample_);
  }
  void on_requested_incompatible_qos(fast::DataReader*,
                                     const fast::RequestedIncompatibleQosStatus& status) override {
    counters_.foreign_qualities += static_cast<std::uint64_t>(status.total_count_change);
  }

  Counters& counters_;
  Domain::Take take_;
  std::vector<std::uint8_t> sample_;  // kept for its storage
};

class DomainOfFast : public Domain, private fast::DomainParticipantListener {
 public:
  ~DomainOfFast() override {
    if (participant_ == nullptr) return;
    participant_->set_listener(nullptr);
    participant_->delete_contained_entities();
    fast::DomainParticipantFactory::get_instance()->delete_participant(participant_);
  }

  bool open(const DomainConfig& config) {
    participant_ = fast::DomainParticipantFactory::get_instance()->create_participant(
        static_cast<fast::DomainId_t>(config.domain), quality_of(config), this,
        fast::StatusMask::none());
    if (participant_ == nullptr) return false;
    publisher_ = participant_->create_publisher(fast::PUBLISHER_QOS_DEFAULT);
    subscriber_ = participant_->create_subscriber(fast::SUBSCRIBER_QOS_DEFAULT);
    return publisher_ != nullptr && subscriber_ != nullptr;
  }

  Result<Writer*, Problem> write_to(const TopicType& topic, const Quality& quality) override {
    fast::Topic* const made = topic_of(topic);
    fast::DataWriterQos qos = fast::DATAWRITER_QOS_DEFAULT;
    set_quality(qos, quality, topic.hash);
    qos.publish_mode().kind = fast::ASYNCHRONOUS_PUBLISH_MODE;
    auto writer = std::make_unique<WriterOfFast>(counters_);
    if (made == nullptr || !writer->open(*publisher_, *made, qos))
      return Unexpected{Problem{topic.topic, "Fast DDS refuses a writer of " + topic.type}};
    return writers_.emplace_back(std::move(writer)).get();
  }

  Result<bool, Problem> read_from(const TopicType& topic, const Quality& quality,
                                  Take take) override {
    fast::Topic* const made = topic_of(topic);
    fast::DataReaderQos qos = fast::DATAREADER_QOS_DEFAULT;
    set_quality(qos, quality, topic.hash);
    auto reader = std::make_unique<ReaderOfFast>(counters_, std::move(take));
    if (made == nullptr || !reader->open(*subscriber_, *made, qos))
      return Unexpected{Problem{topic.topic, "Fast DDS refuses a reader of " + topic.type}};
    readers_.push_back(std::move(reader));
    return true;
  }

  Guid guid() const override { return bytes_of(participant_->guid()); }
  DomainFigures figures() const override {
    return {counters_.participants, counters_.foreign_types, counters_.foreign_qualities,
            malformed_of_all, reported_of_all};
  }

 private:
  static fast::DomainParticipantQos quality_of(const DomainConfig& config) {
    fast::DomainParticipantQos qos = fast::PARTICIPANT_QOS_DEFAULT;
    qos.name("/");
    const std::string enclave = "enclave=/;";
    qos.user_data().setValue({enclave.begin(), enclave.end()});
    auto transport = std::make_shared<eprosima::fastdds::rtps::UDPv4TransportDescriptor>();
    transport->interfaceWhiteList.push_back(config.interface);
    qos.transport().use_builtin_transports = false;
    qos.transport().user_transports.push_back(std::move(transport));
    if (config.shared_memory_bytes > 0) {
      auto memory = std::make_shared<eprosima::fastdds::rtps::SharedMemTransportDescriptor>();
      memory->segment_size(config.shared_memory_bytes);
      memory->max_message_size(config.shared_memory_bytes / kMessagesUnderWay);
      qos.transport().user_transports.push_back(std::move(memory));
    }
    auto& peers = qos.wire_protocol().builtin.initialPeersList;
    for (const std::string& peer : config.peers) {
      rtps::Locator_t locator;
      rtps::IPLocator::setIPv4(locator, peer);
      peers.push_back(locator);
    }
    if (!config.peers.empty()) {  // a list takes the place of multicast, which is to go on
      rtps::Locator_t all;
      rtps::IPLocator::setIPv4(all, "239.255.0.1");
      peers.push_back(all);
    }
    return qos;
  }

  fast::Topic* topic_of(const TopicType& topic) {
    const auto [type, fresh] = types_.try_emplace(topic.type);
    if (fresh) {
      type->second = fast::TypeSupport{new CdrType{topic.type}};
      if (type->second.register_type(participant_) != ReturnCode_t::RETCODE_OK) return nullptr;
    }
    {
      const std::lock_guard hold(lock_);
      ours_.insert_or_assign(topic.topic, topic.type);
    }
    return participant_->create_topic(topic.topic, topic.type, fast::TOPIC_QOS_DEFAULT);
  }

  void on_participant_discovery(fast::DomainParticipant*,
                                rtps::ParticipantDiscoveryInfo&& info) override {
    if (info.status == rtps::ParticipantDiscoveryInfo::DISCOVERED_PARTICIPANT)
      ++counters_.participants;
  }
  void on_publisher_discovery(fast::DomainParticipant*, rtps::WriterDiscoveryInfo&& info) override {
    if (info.status == rtps::WriterDiscoveryInfo::DISCOVERED_WRITER)
      look_at(info.info.topicName().to_string(), info.info.typeName().to_string());
  }
  void on_subscriber_discovery(fast::DomainParticipant*,
                               rtps::ReaderDiscoveryInfo&& info) override {
    if (info.status == rtps::ReaderDiscoveryInfo::DISCOVERED_READER)
      look_at(info.info.topicName().to_string(), info.info.typeName().to_string());
  }
  void look_at(const std::string& topic, const std::string& type) {
    const std::lock_guard hold(lock_);
    const auto ours = ours_.find(topic);
    if (ours != ours_.end() && ours->second != type) ++counters_.foreign_types;
  }

  Counters counters_;
  std::mutex lock_;
  std::map<std::string, std::string> ours_;  // types by topic; under the lock
  fast::DomainParticipant* participant_ = nullptr;
  fast::Publisher* publisher_ = nullptr;
  fast::Subscriber* subscriber_ = nullptr;
  std::map<std::string, fast::TypeSupport> types_;
  std::vector<std::unique_ptr<WriterOfFast>> writers_;
  std::vector<std::unique_ptr<ReaderOfFast>> readers_;
};

bool is_address(const std::string& text) { return rtps::IPLocator::isIPv4(text); }

}  // namespace

Result<std::unique_ptr<Domain>, Problem> Domain::join(const DomainConfig& config) {
  const std::string place = "DDS domain " + std::to_string(config.domain);
  if (config.domain < 0 || config.domain > kDomainMax)
    return Unexpected{Problem{place, "expected 0 to " + std::to_string(kDomainMax)}};
  std::vector<std::string> addresses = config.peers;
  addresses.push_back(config.interface);
  for (const std::string& address : addresses)
    if (!is_address(address))
      return Unexpected{Problem{place, address + " is not an IPv4 address"}};
  count_instead_of_printing();
  auto domain = std::make_unique<DomainOfFast>();
  if (!domain->open(config))
    return Unexpected{
        Problem{place, "Fast DDS opens no socket at " + config.interface +
                           (config.shared_memory_bytes > 0 ? ", or gets no shared memory" : "")}};
  return std::unique_ptr<Domain>{std::move(domain)};
}

}  // namespace pitwall::dds
