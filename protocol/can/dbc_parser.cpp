// SPDX-License-Identifier: Apache-2.0
#include "protocol/can/dbc_parser.hpp"

#include <array>
#include <charconv>
#include <limits>
#include <optional>
#include <utility>

#include "protocol/can/parser/dbc_details.hpp"
#include "protocol/can/parser/dbc_draft.hpp"
#include "protocol/can/parser/dbc_encoding.hpp"
#include "protocol/can/parser/dbc_scanner.hpp"
#include "protocol/can/parser/dbc_statement.hpp"

namespace pitwall::can {
namespace {

constexpr std::string_view kIndependentName = "VECTOR__INDEPENDENT_SIG_MSG";
constexpr std::uint32_t kIndependentBit = 0x40000000;
constexpr std::size_t kMaxStops = kMaxFindings / 2;  // statements that cannot be read, of one file
constexpr std::size_t kMaxLongSignals = 8 * kMaxTransportBytes;  // as many as bits

// A message whose signals are being read. One with a problem only collects them.
struct OpenMessage {
  std::uint32_t key = 0;
  Message message;
  std::vector<DbcDraft::Mark> marks;
  std::optional<Problem> problem;
};

class Parser {
 public:
  Parser(std::string_view text, const std::string& name) : scan_(text, name), draft_(name) {}

  DbcDraft& draft() { return draft_; }
  std::string place_of(std::size_t offset) { return scan_.place_of(offset); }

  Database parse() {
    if (!scan_.is_utf8()) {
      draft_.find({FindingKind::kConverted, scan_.place_of(scan_.utf8_prefix()),
                   "the text is not UTF-8 from here on and is read as CP1252", "", ""});
    }
    while (!scan_.at_end() && stops_ < kMaxStops) {
      begin_ = scan_.here();
      try {
        section();
      } catch (const DbcScanner::Stop& stop) {
        stopped(stop.problem, "the text up to the next statement is left out");
      }
    }
    if (stops_ == kMaxStops) give_up();
    close();
    draft_.index();
    for (const auto& pass : details_) {
      for (const std::size_t begin : pass) {
        scan_.rewind(begin);
        read_detail(scan_, draft_);
      }
    }
    if (draft_.database.messages.empty() && !has_messages_) {
      draft_.find({FindingKind::kNoMessage, scan_.place_of(0), "the file has no message", "", ""});
    }
    return draft_.finish();
  }

 private:
  void section() {
    const std::string_view word = scan_.word();
    if (word == "SG_") return add_signal();
    const int pass = pass_of(word);
    if (pass >= 0) {
      close();
      (void)scan_.statement();
      return details_[static_cast<std::size_t>(pass)].push_back(begin_);
    }
    if (word == "BO_") return message();
    if (!is_section(word) || is_unused_section(word)) return keep(word);
    close();
    if (word == "VERSION") return static_cast<void>(draft_.database.version = scan_.string());
    if (word == "NS_") return new_symbols();
    if (word == "BS_") return bit_timing();
    if (word == "BU_") return nodes();
  }

  std::string place() { return scan_.place_of(begin_); }

  // What could not be read, as an error of the message that it stands in.
  void report(const Problem& problem, std::string outcome) {
    Finding f{FindingKind::kSyntax, problem.place, problem.what, std::move(outcome), ""};
    open_ ? draft_.flaw(open_->message, std::move(f)) : draft_.find(std::move(f));
  }

  void stopped(const Problem& problem, std::string outcome) {
    ++stops_;
    report(problem, std::move(outcome));
    scan_.recover(begin_);
  }

  void give_up() {
    draft_.find({FindingKind::kSyntax, scan_.place(),
                 std::to_string(kMaxStops) + " statements cannot be read",
                 "the file is not read from here on", ""});
  }

  // A section that nobody reads must at least not hide one that somebody would.
  void keep(std::string_view word) {
    const bool is_known = is_unused_section(word);
    if (is_known) close();
    scan_.rewind(begin_);
    std::string_view text = scan_.statement();
    const bool is_closed = text.ends_with(';');
    if (!is_closed && reads_like_message(text)) return misspelt_message(word);
    if (!is_closed) text = unclosed(word);
    draft_.database.unused.push_back({std::string{word}, scan_.utf8(text), place(), is_known});
    if (is_known || !is_closed) return;  // signals that follow may still belong to the message
    close();
    draft_.find({FindingKind::kUnknownSection, place(),
                 std::string{word} + " is no section of a DBC file; skipped", "",
                 std::string{word}});
  }

  Problem no_end(std::string_view word) {
    const char* const where = scan_.at_end() ? "" : " before the next section";
    return {place(), std::string{word} + " has no closing ';'" + where};
  }

  // The text up to the next section.
  std::string_view unclosed(std::string_view word) {
    scan_.recover(begin_);
    report(no_end(word), "it is kept as it is written");
    return scan_.since(begin_);
  }

