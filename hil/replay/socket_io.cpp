// SPDX-License-Identifier: Apache-2.0
#include "hil/replay/socket_io.hpp"

#include <algorithm>
#include <array>

#include "protocol/transport/clock.hpp"
#include "protocol/transport/readiness.hpp"
#include "protocol/vocabulary/check.hpp"
#include "protocol/vocabulary/fixed_vector.hpp"

namespace pitwall::replay {
namespace {

constexpr Duration kIdle = milliseconds(10);           // a longer wait ends with a signal
constexpr Duration kExactWait = milliseconds(5);       // the last stretch of it, by the clock
constexpr Duration kSignalPeriod = milliseconds(100);  // a busy replay looks that often
constexpr Duration kServePeriod = milliseconds(2);     // of a stream that could not write all
constexpr Duration kLookPeriod = milliseconds(20);     // for readers of topics
constexpr Duration kAcquaintance = milliseconds(200);  // of a reader that we know, with us
constexpr Duration kSettle = milliseconds(50);         // DDS sends on a thread of its own
constexpr unsigned kNetworkShift = 24;                 // 127.0.0.0/8 is this machine
constexpr std::size_t kSamples = 64;
constexpr std::size_t kUsual = kSamples * 9 / 10;
constexpr Duration kSampleSleep = microseconds(600);
// Any reader of a topic may ask for it, and a burst is not to push out what is not sent yet.
constexpr dds::Quality kTopicQuality{.reliable = true, .latched = true, .depth = 64};

bool is_topic(const Track& track) {
  return track.to && std::holds_alternative<RosTopic>(*track.to);
}

}  // namespace

Result<SocketIo, Problem> SocketIo::open(const Timeline& timeline) {
  auto stop = transport::StopSignal::install();  // before threads of DDS, which would get it
  if (!stop) return Unexpected{stop.error()};
  std::unique_ptr<dds::Domain> domain;
  if (std::ranges::any_of(timeline.tracks, is_topic)) {
    CHECK(timeline.dds);
    auto joined = dds::Domain::join(*timeline.dds);
    if (!joined) return Unexpected{joined.error()};
    domain = *std::move(joined);
  }
  std::vector<Sender> senders;
  for (const Track& track : timeline.tracks) {
    auto sender = open(track, domain.get());
    if (!sender) return Unexpected{sender.error()};
    senders.push_back(*std::move(sender));
  }
  const auto is_stream = [](const Sender& one) { return std::holds_alternative<Stream>(one); };
  if (std::ranges::count_if(senders, is_stream) > std::ptrdiff_t{kMaxStreams})
    return Unexpected{Problem{"--receiver", "expected at most 16 TCP ports and serial devices"}};
  return SocketIo{std::move(domain), std::move(senders), *std::move(stop)};
}

Result<SocketIo::Sender, Problem> SocketIo::open_receiver(const Track& track) {
  if (const auto* udp = std::get_if<UdpAddress>(&*track.to)) {
    const bool stays_here = udp->ip >> kNetworkShift == kLoopbackIp >> kNetworkShift;
    auto socket =
        transport::UdpSocket::bind({.ip = stays_here ? kLoopbackIp : transport::kAnyIp, .port = 0});
    if (!socket) return Unexpected{socket.error()};
    if (auto connected = socket->connect(*udp); !connected) return Unexpected{connected.error()};
    return Sender{Line{*std::move(socket), &track.datagrams}};
  }
  const auto* tcp = std::get_if<TcpPort>(&*track.to);
  auto sender = tcp != nullptr
                    ? transport::StreamSender::listen(tcp->local)
                    : transport::StreamSender::open(std::get<transport::SerialDevice>(*track.to));
  if (!sender) return Unexpected{sender.error()};
  return Sender{Stream{track.target, *std::move(sender), &track.datagrams}};
}

Result<SocketIo::Sender, Problem> SocketIo::open_topic(const Track& track, dds::Domain& domain) {
  const RosTopic& names = std::get<RosTopic>(*track.to);
  auto writer = domain.write_to({.topic = names.topic, .type = names.type}, kTopicQuality);
  if (!writer) return Unexpected{writer.error()};
  return Sender{Topic{track.target, *writer, &track.datagrams}};
}

Result<SocketIo::Sender, Problem> SocketIo::open(const Track& track, dds::Domain* domain) {
  if (is_topic(track)) return open_topic(track, *domain);
  if (track.to) return open_receiver(track);
  auto sender = transport::CanSender::open(track.target);
  if (!sender) return Unexpected{sender.error()};
  auto frames = transport::PreparedFrames::make(track.frames, track.fd_flags);
  if (!frames) return Unexpected{frames.error()};
  return Sender{Bus{*std::move(sender), *std::move(frames), &track}};
}

Duration SocketIo::measured_lead() {
  std::array<Duration, kSamples> late{};
  for (Duration& sample : late) {
    const Instant deadline = transport::monotonic_now() + kSampleSleep;
    transport::sleep_until(deadline);
    sample = transport::monotonic_now() - deadline;
  }
  std::nth_element(late.begin(), late.begin() + kUsual, late.end());
  return std::min(late[kUsual], kMaxLead);
}

void SocketIo::set_lead(Duration lead) {
  lead_ = lead;
  const Instant begin = transport::monotonic_now();
  for (std::size_t i = 0; i < kSamples; ++i) static_cast<void>(transport::monotonic_now());
  half_reading_ = (transport::monotonic_now() - begin) / (2 * static_cast<std::int64_t>(kSamples));
  half_reading_ = std::min(half_reading_, kGroup / 2);
}

Instant SocketIo::now() { return read_ = transport::monotonic_now(); }

// Callers come and go, and queues are written, while there is time for it.
void SocketIo::serve_streams() {
  for (const std::size_t i : streams_) std::get<Stream>(senders_[i]).sender.service();
}

// Until it is done, the time has come, or a signal.
template <class Done>
void SocketIo::serve_until(Instant give_up, Done&& done) {
  while (!stopped_ && now() < give_up) {
    serve_streams();
    if (done()) return;
    FixedVector<int, kMaxStreams + 1> watched;
    static_cast<void>(watched.push(stop_.fd()));
    bool is_queued = false;
    for (const std::size_t i : streams_) {
      const transport::StreamSender& sender = std::get<Stream>(senders_[i]).sender;
      static_cast<void>(watched.push(sender.fd()));
      is_queued = is_queued || sender.queued_bytes() > 0;
    }
    const Instant until = is_queued ? std::min(give_up, read_ + kServePeriod) : give_up;
    transport::wait_readable(watched.span(), until);
    stopped_ = stop_.raised();
  }
}

void SocketIo::poll_signals(Instant deadline) {
  const bool idle = deadline - read_ > kIdle;
  if (!idle && deadline - polled_at_ <= kSignalPeriod) return;
  if (idle) {
    serve_until(deadline - kExactWait, [] { return false; });
  } else {
    serve_streams();
  }
  stopped_ = stopped_ || stop_.raised();
  polled_at_ = deadline;
}

bool SocketIo::is_awaited(const Sender& sender) {
  if (const auto* stream = std::get_if<Stream>(&sender)) return stream->sender.is_open();
  const auto* topic = std::get_if<Topic>(&sender);
  return topic == nullptr || topic->writer->readers() > 0;
}

// Readers of topics are no descriptors: they are looked for.
void SocketIo::wait_for_clients(Duration timeout) {
  const Instant give_up = now() + timeout;
  while (!stopped_ && now() < give_up && !std::ranges::all_of(senders_, is_awaited))
    serve_until(std::min(give_up, read_ + kLookPeriod), [] { return false; });
  if (domain_ != nullptr) serve_until(now() + kAcquaintance, [] { return false; });
}

void SocketIo::finish(Duration timeout) {
  serve_until(now() + timeout, [&] {
    return std::ranges::all_of(streams_, [&](std::size_t i) {
      return std::get<Stream>(senders_[i]).sender.queued_bytes() == 0;
    });
  });
  for (const std::size_t i : streams_) std::get<Stream>(senders_[i]).sender.close();
  if (domain_ == nullptr) return;
  const Instant give_up = now() + timeout;
  for (Sender& sender : senders_)
    if (Topic* topic = std::get_if<Topic>(&sender)) topic->writer->settle(give_up - now());
  serve_until(now() + kSettle, [] { return false; });  // of readers that acknowledge nothing
}

void SocketIo::wait_until(Instant deadline) {
  poll_signals(deadline);
  if (stopped_) return;
  if (lead_.ns == 0 || !budget_.has_credit(read_)) return transport::sleep_until(deadline);
  Instant busy_from = read_;
  if (deadline - read_ > lead_) {
    transport::sleep_until(deadline - lead_);
    busy_from = now();
  }
  // The look that comes nearest to the deadline is the last one.
  while (read_ < deadline - half_reading_) now();
  budget_.spend(read_ - busy_from);
}

transport::SendOutcome SocketIo::send(Line& line, std::size_t first, std::size_t count) {
  for (std::size_t i = 0; i < count; ++i)
    if (!line.socket.send((*line.datagrams)[first + i]))
      return {.taken = i, .error = line.socket.send_error()};
  return {.taken = count, .error = 0};
}

TrackOutcome SocketIo::send(Stream& stream, std::size_t first, std::size_t count) {
  for (std::size_t i = 0; i < count; ++i)
    if (!stream.sender.send((*stream.datagrams)[first + i])) return {.taken = i};
  return {.taken = count};
}

TrackOutcome SocketIo::send(Topic& topic, std::size_t first, std::size_t count) {
  for (std::size_t i = 0; i < count; ++i)
    if (!topic.writer->write((*topic.datagrams)[first + i])) return {.taken = i};
  return {.taken = count};
}

TrackOutcome SocketIo::send(std::size_t track, std::size_t first, std::size_t count) {
  Sender& sender = senders_[track];
  if (Stream* stream = std::get_if<Stream>(&sender)) return send(*stream, first, count);
  if (Topic* topic = std::get_if<Topic>(&sender)) return send(*topic, first, count);
  transport::SendOutcome outcome;
  if (Bus* bus = std::get_if<Bus>(&sender)) {
    outcome = bus->sender.send(bus->frames, first, count);
  } else {
    outcome = send(std::get<Line>(sender), first, count);
  }
  if (outcome.error != 0 && !outcome.full()) last_error_ = outcome.error;
  return {.taken = outcome.taken, .full = outcome.full()};
}

void SocketIo::prepare(std::size_t track, std::size_t end, unsigned pass) {
  Bus* bus = std::get_if<Bus>(&senders_[track]);
  if (bus == nullptr) return;
  if (bus->pass != pass) {
    bus->pass = pass;
    bus->prepared = 0;
  }
  for (; bus->prepared < end; ++bus->prepared) {
    can::Frame frame = bus->track->frames[bus->prepared];
    if (bus->track->restamp.stamp(bus->prepared, pass, frame))
      bus->frames.set_data(bus->prepared, frame.payload());
  }
}

std::vector<StreamReport> SocketIo::streams() const {
  std::vector<StreamReport> reports;
  for (const std::size_t i : streams_) {
    const Stream& stream = std::get<Stream>(senders_[i]);
    reports.push_back({stream.target, stream.sender.counters()});
  }
  return reports;
}

std::vector<std::string> SocketIo::unread_topics() const {
  std::vector<std::string> topics;
  for (const Sender& sender : senders_)
    if (const auto* topic = std::get_if<Topic>(&sender); topic && topic->writer->readers() == 0)
      topics.push_back(topic->target);
  return topics;
}

std::uint64_t SocketIo::undelivered(std::size_t track) const {
  const Line* line = std::get_if<Line>(&senders_[track]);
  return line == nullptr ? 0 : line->socket.counters().rx_refused;
}

std::string SocketIo::last_error() const {
  if (last_error_ == 0) return {};
  return transport::PosixOutcome{.value = -1, .error = last_error_}.reason();
}

}  // namespace pitwall::replay
