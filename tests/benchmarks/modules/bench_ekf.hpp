// `pitwall-benchmarks ekf [--json FILE]`: what the filter of localization costs the car.
//
//   in     lockstep runs of LVMS from real receiver bytes: with the spatial filter and with
//          the planar one, each with the longest window, looked at four times a second; and three
//          of the car as it is, one receiver of which is late by 100 ms, each step timed: alike to
//          the bit, so that the least of a tick is what the step costs and not the machine
//   out    a table in microseconds of processor time: a prediction, an update by kind of
//          measurement, a position that comes 100 ms and 1 s late, with all that has to be done
//          again; a step of the car in the ticks that take something late, and what it takes from
//          the heap
//   gates  in reference units of the same run, see tests/benchmarks/cost; on the reference
//          machine, us, of the spatial filter: prediction 15 and update 30 at p50, each kind; a
//          rewind of 100 ms 1000 and of 1 s 8000 at p50; step with a rewind of 100 ms 1200 at p99,
//          no allocation: exit code 1 where one is missed
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>

namespace pitwall::benchmarks {

int bench_ekf(std::span<const std::string> args);

}  // namespace pitwall::benchmarks