  // Its signals are not those of the message before it.
  void misspelt_message(std::string_view word) {
    close();
    scan_.recover(begin_);
    open_.emplace();
    open_->problem = no_end(word);
    has_messages_ = true;
  }

  // The list has no end mark: its last word is the one that nothing but another word may follow.
  void new_symbols() {
    if (!scan_.take(':')) report({scan_.place(), "expected ':'"}, "it is read as if it were there");
    while (!scan_.at_end()) {
      const std::size_t begin = scan_.offset();
      (void)scan_.word();
      const char next = scan_.peek();
      const bool is_listed = next == '_' || (next >= 'A' && next <= 'Z') || next == '\0';
      if (!is_listed) return scan_.rewind(begin);
    }
  }

  void bit_timing() {
    scan_.expect(':');
    while (scan_.peek() >= '0' && scan_.peek() <= '9') {
      (void)scan_.integer(0, kAnyInteger);
      while (scan_.take(':') || scan_.take(',')) {
      }
    }
  }

  // Neither has this list; a new line that begins with a word like SECTION_ ends it.
  void nodes() {
    scan_.expect(':');
    while (!scan_.at_end()) {
      const std::size_t begin = scan_.here();
      const std::string_view word = scan_.word();
      if (is_section(word) || (scan_.begins_line(begin) && word.ends_with('_'))) {
        return scan_.rewind(begin);
      }
      draft_.database.nodes.push_back({scan_.utf8(word), "", {}});
      (void)scan_.take(',');
    }
  }

  void message() {
    close();
    open_.emplace();
    open_->message.place = place();
    has_messages_ = true;
    try {
      header(*open_);
    } catch (const DbcScanner::Stop& stop) {
      ++stops_;
      open_->problem = stop.problem;
      scan_.recover(begin_);
    }
  }

  void header(OpenMessage& o) {
    Message& m = o.message;
    o.key = static_cast<std::uint32_t>(scan_.integer(0, std::numeric_limits<std::uint32_t>::max()));
    m.extended = (o.key & kExtendedBit) != 0;
    m.id = o.key & ~kExtendedBit;
    m.name = scan_.utf8(scan_.word());
    scan_.expect(':');
    const std::size_t at_length = scan_.here();
    m.length = static_cast<std::uint16_t>(scan_.integer(0, kMaxDataBytes, kMaxTransportBytes));
    if (!m.is_on_frame()) {
      draft_.flaw(m, {FindingKind::kTooLong, scan_.place_of(at_length),
                      DbcScanner::expected(0, kMaxDataBytes),
                      "message " + m.name + " is kept, but no frame is decoded with it", m.name});
    }
    m.fd = m.length > 8 && m.is_on_frame();
    if (!scan_.next_word().empty() && !is_section(scan_.next_word())) {
      m.sender = scan_.utf8(scan_.word());
    } else if (scan_.next_word().empty() && !scan_.at_end() && !scan_.begins_line(scan_.here())) {
      (void)scan_.word();  // stops
    } else {
      m.sender = kNoNode;
      draft_.flaw(m, {FindingKind::kSyntax, scan_.place(), "message " + m.name + " has no sender",
                      "it is read as if it named " + m.sender, m.name});
    }
  }

  // The end of the message that is open.
  void close() {
    if (!open_) return;
    OpenMessage o = *std::move(open_);
    open_.reset();
    Message& m = o.message;
    const std::string its_signals = "its " + std::to_string(m.signals.size()) + " signals";
    if (o.problem) {
      if (!m.name.empty()) draft_.leave_out(o.key);
      return draft_.find({FindingKind::kSyntax, o.problem->place, o.problem->what,
                          (m.name.empty() ? "the message" : "message " + m.name) +
                              " is left out with " + its_signals,
                          m.name});
    }
    if (o.key == kIndependentSignals ||
        ((o.key & kIndependentBit) != 0 && m.name == kIndependentName)) {
      draft_.leave_out(o.key);
      return draft_.find({FindingKind::kIndependentSignals, m.place,
                          m.name + " is no message; " + its_signals + " are skipped", "", m.name});
    }
    if (m.id > (m.extended ? kMaxExtendedId : kMaxStandardId) && !is_kept_as_extended(o)) return;
    draft_.add(o.key, std::move(m), std::move(o.marks));
  }

  // An id that is too large. Many files leave out the mark of 29 bits.
  bool is_kept_as_extended(OpenMessage& o) {
    Message& m = o.message;
    const bool is_kept = m.id <= kMaxExtendedId;
    Finding f{FindingKind::kMessage, m.place,
              "id " + std::to_string(m.id) + " of message " + m.name + " is too large for " +
                  (m.extended ? "29 bits" : "11 bits"),
              is_kept ? "it is read as one of 29 bits"
                      : "the message is left out with its " + std::to_string(m.signals.size()) +
                            " signals",
              m.name};
    m.extended = true;
    if (!is_kept) draft_.leave_out(o.key);
    draft_.flaw(m, std::move(f));
    return is_kept;
  }

