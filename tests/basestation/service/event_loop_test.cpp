// SPDX-License-Identifier: Apache-2.0
#include "basestation/service/event_loop.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <memory>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include "basestation/link/key_pair.hpp"
#include "protocol/telemetry/endpoint/car_endpoint.hpp"
#include "protocol/transport/clock.hpp"
#include "protocol/transport/readiness.hpp"

namespace pitwall::service {
namespace {

class EventLoop : public ::testing::Test {
 protected:
  void SetUp() override {
    ASSERT_TRUE(radio_.front() && car_socket_ && words_);
    ASSERT_EQ(::pipe(stop_), 0);
    telemetry::LinkEndpointConfig config;
    config.association.keys = keys_.base;
    service_ = std::make_unique<CarService>(ServiceConfig{}, config, randomness_);
  }
  void TearDown() override {
    for (const int fd : stop_) ::close(fd);
  }
  void run(Duration duration) {
    const CarLoop car{.service = service_.get(),
                      .title = "car 7",
                      .radio = {&*radio_.front(), 1},
                      .stop_port = &*words_,
                      .script = &script_};
    run_event_loop({&car, 1}, tasks_, duration, stop_[0]);
  }
  // A car that speaks from another thread until the loop has ended.
  void run_with_car(Duration duration) {
    std::atomic<bool> over = false;
    std::thread car([&] { drive(over); });
    run(duration);
    over = true;
    car.join();
  }
  void drive(const std::atomic<bool>& over) {
    telemetry::SeededRandomness randomness(3);
    telemetry::LinkEndpointConfig config;
    config.association.keys = keys_.car;
    config.association.greeting.real_car = true;
    const UdpAddress base = radio_.front()->local();
    config.association.peer[0] = base;
    telemetry::CarEndpoint car(config, randomness);
    telemetry::Snapshot snapshot;
    snapshot.values[telemetry::field("ego.x")] = 12.0;
    std::vector<transport::UdpDatagram> batch(8);
    while (!over) {
      const Instant now = transport::monotonic_now();
      const std::size_t n = car_socket_->receive(batch);
      for (std::size_t i = 0; i < n; ++i) {
        car.feed(batch[i].payload(), 0, batch[i].from, batch[i].at);
      }
      snapshot.at(telemetry::Group::kEgo) = now;
      while (const auto out = car.poll(snapshot, now)) {
        car_socket_->send_to(out->to, out->bytes);
      }
      const int watched[] = {car_socket_->fd()};
      transport::wait_readable(watched, now + milliseconds(2));
    }
  }

  telemetry::SeededRandomness randomness_{1};
  link::KeyPair keys_ = link::make_key_pair(randomness_);
  std::vector<Result<transport::UdpSocket, Problem>> radio_ = [] {
    std::vector<Result<transport::UdpSocket, Problem>> sockets;
    sockets.push_back(transport::UdpSocket::bind({}));
    return sockets;
  }();
  Result<transport::UdpSocket, Problem> car_socket_ = transport::UdpSocket::bind({});
  Result<transport::UdpSocket, Problem> words_ = transport::UdpSocket::bind({});
  inputs::CommandScript script_;
  int stop_[2] = {-1, -1};
  std::unique_ptr<CarService> service_;
  std::vector<LoopTask*> tasks_;
};

TEST_F(EventLoop, MeetsTheCar) {
  run_with_car(milliseconds(600));
  EXPECT_GT(service_->link().rate().packets(), 3U);
  EXPECT_EQ(service_->vehicle().view(telemetry::field("ego.x"), transport::monotonic_now()).value,
            12.0);
}

TEST_F(EventLoop, RunsTheScriptAndTakesStopsByUdp) {
  script_ = *inputs::CommandScript::parse("0.1 take 9\n", "f");
  const std::string word = "stop controlled\n";
  auto operator_socket = transport::UdpSocket::bind({});
  ASSERT_TRUE(operator_socket);
  operator_socket->send_to(words_->local(),
                           {reinterpret_cast<const std::uint8_t*>(word.data()), word.size()});
  run_with_car(milliseconds(600));
  EXPECT_EQ(service_->link().endpoint().authority().holder(transport::monotonic_now()), 9);
  EXPECT_EQ(service_->link().endpoint().stop().state().level, telemetry::StopLevel::kControlled);
}

TEST_F(EventLoop, EndsByItself) {
  run(milliseconds(30));
  EXPECT_EQ(service_->link().rate().packets(), 0U);
}

TEST_F(EventLoop, EndsWhenItIsTold) {
  ASSERT_EQ(::write(stop_[1], "x", 1), 1);
  run({});
}

TEST_F(EventLoop, SendsNothingBeforeACarWasReceived) {
  run(milliseconds(250));
  EXPECT_EQ(radio_.front()->counters().sent, 0U);
}

// Of every turn: what people ask for, then the service, then what is published, then the tasks.
TEST_F(EventLoop, RequestsAreExecutedBeforeAnythingIsPublished) {
  struct Order : Publisher, LoopTask {
    std::vector<std::string> calls;
    void submit(CarService&, Instant) override { calls.emplace_back("submit"); }
    void publish(const CarService&, Instant) override { calls.emplace_back("publish"); }
    void serve(Instant) override { calls.emplace_back("task"); }
    void finish(Instant) override { calls.emplace_back("finish"); }
    Instant due() const override { return Instant::max(); }
  } order;
  Publisher* const publisher = &order;
  LoopTask* const task = &order;
  const CarLoop car{.service = service_.get(), .publishers = {&publisher, 1}};
  ASSERT_EQ(::write(stop_[1], "x", 1), 1);
  run_event_loop({&car, 1}, {&task, 1}, {}, stop_[0]);
  EXPECT_EQ(order.calls, (std::vector<std::string>{"submit", "publish", "task", "finish"}));
}

}  // namespace
}  // namespace pitwall::service
