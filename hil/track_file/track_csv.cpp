// SPDX-License-Identifier: Apache-2.0
#include "hil/track_file/track_csv.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <optional>

#include "protocol/vocabulary/text.hpp"

namespace pitwall::track_file {
namespace {

constexpr double kSamePlace_m = 1e-3;
constexpr double kFarthest_m = 100'000.0;  // what a track file may say
constexpr double kWidest_m = 200.0;
constexpr double kSteepest_rad = from_deg(45.0);

struct Column {
  std::string_view name;
  double CsvRow::*into;  // null: read over
  double factor = 1.0;
};

constexpr std::array kColumns{
    Column{"x_m", &CsvRow::x_m},
    Column{"x_ref_m", &CsvRow::x_m},
    Column{"y_m", &CsvRow::y_m},
    Column{"y_ref_m", &CsvRow::y_m},
    Column{"s_m", &CsvRow::s_m},
    Column{"s_ref_m", &CsvRow::s_m},
    Column{"curvature_per_m", &CsvRow::curvature_per_m},
    Column{"kappa_ref_radpm", &CsvRow::curvature_per_m},
    Column{"width_right_m", &CsvRow::width_right_m},
    Column{"w_tr_right_m", &CsvRow::width_right_m},
    Column{"width_left_m", &CsvRow::width_left_m},
    Column{"w_tr_left_m", &CsvRow::width_left_m},
    Column{"bank_deg", &CsvRow::bank_rad, from_deg(1.0)},
    Column{"bank_rad", &CsvRow::bank_rad},
    Column{"banking_rad", &CsvRow::bank_rad, -1.0},
    Column{"z_m", &CsvRow::height_m},
    Column{"height_m", &CsvRow::height_m},
    Column{"x_normvec_m", nullptr},
    Column{"y_normvec_m", nullptr},
    Column{"alpha_m", nullptr},
    Column{"s_racetraj_m", nullptr},
    Column{"psi_racetraj_rad", nullptr},
    Column{"kappa_racetraj_radpm", nullptr},
    Column{"vx_racetraj_mps", nullptr},
    Column{"ax_racetraj_mps2", nullptr},
    Column{"psi_ref_rad", nullptr},
    Column{"dkappa_ref_radpm2", nullptr},
};

using Header = std::vector<const Column*>;

std::vector<std::string_view> fields_of(std::string_view line, char separator) {
  std::vector<std::string_view> fields;
  for (;;) {
    const std::size_t end = line.find(separator);
    fields.push_back(trimmed(line.substr(0, end)));
    if (end == std::string_view::npos) return fields;
    line.remove_prefix(end + 1);
  }
}

const Column* column_of(std::string_view name) {
  const auto* found = std::ranges::find(kColumns, name, &Column::name);
  return found == kColumns.end() ? nullptr : found;
}

std::optional<double> number_of(std::string_view field) {
  double value = 0.0;
  if (field.starts_with('+')) field.remove_prefix(1);
  const char* const end = field.data() + field.size();
  const auto [stop, error] = std::from_chars(field.data(), end, value);
  if (error != std::errc{} || stop != end || !std::isfinite(value)) return std::nullopt;
  return value;
}

class Reader {
 public:
  explicit Reader(const std::string& name) { csv_.name = name; }

  Result<TrackCsv, Problem> read(std::string_view text) {
    if (text.size() > kMaxCsvBytes) return refuse(1, "expected at most 8 MB");
    for (std::size_t line = 1; !text.empty(); ++line) {
      const std::size_t end = text.find('\n');
      if (auto problem = take(trimmed(text.substr(0, end)), line)) return Unexpected{*problem};
      text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
    }
    if (header_.empty())
      return refuse(1,
                    "no header: a line of column names such as x_m,y_m,w_tr_right_m,w_tr_left_m");
    if (csv_.rows.size() < kRowsMin)
      return refuse(last_line_, std::to_string(csv_.rows.size()) +
                                    " points: a track has at least " + std::to_string(kRowsMin));
    return std::move(csv_);
  }

 private:
  Unexpected<Problem> refuse(std::size_t line, const std::string& what) const {
    return Unexpected{problem(line, what)};
  }
  Problem problem(std::size_t line, const std::string& what) const {
    return {csv_.name + ":" + std::to_string(line), what};
  }

