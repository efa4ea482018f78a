// SPDX-License-Identifier: Apache-2.0
#include "basestation/publishers/web/admission/room_left.hpp"

#include <sys/resource.h>
#include <unistd.h>

#include <charconv>
#include <optional>
#include <string_view>

#include "protocol/transport/file.hpp"

namespace pitwall::publishers::web {
namespace {

constexpr std::uint64_t kMegabyte = 1'000'000;
constexpr std::string_view kGroups = "/sys/fs/cgroup";

// A number at the beginning of the text; none of "max".
std::optional<std::uint64_t> number_in(std::string_view text) {
  std::uint64_t number = 0;
  const auto read = std::from_chars(text.data(), text.data() + text.size(), number);
  return read.ec == std::errc{} ? std::optional{number} : std::nullopt;
}

std::optional<std::uint64_t> number_of_file(const std::string& path) {
  const auto text = transport::read_file(path);
  return text ? number_in(*text) : std::nullopt;
}

// The field "NAME:  NUMBER kB" of /proc/self/status, in bytes.
std::uint64_t status_bytes(std::string_view status, std::string_view name) {
  const std::size_t at = status.find(name);
  if (at == status.npos) return 0;
  std::string_view rest = status.substr(at + name.size());
  rest.remove_prefix(std::min(rest.find_first_of("0123456789"), rest.size()));
  constexpr std::uint64_t kKibibyte = 1'024;
  return number_in(rest).value_or(0) * kKibibyte;
}

std::uint64_t allowed_by(__rlimit_resource_t resource) {
  rlimit limit{};
  if (::getrlimit(resource, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY) return 0;
  return limit.rlim_cur;
}

// The folder of this process's control group; empty: none of version 2.
std::string control_group() {
  const auto groups = transport::read_file("/proc/self/cgroup");
  if (!groups) return {};
  constexpr std::string_view kUnified = "0::";
  const std::size_t at = groups->find(kUnified);
  if (at == groups->npos) return {};
  const std::string_view rest = std::string_view{*groups}.substr(at + kUnified.size());
  return std::string{kGroups} + std::string{rest.substr(0, rest.find('\n'))};
}

}  // namespace

std::vector<MemoryUse> memory_use() {
  std::vector<MemoryUse> uses;
  const auto add = [&](std::string bound, std::uint64_t used, std::uint64_t allowed) {
    if (allowed > 0) uses.push_back({.bound = std::move(bound), .used = used, .allowed = allowed});
  };
  const std::uint64_t data = allowed_by(RLIMIT_DATA), space = allowed_by(RLIMIT_AS);
  if (data > 0 || space > 0) {
    const auto status = transport::read_file("/proc/self/status");
    if (status) {
      add("RLIMIT_DATA", status_bytes(*status, "VmData:"), data);
      add("RLIMIT_AS", status_bytes(*status, "VmSize:"), space);
    }
  }
  const std::string group = control_group();
  if (group.empty()) return uses;
  const auto allowed = number_of_file(group + "/memory.max");
  const auto used = number_of_file(group + "/memory.current");
  if (allowed && used) add("memory.max", *used, *allowed);
  return uses;
}

std::string short_of_memory(std::span<const MemoryUse> uses, std::uint64_t room) {
  for (const MemoryUse& use : uses) {
    if (use.used + room <= use.allowed) continue;
    return "memory: " + std::to_string(use.used / kMegabyte) + " of " +
           std::to_string(use.allowed / kMegabyte) + " MB used (" + use.bound + ")";
  }
  return {};
}

std::string short_of_descriptors(int descriptor) {
  const std::uint64_t allowed = allowed_by(RLIMIT_NOFILE);
  if (allowed == 0 || static_cast<std::uint64_t>(descriptor) + kKeptDescriptors < allowed)
    return {};
  return "file descriptors: all but a few of " + std::to_string(allowed) + " used (RLIMIT_NOFILE)";
}

}  // namespace pitwall::publishers::web
