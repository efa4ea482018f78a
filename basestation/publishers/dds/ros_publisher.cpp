// SPDX-License-Identifier: Apache-2.0
#include "basestation/publishers/dds/ros_publisher.hpp"

#include <atomic>
#include <future>
#include <mutex>
#include <optional>
#include <thread>
#include <utility>
#include <variant>

#include "basestation/publishers/feed/feed.hpp"
#include "protocol/ros/cdr.hpp"
#include "protocol/ros/describe.hpp"
#include "protocol/ros/messages/discovery.hpp"
#include "protocol/ros/names.hpp"
#include "protocol/transport/clock.hpp"
#include "protocol/transport/readiness.hpp"
#include "protocol/transport/realtime.hpp"

namespace pitwall::publishers::dds {
namespace {

using feed::Feed;
using pitwall::dds::Domain;
using pitwall::dds::Writer;
using ros_view::BaseStatus;

constexpr Duration kPollPeriod = milliseconds(100);
constexpr int kTfDepth = 100, kUsualDepth = 10, kLatchedDepth = 1;

pitwall::dds::Quality quality_of(const ros_view::Topic& topic) {
  if (topic.latched) return {.reliable = true, .latched = true, .depth = kLatchedDepth};
  return {.depth = topic.name == "/tf" ? kTfDepth : kUsualDepth};
}

template <std::size_t N>
std::vector<std::uint8_t> node_list(const Domain& domain, const std::string& node,
                                    const std::vector<Writer*>& writers) {
  const auto gid_of = [](const pitwall::dds::Guid& guid) {
    ros::Gid<N> gid;
    std::copy(guid.begin(), guid.end(), gid.data.begin());
    return gid;
  };
  ros::NodeEntitiesInfo<N> entities;
  entities.node_namespace = "/";
  entities.node_name = node;
  for (const Writer* const writer : writers)
    entities.writer_gid_seq.push_back(gid_of(writer->guid()));
  ros::ParticipantEntitiesInfo<N> info{.gid = gid_of(domain.guid()), .node_entities_info_seq = {}};
  info.node_entities_info_seq.push_back(std::move(entities));
  std::vector<std::uint8_t> bytes;
  ros::encode(info, bytes);
  return bytes;
}

class RosPublisher : public service::Publisher {
 public:
  RosPublisher(RosConfig config, std::unique_ptr<Domain> domain)
      : read_status_(std::move(config.read_status)),
        distribution_(config.distribution),
        node_(std::move(config.node)),
        view_(std::move(config.view)),
        domain_(std::move(domain)),
        failed_(view_.topics().size()) {}

  ~RosPublisher() override {
    feed_.close();
    if (thread_.joinable()) thread_.join();
  }

  Result<bool, Problem> open() {
    for (const ros_view::Topic& topic : view_.topics()) {
      const auto name = ros::dds_topic(topic.name);
      if (!name) return Unexpected{name.error()};
      const auto writer = domain_->write_to({*name, ros::dds_type(topic.type), hash_of(topic.hash)},
                                            quality_of(topic));
      if (!writer) return Unexpected{writer.error()};
      writers_.push_back(*writer);
    }
    const auto reported = tell_node();
    if (!reported) return Unexpected{reported.error()};
    thread_ = std::thread([this] { serve_readers(); });
    return true;
  }

  void packet(const service::CarService& car, const telemetry::Arrival& arrival) override {
    feed_.sample(car.link().endpoint().state(), arrival.groups, arrival.received);
  }

  void publish(const service::CarService& /*car*/, Instant now) override {
    if (now < due_) return;
    due_ = now + kPollPeriod;
    BaseStatus base_status{.at = now};
    if (read_status_) read_status_(base_status, now);
    const service::PublisherFigures own = figures_now();
    for (const auto& [name, count] : own.dropped)
      base_status.publishers.emplace_back("ros " + name, count);
    for (const auto& [name, count] : own.refused)
      base_status.publishers.emplace_back("ros " + name, count);
    const std::lock_guard hold(lock_);
    base_status_ = std::move(base_status);
  }
  Instant due() const override { return due_; }
  std::optional<service::PublisherFigures> figures() const override { return figures_now(); }

 private:
  // Humble knows no hashes.
  std::string hash_of(const std::string& hash) const {
    return distribution_ == Distribution::kHumble ? std::string{} : hash;
  }

