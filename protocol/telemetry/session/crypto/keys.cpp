// SPDX-License-Identifier: Apache-2.0
#include "protocol/telemetry/session/crypto/keys.hpp"

#include <algorithm>
#include <optional>
#include <span>
#include <utility>

#include "protocol/telemetry/session/crypto/cipher.hpp"
#include "protocol/vocabulary/text.hpp"

namespace pitwall::telemetry {

namespace {

constexpr std::string_view kDigits = "0123456789abcdef";
constexpr unsigned kNibble = 4, kNibbleMask = 15;

void append_hex(std::string& text, std::span<const std::uint8_t> bytes) {
  for (const std::uint8_t byte : bytes) {
    text += kDigits[byte >> kNibble];
    text += kDigits[byte & kNibbleMask];
  }
}

std::optional<unsigned> digit_of(char c) {
  const char lower = c >= 'A' && c <= 'F' ? static_cast<char>(c - 'A' + 'a') : c;
  const std::size_t at = kDigits.find(lower);
  if (at == std::string_view::npos) return std::nullopt;
  return static_cast<unsigned>(at);
}

bool parse_hex(std::string_view text, std::span<std::uint8_t> bytes) {
  if (text.size() != 2 * bytes.size()) return false;
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    const auto high = digit_of(text[2 * i]), low = digit_of(text[2 * i + 1]);
    if (!high || !low) return false;
    bytes[i] = static_cast<std::uint8_t>(*high << kNibble | *low);
  }
  return true;
}

enum class Line : std::uint8_t { kRole, kPublic, kSecret, kPeer, kUse };
constexpr std::array<std::string_view, 5> kLineNames{"role", "public", "secret", "peer", "use"};
constexpr std::string_view kBenchUse = "bench";

// The lines of a file, each once, the last if it has one; values are checked by the caller.
struct Lines {
  std::array<std::string_view, kLineNames.size()> value{};
  std::array<int, kLineNames.size()> number{};

  std::string_view operator[](Line line) const { return value[static_cast<std::size_t>(line)]; }
  std::string place(const std::string& file, Line line) const {
    return file + ":" + std::to_string(number[static_cast<std::size_t>(line)]);
  }
};

Result<Lines, Problem> split(std::string_view text, const std::string& place) {
  Lines lines;
  int number = 0;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    const std::string_view line = trimmed(text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
    ++number;
    if (line.empty() || line.front() == '#') continue;
    const std::string here = place + ":" + std::to_string(number);
    const std::size_t colon = line.find(':');
    const std::string_view name = line.substr(0, colon);
    std::size_t which = 0;
    while (which < kLineNames.size() && kLineNames[which] != name) ++which;
    if (colon == std::string_view::npos || which == kLineNames.size()) {
      return Unexpected{Problem{here, "expected one of: role:, public:, secret:, peer:, use:"}};
    }
    if (lines.number[which] != 0) {
      return Unexpected{Problem{here, std::string(name) + ": occurs twice"}};
    }
    lines.value[which] = trimmed(line.substr(colon + 1));
    lines.number[which] = number;
  }
  for (std::size_t i = 0; i < static_cast<std::size_t>(Line::kUse); ++i) {
    if (lines.number[i] == 0) {
      return Unexpected{Problem{place, "has no line " + std::string(kLineNames[i]) + ":"}};
    }
  }
  return lines;
}

constexpr std::array<std::string_view, 2> kRoleNames{"car", "base"};
std::string_view name_of(Role role) { return kRoleNames[static_cast<std::size_t>(role)]; }

std::string wrong_role_text(Role found) {
  return found == Role::kCar ? "these are the car's keys, expected the base's: give base.keys"
                             : "these are the base's keys, expected the car's: give car.keys";
}

constexpr std::string_view kBenchAtRealCar =
    "keys of a bench, whose sessions may be logged, expected a pair for a real car: make one with "
    "`pitwall-base keygen` without --bench (or start the car with --simulation)";

// Why no session can be made with the peer, if so. Bit 255 of a key means nothing (RFC 7748).
std::optional<std::string> peer_problem(const KeyFile& keys) {
  constexpr const char* kRemedy =
      ", expected the public: of the other end's file: make both with `pitwall-base keygen`";
  constexpr std::uint8_t kUsedBits = 0x7F;
  PublicKey peer = keys.peer;
  peer.back() &= kUsedBits;
  if (peer == keys.own.public_key) return std::string{"is the own key"} + kRemedy;
  Key shared;
  if (agree(keys.own.secret_key, keys.peer, shared)) return std::nullopt;
  return "gives no shared secret (all zero, or another point of low order)" + std::string{kRemedy};
}

}  // namespace

