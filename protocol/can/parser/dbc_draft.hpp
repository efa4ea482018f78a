// A database while its file is being read: what the sections say, not yet put together.
//   in      messages in the order of the file, then what refers to them by number and name
//   out     finish(): the Database; selectors resolved, long names in place, plans made, everything
//           that contradicts itself left out or marked
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
inline constexpr std::string_view kNobody = "Vector__XXX";  // the receiver of what nobody receives
// VECTOR__INDEPENDENT_SIG_MSG: where editors park signals that belong to no message.
inline constexpr std::uint32_t kIndependentSignals = 0xC0000000;

// Ends the reading of one statement.
[[noreturn]] void refuse_at(const std::string& place, const std::string& what);

class DbcDraft {
 public:
  // How a signal was marked: plain, M, m3 or m3M; and what SG_MUL_VAL_ says of it.
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
  // What refers to this number is no mistake of its own: its message was left out and told.
  void leave_out(std::uint32_t key) { left_out_.insert(key); }
  void leave_out(std::uint32_t key, const std::string& signal) { lost_.insert({key, signal}); }
  bool is_left_out(std::uint32_t key, const std::string& signal) const {
    return left_out_.contains(key) || lost_.contains({key, signal});
  }
  // After the last message; before anything is looked up.
  void index();

  std::optional<std::size_t> message(std::uint32_t key) const;
  std::optional<Found> signal(std::uint32_t key, std::string_view name) const;
  std::optional<std::size_t> signal(std::size_t message, std::string_view name) const;
  std::optional<std::size_t> node(std::string_view name) const;
  const ValueTable* table(std::string_view name) const;
  // Of that name, for every kind of owner that it is defined for.
  std::vector<AttributeDefinition*> definitions(std::string_view name);
  const AttributeDefinition* definition(AttributeOwner owner, std::string_view name);

  // False where it replaces one of the same name.
  bool add(ValueTable table);
  bool add(AttributeDefinition definition);

  void find(Finding finding);
  // An error of this message, for its table too.
  void flaw(Message& message, Finding finding);
  void lengthen(std::uint32_t key, std::string name);
  void lengthen(Found found, std::string name);
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
  std::set<std::uint32_t> left_out_;                      // messages
  std::set<std::pair<std::uint32_t, std::string>> lost_;  // their signals
  std::array<std::size_t, kFindingKinds> found_{};        // of each kind
  std::vector<std::vector<std::uint32_t>> by_name_;       // signals of each message, sorted
  std::map<std::string, std::size_t, std::less<>> nodes_, tables_;
  std::map<std::string, std::vector<std::size_t>, std::less<>> definitions_;  // by name
  struct LongName {
    std::size_t message = 0;
    std::optional<std::size_t> signal;  // none: the message itself
    std::string name;
  };
  std::vector<LongName> long_names_;
};

}  // namespace pitwall::can
