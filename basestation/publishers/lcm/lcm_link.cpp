// SPDX-License-Identifier: Apache-2.0
#include "basestation/publishers/lcm/lcm_link.hpp"

#include <lcm/lcm.h>

#include <charconv>
#include <optional>

#include "protocol/transport/udp_socket.hpp"

namespace pitwall::publishers::lcm {
namespace {

constexpr std::string_view kScheme = "udpm://", kTtl = "ttl=";
constexpr std::uint32_t kMulticastBits = 0xEU;  // 224.0.0.0/4
constexpr unsigned kMulticastShift = 28;
constexpr int kTtlMax = 255;

std::optional<int> number_of(std::string_view text) {
  int value = 0;
  const char* const end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, value);
  if (error != std::errc{} || stop != end || text.empty()) return std::nullopt;
  return value;
}

lcm_t* lcm_of(void* pointer) { return static_cast<lcm_t*>(pointer); }

}  // namespace

Result<LcmUrl, Problem> LcmUrl::parse(std::string_view text) {
  const auto wrong = [text](const char* what) {
    return Unexpected{Problem{"--lcm " + std::string{text}, what}};
  };
  std::string_view rest = text;
  if (!rest.starts_with(kScheme)) return wrong("udpm://ADDRESS:PORT?ttl=N is what it can be");
  rest.remove_prefix(kScheme.size());
  const std::string_view place = rest.substr(0, rest.find('?'));
  rest.remove_prefix(std::min(rest.size(), place.size() + 1));
  const auto address = transport::parse_udp_address(place);
  if (!address || address->port == 0) return wrong("an address and a port are needed");
  if (address->ip >> kMulticastShift != kMulticastBits) {
    return wrong("the address is no multicast group: 224.0.0.0 to 239.255.255.255");
  }
  LcmUrl url{.address = std::string{place.substr(0, place.find(':'))}, .port = address->port};
  if (rest.empty()) return url;
  if (!rest.starts_with(kTtl)) return wrong("the only option is ttl=N");
  const auto ttl = number_of(rest.substr(kTtl.size()));
  if (!ttl || *ttl < 0 || *ttl > kTtlMax) return wrong("a ttl is 0 to 255");
  url.ttl = *ttl;
  return url;
}

std::string LcmUrl::text() const {
  return std::string{kScheme} + address + ":" + std::to_string(port) +
         "?ttl=" + std::to_string(ttl);
}

void LcmLink::Close::operator()(void* lcm) const { lcm_destroy(lcm_of(lcm)); }

Result<LcmLink, Problem> LcmLink::open(const LcmUrl& url) {
  lcm_t* const lcm = lcm_create(url.text().c_str());
  if (lcm == nullptr) {
    return Unexpected{Problem{"--lcm " + url.text(),
                              "LCM cannot send there; if no route for multicast exists: "
                              "ip route add 224.0.0.0/4 dev lo"}};
  }
  return LcmLink{lcm};
}

bool LcmLink::publish(const std::string& channel, std::span<const std::uint8_t> message) {
  return lcm_publish(lcm_of(lcm_.get()), channel.c_str(), message.data(),
                     static_cast<unsigned>(message.size())) == 0;
}

}  // namespace pitwall::publishers::lcm
