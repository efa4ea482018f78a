// SPDX-License-Identifier: Apache-2.0
#include "tests/benchmarks/gateway/listener.hpp"

#include <algorithm>
#include <utility>

#include "protocol/transport/clock.hpp"

namespace pitwall::load {
namespace {

constexpr std::size_t kRead = 2'048;
// The bus falls silent with all messages at once, and a log is short.
constexpr std::size_t kWatched = can::LossLog::kMax;
constexpr can::MonitorRules kRules{};

}  // namespace

Listener::Listener(transport::CanSocket bus, const Traffic& traffic)
    : bus_(std::move(bus)),
      traffic_(&traffic),
      monitors_(traffic.streams().size()),
      frames_(kRead),
      arrivals_(traffic.streams().size()) {
  for (std::size_t i = 0; i < traffic.streams().size(); ++i) {
    const can::MessageRow& row = traffic.streams()[i].row;
    rows_.push_back(row);
    arrivals_[i].reserve(static_cast<std::size_t>(traffic.length() / row.period) + 1);
  }
}

Result<Listener, Problem> Listener::open(const std::string& interface, const Traffic& traffic) {
  auto bus = transport::CanSocket::open(interface);
  if (!bus) return Unexpected{bus.error()};
  return Listener{*std::move(bus), traffic};
}

void Listener::poll() {
  const Instant now = transport::monotonic_now();  // everything stamped before is there to be read
  while (const std::size_t count = bus_.receive(frames_)) {
    for (std::size_t i = 0; i < count; ++i) take(frames_[i]);
    keep_reports();
    if (count < frames_.size()) break;
  }
  for (std::size_t first = 0; first < rows_.size(); first += kWatched) {
    const std::size_t count = std::min(kWatched, rows_.size() - first);
    can::watch(std::span(rows_).subspan(first, count), std::span(monitors_).subspan(first, count),
               now, log_);
    keep_reports();
  }
}

void Listener::take(const can::ReceivedFrame& received) {
  const auto stream = traffic_->stream_of(received.frame.id);
  if (!stream || received.frame.length != rows_[*stream].length) {
    ++counts_.others;
    return;
  }
  ++counts_.received;
  arrivals_[*stream].push_back(received.at);
  const auto verdict = can::judge(rows_[*stream], kRules, monitors_[*stream], received, log_);
  if (verdict != can::FrameVerdict::kGood) ++counts_.refused;
  if (log_.count == can::LossLog::kMax) keep_reports();
}

void Listener::keep_reports() {
  reports_.insert(reports_.end(), log_.listed().begin(), log_.listed().end());
  log_.clear();
}

std::uint64_t Listener::lost() const {
  std::uint64_t lost = 0;
  for (const can::MessageMonitor& monitor : monitors_) lost += monitor.lost;
  return lost;
}

std::uint64_t Listener::late() const {
  std::uint64_t late = 0;
  for (const can::MessageMonitor& monitor : monitors_) late += monitor.late;
  return late;
}

}  // namespace pitwall::load
