// SPDX-License-Identifier: Apache-2.0
#include "basestation/link/stamp_file.hpp"

#include <charconv>
#include <chrono>
#include <filesystem>
#include <system_error>
#include <utility>

#include "protocol/transport/file.hpp"

namespace pitwall::link {
namespace {

constexpr std::string_view kKeys = ".keys", kStamp = ".stamp", kName = "stamp: ";
constexpr std::size_t kMaxBytes = 64;
constexpr unsigned kOwnerOnly = 0600;

Unexpected<Problem> refuse(const std::string& path, const std::string& what) {
  return Unexpected{
      Problem{path + ":1", what + ", expected one line `stamp: NANOSECONDS` of 1 to 2^63 - 1"}};
}

}  // namespace

std::string stamp_file_of(const std::string& key_file) {
  const std::size_t end =
      key_file.ends_with(kKeys) ? key_file.size() - kKeys.size() : key_file.size();
  return key_file.substr(0, end) + std::string{kStamp};
}

std::string stamp_text(telemetry::Stamp stamp) {
  return std::string{kName} + std::to_string(stamp) + "\n";
}

Result<telemetry::Stamp, Problem> parse_stamp(std::string_view text, const std::string& path) {
  if (!text.starts_with(kName)) return refuse(path, "is not a stamp file");
  if (!text.ends_with('\n')) return refuse(path, "is cut short");
  const std::string_view digits = text.substr(kName.size(), text.size() - kName.size() - 1);
  // Signed: beyond the greatest stamp there is none that a car could use.
  std::int64_t stamp = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), stamp);
  if (error != std::errc{} || end != digits.data() + digits.size() || stamp <= 0) {
    return refuse(path, "has no stamp in range");
  }
  return static_cast<telemetry::Stamp>(stamp);
}

Result<telemetry::Stamp, Problem> read_stamp(const std::string& path) {
  std::error_code unknown;  // whether it is there: then reading it tells why not
  if (!std::filesystem::exists(path, unknown) && !unknown) return telemetry::Stamp{0};
  const auto text = transport::read_private_file(path, kMaxBytes);
  if (!text) return Unexpected{text.error()};
  return parse_stamp(*text, path);
}

StampFile::StampFile(std::string path, telemetry::Stamp known, Duration period)
    : path_(std::move(path)),
      period_(period),
      reported_(known),
      newest_(known),
      tried_(known),
      writer_([this] { write_all(); }) {}

StampFile::~StampFile() {
  {
    const std::lock_guard lock{mutex_};
    ended_ = true;
  }
  changed_.notify_one();
  writer_.join();
}

void StampFile::keep(telemetry::Stamp newest) {
  if (newest == reported_) return;
  reported_ = newest;
  {
    const std::lock_guard lock{mutex_};
    newest_ = newest;
  }
  changed_.notify_one();
}

std::optional<Problem> StampFile::take_problem() {
  const std::lock_guard lock{mutex_};
  return std::exchange(problem_, std::nullopt);
}

void StampFile::write_all() {
  std::unique_lock lock{mutex_};
  while (true) {
    changed_.wait(lock, [this] { return ended_ || newest_ != tried_; });
    if (newest_ == tried_) return;
    tried_ = newest_;
    const std::string text = stamp_text(newest_);
    lock.unlock();
    const auto written = transport::write_file(path_, text, kOwnerOnly);
    lock.lock();
    if (!written && !failed_) {
      failed_ = true;
      problem_ = written.error();
    }
    changed_.wait_for(lock, std::chrono::nanoseconds{period_.ns}, [this] { return ended_; });
  }
}

}  // namespace pitwall::link
