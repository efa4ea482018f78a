// Owner of the bytes that the records of a recording refer to.
//   in     whole files and decompressed blocks, taken over without a copy; single messages, copied
//   out    spans that stay valid as long as the pool, or the pool that absorbed it, exists, even
//          after moves
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

#include "protocol/transport/file_bytes.hpp"
#include "protocol/vocabulary/bytes.hpp"

namespace pitwall::traffic {

using Bytes = std::span<const std::uint8_t>;

class BytePool {
 public:
  Bytes adopt(const transport::FileBytes& block) {
    blocks_.push_back(block.owner());
    open_ = nullptr;
    return block.bytes();
  }

  Bytes copy(Bytes bytes) {
    if (open_ == nullptr || open_->capacity() - open_->size() < bytes.size()) {
      const auto block = std::make_shared<std::string>();
      blocks_.push_back(block);
      open_ = block.get();
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

  std::vector<std::shared_ptr<const void>> blocks_;
  std::string* open_ = nullptr;  // the block for copies
};

}  // namespace pitwall::traffic