  Result<bool, Problem> tell_node() {
    using OfJazzy = ros::ParticipantEntitiesInfo<ros::kGidOfIron>;
    const auto writer =
        domain_->write_to({"ros_discovery_info", ros::dds_type(OfJazzy::kType),
                           hash_of(ros::type_hash(ros::describe<OfJazzy>()))},
                          {.reliable = true, .latched = true, .depth = kLatchedDepth});
    if (!writer) return Unexpected{writer.error()};
    const auto bytes = distribution_ == Distribution::kHumble
                           ? node_list<ros::kGidOfHumble>(*domain_, node_, writers_)
                           : node_list<ros::kGidOfIron>(*domain_, node_, writers_);
    if (!(*writer)->write(bytes))
      return Unexpected{Problem{"ros_discovery_info", "Fast DDS did not send the list of nodes"}};
    return true;
  }

  void serve_readers() {
    transport::lower_priority();
    const ros_view::Sink sink = [this](const ros_view::Message& message) { write(message); };
    view_.statics(transport::monotonic_now(), transport::realtime_minus_monotonic(), sink);
    Instant look_at = transport::monotonic_now();
    while (!feed_.closed()) {
      transport::wait_readable(std::array{feed_.fd()}, look_at);
      const Duration utc_minus_base = transport::realtime_minus_monotonic();
      for (const feed::Item& item : feed_.take()) {
        const auto* const sample = std::get_if<std::unique_ptr<const feed::Sample>>(&item);
        if (sample == nullptr) continue;
        view_.car((*sample)->state, (*sample)->groups, (*sample)->received, utc_minus_base, sink);
      }
      if (transport::monotonic_now() < look_at) continue;
      look_at = transport::monotonic_now() + kPollPeriod;
      if (const auto base_status = take_base_status())
        view_.base(*base_status, utc_minus_base, sink);
    }
  }

  void write(const ros_view::Message& message) {
    if (writers_[message.topic]->write(message.cdr)) {
      ++sent_;
    } else {
      ++failed_[message.topic];
    }
  }

  std::optional<BaseStatus> take_base_status() {
    const std::lock_guard hold(lock_);
    return std::exchange(base_status_, std::nullopt);
  }

  service::PublisherFigures figures_now() const {
    service::PublisherFigures figures{.publisher = "ros", .sent = sent_};
    for (const Writer* const writer : writers_)
      figures.clients += static_cast<std::uint64_t>(writer->readers());
    const auto dropped = feed_.drops();
    for (const telemetry::GroupRow& row : telemetry::kGroupTable)
      if (const auto count = dropped[telemetry::index_of(row.group)]; count > 0)
        figures.dropped.emplace_back("/base/" + std::string{row.name}, count);
    for (std::size_t i = 0; i < failed_.size(); ++i) {
      figures.failed += failed_[i];
      if (failed_[i] > 0) figures.dropped.emplace_back(view_.topics()[i].name, failed_[i]);
    }
    const pitwall::dds::DomainFigures domain = domain_->figures();
    figures.refused = {{"foreign_types", domain.foreign_types},
                       {"foreign_qualities", domain.foreign_qualities},
                       {"malformed_datagrams", domain.malformed}};
    return figures;
  }

  std::function<void(BaseStatus&, Instant)> read_status_;
  Distribution distribution_;
  std::string node_;
  ros_view::View view_;  // of the thread, once it runs; its topics never change
  Feed feed_;
  std::unique_ptr<Domain> domain_;
  std::vector<Writer*> writers_;  // as the topics
  std::vector<std::atomic<std::uint64_t>> failed_;
  std::atomic<std::uint64_t> sent_{0};
  Instant due_{};
  std::mutex lock_;
  std::optional<BaseStatus> base_status_;  // under the lock
  std::thread thread_;
};

}  // namespace

Result<Distribution, Problem> distribution_named(const std::string& name) {
  if (name == "humble") return Distribution::kHumble;
  if (name == "iron" || name == "jazzy") return Distribution::kJazzy;
  return Unexpected{Problem{"ROS 2 " + name, "expected one of: humble, iron, jazzy"}};
}

Result<std::unique_ptr<service::Publisher>, Problem> start(RosConfig config) {
  // Fast DDS starts threads of its own, which take after the one that starts them.
  auto domain = std::async(std::launch::async, [&] {
                  transport::lower_priority();
                  return Domain::join(config.domain);
                }).get();
  if (!domain) return Unexpected{domain.error()};
  auto publisher = std::make_unique<RosPublisher>(std::move(config), *std::move(domain));
  const auto opened = publisher->open();
  if (!opened) return Unexpected{opened.error()};
  return std::unique_ptr<service::Publisher>{std::move(publisher)};
}

}  // namespace pitwall::publishers::dds
