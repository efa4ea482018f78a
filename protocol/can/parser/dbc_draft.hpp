// Draft of a database during parsing: the content of the sections, not yet combined.
//   in      messages in the order of the file, then the items that refer to them by number and name
//   out     finish(): the Database, with resolved selectors, long names and plans; everything
//           inconsistent is left out or marked
//   errors  findings of the database
//   cost    n log n in the size of the file, whatever is in it
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "protocol/can/database.hpp"
#include "protocol/can/parser/dbc_scanner.hpp"

namespace pitwall::can {

inline constexpr std::uint32_t kExtendedBit = 0x80000000;
inline constexpr std::string_view kNoNode = "Vector__XXX";  // placeholder: no receiver
// VECTOR__INDEPENDENT_SIG_MSG: editors keep signals there that belong to no message.
inline constexpr std::uint32_t kIndependentSignals = 0xC0000000;

// Throws, which ends the parsing of this statement.
[[noreturn]] void refuse_at(const std::string& place, const std::string& what);

class DbcDraft {
 public:
  // Multiplexing mark of a signal: plain, M, m3 or m3M; and its entry in SG_MUL_VAL_.
  struct Mark {
    bool is_selector = false;
    std::optional<std::uint64_t> value;
    std::optional<std::size_t> selector;
    std::vector<SelectorRange> ranges;
  };
  struct Found {
    std::size_t message = 0, signal = 0;
  };

  explicit DbcDraft(const std::string& name) { database.name = name; }

  // A second message with the same id is left out, one with the same name is marked.
  void add(std::uint32_t key, Message message, std::vector<Mark> marks);
  // References to this number are not reported: its message was left out with a finding.
  void leave_out(std::uint32_t key) { left_out_.insert(key); }
  void leave_out(std::uint32_t key, const std::string& signal) {
    left_out_signals_.insert({key, signal});
  }
  bool is_left_out(std::uint32_t key, const std::string& signal) const {
    return left_out_.contains(key) || left_out_signals_.contains({key, signal});
  }
  // Call after the last message and before any lookup.
  void index();

  std::optional<std::size_t> message(std::uint32_t key) const;
  std::optional<Found> signal(std::uint32_t key, std::string_view name) const;
  std::optional<std::size_t> signal(std::size_t message, std::string_view name) const;
  std::optional<std::size_t> node(std::string_view name) const;
  const ValueTable* table(std::string_view name) const;
  // All definitions of that name, one per kind of owner.
  std::vector<AttributeDefinition*> definitions(std::string_view name);
  const AttributeDefinition* definition(AttributeOwner owner, std::string_view name);

  // False if it replaces one of the same name.
  bool add(ValueTable table);
  bool add(AttributeDefinition definition);

  void find(Finding finding);
  // Adds an error of this message, also to its list of flaws.
  void flaw(Message& message, Finding finding);
  void set_long_name(std::uint32_t key, std::string name);
  void set_long_name(Found found, std::string name);
  Database finish();

  Database database;
  std::vector<std::vector<Mark>> marks;  // of each message, by signal

 private:
  void lengthen_names();
  void mark_equal_names();
  void apply_attributes(Message& m, std::optional<std::string_view> usual_format,
                        std::optional<std::string_view> usual_period);
  void add_remarks(const Message& m);

  std::map<std::uint32_t, std::size_t> by_key_;
  std::map<std::pair<bool, std::uint32_t>, std::size_t> ids_;
  std::set<std::uint32_t> left_out_;                                  // messages
  std::set<std::pair<std::uint32_t, std::string>> left_out_signals_;  // their signals
  std::array<std::size_t, kFindingKinds> found_{};                    // of each kind
  std::vector<std::vector<std::uint32_t>> by_name_;  // signals of each message, sorted
  std::map<std::string, std::size_t, std::less<>> nodes_, tables_;
  std::map<std::string, std::vector<std::size_t>, std::less<>> definitions_;  // by name
  struct LongName {
    std::size_t message = 0;
    std::optional<std::size_t> signal;  // empty: the message itself
    std::string name;
  };
  std::vector<LongName> long_names_;
};

}  // namespace pitwall::can
