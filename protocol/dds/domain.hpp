// DDS participant compatible with ROS 2's rmw_fastrtps, behind one small interface of bytes. Only
// domain.cpp includes Fast DDS.
//   in     topics and types by their DDS names, CDR bytes with their header of four bytes
//   out    samples to all readers; samples from all writers, on a thread of Fast DDS
//   invariants
//          UDPv4, and shared memory where it is asked for: no data sharing, no type object, XCDR1
//          only on the named interface, which is loopback by default
//          a writer never waits for a reader: it keeps its newest `depth` samples
//          a participant has its own sockets and threads: use one Domain for each stream that must
//          not wait for another
//   errors join(), write_to(), read_from(): Problem. Later: figures()
//   source ros2/rmw_fastrtps: participant.cpp, qos.cpp, TypeSupport_impl.cpp
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "protocol/vocabulary/result.hpp"
#include "protocol/vocabulary/time.hpp"

namespace pitwall::dds {

// The ports of higher domains are in the range of outgoing connections.
inline constexpr int kDomainMax = 101;

struct DomainConfig {
  int domain = 0;
  std::string interface = "127.0.0.1";  // address of this machine
  std::vector<std::string> peers{};     // addresses to contact where multicast does not reach
  // Of what is on its way from here to others of this machine; 0: none, all goes over UDP.
  std::uint32_t shared_memory_bytes = 0;
};

struct TopicType {
  std::string topic;   // "rt/vehicle/odom"
  std::string type;    // "nav_msgs::msg::dds_::Odometry_"
  std::string hash{};  // "RIHS01_...", announced to readers; empty: not announced
};

struct Quality {
  bool reliable = true;
  bool latched = false;  // transient local: a late reader gets the newest samples
  int depth = 10;        // samples kept for slow readers
};

// As sensor drivers send: what is late is not worth sending again.
inline constexpr Quality kSensorData{.reliable = false, .latched = false, .depth = 5};

using Guid = std::array<std::uint8_t, 16>;
using Bytes = std::span<const std::uint8_t>;

struct DomainFigures {
  std::uint64_t participants = 0;  // other participants that were discovered
  // Remote endpoints on one of our topics with another type: they are not connected.
  std::uint64_t foreign_types = 0;
  std::uint64_t foreign_qualities = 0;  // remote endpoints with an incompatible QoS
  // Of all domains of this process: datagrams that Fast DDS could not read, and its other error
  // reports. Fast DDS drops a datagram without the RTPS magic without a report.
  std::uint64_t malformed = 0, reported = 0;
};

class Writer {
 public:
  virtual ~Writer() = default;
  virtual bool write(Bytes cdr) = 0;  // false: not accepted, the sample is lost
  virtual Guid guid() const = 0;
  virtual int readers() const = 0;  // connected now
  // Waits until the reliable readers have all samples; false if that takes longer than `most`.
  virtual bool settle(Duration most) = 0;
};

class Domain {
 public:
  static Result<std::unique_ptr<Domain>, Problem> join(const DomainConfig& config);
  virtual ~Domain() = default;

  // The writer lives as long as the domain.
  virtual Result<Writer*, Problem> write_to(const TopicType& topic, const Quality& quality) = 0;
  // A thread of the domain calls `take` for each sample in turn.
  using Take = std::function<void(Bytes cdr)>;
  virtual Result<bool, Problem> read_from(const TopicType& topic, const Quality& quality,
                                          Take take) = 0;
  virtual Guid guid() const = 0;
  virtual DomainFigures figures() const = 0;
};

}  // namespace pitwall::dds
