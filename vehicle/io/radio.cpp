// SPDX-License-Identifier: Apache-2.0
#include "vehicle/io/radio.hpp"

#include <span>
#include <utility>

#include "protocol/telemetry/session/crypto/keys.hpp"
#include "protocol/transport/clock.hpp"
#include "protocol/transport/file.hpp"
#include "protocol/vocabulary/check.hpp"
#include "vehicle/io/station_addresses.hpp"

namespace pitwall::io {
namespace {

using transport::UdpSocket;

constexpr std::uint8_t kExpedited = 46;  // RFC 3246: every packet holds safety's part

recorder::RadioDatagram on_air(telemetry::PathId path, UdpAddress other,
                               std::span<const std::uint8_t> bytes) {
  return {.path = path, .ip = other.ip, .port = other.port, .bytes = bytes};
}

Result<telemetry::KeyFile, Problem> read_keys(const std::string& path, bool real_car) {
  const auto text = transport::read_private_file(path, telemetry::kMaxKeyFileBytes);
  if (!text) return Unexpected{text.error()};
  return telemetry::parse_key_file(*text, path,
                                   {.role = telemetry::Role::kCar, .real_car = real_car});
}

Result<UdpSocket, Problem> open_socket(UdpAddress base) {
  return UdpSocket::bind({.ip = is_loopback(base) ? kLoopbackIp : transport::kAnyIp},
                         {.dscp = kExpedited});
}

void set_addresses(telemetry::AssociationConfig& config, std::size_t path,
                   const StationAddresses& addresses) {
  config.peer[path] = addresses.front();
  for (const UdpAddress& spare : std::span(addresses).subspan(1)) {
    CHECK(config.spare[path].push(spare));
  }
}

}  // namespace

Result<Radio, Problem> Radio::open(const RadioArguments& args, const pipeline::RadioParams& params,
                                   bool real_car) {
  auto keys = read_keys(args.key_file, real_car);
  if (!keys) return Unexpected{keys.error()};
  const auto stations = parse_station_addresses(args.stations);
  if (!stations) return Unexpected{stations.error()};
  telemetry::LinkEndpointConfig config;
  config.association.keys = *std::move(keys);
  config.association.greeting.signed_only = params.signed_only;
  config.association.greeting.real_car = real_car;
  config.association.to_utc = transport::realtime_minus_monotonic();
  config.association.paths = static_cast<std::uint8_t>(stations->size());
  std::vector<UdpSocket> paths;
  for (std::size_t i = 0; i < stations->size(); ++i) {
    auto socket = open_socket((*stations)[i].front());
    if (!socket) return Unexpected{socket.error()};
    paths.push_back(*std::move(socket));
    set_addresses(config.association, i, (*stations)[i]);
    const pipeline::RadioPathParams path =
        i < params.paths.size() ? params.paths[i] : pipeline::RadioPathParams{};
    config.budget[i] = {.bytes_per_s = path.bytes_per_s,
                        .packets_per_s = path.packets_per_s,
                        .safety_bytes_per_s = path.safety_bytes_per_s};
    const auto budget = telemetry::PathBudget::make(config.budget[i]);
    if (!budget) return Unexpected{budget.error()};
  }
  return Radio{config, std::move(paths)};
}

Radio::Radio(const telemetry::LinkEndpointConfig& config, std::vector<UdpSocket> paths)
    : randomness_(std::make_unique<telemetry::SystemRandomness>()),
      endpoint_(config, *randomness_),
      paths_(std::move(paths)),
      inbox_(UdpSocket::kBatch),
      bench_keys_(config.association.keys.bench) {}

void Radio::receive(BlackBox& box) {
  for (std::size_t path = 0; path < paths_.size(); ++path)
    for (std::size_t taken = 0, count = inbox_.size();
         count == inbox_.size() && taken < kReadsPerTick; taken += count) {
      count = paths_[path].receive(inbox_);
      for (const transport::UdpDatagram& datagram : std::span(inbox_).first(count)) {
        const auto number = static_cast<telemetry::PathId>(path);
        box.radio(false, datagram.at, on_air(number, datagram.from, datagram.payload()));
        endpoint_.feed(datagram.payload(), number, datagram.from, datagram.at);
      }
    }
}

void Radio::send(const telemetry::Snapshot& snapshot, Instant now, BlackBox& box) {
  while (const auto out = endpoint_.poll(snapshot, now)) {
    paths_[out->path].send_to(out->to, out->bytes);
    box.radio(true, now, on_air(out->path, out->to, out->bytes));
  }
}

}  // namespace pitwall::io
