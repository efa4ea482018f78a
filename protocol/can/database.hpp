// The messages of one CAN database as a value, each signal with its plan.
//   in      filled by the DBC parser
//   out     messages sorted by (standard before extended, id); lookups by id and by name; what the
//           file says beside that: nodes, attributes, names of values, and what nobody understood
//   units   physical values in the units that the file names
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "protocol/can/signal.hpp"
#include "protocol/vocabulary/result.hpp"
#include "protocol/vocabulary/time.hpp"

namespace pitwall::can {

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
};

struct Message {
  std::uint32_t id = 0;
  bool extended = false;
  bool fd = false;
  std::uint8_t length = 0;
  std::string name, sender, comment;
  std::vector<std::string> other_senders;  // BO_TX_BU_
  Duration period{};                       // of the attribute GenMsgCycleTime; zero: not given
  std::vector<Signal> signals;
  std::vector<Attribute> attributes;
  std::string place;
  std::uint8_t deepest = 0;  // the largest depth of its signals; zero: nothing is multiplexed

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

// What is not wrong enough to refuse the file. A note is only worth knowing.
struct Remark {
  bool is_warning = true;
  std::string place, what;
};
inline constexpr std::size_t kMaxRemarks = 10'000;

struct Database {
  std::string name, version, comment;
  std::vector<Message> messages;
  std::vector<Node> nodes;
  std::vector<ValueTable> tables;
  std::vector<AttributeDefinition> definitions;
  std::vector<Attribute> attributes;  // of the network
  std::vector<Section> unused;
  std::vector<Remark> remarks;       // in the order of the file
  std::size_t remarks_left_off = 0;  // beyond kMaxRemarks

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

// The first contradiction in a message: signals outside it, equal names, bits claimed twice by
// signals that can be present together. Sorts nothing, resolves nothing; n log n in the signals.
std::optional<Problem> contradiction(const Message& message);

}  // namespace pitwall::can
