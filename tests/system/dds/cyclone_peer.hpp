// Cyclone DDS participant as an independent peer in tests, with types from its own compiler.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <dds/dds.h>
#include <gtest/gtest.h>

#include <array>
#include <deque>
#include <functional>
#include <string>
#include <vector>

#include "protocol/transport/clock.hpp"

namespace pitwall::testing {

// A sample on loan from Cyclone; the destructor returns the loan.
template <class M>
class Loan {
 public:
  Loan() = default;
  Loan(dds_entity_t reader, void* sample) : reader_(reader), sample_(sample) {}
  Loan(Loan&& other) noexcept : reader_(other.reader_), sample_(other.sample_) {
    other.sample_ = nullptr;
  }
  Loan& operator=(Loan&&) = delete;
  ~Loan() {
    if (sample_ != nullptr) dds_return_loan(reader_, &sample_, 1);
  }
  explicit operator bool() const { return sample_ != nullptr; }
  const M* operator->() const { return static_cast<const M*>(sample_); }
  const M& operator*() const { return *static_cast<const M*>(sample_); }

 private:
  dds_entity_t reader_ = 0;
  void* sample_ = nullptr;
};

struct Endpoint {
  std::string topic, type, user_data;
  std::array<std::uint8_t, 16> guid{};
};

// Quality of service of a Cyclone endpoint.
struct Ask {
  bool reliable = true, latched = false;
  int depth = 64;
};

class CyclonePeer {
 public:
  explicit CyclonePeer(unsigned domain)
      : participant_(dds_create_participant(domain, nullptr, nullptr)) {
    EXPECT_GT(participant_, 0);
  }
  ~CyclonePeer() { dds_delete(participant_); }
  CyclonePeer(const CyclonePeer&) = delete;
  CyclonePeer& operator=(const CyclonePeer&) = delete;

  dds_entity_t reader(const dds_topic_descriptor_t& description, const char* type,
                      const char* topic, Ask ask = {}) {
    dds_qos_t* const qos = qos_of(ask);
    const dds_entity_t made =
        dds_create_reader(participant_, topic_of(description, type, topic), qos, nullptr);
    dds_delete_qos(qos);
    EXPECT_GT(made, 0) << topic;
    return made;
  }
  dds_entity_t writer(const dds_topic_descriptor_t& description, const char* type,
                      const char* topic, Ask ask = {}) {
    dds_qos_t* const qos = qos_of(ask);
    const dds_entity_t made =
        dds_create_writer(participant_, topic_of(description, type, topic), qos, nullptr);
    dds_delete_qos(qos);
    EXPECT_GT(made, 0) << topic;
    return made;
  }

  template <class M>
  static Loan<M> take(dds_entity_t reader) {
    void* sample = nullptr;
    dds_sample_info_t info{};
    if (dds_take(reader, &sample, &info, 1, 1) <= 0) return {};
    if (!info.valid_data) {
      dds_return_loan(reader, &sample, 1);
      return {};
    }
    return {reader, sample};
  }

  // Whether the peer itself knows a writer for this reader. A volatile reader gets only what is
  // written after that, and the two sides learn of each other at different moments.
  static bool has_writer(dds_entity_t reader) {
    dds_subscription_matched_status_t status{};
    return dds_get_subscription_matched_status(reader, &status) == DDS_RETCODE_OK &&
           status.current_count > 0;
  }

  // All writers, or all readers, of the domain.
  std::vector<Endpoint> others(bool writers) {
    const dds_entity_t reader = dds_create_reader(
        participant_,
        writers ? DDS_BUILTIN_TOPIC_DCPSPUBLICATION : DDS_BUILTIN_TOPIC_DCPSSUBSCRIPTION, nullptr,
        nullptr);
    std::vector<Endpoint> found;
    while (const auto sample = take<dds_builtintopic_endpoint_t>(reader)) {
      Endpoint endpoint{sample->topic_name, sample->type_name, {}, {}};
      std::copy_n(sample->key.v, endpoint.guid.size(), endpoint.guid.begin());
      void* data = nullptr;
      std::size_t size = 0;
      if (dds_qget_userdata(sample->qos, &data, &size) && data != nullptr) {
        endpoint.user_data.assign(static_cast<const char*>(data), size);
        dds_free(data);
      }
      // The reader of this builtin topic itself does not count.
      if (!endpoint.topic.starts_with("DCPS")) found.push_back(std::move(endpoint));
    }
    dds_delete(reader);
    return found;
  }

 private:
  static dds_qos_t* qos_of(const Ask& ask) {
    constexpr dds_duration_t kBlocking = 100'000'000;
    dds_qos_t* const qos = dds_create_qos();
    dds_qset_reliability(qos, ask.reliable ? DDS_RELIABILITY_RELIABLE : DDS_RELIABILITY_BEST_EFFORT,
                         kBlocking);
    dds_qset_durability(qos,
                        ask.latched ? DDS_DURABILITY_TRANSIENT_LOCAL : DDS_DURABILITY_VOLATILE);
    dds_qset_history(qos, DDS_HISTORY_KEEP_LAST, ask.depth);
    return qos;
  }
  // Gives the type the name that ROS 2 uses.
  dds_entity_t topic_of(const dds_topic_descriptor_t& description, const char* type,
                        const char* topic) {
    dds_topic_descriptor_t& named = descriptions_.emplace_back(description);
    named.m_typename = type;
    const dds_entity_t made = dds_create_topic(participant_, &named, topic, nullptr, nullptr);
    EXPECT_GT(made, 0) << topic;
    return made;
  }

  dds_entity_t participant_;
  std::deque<dds_topic_descriptor_t> descriptions_;
};

// Waits until `is_so` or the timeout, by the monotonic clock: the network has no virtual time.
inline bool comes(const std::function<bool()>& is_so, Duration patience = seconds(30)) {
  for (const Instant end = transport::monotonic_now() + patience;
       transport::monotonic_now() < end;) {
    if (is_so()) return true;
    transport::sleep_until(transport::monotonic_now() + milliseconds(20));
  }
  return is_so();
}

}  // namespace pitwall::testing
