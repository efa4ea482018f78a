// SPDX-License-Identifier: Apache-2.0
#include "hil/bench/run_keys.hpp"

#include <filesystem>
#include <system_error>

#include "protocol/telemetry/session/keys.hpp"
#include "protocol/telemetry/session/randomness.hpp"
#include "protocol/transport/file.hpp"

namespace pitwall::bench {
namespace {

namespace fs = std::filesystem;

Result<bool, Problem> replace(const std::string& path, const telemetry::KeyFile& keys) {
  std::error_code error;
  fs::remove(path, error);
  if (error) return Unexpected{Problem{path, error.message()}};
  return transport::write_private_file(path, telemetry::text_of(keys));
}

}  // namespace

Result<bool, Problem> make_run_keys(const std::string& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) return Unexpected{Problem{folder, error.message()}};
  telemetry::SystemRandomness randomness;
  telemetry::KeyFile car{
      .role = telemetry::Role::kCar, .own = make_identity(randomness), .peer = {}};
  telemetry::KeyFile base{
      .role = telemetry::Role::kBase, .own = make_identity(randomness), .peer = {}};
  car.bench = base.bench = true;
  car.peer = base.own.public_key;
  base.peer = car.own.public_key;
  if (auto written = replace(folder + "/car.keys", car); !written) return written;
  return replace(folder + "/base.keys", base);
}

}  // namespace pitwall::bench
