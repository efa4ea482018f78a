// SPDX-License-Identifier: Apache-2.0
#include "protocol/recorder/record_queue.hpp"

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

RecordQueue::RecordQueue(std::size_t bytes) : capacity_(bytes) { filling_.reserve(capacity_); }

bool RecordQueue::push(const Record& record) {
  const Head head{.logged_ns = record.logged.ns,
                  .published_ns = record.published.ns,
                  .bytes = record.data.size(),
                  .channel = record.channel};
  const std::size_t bytes = sizeof head + record.data.size();
  const std::lock_guard lock{mutex_};
  if (closed_ || filling_.size() + bytes > capacity_) {
    ++dropped_;
    return false;
  }
  const std::size_t at = filling_.size();
  filling_.resize(at + bytes);
  std::memcpy(filling_.data() + at, &head, sizeof head);
  if (!record.data.empty()) {
    std::memcpy(filling_.data() + at + sizeof head, record.data.data(), record.data.size());
  }
  // Else the writer comes by itself: no system call for each record.
  if (filling_.size() > capacity_ / 2 && at <= capacity_ / 2) much_.notify_one();
  return true;
}

bool RecordQueue::take_all(Batch& batch, Duration wait) {
  batch.bytes_.clear();
  batch.bytes_.reserve(capacity_);
  batch.at_ = 0;
  std::unique_lock lock{mutex_};
  much_.wait_for(lock, std::chrono::nanoseconds{wait.ns},
                 [this] { return closed_ || filling_.size() > capacity_ / 2; });
  std::swap(batch.bytes_, filling_);
  return !closed_;
}

void RecordQueue::close() {
  const std::lock_guard lock{mutex_};
  closed_ = true;
  much_.notify_one();
}

std::uint64_t RecordQueue::dropped() const {
  const std::lock_guard lock{mutex_};
  return dropped_;
}

}  // namespace pitwall::recorder
