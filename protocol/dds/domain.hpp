// DDS as ROS 2's rmw_fastrtps speaks it, behind one small interface: bytes out, bytes in. Only
// domain.cpp knows Fast DDS.
//   in     topics and types by their DDS names, CDR bytes with their header of four
//   out    samples to whoever reads; samples of whoever writes, on a thread of Fast DDS
//   invariants
//          UDPv4 alone: no shared memory, no data sharing, no type object, XCDR1
//          on the one interface that is named, loopback unless another is meant
//          nothing here waits for a reader: a writer keeps its newest `depth` samples and no more
//          a participant has its own sockets and threads: one Domain for each stream that must not
//          wait for another
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

inline constexpr int kDomainMax = 101;  // ports of higher ones are those of outgoing connections

struct DomainConfig {
  int domain = 0;
  std::string interface = "127.0.0.1";  // address of this machine
  std::vector<std::string> peers{};     // asked for by address, where multicast does not reach
};

struct TopicType {
  std::string topic;   // "rt/vehicle/odom"
  std::string type;    // "nav_msgs::msg::dds_::Odometry_"
  std::string hash{};  // "RIHS01_...", told to readers; empty: not told
};

struct Quality {
  bool reliable = true;
  bool latched = false;  // transient local: who comes later gets the newest
  int depth = 10;        // samples kept for readers that are behind
};

using Guid = std::array<std::uint8_t, 16>;
using Bytes = std::span<const std::uint8_t>;

struct DomainFigures {
  std::uint64_t participants = 0;  // others that were met
  // Endpoints of others on a topic of ours that have another type: they are not connected.
  std::uint64_t foreign_types = 0;
  std::uint64_t foreign_qualities = 0;  // that ask for what we do not offer
  // Of all domains of this process: datagrams that Fast DDS could not read, and what else it
  // reports. One without the mark of RTPS it drops without a word.
  std::uint64_t malformed = 0, reported = 0;
};

class Writer {
 public:
  virtual ~Writer() = default;
  virtual bool write(Bytes cdr) = 0;  // false: not taken, and lost
  virtual Guid guid() const = 0;
  virtual int readers() const = 0;  // that are connected now
  // Waits until the reliable ones of them have all samples; false: not within so long.
  virtual bool settle(Duration most) = 0;
};

class Domain {
 public:
  static Result<std::unique_ptr<Domain>, Problem> join(const DomainConfig& config);
  virtual ~Domain() = default;

  // It lives as long as the domain.
  virtual Result<Writer*, Problem> write_to(const TopicType& topic, const Quality& quality) = 0;
  // `take` is called on a thread of the domain, for each sample in turn.
  using Take = std::function<void(Bytes cdr)>;
  virtual Result<bool, Problem> read_from(const TopicType& topic, const Quality& quality,
                                          Take take) = 0;
  virtual Guid guid() const = 0;
  virtual DomainFigures figures() const = 0;
};

}  // namespace pitwall::dds
