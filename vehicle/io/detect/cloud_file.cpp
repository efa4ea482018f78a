// SPDX-License-Identifier: Apache-2.0
#include "vehicle/io/detect/cloud_file.hpp"

#include <array>
#include <charconv>
#include <cstdint>
#include <cstring>
#include <optional>
#include <vector>

namespace pitwall::io {
namespace {

using perception::LidarPoint, perception::PointCloud;

constexpr std::array<std::string_view, 4> kNames{"x", "y", "z", "intensity"};
constexpr std::size_t kNeeded = 3;  // of the names

template <class Number>
std::optional<Number> number_in(std::string_view word) {
  Number value{};
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error != std::errc{} || end != word.data() + word.size()) return std::nullopt;
  return value;
}

std::vector<std::string_view> words_of(std::string_view line) {
  std::vector<std::string_view> words;
  for (std::size_t at = line.find_first_not_of(" \t\r"); at != std::string_view::npos;) {
    const std::size_t end = std::min(line.find_first_of(" \t\r", at), line.size());
    words.push_back(line.substr(at, end - at));
    at = line.find_first_not_of(" \t\r", end);
  }
  return words;
}

// The lines of a text, counted.
class Lines {
 public:
  explicit Lines(std::string_view text) : rest_(text) {}

  std::optional<std::string_view> next() {
    if (rest_.empty()) return std::nullopt;
    const std::size_t end = std::min(rest_.find('\n'), rest_.size());
    const std::string_view line = rest_.substr(0, end);
    rest_.remove_prefix(std::min(end + 1, rest_.size()));
    ++number_;
    return line;
  }
  std::size_t number() const { return number_; }
  std::string_view rest() const { return rest_; }

 private:
  std::string_view rest_;
  std::size_t number_ = 0;
};

enum class Kind : char { kSigned = 'I', kUnsigned = 'U', kFloat = 'F' };

struct Field {
  std::string name;
  Kind kind = Kind::kFloat;
  std::size_t size = 4, count = 1;
  std::size_t byte = 0, word = 0;  // where it begins in a point: binary, ascii
};

struct Head {
  std::vector<Field> fields;
  std::size_t points = 0, bytes = 0, words = 0;  // bytes and words of a point
  bool is_ascii = false;
};

template <class Value>
double value_at(const char* at) {
  Value value;
  std::memcpy(&value, at, sizeof value);
  return static_cast<double>(value);
}

double value_of(const Field& f, const char* at) {
  switch (f.kind) {
    case Kind::kFloat:
      return f.size == 8 ? value_at<double>(at) : value_at<float>(at);
    case Kind::kSigned:
      return f.size == 1   ? value_at<std::int8_t>(at)
             : f.size == 2 ? value_at<std::int16_t>(at)
             : f.size == 4 ? value_at<std::int32_t>(at)
                           : value_at<std::int64_t>(at);
    case Kind::kUnsigned:
      return f.size == 1   ? value_at<std::uint8_t>(at)
             : f.size == 2 ? value_at<std::uint16_t>(at)
             : f.size == 4 ? value_at<std::uint32_t>(at)
                           : value_at<std::uint64_t>(at);
  }
  return 0.0;
}

bool is_known(const Field& f) {
  const bool whole = f.size == 1 || f.size == 2 || f.size == 4 || f.size == 8;
  return f.kind == Kind::kFloat ? f.size == 4 || f.size == 8 : whole;
}

class PcdReader {
 public:
  PcdReader(std::string_view bytes, const std::string& name) : lines_(bytes), name_(name) {}

  Result<PointCloud, Problem> read() {
    auto head = read_head();
    if (!head) return Unexpected{head.error()};
    place(*head);
    for (std::size_t k = 0; k < kNeeded; ++k)
      if (used_[k] == nullptr) return refuse_here("FIELDS without " + std::string{kNames[k]});
    return head->is_ascii ? read_ascii(*head) : read_binary(*head);
  }

 private:
  Unexpected<Problem> refuse_here(const std::string& what) const {
    return pitwall::refuse(name_ + ":" + std::to_string(lines_.number()), what);
  }

  Result<Head, Problem> read_head() {
    Head head;
    while (const auto line = lines_.next()) {
      const auto words = words_of(line->substr(0, line->find('#')));
      if (words.empty()) continue;
      if (words[0] == "DATA") {
        if (words.size() != 2 || (words[1] != "ascii" && words[1] != "binary"))
          return refuse_here("expected DATA ascii or DATA binary");
        head.is_ascii = words[1] == "ascii";
        if (head.fields.empty()) return refuse_here("DATA before FIELDS");
        for (const Field& f : head.fields)
          if (!is_known(f)) return refuse_here("a type of " + f.name + " that no PCD has");
        return head;
      }
      if (const auto taken = take(words, head); !taken) return Unexpected{taken.error()};
    }
    return refuse_here("no DATA in the head of a PCD");
  }