  void add_signal() {
    if (!open_) refuse_at(place(), "a signal outside a message");
    if (!open_->message.is_on_frame() && open_->message.signals.size() >= kMaxLongSignals) {
      refuse_at(place(), "expected at most " + std::to_string(kMaxLongSignals) +
                             " signals in a message longer than a frame");
    }
    Signal s;
    DbcDraft::Mark mark;
    try {
      signal(s, mark);
    } catch (const DbcScanner::Stop& stop) {
      draft_.leave_out(open_->key, s.name);
      return stopped(stop.problem, "signal " + s.name + " is left out");
    }
    open_->message.signals.push_back(std::move(s));
    open_->marks.push_back(std::move(mark));
  }

  void signal(Signal& s, DbcDraft::Mark& mark) {
    s.place = scan_.place();
    s.name = scan_.utf8(scan_.word());
    if (scan_.peek() != ':') mark = multiplex_mark();
    scan_.expect(':');
    layout(s);
    s.unit = scan_.string();
    receivers(s);
  }

  void layout(Signal& s) {
    SignalLayout& l = s.layout;
    const auto last_bit = static_cast<std::int64_t>(8U * open_->message.length) - 1;
    l.start = static_cast<std::uint16_t>(scan_.integer(0, 8 * kMaxDataBytes - 1, last_bit));
    scan_.expect('|');
    l.length = static_cast<std::uint8_t>(scan_.integer(1, 64));
    scan_.expect('@');
    l.order = scan_.integer(0, 1) == 1 ? ByteOrder::kIntel : ByteOrder::kMotorola;
    if (scan_.take('-')) {
      l.number = Number::kSigned;
    } else {
      scan_.expect('+');
    }
    scan_.expect('(');
    const std::size_t at = scan_.here();
    l.scale = scan_.real();
    if (l.scale == 0.0) refuse_at(scan_.place_of(at), "signal " + s.name + " has the scale 0");
    scan_.expect(',');
    l.offset = scan_.real();
    scan_.expect(')');
    scan_.expect('[');
    l.min = scan_.real();
    scan_.expect('|');
    l.max = scan_.real();
    scan_.expect(']');
  }

  // Some editors write none at all, not even Vector__XXX.
  void receivers(Signal& s) {
    do {
      const std::string_view word = scan_.next_word();
      if (word.empty() || is_section(word)) return;
      (void)scan_.word();
      if (word != kNoNode) s.receivers.push_back(scan_.utf8(word));
    } while (scan_.take(',') || !scan_.begins_line(scan_.here()));
  }

  DbcDraft::Mark multiplex_mark() {
    const std::size_t begin = scan_.here();
    std::string_view word = scan_.word();
    DbcDraft::Mark mark;
    if (word.ends_with('M')) {
      mark.is_selector = true;
      word.remove_suffix(1);
    }
    if (word.empty() && mark.is_selector) return mark;
    std::uint64_t value = 0;
    const char* const end = word.data() + word.size();
    if (!word.starts_with('m') || word.size() < 2 ||
        std::from_chars(word.data() + 1, end, value).ptr != end) {
      refuse_at(scan_.place_of(begin), "expected ':' or a multiplexer mark such as M, m3 or m3M");
    }
    mark.value = value;
    return mark;
  }

  DbcScanner scan_;
  DbcDraft draft_;
  std::size_t begin_ = 0;  // of the section being read
  std::optional<OpenMessage> open_;
  bool has_messages_ = false;
  std::size_t stops_ = 0;
  std::array<std::vector<std::size_t>, kPasses> details_;
};

// What UTF-16 lost on the way.
void report_conversion(Parser& parser, const Utf16Text& from, const std::string& name) {
  parser.draft().find({FindingKind::kConverted, name + ":1:1",
                       std::string{"the text is UTF-16 ("} +
                           (from.is_little_endian ? "little" : "big") + "-endian)",
                       "", ""});
  if (from.broken == 0) return;
  parser.draft().find(
      {FindingKind::kEncoding, parser.place_of(from.first_broken_at),
       std::to_string(from.broken) + " characters are no UTF-16, the first of them here",
       "each is read as U+FFFD", ""});
}

}  // namespace

Result<Database, Problem> parse_dbc_leniently(std::string_view text, const std::string& name) {
  if (text.size() > kMaxDbcBytes) return refuse(name, "file is too large");
  const auto converted = from_utf16(text);
  if (converted) text = converted->utf8;
  if (const std::string_view kind = kind_of_file(text); !kind.empty()) {
    return refuse(name + ":1:1", "expected a CAN database (DBC), this is " + std::string{kind});
  }
  Parser parser{text, name};
  if (converted) report_conversion(parser, *converted, name);
  return parser.parse();
}

Result<Database, Problem> parse_dbc(std::string_view text, const std::string& name) {
  auto database = parse_dbc_leniently(text, name);
  if (!database) return database;
  if (auto refusal = refusal_of(*database)) return Unexpected{*std::move(refusal)};
  return database;
}

}  // namespace pitwall::can
