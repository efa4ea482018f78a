// SPDX-License-Identifier: Apache-2.0
#include "hil/nodes/can_variant.hpp"

#include <algorithm>
#include <array>
#include <string>
#include <string_view>
#include <utility>

#include "hil/nodes/database_texts.hpp"
#include "protocol/can/av24.hpp"
#include "protocol/can/dbc_parser.hpp"
#include "protocol/can/decode.hpp"
#include "protocol/can/encode.hpp"

namespace pitwall::can_variant {

// How the values of one message become those of another.
struct Translation {
  const can::Message* from = nullptr;
  const can::Message* to = nullptr;
  std::vector<std::optional<std::size_t>> sources;  // by signal of `to`; absent: not in `from`
  std::vector<double> otherwise;                    // value of a signal without a source
};

struct Periodic {
  const can::Message* message = nullptr;
  Duration period{};
  std::vector<double> values;
};

struct MessageTranslation {
  bool same = false;  // nothing to translate
  can::Database model, bus;
  std::vector<Translation> transmitted, received;
  std::vector<Periodic> own;
};

namespace {

using scenario::BusRevision;

struct Route {
  const char *model, *bus;  // messages
};
struct Alias {
  const char *model, *bus;  // signals
};
struct VariantNames {
  const char* text;                        // what differs from av21.dbc, or the whole
  bool whole = false;                      // a database of its own
  std::vector<std::string_view> absent{};  // messages of av21 that it lacks
  std::vector<Route> routes{};             // where the names of messages do not say it
  std::vector<Alias> aliases{};
};

VariantNames names_of(BusRevision which) {
  switch (which) {
    case BusRevision::kV14:
    case BusRevision::kProtected:
      break;
    case BusRevision::kV9:
      return {.text = kV9Text,
              .absent = {"marelli_report_1", "marelli_report_2", "ct_report_2", "dash_switches_cmd",
                         "ct_vehicle_acc_feedback"}};
    case BusRevision::kV12:
      return {.text = kV12Text,
              .absent = {"ct_report_2"},
              .routes = {{"marelli_report_1", "marelli_report_1"},
                         {"marelli_report_1", "marelli_report_2"},
                         {"marelli_report_2", "marelli_report_3"}},
              .aliases = {{"marelli_track_flag", "Marelli_Track_Flag"},
                          {"marelli_vehicle_flag", "Marelli_Vehicle_Flag"},
                          {"marelli_sector_flag", "Marelli_Sector_Flag"},
                          {"marelli_rc_base_sync_check", "lte_sync_ok"},
                          {"marelli_rc_lte_rssi", "lte_modem_lte_rssi"},
                          {"marelli_gps_lat", "GPS_Lat"},
                          {"marelli_gps_long", "GPS_Lon"}}};
    case BusRevision::kAv24:
      return {.text = kAv24Text,
              .whole = true,
              .aliases = {{"steering_motor_ang_1_fdbk", "primary_steering_angle_fbk"},
                          {"steering_motor_ang_2_fdbk", "secondary_steering_ang_fdbk"},
                          {"steering_motor_ang_3_fdbk", "average_steering_ang_fdbk"},
                          {"brake_pressure_cmd", "F_brake_pressure_cmd"}}};
  }
  return {.text = kAv21Text, .whole = true};
}

// Of signals that the bench does not model, where a car at rest does not say zero.
constexpr std::array<std::pair<std::string_view, double>, 4> kAtRest{
    {{"sbw_ecu_voltage", 13.5},
     {"sbw_ecu_temp", 40.0},
     {"intake_manifold_press_kPa", 101.3},
     {"intake_air_temp_degC", 25.0}}};

double at_rest(const can::Signal& signal) {
  for (const auto& [name, value] : kAtRest)
    if (name == signal.name) return value;
  const can::SignalLayout& l = signal.layout;
  return l.min < l.max ? std::clamp(0.0, l.min, l.max) : 0.0;
}

can::Database overlaid(const can::Database& base, can::Database over,
                       const std::vector<std::string_view>& absent) {
  for (const can::Message& message : base.messages) {
    const bool lacks = std::ranges::find(absent, message.name) != absent.end();
    if (!lacks && over.find(message.name) == nullptr) over.messages.push_back(message);
  }
  std::ranges::sort(over.messages, {}, &can::Message::id);
  return over;
}

Translation translation(const can::Message& from, const can::Message& to,
                        const std::vector<Alias>& aliases) {
  Translation out{.from = &from, .to = &to, .sources = {}, .otherwise = {}};
  for (const can::Signal& signal : to.signals) {
    auto source = from.index_of(signal.name);
    for (const Alias& alias : aliases) {
      if (signal.name == alias.bus && !source) source = from.index_of(alias.model);
      if (signal.name == alias.model && !source) source = from.index_of(alias.bus);
    }
    out.sources.push_back(source);
    out.otherwise.push_back(at_rest(signal));
  }
  return out;
}

bool is_complete(const Translation& t) {
  return std::ranges::all_of(t.sources, [](const auto& source) { return source.has_value(); });
}

void add_transmitted(MessageTranslation& tables, const VariantNames& names) {
  const auto add = [&](const can::Message* from, const can::Message* to) {
    if (from != nullptr && to != nullptr)
      tables.transmitted.push_back(translation(*from, *to, names.aliases));
  };
  for (const Route& route : names.routes)
    add(tables.model.find(std::string_view(route.model)),
        tables.bus.find(std::string_view(route.bus)));
  for (const can::Message& to : tables.bus.messages) {
    const auto routed = [&to](const Route& route) { return route.bus == to.name; };
    if (std::ranges::any_of(names.routes, routed)) continue;
    add(tables.model.find(std::string_view(to.name)), &to);
  }
}

void add_received(MessageTranslation& tables, const VariantNames& names) {
  for (const can::Message& from : tables.bus.messages) {
    const can::Message* const to = tables.model.find(std::string_view(from.name));
    if (to == nullptr) continue;
    Translation t = translation(from, *to, names.aliases);
    if (is_complete(t)) tables.received.push_back(std::move(t));
  }
}

// Of the AV-24 only: nobody knows who sends what V9 and V12 have alone.
void add_own(MessageTranslation& tables) {
  for (const can::MessageRow& row : can::av24::kMessages) {
    const can::Message* const message = tables.bus.find(std::string_view(row.name));
    if (message == nullptr || message->id != row.id) continue;
    if (row.direction != can::Direction::kFromCar) continue;
    if (tables.model.find(std::string_view(row.name)) != nullptr) continue;
    Periodic own{.message = message, .period = row.period, .values = {}};
    for (const can::Signal& signal : message->signals) own.values.push_back(at_rest(signal));
    tables.own.push_back(std::move(own));
  }
}

std::optional<can::Frame> translate(const Translation& t, const can::Frame& frame,
                                    std::uint64_t& unsent) {
  std::array<double, 64> from{}, to{};
  const std::size_t values = t.from->signals.size();
  if (!can::decode(*t.from, frame, std::span(from).first(values))) return std::nullopt;
  for (std::size_t i = 0; i < t.sources.size(); ++i)
    to[i] = t.sources[i] ? from[*t.sources[i]] : t.otherwise[i];
  can::Frame out;
  can::EncodeCounters counters;
  if (can::encode(*t.to, std::span(to).first(t.sources.size()), out, counters)) return out;
  ++unsent;
  return std::nullopt;
}

}  // namespace

Result<CanVariant, Problem> CanVariant::of(BusRevision which) {
  auto model = can::parse_dbc(kAv21Text, "av21.dbc");
  if (!model) return Unexpected{model.error()};
  const VariantNames names = names_of(which);
  auto other = can::parse_dbc(names.text, scenario::name_of(which));
  if (!other) return Unexpected{other.error()};
  auto tables = std::make_shared<MessageTranslation>();
  tables->same = which == BusRevision::kV14 || which == BusRevision::kProtected;
  tables->bus = names.whole ? *std::move(other) : overlaid(*model, *std::move(other), names.absent);
  tables->model = *std::move(model);
  add_transmitted(*tables, names);
  add_received(*tables, names);
  add_own(*tables);
  CanVariant variant{std::move(tables)};
  if (which == BusRevision::kProtected) variant.also_.emplace();
  return variant;
}

CanVariant::CanVariant(std::shared_ptr<const MessageTranslation> tables)
    : tables_(std::move(tables)), due_(tables_->own.size()) {}

Frames CanVariant::transmitted(const can::Frame& frame) {
  Frames out;
  if (tables_->same) {
    CHECK(out.push(also_ ? with_checksum(frame) : frame));
    return out;
  }
  for (const Translation& t : tables_->transmitted) {
    if (!can::is_frame_of(*t.from, frame)) continue;
    if (const auto translated = translate(t, frame, unsent_)) CHECK(out.push(*translated));
  }
  return out;
}

std::optional<can::Frame> CanVariant::receive(const can::Frame& frame) {
  if (tables_->same) return frame;
  for (const Translation& t : tables_->received)
    if (can::is_frame_of(*t.from, frame)) return translate(t, frame, unsent_);
  return std::nullopt;
}

Frames CanVariant::due(Instant now) {
  Frames out;
  for (std::size_t i = 0; i < due_.size(); ++i) {
    const Periodic& own = tables_->own[i];
    if (due_[i] > now) continue;
    due_[i] += own.period * ((now - due_[i]) / own.period + 1);
    can::Frame frame;
    can::EncodeCounters counters;
    if (can::encode(*own.message, own.values, frame, counters)) CHECK(out.push(frame));
  }
  if (also_)
    for (const can::Frame& frame : also_->due(now)) CHECK(out.push(frame));
  return out;
}

const can::Database& CanVariant::database() const { return tables_->bus; }

}  // namespace pitwall::can_variant
