// Encoder and parser of netlink messages of the kernel. Pure: bytes in, bytes out.
//   in     type, fixed part and attributes of a request; or the bytes of an answer
//   out    bytes to send; attributes one by one
//   invariants
//          for_each_attribute() returns the attributes that NetlinkRequest wrote
//   errors a request that does not fit is our own mistake (CHECK); an attribute of an answer that
//          ends beyond its bytes ends the iteration
//   source Linux userspace-api/netlink/intro.rst, include/uapi/linux/netlink.h
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <linux/netlink.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <string_view>
#include <type_traits>

#include "protocol/vocabulary/check.hpp"

namespace pitwall::transport {

static_assert(sizeof(nlattr) == 4 && sizeof(nlmsghdr) == 16);  // both are multiples of four

using NetlinkBytes = std::span<const std::uint8_t>;

// Messages and attributes begin at multiples of four.
constexpr std::size_t netlink_aligned(std::size_t bytes) { return (bytes + 3) / 4 * 4; }

class NetlinkRequest {
 public:
  template <class Fixed>
  NetlinkRequest(std::uint16_t type, unsigned flags, const Fixed& fixed) {
    head_.nlmsg_type = type;
    head_.nlmsg_flags = static_cast<std::uint16_t>(NLM_F_REQUEST | flags);
    append(&fixed, sizeof fixed);
  }

  template <class T>
  void put(unsigned attribute, const T& value) {
    static_assert(std::is_trivially_copyable_v<T>);
    const std::size_t start = open_nest(attribute);
    append(&value, sizeof value);
    close_nest(start);
  }
  void put_text(unsigned attribute, std::string_view text) {
    const std::size_t start = open_nest(attribute);
    append(text.data(), text.size());
    append("", 1);
    close_nest(start);
  }
  // Attributes written between open_nest() and close_nest() are nested in `attribute`.
  std::size_t open_nest(unsigned attribute) {
    align();
    const std::size_t start = size_;
    const nlattr head{.nla_len = 0, .nla_type = static_cast<std::uint16_t>(attribute)};
    append(&head, sizeof head);
    return start;
  }
  void close_nest(std::size_t start) {
    const auto length = static_cast<std::uint16_t>(size_ - start);
    std::memcpy(&bytes_[start], &length, sizeof length);
    align();
  }

  NetlinkBytes bytes(std::uint32_t sequence) {
    head_.nlmsg_len = static_cast<std::uint32_t>(size_);
    head_.nlmsg_seq = sequence;
    std::memcpy(bytes_.data(), &head_, sizeof head_);
    return {bytes_.data(), size_};
  }

 private:
  void append(const void* what, std::size_t count) {
    CHECK(count <= bytes_.size() - size_);
    std::memcpy(&bytes_[size_], what, count);
    size_ += count;
  }
  void align() { size_ = std::min(bytes_.size(), netlink_aligned(size_)); }

  static constexpr std::size_t kRoom = 512;  // our largest request takes less than half of it
  alignas(nlmsghdr) std::array<std::uint8_t, kRoom> bytes_{};
  nlmsghdr head_{};
  std::size_t size_ = sizeof(nlmsghdr);
};

// The leading bytes as a T; missing bytes are zero, as the kernel defines it for grown structures.
template <class T>
T read_as(NetlinkBytes bytes) {
  static_assert(std::is_trivially_copyable_v<T>);
  T out{};
  std::memcpy(&out, bytes.data(), std::min(bytes.size(), sizeof out));
  return out;
}

inline std::string_view read_text(NetlinkBytes bytes) {
  const auto end = std::find(bytes.begin(), bytes.end(), std::uint8_t{0});
  return {reinterpret_cast<const char*>(bytes.data()),
          static_cast<std::size_t>(end - bytes.begin())};
}

// Calls visit(attribute type without flag bits, its contents) for each attribute.
template <class Visit>
void for_each_attribute(NetlinkBytes bytes, Visit&& visit) {
  while (bytes.size() >= sizeof(nlattr)) {
    const auto head = read_as<nlattr>(bytes);
    if (head.nla_len < sizeof(nlattr) || head.nla_len > bytes.size()) return;
    visit(static_cast<unsigned>(head.nla_type & NLA_TYPE_MASK),
          bytes.subspan(sizeof(nlattr), head.nla_len - sizeof(nlattr)));
    bytes = bytes.subspan(std::min<std::size_t>(bytes.size(), netlink_aligned(head.nla_len)));
  }
}

// The bytes after the fixed part of a message.
template <class Fixed>
NetlinkBytes attributes_after(NetlinkBytes message) {
  const std::size_t skipped = netlink_aligned(sizeof(Fixed));
  return message.subspan(std::min(message.size(), skipped));
}

}  // namespace pitwall::transport
