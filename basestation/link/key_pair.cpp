// SPDX-License-Identifier: Apache-2.0
#include "basestation/link/key_pair.hpp"

#include <filesystem>
#include <system_error>

#include "protocol/transport/file.hpp"

namespace pitwall::link {

namespace {

namespace fs = std::filesystem;

// A new folder is its owner's alone, whatever the umask.
Result<bool, Problem> make_folder(const std::string& folder) {
  std::error_code error;
  const bool made = fs::create_directories(folder, error);
  if (made && !error) fs::permissions(folder, fs::perms::owner_all, error);
  if (error) return Unexpected{Problem{folder, error.message()}};
  return true;
}

}  // namespace

KeyPair make_key_pair(telemetry::Randomness& randomness, bool bench) {
  const telemetry::Identity car = telemetry::make_identity(randomness);
  const telemetry::Identity base = telemetry::make_identity(randomness);
  return {
      .car = {.role = telemetry::Role::kCar, .own = car, .peer = base.public_key, .bench = bench},
      .base = {
          .role = telemetry::Role::kBase, .own = base, .peer = car.public_key, .bench = bench}};
}

Result<bool, Problem> write_key_pair(const std::string& folder, const KeyPair& pair) {
  if (auto made = make_folder(folder); !made) return made;
  std::error_code error;
  const std::string car = (fs::path(folder) / kCarKeys).string();
  const std::string base = (fs::path(folder) / kBaseKeys).string();
  for (const std::string& path : {car, base}) {
    if (fs::exists(fs::symlink_status(path, error))) {
      return Unexpected{Problem{path, "exists already: keys are never replaced"}};
    }
  }
  if (auto written = transport::write_private_file(car, text_of(pair.car)); !written) {
    return written;
  }
  auto written = transport::write_private_file(base, text_of(pair.base));
  if (!written) fs::remove(car, error);  // half a pair is of no use
  return written;
}

Result<telemetry::KeyFile, Problem> read_keys(const std::string& path, telemetry::Role role) {
  const auto text = transport::read_private_file(path, telemetry::kMaxKeyFileBytes);
  if (!text) return Unexpected{text.error()};
  return telemetry::parse_key_file(*text, path, {.role = role});
}

}  // namespace pitwall::link
