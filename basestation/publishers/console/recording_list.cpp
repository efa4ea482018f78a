// SPDX-License-Identifier: Apache-2.0
#include "basestation/publishers/console/recording_list.hpp"

#include <algorithm>
#include <charconv>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <span>
#include <system_error>
#include <utility>

#include "protocol/json/json_text.hpp"
#include "protocol/recorder/channels.hpp"
#include "protocol/recorder/file_disk.hpp"
#include "protocol/recording/mcap_reader.hpp"
#include "protocol/transport/realtime.hpp"

namespace pitwall::publishers::console {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kHeadBytes = 64 * 1'024;  // in front of the first chunk: what the run was

std::optional<int> digits(std::string_view text, std::size_t at, std::size_t count) {
  int value = 0;
  const char* const from = text.data() + at;
  const auto [end, error] = std::from_chars(from, from + count, value);
  if (error != std::errc{} || end != from + count) return std::nullopt;
  return value;
}

recording::Metadata run_of(const fs::path& segment) {
  std::ifstream file{segment, std::ios::binary};
  std::string head(kHeadBytes, '\0');
  file.read(head.data(), static_cast<std::streamsize>(head.size()));
  head.resize(static_cast<std::size_t>(file.gcount()));
  recording::McapReader reader{{reinterpret_cast<const std::uint8_t*>(head.data()), head.size()}};
  reader.next();
  return reader.run();
}

std::string value_of(const recording::Metadata& run, std::string_view key) {
  for (const auto& [name, value] : run) {
    if (name == key) return value;
  }
  return {};
}

// None where the folder holds no segment.
std::optional<Recording> look_into(const fs::path& folder) {
  Recording recording{.name = folder.filename().string(), .folder = folder.string()};
  std::vector<fs::path> segments;
  std::error_code error;
  for (auto entry = fs::directory_iterator(folder, error);
       !error && entry != fs::directory_iterator() && segments.size() < kSegmentsMax;
       entry.increment(error)) {
    std::error_code none;
    if (entry->path().extension() != ".mcap" || entry->is_symlink(none)) continue;
    if (!entry->is_regular_file(none)) continue;
    segments.push_back(entry->path());
    const std::uintmax_t bytes = entry->file_size(none);
    if (!none) recording.bytes += bytes;
  }
  if (error) {
    recording.problem = error.message();
    return recording;
  }
  if (segments.empty()) return std::nullopt;
  std::ranges::sort(segments);  // their names begin with their time
  recording.segments = segments.size();
  recording.first = begin_of_segment(segments.front().filename().string());
  recording.last = begin_of_segment(segments.back().filename().string());
  recording.running = recorder::is_being_written(segments.back().string());
  const recording::Metadata run = run_of(segments.front());
  recording.car = value_of(run, "car");
  recording.car_name = value_of(run, "name");
  if (!recorder::clock_of(run)) recording.problem = "no recording of a base station";
  return recording;
}

std::string line(const Recording& recording, std::string_view track) {
  const auto ms = [](const std::optional<UtcTime>& at) {
    return at ? json::number(at->milliseconds()) : "null";
  };
  return json::Object{}
      .text("name", recording.name)
      .text("folder", recording.folder)
      .text("car", recording.car)
      .text("car_name", recording.car_name)
      .number("segments", recording.segments)
      .number("bytes", recording.bytes)
      .json("first_utc_ms", ms(recording.first))
      .json("last_utc_ms", ms(recording.last))
      .flag("running", recording.running)
      .text("problem", recording.problem)
      .text("command", recording.problem.empty() ? replay_command(recording.folder, track) : "")
      .str();
}

std::string in_a_shell(std::string_view word) {
  const bool plain = !word.empty() && std::ranges::all_of(word, [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
           std::string_view{"/._-+:@"}.find(c) != std::string_view::npos;
  });
  if (plain) return std::string{word};
  std::string quoted = "'";
  for (const char c : word) quoted += c == '\'' ? std::string{"'\\''"} : std::string{c};
  return quoted + "'";
}

}  // namespace

