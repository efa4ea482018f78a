// SPDX-License-Identifier: Apache-2.0
#include "basestation/link/key_log_file.hpp"

#include <filesystem>
#include <memory>
#include <utility>

#include "protocol/transport/file.hpp"

namespace pitwall::link {

Result<telemetry::KeyLog, Problem> key_log_to(const std::string& path,
                                              const telemetry::KeyFile& keys) {
  if (!keys.bench) {
    return Unexpected{Problem{"--key-log",
                              "expected keys of the bench; make them with "
                              "`pitwall-base keygen --bench --out FOLDER`"}};
  }
  if (!std::filesystem::exists(path)) {
    const auto made = transport::write_private_file(path, "");
    if (!made) return Unexpected{made.error()};
  } else if (const auto ours = transport::read_private_file(path); !ours) {
    return Unexpected{ours.error()};
  }
  auto file = transport::AppendWriter::open(path);
  if (!file) return Unexpected{file.error()};
  const auto writer = std::make_shared<transport::AppendWriter>(*std::move(file));
  return telemetry::KeyLog{[writer](const std::string& lines) { writer->write(lines); }};
}

}  // namespace pitwall::link