  Result<bool, Problem> take(const std::vector<std::string_view>& words, Head& head) {
    const std::string_view key = words[0];
    if (key == "FIELDS") {
      head.fields.clear();
      for (std::size_t i = 1; i < words.size(); ++i)
        head.fields.push_back({.name = std::string{words[i]}});
      return true;
    }
    if (key == "POINTS") {
      const auto count = words.size() == 2 ? number_in<std::size_t>(words[1]) : std::nullopt;
      if (!count || *count > kCloudPointsMax)
        return refuse_here("POINTS: expected a number, at most " + std::to_string(kCloudPointsMax));
      head.points = *count;
      return true;
    }
    if (key == "SIZE" || key == "TYPE" || key == "COUNT") return take_column(words, head);
    if (key == "VERSION" || key == "WIDTH" || key == "HEIGHT" || key == "VIEWPOINT") return true;
    return refuse_here("'" + std::string{key} + "' is no line of the head of a PCD");
  }

  Result<bool, Problem> take_column(const std::vector<std::string_view>& words, Head& head) {
    constexpr std::size_t kMost = 4096;
    if (words.size() != head.fields.size() + 1)
      return refuse_here(std::string{words[0]} + ": expected " +
                         std::to_string(head.fields.size()) + " values, one for each field");
    for (std::size_t i = 0; i < head.fields.size(); ++i) {
      Field& field = head.fields[i];
      const std::string_view word = words[i + 1];
      if (words[0] == "TYPE") {
        if (word != "I" && word != "U" && word != "F")
          return refuse_here("TYPE: expected I, U or F");
        field.kind = static_cast<Kind>(word[0]);
        continue;
      }
      const auto number = number_in<std::size_t>(word);
      if (!number || *number == 0 || *number > kMost)
        return refuse_here(std::string{words[0]} + ": expected a whole number above 0");
      (words[0] == "SIZE" ? field.size : field.count) = *number;
    }
    return true;
  }

  void place(Head& head) {
    for (Field& field : head.fields) {
      field.byte = head.bytes, field.word = head.words;
      head.bytes += field.size * field.count, head.words += field.count;
      for (std::size_t k = 0; k < kNames.size(); ++k)
        if (field.name == kNames[k]) used_[k] = &field;
    }
  }

  static void set(LidarPoint& point, std::size_t k, double value) {
    const std::array<float*, 4> to{&point.x_m, &point.y_m, &point.z_m, &point.intensity};
    *to[k] = static_cast<float>(value);
  }

  Result<PointCloud, Problem> read_binary(const Head& head) const {
    const std::string_view data = lines_.rest();
    if (data.size() < head.points * head.bytes)
      return refuse_here("ends after " + std::to_string(data.size() / head.bytes) + " of " +
                         std::to_string(head.points) + " points");
    PointCloud points(head.points);
    for (std::size_t i = 0; i < head.points; ++i)
      for (std::size_t k = 0; k < used_.size(); ++k)
        if (used_[k] != nullptr)
          set(points[i], k, value_of(*used_[k], data.data() + i * head.bytes + used_[k]->byte));
    return points;
  }

  Result<PointCloud, Problem> read_ascii(const Head& head) {
    PointCloud points;
    points.reserve(head.points);
    while (points.size() < head.points) {
      const auto line = lines_.next();
      if (!line)
        return refuse_here("ends after " + std::to_string(points.size()) + " of " +
                           std::to_string(head.points) + " points");
      const auto words = words_of(*line);
      if (words.empty()) continue;
      if (words.size() != head.words)
        return refuse_here("expected " + std::to_string(head.words) + " values, got " +
                           std::to_string(words.size()));
      LidarPoint& point = points.emplace_back();
      for (std::size_t k = 0; k < used_.size(); ++k) {
        if (used_[k] == nullptr) continue;
        const std::string_view word = words[used_[k]->word];
        const auto value = number_in<double>(word);
        if (!value) return refuse_here("'" + std::string{word} + "' is no number");
        set(point, k, *value);
      }
    }
    return points;
  }

  Lines lines_;
  const std::string& name_;
  std::array<const Field*, kNames.size()> used_{};
};

Result<PointCloud, Problem> parse_kitti(std::string_view bytes, const std::string& name) {
  constexpr std::size_t kPointBytes = 16;
  if (bytes.size() % kPointBytes != 0)
    return refuse(name, std::to_string(bytes.size()) + " bytes are no whole number of points of " +
                            std::to_string(kPointBytes) + " bytes (x, y, z, intensity)");
  if (bytes.size() / kPointBytes > kCloudPointsMax)
    return refuse(name, "more than " + std::to_string(kCloudPointsMax) + " points");
  PointCloud points(bytes.size() / kPointBytes);
  for (std::size_t i = 0; i < points.size(); ++i) {
    std::array<float, 4> row{};
    std::memcpy(row.data(), bytes.data() + i * kPointBytes, kPointBytes);
    points[i] = {row[0], row[1], row[2], row[3]};
  }
  return points;
}

}  // namespace

Result<PointCloud, Problem> parse_cloud(std::string_view bytes, const std::string& name) {
  if (name.ends_with(".bin")) return parse_kitti(bytes, name);
  if (name.ends_with(".pcd")) return PcdReader{bytes, name}.read();
  return refuse(name, "expected a .pcd or a .bin of KITTI");
}

}  // namespace pitwall::io
