// SPDX-License-Identifier: Apache-2.0
#include "protocol/recording/mcap_recovery.hpp"

#include <algorithm>
#include <limits>
#include <map>
#include <optional>

namespace pitwall::recording {
namespace {

constexpr std::size_t kChunkBytes = std::size_t{1} << 20;
constexpr std::size_t kMessageOverhead = 64;  // more than the head of a message record
constexpr auto kLatest = static_cast<std::uint64_t>(std::numeric_limits<std::int64_t>::max());

struct Survey {
  std::vector<Channel> channels;
  std::map<std::uint16_t, ChannelId> places;  // by id in the old file
  std::size_t largest = 0;                    // bytes of a message
  std::uint64_t place = 0;                    // where reading stopped
  McapEnd end = McapEnd::kReading;
  Metadata run;
};

// Channels may stand anywhere in a file, the new one has them in front: so it is read twice.
Survey survey_of(std::span<const std::uint8_t> file) {
  Survey survey;
  McapReader reader{file};
  while (const auto message = reader.next()) {
    survey.largest = std::max(survey.largest, message->data.size());
  }
  for (const auto& [id, channel] : reader.channels()) {
    survey.places[id] = {static_cast<std::uint16_t>(survey.channels.size())};
    survey.channels.push_back(channel);
  }
  survey.place = reader.place();
  survey.end = reader.end();
  survey.run = reader.run();
  return survey;
}

bool believable(const McapMessage& message) {
  return message.logged_ns <= kLatest && message.published_ns <= kLatest;
}

std::string plural(std::uint64_t count, const std::string& what) {
  return std::to_string(count) + " " + what + (count == 1 ? "" : "s");
}

}  // namespace

Result<McapRecovery, Problem> recover_mcap(std::span<const std::uint8_t> file,
                                           const std::string& place) {
  const Survey survey = survey_of(file);
  if (survey.end == McapEnd::kNoMagic) return Unexpected{Problem{place, to_string(survey.end)}};
  McapRecovery out;
  out.found = survey.end;
  const auto sink = [&out](std::span<const std::uint8_t> bytes) {
    out.file.insert(out.file.end(), bytes.begin(), bytes.end());
    return true;
  };
  out.file.reserve(file.size() + kChunkBytes);
  McapWriter writer{
      survey.channels, survey.run, sink,
      McapLimits{.chunk_bytes = std::max(kChunkBytes, survey.largest + kMessageOverhead)}};
  McapReader reader{file};
  while (const auto message = reader.next()) {
    const McapStamps stamps{.logged = {static_cast<std::int64_t>(message->logged_ns)},
                            .published = {static_cast<std::int64_t>(message->published_ns)},
                            .sequence = message->sequence};
    const ChannelId channel = survey.places.at(message->channel);
    if (!believable(*message) || !writer.copy(channel, stamps, message->data)) {
      ++out.messages_lost;
      continue;
    }
    out.first = out.kept == 0 ? stamps.logged : std::min(out.first, stamps.logged);
    out.last = out.kept == 0 ? stamps.logged : std::max(out.last, stamps.logged);
    ++out.kept;
  }
  writer.close();
  const McapReaderCounters& counters = reader.counters();
  out.unverified = counters.unverified;
  out.chunks_lost = counters.bad_chunk_crc + counters.compressed_chunks;
  out.messages_lost += counters.unknown_channel + counters.implausible;
  out.checksum_wrong = counters.bad_data_crc != 0;
  out.bytes_lost = file.size() - survey.place + counters.bytes_skipped;
  return out;
}

std::string to_string(const McapRecovery& recovery) {
  std::string text = plural(recovery.kept, "message") + " kept";
  if (recovery.kept != 0) {
    text += " (" + std::to_string((recovery.last - recovery.first).seconds()) + " s)";
  }
  if (recovery.unverified != 0) {
    text += ", " + std::to_string(recovery.unverified) + " of them without a checksum";
  }
  if (recovery.was_whole()) return text + "; the file was whole";
  text += "; found " + std::string{to_string(recovery.found)};
  if (recovery.lossless()) return text + "; lost nothing but the index";
  if (recovery.checksum_wrong) text += "; its checksum is wrong";
  text += "; lost";
  if (recovery.bytes_lost != 0) text += " " + plural(recovery.bytes_lost, "byte") + " at the end";
  if (recovery.chunks_lost != 0) text += " " + plural(recovery.chunks_lost, "damaged chunk");
  if (recovery.messages_lost != 0) {
    text += " " + plural(recovery.messages_lost, "message") + " that cannot be";
  }
  return text;
}

}  // namespace pitwall::recording
