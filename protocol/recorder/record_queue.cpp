// SPDX-License-Identifier: Apache-2.0
#include "protocol/recorder/record_queue.hpp"

#include <algorithm>
#include <chrono>
#include <cstring>

namespace pitwall::recorder {
namespace {

struct Head {
  std::int64_t logged_ns, published_ns;
  std::uint64_t bytes;
  std::uint16_t channel;
};

}  // namespace

std::optional<Record> Batch::next() {
  if (at_ == bytes_.size()) return std::nullopt;
  Head head{};
  std::memcpy(&head, bytes_.data() + at_, sizeof head);
  at_ += sizeof head;
  const Record record{.channel = head.channel,
                      .logged = {head.logged_ns},
                      .published = {head.published_ns},
                      .data = std::span{bytes_}.subspan(at_, head.bytes)};
  at_ += head.bytes;
  return record;
}

RecordQueue::RecordQueue(std::size_t bytes) : ring_(bytes) {}

void RecordQueue::copy_in(std::uint64_t at, const void* from, std::size_t bytes) {
  if (bytes == 0) return;
  const std::size_t place = at % ring_.size();
  const std::size_t first = std::min(bytes, ring_.size() - place);
  std::memcpy(ring_.data() + place, from, first);
  std::memcpy(ring_.data(), static_cast<const std::uint8_t*>(from) + first, bytes - first);
}

void RecordQueue::copy_out(std::uint64_t at, std::span<std::uint8_t> to) const {
  const std::size_t place = at % ring_.size();
  const std::size_t first = std::min(to.size(), ring_.size() - place);
  std::copy_n(ring_.begin() + static_cast<std::ptrdiff_t>(place), first, to.begin());
  std::copy_n(ring_.begin(), to.size() - first, to.begin() + static_cast<std::ptrdiff_t>(first));
}

bool RecordQueue::push(const Record& record) {
  const Head head{.logged_ns = record.logged.ns,
                  .published_ns = record.published.ns,
                  .bytes = record.data.size(),
                  .channel = record.channel};
  const std::size_t bytes = sizeof head + record.data.size();
  const std::uint64_t at = pushed_.load(std::memory_order_relaxed);
  const std::uint64_t waiting = at - taken_.load(std::memory_order_acquire);
  if (refuses_ || waiting + bytes > ring_.size()) {
    dropped_.store(dropped_.load(std::memory_order_relaxed) + 1, std::memory_order_relaxed);
    return false;
  }
  copy_in(at, &head, sizeof head);
  copy_in(at + sizeof head, record.data.data(), record.data.size());
  pushed_.store(at + bytes, std::memory_order_release);
  return true;
}

bool RecordQueue::take_all(Batch& batch, Duration wait) {
  bool last = false;
  {
    std::unique_lock lock{mutex_};
    ends_.wait_for(lock, std::chrono::nanoseconds{wait.ns}, [this] { return closed_; });
    last = closed_;
  }
  const std::uint64_t from = taken_.load(std::memory_order_relaxed);
  const std::uint64_t to = pushed_.load(std::memory_order_acquire);
  batch.at_ = 0;
  batch.bytes_.reserve(ring_.size());
  batch.bytes_.resize(to - from);
  copy_out(from, batch.bytes_);
  taken_.store(to, std::memory_order_release);
  return !last;
}

void RecordQueue::close() {
  refuses_ = true;
  const std::lock_guard lock{mutex_};
  closed_ = true;
  ends_.notify_one();
}

}  // namespace pitwall::recorder
