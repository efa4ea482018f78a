// SPDX-License-Identifier: Apache-2.0
#include "basestation/publishers/web/admission/access.hpp"

#include <algorithm>
#include <array>

namespace pitwall::publishers::web {
namespace {

bool is_digit(char c) { return c >= '0' && c <= '9'; }

std::string lower(std::string_view text) {
  std::string out{text};
  for (char& c : out)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return out;
}

// "name:80" or "[::1]:80" without the port.
std::string name_of(std::string_view host) {
  const std::size_t end = host.starts_with('[') ? host.find(']') : host.find(':');
  const bool bracket = host.starts_with('[') && end != std::string_view::npos;
  return lower(host.substr(0, bracket ? end + 1 : end));
}

bool is_address(std::string_view name) {
  if (name.starts_with('[')) return name.ends_with(']');
  return !name.empty() && std::ranges::all_of(name, [](char c) { return is_digit(c) || c == '.'; });
}

bool own_host(const AccessRules& rules, std::string_view host) {
  const std::string name = name_of(host);
  return is_address(name) || name == "localhost" ||
         std::ranges::any_of(rules.names, [&](const auto& own) { return lower(own) == name; });
}

// A page that was loaded from this machine: from a file, or from a server that listens here.
bool is_local_page(std::string_view origin) {
  if (origin == "file://") return true;
  constexpr std::array<std::string_view, 2> kSchemes{"http://", "https://"};
  for (const std::string_view scheme : kSchemes) {
    if (!origin.starts_with(scheme)) continue;
    const std::string name = name_of(origin.substr(scheme.size()));
    return name == "localhost" || name == "[::1]" || (is_address(name) && name.starts_with("127."));
  }
  return false;
}

bool admits_origin(const AccessRules& rules, const Visitor& visitor) {
  const std::string origin = lower(visitor.origin);
  const std::string own = lower(visitor.host);
  return origin.empty() || origin == "https://" + own ||
         (!rules.encrypted && origin == "http://" + own) ||
         (rules.local_pages && is_local_page(origin)) ||
         std::ranges::any_of(rules.origins, [&](const auto& one) { return lower(one) == origin; });
}

}  // namespace

std::string_view text_of(Refused refused) {
  switch (refused) {
    case Refused::kHost:
      return "this base has another name: use its address, or start it with --web-name";
    case Refused::kOrigin:
      return "a page of another origin may not speak to this base";
    case Refused::kToken:
      return "expected a token of this base";
  }
  return "?";
}

Result<Identity, Refused> admit(const AccessRules& rules, const Visitor& visitor, UtcTime now) {
  if (!own_host(rules, visitor.host)) return Unexpected{Refused::kHost};
  if (!admits_origin(rules, visitor)) return Unexpected{Refused::kOrigin};
  if (!visitor.token.empty()) {
    auto who = rules.tokens->find(visitor.token);
    return who ? Result<Identity, Refused>{*std::move(who)} : Unexpected{Refused::kToken};
  }
  if (auto who = rules.tokens->find_session(visitor.session, now)) return *std::move(who);
  if (rules.default_role) return Identity{.role = *rules.default_role};
  return Unexpected{Refused::kToken};
}

}  // namespace pitwall::publishers::web