Identity make_identity(Randomness& randomness) {
  prepare_sodium();
  Identity identity;
  randomness.fill(identity.secret_key.bytes);
  identity.public_key = public_of(identity.secret_key);
  return identity;
}

std::string text_of(const PublicKey& key) {
  std::string text;
  append_hex(text, key);
  return text;
}

Result<PublicKey, Problem> parse_public_key(std::string_view text, const std::string& place) {
  PublicKey key{};
  if (parse_hex(trimmed(text), key)) return key;
  return Unexpected{Problem{place, "expected 64 hexadecimal digits"}};
}

std::string text_of(const KeyFile& keys) {
  std::string text = "# Keys of the ";
  text += keys.role == Role::kCar ? "car" : "base station";
  text += " for the radio. Whoever has this file can speak in its name: keep it secret.\nrole: ";
  text += name_of(keys.role);
  text += "\npublic: " + text_of(keys.own.public_key) + "\nsecret: ";
  append_hex(text, keys.own.secret_key.bytes);
  text += "\npeer: " + text_of(keys.peer) + "\n";
  return keys.bench ? text + "use: " + std::string{kBenchUse} + "\n" : text;
}

Result<KeyFile, Problem> parse_key_file(std::string_view text, const std::string& place,
                                        KeyUser user) {
  prepare_sodium();
  const auto lines = split(text, place);
  if (!lines) return Unexpected{lines.error()};
  const auto wrong = [&](Line line, std::string what) {
    return Unexpected{Problem{lines->place(place, line), std::move(what)}};
  };
  const std::string_view role = (*lines)[Line::kRole];
  if (role != kRoleNames[0] && role != kRoleNames[1])
    return wrong(Line::kRole, "role: car or base");
  const Role found = role == name_of(Role::kCar) ? Role::kCar : Role::kBase;
  if (found != user.role) return wrong(Line::kRole, wrong_role_text(found));
  const auto own = parse_public_key((*lines)[Line::kPublic], lines->place(place, Line::kPublic));
  if (!own) return Unexpected{own.error()};
  const auto peer = parse_public_key((*lines)[Line::kPeer], lines->place(place, Line::kPeer));
  if (!peer) return Unexpected{peer.error()};
  KeyFile keys{.role = found, .own = {}, .peer = *peer};
  keys.own.public_key = *own;
  if (!parse_hex((*lines)[Line::kSecret], keys.own.secret_key.bytes)) {
    return wrong(Line::kSecret, "expected 64 hexadecimal digits");
  }
  if (public_of(keys.own.secret_key) != keys.own.public_key) {
    return wrong(Line::kPublic, "does not belong to secret:");
  }
  if (auto problem = peer_problem(keys)) return wrong(Line::kPeer, *std::move(problem));
  const std::string_view use = (*lines)[Line::kUse];
  keys.bench = use == kBenchUse;
  if (!keys.bench && !use.empty()) return wrong(Line::kUse, "use: bench, or no such line");
  if (keys.bench && user.real_car) return wrong(Line::kUse, std::string{kBenchAtRealCar});
  return keys;
}

}  // namespace pitwall::telemetry
