// SPDX-License-Identifier: Apache-2.0
#include "basestation/publishers/feed/feed.hpp"

#include <sys/eventfd.h>
#include <unistd.h>

#include <iterator>
#include <utility>

namespace pitwall::publishers::feed {
namespace {

std::size_t text_bytes_of(const Item& item) {
  const auto* const reported = std::get_if<Reported>(&item);
  return reported == nullptr ? 0 : reported->json.size();
}

}  // namespace

std::vector<std::string> channel_names() {
  std::vector<std::string> names;
  for (const recording::Channel& channel : recorder::channels()) {
    if (names.size() < kStatusChannel) names.push_back(channel.topic);
  }
  names.emplace_back("/base/values");
  return names;
}

Feed::Feed()
    : wake_fd_(transport::posix_call([] { return ::eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK); })) {}

void Feed::sample(const telemetry::Snapshot& state, telemetry::GroupSet groups, Instant received) {
  if (groups.empty()) return;
  push(std::make_unique<const Sample>(
      Sample{.state = state, .groups = groups, .received = received}));
}

void Feed::text(recorder::Topic topic, Instant at, std::string_view json) {
  push(Reported{.topic = topic, .at = at, .json = std::string{json}});
}

void Feed::base_status(std::unique_ptr<const BaseStatus> base_status) {
  push(std::move(base_status));
}

void Feed::push(Item item) {
  bool first = false;
  {
    const std::lock_guard hold(lock_);
    first = waiting_.empty();
    text_bytes_ += text_bytes_of(item);
    waiting_.push_back(std::move(item));
    while (waiting_.size() > kItems || (text_bytes_ > kTextBytes && waiting_.size() > 1)) {
      drop_oldest();
    }
  }
  if (first) wake();
}

void Feed::drop_oldest() {
  const Item& oldest = waiting_.front();
  if (const auto* const sample = std::get_if<std::unique_ptr<const Sample>>(&oldest)) {
    for (const telemetry::GroupRow& row : telemetry::kGroupTable) {
      if ((*sample)->groups.has(row.group)) ++drops_[recorder::channel_of(row.group)];
    }
  } else if (const auto* const reported = std::get_if<Reported>(&oldest)) {
    ++drops_[recorder::channel_of(reported->topic)];
  } else {
    ++drops_[kStatusChannel];
  }
  text_bytes_ -= text_bytes_of(oldest);
  waiting_.pop_front();
}

void Feed::wake() const {
  const std::uint64_t one = 1;
  (void)transport::posix_call([&] { return ::write(wake_fd_.get(), &one, sizeof one); });
}

void Feed::close() {
  {
    const std::lock_guard hold(lock_);
    closed_ = true;
  }
  wake();
}

bool Feed::closed() const {
  const std::lock_guard hold(lock_);
  return closed_;
}

std::vector<Item> Feed::take() {
  const std::lock_guard hold(lock_);
  // Under the lock: what comes from now on rings again. Once it is closed it stays readable.
  std::uint64_t count = 0;
  if (!closed_) {
    (void)transport::posix_call([&] { return ::read(wake_fd_.get(), &count, sizeof count); });
  }
  std::vector<Item> items{std::make_move_iterator(waiting_.begin()),
                          std::make_move_iterator(waiting_.end())};
  waiting_.clear();
  text_bytes_ = 0;
  return items;
}

ChannelCounts Feed::drops() const {
  const std::lock_guard hold(lock_);
  return drops_;
}

}  // namespace pitwall::publishers::feed