std::optional<UtcTime> begin_of_segment(std::string_view name) {
  namespace chrono = std::chrono;
  constexpr std::string_view kForm = "_20261122T003000.250Z_";
  constexpr std::size_t kTime = 9, kDot = 16, kZone = 20;
  // From the back: what comes in front may have anything in it.
  const std::size_t number = name.rfind('_');
  if (number == std::string_view::npos || number + 1 < kForm.size()) return std::nullopt;
  const std::string_view form = name.substr(number + 1 - kForm.size(), kForm.size());
  if (form.front() != '_' || form[kTime] != 'T' || form[kDot] != '.' || form[kZone] != 'Z') {
    return std::nullopt;
  }
  const auto year = digits(form, 1, 4), month = digits(form, 5, 2), day = digits(form, 7, 2);
  const auto hour = digits(form, 10, 2), minute = digits(form, 12, 2), second = digits(form, 14, 2);
  const auto millisecond = digits(form, 17, 3);
  if (!year || !month || !day || !hour || !minute || !second || !millisecond) return std::nullopt;
  const chrono::year_month_day date{chrono::year{*year},
                                    chrono::month{static_cast<unsigned>(*month)},
                                    chrono::day{static_cast<unsigned>(*day)}};
  if (!date.ok() || *hour > 23 || *minute > 59 || *second > 60) return std::nullopt;
  const auto at = chrono::sys_days{date} + chrono::hours{*hour} + chrono::minutes{*minute} +
                  chrono::seconds{*second} + chrono::milliseconds{*millisecond};
  return UtcTime{chrono::duration_cast<chrono::nanoseconds>(at.time_since_epoch()).count()};
}

std::string replay_command(std::string_view folder, std::string_view track) {
  return "pitwall-base --replay " + in_a_shell(folder) + " --web 0" +
         (track.empty() ? "" : " --track " + in_a_shell(track));
}

Recordings recordings_of(const std::string& folder) {
  Recordings list;
  std::error_code error;
  const fs::path root = fs::absolute(folder, error).lexically_normal();
  list.root = root.string();
  auto itself = look_into(root);
  if (itself && !itself->problem.empty() && itself->segments == 0) {
    list.problem = itself->problem;
    return list;
  }
  if (itself) list.found.push_back(*std::move(itself));
  for (auto entry = fs::directory_iterator(root, error);
       !error && entry != fs::directory_iterator(); entry.increment(error)) {
    std::error_code none;
    if (entry->is_symlink(none) || !entry->is_directory(none)) continue;
    if (auto found = look_into(entry->path())) list.found.push_back(*std::move(found));
  }
  std::ranges::sort(list.found, [](const Recording& a, const Recording& b) {
    return std::pair{a.last.value_or(UtcTime{}), b.name} >
           std::pair{b.last.value_or(UtcTime{}), a.name};
  });
  if (list.found.size() > kRecordingsMax) {
    list.left_out = list.found.size() - kRecordingsMax;
    list.found.resize(kRecordingsMax);
  }
  return list;
}

std::string recordings_text(const Recordings& recordings, std::string_view track) {
  json::Array lines;
  for (const Recording& recording : recordings.found) lines.json(line(recording, track));
  return json::Object{}
      .text("root", recordings.root)
      .number("left_out", recordings.left_out)
      .text("problem", recordings.problem)
      .json("recordings", lines.str())
      .str();
}

RecordingList::RecordingList(std::string folder, std::string track, Show show)
    : folder_(std::move(folder)),
      track_(std::move(track)),
      show_(std::move(show)),
      thread_([this] { refresh_periodically(); }) {}

RecordingList::~RecordingList() {
  {
    const std::lock_guard lock{mutex_};
    ends_ = true;
  }
  ending_.notify_all();
  thread_.join();
}

void RecordingList::refresh_periodically() {
  transport::lower_priority();
  std::unique_lock lock{mutex_};
  while (!ends_) {
    lock.unlock();
    show_(recordings_text(recordings_of(folder_), track_));
    lock.lock();
    ending_.wait_for(lock, std::chrono::nanoseconds{kEvery.ns}, [this] { return ends_; });
  }
}

}  // namespace pitwall::publishers::console
