// SPDX-License-Identifier: Apache-2.0
#include "basestation/intake/key_pair.hpp"

#include <filesystem>
#include <system_error>

#include "protocol/transport/file.hpp"

namespace pitwall::intake {

namespace {

namespace fs = std::filesystem;

constexpr std::size_t kKeyFileMax = 4'096;

}  // namespace

KeyPair make_key_pair(telemetry::Randomness& randomness) {
  const telemetry::Identity car = telemetry::make_identity(randomness);
  const telemetry::Identity base = telemetry::make_identity(randomness);
  return {.car = {.role = telemetry::Role::kCar, .own = car, .peer = base.public_key},
          .base = {.role = telemetry::Role::kBase, .own = base, .peer = car.public_key}};
}

Result<bool, Problem> write_key_pair(const std::string& folder, const KeyPair& pair) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) return Unexpected{Problem{folder, error.message()}};
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
  const auto text = transport::read_private_file(path, kKeyFileMax);
  if (!text) return Unexpected{text.error()};
  auto keys = telemetry::parse_key_file(*text, path);
  if (!keys) return keys;
  if (keys->role != role) {
    const bool car = keys->role == telemetry::Role::kCar;
    return Unexpected{Problem{path, car ? "these are the car's keys, not the base's"
                                        : "these are the base's keys, not the car's"}};
  }
  return keys;
}

}  // namespace pitwall::intake
