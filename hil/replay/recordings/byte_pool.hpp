// Owner of the bytes that the records of a recording refer to.
//   in     whole files and decompressed blocks, taken over as they are; single messages, copied
//   out    spans that stay valid as long as the pool or the pool that absorbed it lives, wherever
//          it is moved to
//   cost   a copy allocates once per mebibyte
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "protocol/vocabulary/bytes.hpp"

namespace pitwall::traffic {

using Bytes = std::span<const std::uint8_t>;

class BytePool {
 public:
  Bytes adopt(std::string block) {
    blocks_.push_back(std::make_unique<std::string>(std::move(block)));
    open_ = nullptr;
    return as_bytes(*blocks_.back());
  }

  Bytes copy(Bytes bytes) {
    if (open_ == nullptr || open_->capacity() - open_->size() < bytes.size()) {
      blocks_.push_back(std::make_unique<std::string>());
      open_ = blocks_.back().get();
      open_->reserve(std::max(kBlockBytes, bytes.size()));  // never grows: spans point into it
    }
    const std::size_t begin = open_->size();
    open_->append(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    return as_bytes(*open_).subspan(begin);
  }

  void absorb(BytePool&& other) {
    blocks_.insert(blocks_.end(), std::make_move_iterator(other.blocks_.begin()),
                   std::make_move_iterator(other.blocks_.end()));
    other.blocks_.clear();
    other.open_ = nullptr;
    open_ = nullptr;
  }

 private:
  static constexpr std::size_t kBlockBytes = std::size_t{1} << 20;

  std::vector<std::unique_ptr<std::string>> blocks_;
  std::string* open_ = nullptr;  // the block that copies go to
};

}  // namespace pitwall::traffic
