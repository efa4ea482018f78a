// CAN database as a value: its messages, and for each signal the plan of its encoding.
//   in      filled by the DBC parser
//   out     messages sorted by (standard before extended, id); lookups by id and by name; other
//           content of the file: nodes, attributes, names of values, and sections without use
//   units   physical values in the units that the file states
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "protocol/can/finding.hpp"
#include "protocol/can/signal.hpp"
#include "protocol/vocabulary/result.hpp"
#include "protocol/vocabulary/time.hpp"

namespace pitwall::can {

inline constexpr std::size_t kMaxTransportBytes = 1785;  // SAE J1939-21: 255 packets of 7 bytes

struct ValueName {
  std::int64_t value = 0;
  std::string name;
  bool operator==(const ValueName&) const = default;
};

// Both ends are included.
struct SelectorRange {
  std::uint64_t low = 0, high = 0;
  bool operator==(const SelectorRange&) const = default;
};

// The value as text; for an ENUM the name of the choice.
struct Attribute {
  std::string name, value;
};

struct Signal {
  std::string name, unit, comment;
  SignalLayout layout;
  SignalPlan plan;
  std::vector<ValueName> values;
  std::vector<std::string> receivers;  // without the placeholder Vector__XXX
  std::vector<Attribute> attributes;
  // Multiplexing: present only if the selector's raw value is in one of the ranges.
  bool is_selector = false;
  std::optional<std::size_t> selector;  // index in the message; empty: always present
  std::vector<SelectorRange> when;
  std::uint8_t depth = 0;  // number of selectors above it
  std::string place;       // "file:line:column" of its definition
  bool is_flawed = false;  // lenient parsing found an error in it
};

struct Message {
  std::uint32_t id = 0;
  bool extended = false;
  bool fd = false;
  std::uint16_t length = 0;  // more than kMaxDataBytes only after lenient parsing
  std::string name, sender, comment;
  std::vector<std::string> other_senders;  // BO_TX_BU_
  Duration period{};                       // of the attribute GenMsgCycleTime; zero: not given
  std::vector<Signal> signals;
  std::vector<Attribute> attributes;
  std::string place;
  std::uint8_t deepest = 0;    // the largest depth of its signals; zero: not multiplexed
  std::vector<Problem> flaws;  // errors of the message and of its signals, with those left out

  // False if longer than any frame, as in J1939 transport. Such a message is never decoded.
  bool is_on_frame() const { return length <= kMaxDataBytes; }
  const Signal* find(std::string_view signal_name) const;
  std::optional<std::size_t> index_of(std::string_view signal_name) const;
};

struct Node {
  std::string name, comment;
  std::vector<Attribute> attributes;
};

struct ValueTable {
  std::string name;
  std::vector<ValueName> values;
};

enum class AttributeOwner : std::uint8_t { kNetwork, kNode, kMessage, kSignal, kEnvironment };

struct AttributeDefinition {
  std::string name;
  AttributeOwner owner = AttributeOwner::kNetwork;
  std::string kind;                       // INT, HEX, FLOAT, STRING or ENUM
  double min = 0.0, max = 0.0;            // of numbers; min >= max: no range
  std::vector<std::string> choices;       // of an ENUM
  std::optional<std::string> by_default;  // value of every owner without its own
};

// Section that has no effect here, kept as written.
struct Section {
  std::string word, text, place;
  bool is_known = false;  // true: part of the DBC format, but not used by this program
};

struct Database {
  std::string name, version, comment;
  std::vector<Message> messages;
  std::vector<Node> nodes;
  std::vector<ValueTable> tables;
  std::vector<AttributeDefinition> definitions;
  std::vector<Attribute> attributes;  // of the network
  std::vector<Section> unused;
  std::vector<Finding> findings;  // in the order of the file; errors only after lenient parsing
  std::array<std::size_t, kFindingSeverities> findings_left_off{};  // beyond kMaxFindings

  // Includes the findings that were left off.
  std::size_t count(FindingSeverity severity) const;
  const Message* find(std::uint32_t id, bool extended = false) const;
  const Message* find(std::string_view message_name) const;
  // The value in `own` (attributes of an owner of that kind), else the default of the definition.
  std::optional<std::string_view> attribute(std::string_view attribute_name, AttributeOwner owner,
                                            std::span<const Attribute> own) const;
};

// Index for the lookup of every frame of a busy bus: a table of the 2048 standard ids, a hash table
// of the extended ones. It points into the database, which must outlive it unchanged.
class MessageIndex {
 public:
  explicit MessageIndex(const Database& database);
  const Message* find(std::uint32_t id, bool extended = false) const;

 private:
  struct Slot {
    std::uint32_t id = 0;
    const Message* message = nullptr;  // null: empty slot
  };
  std::vector<const Message*> standard_;
  std::vector<Slot> extended_;  // open addressing, a power of two, at most half full
};

// Number of selectors that decide on this signal; nullopt if they form a cycle or are too many.
inline constexpr std::uint8_t kMaxSelectors = 64;
std::optional<std::uint8_t> selectors_above(const Message& message, const Signal& signal);

// FNV-1a 64 of everything that defines the meaning of the bits (not comments, units, names of
// values), so that two programs can check that they use the same revision.
std::uint64_t fingerprint(const Database& database);

// The most severe kind first, each kind in the order of the file.
std::vector<const Finding*> worst_first(const Database& database);

// Why a database must not drive a car: the worst error, and the number of further ones. Empty if it
// has no error.
std::optional<Problem> refusal_of(const Database& database);

}  // namespace pitwall::can
