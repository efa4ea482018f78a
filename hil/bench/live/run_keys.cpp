// SPDX-License-Identifier: Apache-2.0
#include "hil/bench/live/run_keys.hpp"

#include <sys/stat.h>
#include <unistd.h>

#include <filesystem>
#include <system_error>
#include <utility>

#include "basestation/link/key_pair.hpp"

namespace pitwall::bench {
namespace {

namespace fs = std::filesystem;

constexpr const char* kMemory = "/dev/shm";

Result<bool, Problem> copy(const std::string& name, const std::string& from,
                           const std::string& to) {
  const auto text = transport::read_file(from + "/" + name, telemetry::kMaxKeyFileBytes);
  if (!text) return Unexpected{text.error()};
  return transport::write_private_file(to + "/" + name, *text);
}

// A folder that is none belongs to nobody else.
bool is_ours(const std::string& folder) {
  struct stat about {};
  return ::stat(folder.c_str(), &about) != 0 || about.st_uid == ::geteuid();
}

}  // namespace

Result<bool, Problem> make_run_keys(const std::string& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (!error) fs::permissions(folder, fs::perms::owner_all, error);
  for (const char* const name : {link::kCarKeys, link::kBaseKeys}) {
    if (!error) fs::remove(fs::path(folder) / name, error);
  }
  if (error) return Unexpected{Problem{folder, error.message()}};
  telemetry::SystemRandomness randomness;
  return link::write_key_pair(folder, link::make_key_pair(randomness, true));
}

Result<RunKeys, Problem> keys_of_run(const LivePlan& plan, const std::string& given) {
  const bool is_new = given.empty();
  if (is_ours(is_new ? plan.folder : given)) {
    RunKeys keys{.folder = is_new ? plan.folder + "/keys" : given};
    if (!is_new) return keys;
    const auto made = make_run_keys(keys.folder);
    if (!made) return Unexpected{made.error()};
    return keys;
  }
  auto memory = transport::TemporaryFolder::create("pitwall-keys-", kMemory);
  if (!memory) return Unexpected{memory.error()};
  RunKeys keys{.folder = memory->path(), .memory = *std::move(memory)};
  Result<bool, Problem> done = true;
  if (is_new) done = make_run_keys(keys.folder);
  if (!is_new && !plan.attached()) done = copy(link::kCarKeys, given, keys.folder);
  if (!is_new && !plan.base.empty() && done) done = copy(link::kBaseKeys, given, keys.folder);
  if (!done) return Unexpected{done.error()};
  return keys;
}

}  // namespace pitwall::bench
