// SPDX-License-Identifier: Apache-2.0
#include "protocol/ros/cdr.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>

#include "protocol/vocabulary/check.hpp"

namespace pitwall::ros {
namespace {

static_assert(std::endian::native == std::endian::little, "numbers are copied as they lie");

constexpr std::array<std::uint8_t, kCdrHeader> kLittleEndian{0, 1, 0, 0};
constexpr std::size_t kLargestNumber = 8;
constexpr std::size_t kPaddingMost = 3;

constexpr std::size_t padding(std::size_t at, std::size_t bytes) {
  return (bytes - at % bytes) % bytes;
}

void swap_each(std::uint8_t* bytes, std::size_t count, std::size_t each) {
  for (std::size_t i = 0; i < count; ++i) std::reverse(bytes + i * each, bytes + (i + 1) * each);
}

}  // namespace

CdrWriter::CdrWriter(std::vector<std::uint8_t>& out) : out_(out), begins_(out.size() + kCdrHeader) {
  out_.insert(out_.end(), kLittleEndian.begin(), kLittleEndian.end());
}

void CdrWriter::put_text(std::string_view text) {
  put(static_cast<std::uint32_t>(text.size() + 1));
  out_.insert(out_.end(), text.begin(), text.end());
  out_.push_back(0);
}

void CdrWriter::put_numbers(const void* numbers, std::size_t count, std::size_t bytes_each) {
  CHECK(bytes_each <= kLargestNumber);
  out_.resize(out_.size() + padding(out_.size() - begins_, bytes_each));
  const std::size_t at = out_.size();
  out_.resize(at + count * bytes_each);
  std::memcpy(out_.data() + at, numbers, count * bytes_each);
}

// The options behind the representation may count the padding at the end: RTPS 10.2.
CdrReader::CdrReader(std::span<const std::uint8_t> bytes) {
  if (bytes.size() < kCdrHeader) {
    refuse("shorter than a CDR header");
  } else if (bytes[0] != 0 || bytes[1] > 1) {
    refuse("expected plain CDR, found representation " + std::to_string(bytes[0]) + ", " +
           std::to_string(bytes[1]));
  } else {
    swapped_ = bytes[1] == 0;
    bytes_ = bytes.subspan(kCdrHeader);
  }
}

void CdrReader::refuse(std::string why) {
  if (problem_) return;
  const std::string place = field_.empty() ? "message" : "field " + std::string(field_);
  problem_ = Problem{place, std::move(why)};
}

void CdrReader::finish() {
  field_ = {};
  if (ok() && bytes_.size() - at_ > kPaddingMost)
    refuse(std::to_string(bytes_.size() - at_) + " bytes after the end of the message");
}

bool CdrReader::has(std::size_t bytes) {
  if (!ok()) return false;
  if (bytes <= bytes_.size() - at_) return true;
  refuse("ends " + std::to_string(bytes - (bytes_.size() - at_)) + " bytes too early");
  return false;
}

bool CdrReader::align(std::size_t bytes) {
  const std::size_t skipped = padding(at_, bytes);
  if (!has(skipped)) return false;
  at_ += skipped;
  return true;
}

std::size_t CdrReader::take_count(std::size_t least_each) {
  std::uint32_t count = 0;
  take(count);
  if (!ok()) return 0;
  if (count <= (bytes_.size() - at_) / least_each) return count;
  refuse(std::to_string(count) + " elements do not fit into " +
         std::to_string(bytes_.size() - at_) + " bytes");
  return 0;
}

std::string_view CdrReader::take_text() {
  const std::size_t length = take_count(1);
  if (!ok()) return {};
  // Some writers leave the NUL of an empty string out.
  if (length == 0) return {};
  const auto* text = reinterpret_cast<const char*>(bytes_.data() + at_);
  if (text[length - 1] != '\0')
    return refuse("expected NUL at the end of the string"), std::string_view{};
  at_ += length;
  return {text, length - 1};
}

bool CdrReader::take_flag() {
  if (!has(1)) return false;
  const std::uint8_t value = bytes_[at_++];
  if (value > 1) refuse("expected a bool of 0 or 1, found " + std::to_string(value));
  return value == 1;
}

void CdrReader::take_numbers(void* numbers, std::size_t count, std::size_t bytes_each) {
  CHECK(bytes_each <= kLargestNumber);
  if (!align(bytes_each) || !has(count * bytes_each)) return;
  std::memcpy(numbers, bytes_.data() + at_, count * bytes_each);
  at_ += count * bytes_each;
  if (swapped_) swap_each(static_cast<std::uint8_t*>(numbers), count, bytes_each);
}

}  // namespace pitwall::ros