  std::optional<Problem> take(std::string_view line, std::size_t number) {
    if (line.empty()) return std::nullopt;
    last_line_ = number;
    const bool comment = line.starts_with('#');
    if (comment) line = trimmed(line.substr(1));
    if (!header_.empty()) return comment ? std::nullopt : take_row(line, number);
    const char separator = line.find(';') == std::string_view::npos ? ',' : ';';
    const auto names = fields_of(line, separator);
    // A comment is the header only where it speaks of columns.
    if (comment && std::ranges::none_of(names, [](auto name) { return column_of(name); }))
      return std::nullopt;
    separator_ = separator;
    return take_header(names, number);
  }

  std::optional<Problem> take_header(const std::vector<std::string_view>& names,
                                     std::size_t number) {
    for (const std::string_view name : names) {
      const Column* column = column_of(name);
      if (column == nullptr) {
        const bool is_value = number_of(name).has_value();
        return problem(number, is_value
                                   ? "numbers before a header: a line of column names comes first"
                                   : "unknown column \"" + std::string(name.substr(0, 40)) + "\"");
      }
      for (const Column* other : header_)
        if (other == column || (column->into != nullptr && other->into == column->into))
          return problem(number, "column \"" + std::string(name) + "\" has the same meaning as \"" +
                                     std::string(other->name) + "\"");
      header_.push_back(column);
    }
    return missing(number);
  }

  bool has(double CsvRow::*what) const {
    return std::ranges::any_of(header_, [what](const Column* c) { return c->into == what; });
  }

  std::optional<Problem> missing(std::size_t number) {
    csv_.has_place = has(&CsvRow::x_m) && has(&CsvRow::y_m);
    csv_.has_bank = has(&CsvRow::bank_rad);
    csv_.has_height = has(&CsvRow::height_m);
    if (!csv_.has_place && !(has(&CsvRow::s_m) && has(&CsvRow::curvature_per_m)))
      return problem(number, "no line: columns x_m and y_m, or s_m and curvature_per_m are needed");
    if (!has(&CsvRow::width_right_m) || !has(&CsvRow::width_left_m))
      return problem(number, "no walls: columns width_right_m and width_left_m are needed");
    return std::nullopt;
  }

  std::optional<Problem> take_row(std::string_view line, std::size_t number) {
    if (csv_.rows.size() == kRowsMax)
      return problem(number, "more than " + std::to_string(kRowsMax) + " points");
    const auto fields = fields_of(line, separator_);
    if (fields.size() != header_.size())
      return problem(number, std::to_string(fields.size()) + " fields, the header has " +
                                 std::to_string(header_.size()));
    CsvRow row{.line = number};
    for (std::size_t i = 0; i < fields.size(); ++i) {
      const auto value = number_of(fields[i]);
      if (!value)
        return problem(number, std::string(header_[i]->name) + ": \"" +
                                   std::string(fields[i].substr(0, 40)) +
                                   "\" is not a finite number");
      if (header_[i]->into != nullptr) row.*header_[i]->into = *value * header_[i]->factor;
    }
    if (auto fault = fault_of(row)) return problem(number, *fault);
    csv_.rows.push_back(row);
    return std::nullopt;
  }

  std::optional<std::string> fault_of(const CsvRow& row) const {
    for (const double width_m : {row.width_right_m, row.width_left_m}) {
      if (width_m <= 0.0) return "a width is not positive";
      if (width_m > kWidest_m) return "a width beyond 200 m";
    }
    if (std::abs(row.bank_rad) > kSteepest_rad) return "banking beyond 45 degrees";
    if (std::abs(row.x_m) > kFarthest_m || std::abs(row.y_m) > kFarthest_m)
      return "farther than 100 km from the origin: subtract the place of the datum";
    if (csv_.rows.empty()) return std::nullopt;
    const CsvRow& before = csv_.rows.back();
    if (row.s_m <= before.s_m)
      return "the station does not increase from line " + std::to_string(before.line);
    if (std::hypot(row.x_m - before.x_m, row.y_m - before.y_m) < kSamePlace_m)
      return "the same place as line " + std::to_string(before.line);
    return std::nullopt;
  }

  TrackCsv csv_;
  Header header_;
  char separator_ = ',';
  std::size_t last_line_ = 1;
};

}  // namespace

Result<TrackCsv, Problem> read_track_csv(std::string_view text, const std::string& name) {
  return Reader{name}.read(text);
}

std::string place_of(const TrackCsv& csv, std::size_t row) {
  return csv.name + ":" + std::to_string(csv.rows[row].line);
}

}  // namespace pitwall::track_file
