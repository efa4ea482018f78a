// The messages of one CAN database as a value, each signal with its plan.
//   in      filled by the DBC parser
//   out     messages sorted by (standard before extended, id); lookups by id and by name; what the
//           file says beside that: nodes, attributes, names of values, and what nobody understood
//   units   physical values in the units that the file names
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

// Both ends included.
struct SelectorRange {
  std::uint64_t low = 0, high = 0;
  bool operator==(const SelectorRange&) const = default;
};

// The value as text; of an ENUM its word.
struct Attribute {
  std::string name, value;
};

struct Signal {
  std::string name, unit, comment;
  SignalLayout layout;
  SignalPlan plan;
  std::vector<ValueName> values;
  std::vector<std::string> receivers;  // without the place holder Vector__XXX
  std::vector<Attribute> attributes;
  // Multiplexing: present only while the selector's raw value is in one of the ranges.
  bool is_selector = false;
  std::optional<std::size_t> selector;  // index in the message; absent: always present
  std::vector<SelectorRange> when;
  std::uint8_t depth = 0;  // selectors above it
  std::string place;       // "file:line:column" of its definition
  bool is_flawed = false;  // an error of a lenient reading is about it
};

struct Message {
  std::uint32_t id = 0;
  bool extended = false;
  bool fd = false;
  std::uint16_t length = 0;  // more than kMaxDataBytes only where a lenient reading kept it
  std::string name, sender, comment;
  std::vector<std::string> other_senders;  // BO_TX_BU_
  Duration period{};                       // of the attribute GenMsgCycleTime; zero: not given
  std::vector<Signal> signals;
  std::vector<Attribute> attributes;
  std::string place;
  std::uint8_t deepest = 0;    // the largest depth of its signals; zero: nothing is multiplexed
  std::vector<Problem> flaws;  // errors of it and of its signals, those left out among them

  // False: longer than any frame, as J1939 transports them. Such a message is never decoded.
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
  std::optional<std::string> by_default;  // of everything that does not say otherwise
};

// A section that decides nothing here, kept as it is written.
struct Section {
  std::string word, text, place;
  bool is_known = false;  // the format knows it, this program has no use for it
};

struct Database {
  std::string name, version, comment;
  std::vector<Message> messages;
  std::vector<Node> nodes;
  std::vector<ValueTable> tables;
  std::vector<AttributeDefinition> definitions;
  std::vector<Attribute> attributes;  // of the network
  std::vector<Section> unused;
  std::vector<Finding> findings;  // in the order of the file; errors only of a lenient reading
  std::array<std::size_t, kFindingSeverities> findings_left_off{};  // beyond kMaxFindings

  // With those that were left off.
  std::size_t count(FindingSeverity severity) const;
  const Message* find(std::uint32_t id, bool extended = false) const;
  const Message* find(std::string_view message_name) const;
  // What `own` (of that kind of owner) says, else the default of the definition.
  std::optional<std::string_view> attribute(std::string_view attribute_name, AttributeOwner owner,
                                            std::span<const Attribute> own) const;
};

// For every frame of a busy bus: a table of the 2048 standard ids, a hash of the extended ones.
// Points into the database, which must outlive it unchanged.
class MessageIndex {
 public:
  explicit MessageIndex(const Database& database);
  const Message* find(std::uint32_t id, bool extended = false) const;

 private:
  struct Slot {
    std::uint32_t id = 0;
    const Message* message = nullptr;  // none: empty
  };
  std::vector<const Message*> standard_;
  std::vector<Slot> extended_;  // open addressing, a power of two, at most half full
};

// How many selectors decide on this signal; nothing where they form a circle or are too many.
inline constexpr std::uint8_t kMaxSelectors = 64;
std::optional<std::uint8_t> selectors_above(const Message& message, const Signal& signal);

// FNV-1a 64 of everything that decides what bits mean (not comments, units, names of values), so
// that two programs can tell whether they speak the same revision.
std::uint64_t fingerprint(const Database& database);

// The errors first, each kind in the order of the file.
std::vector<const Finding*> worst_first(const Database& database);

// Why a database must not drive a car: the worst error and how many more there are. Nothing where
// it has none.
std::optional<Problem> refusal_of(const Database& database);

}  // namespace pitwall::can
