// Window of the newest measurements in order of their own time, with snapshots of the filter
// between them: a late measurement is inserted at its place, and only what follows it is computed
// again.
//
//     entries  0  1  2 ... 7  8  9 ... 15 16 17 18 19 20      entry 0 is the initial belief
//     beliefs  every[0]       every[1]    every[2]   tip      the tip is after entry `folded`
//
// Work is put off until a result is needed: an insertion computes up to its own entry, settle() the
// rest. To interpolate, a filter sees the next kImu entry beside each measurement; so a new kImu
// entry also invalidates all entries since the kImu before it.
//   in     Model: struct with Belief, Params, and
//            static Innovation fold(Belief&, const Params&, const Measurement&,
//                                   const Measurement* next_imu)
//          which updates the belief by one measurement at that measurement's time
//   errors insert_into() returns nullopt for a measurement before the first entry
//   cost   insert_into() and settle(): O(entries since the oldest insertion that is not folded yet
//          + kMemoStride) folds; no allocation
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <optional>

#include "protocol/vocabulary/check.hpp"
#include "vehicle/autonomy/localization/filter/measurement.hpp"

namespace pitwall::localization {

// 1.1 s of IMU at 125 Hz, wheels, slip and road at 100 Hz, two receivers at 20 Hz with their
// attitudes at 50 Hz are 670 entries; the rest is reserve.
inline constexpr std::size_t kEntries = 768, kMemoStride = 8, kMemos = kEntries / kMemoStride;

// Ring buffer, so that dropping old entries moves none.
struct Entries {
  std::array<Measurement, kEntries> ring{};
  std::size_t begins = 0;  // index of entry 0; a multiple of kMemoStride
  std::size_t size = 0;
  std::size_t folded = 0;  // the last entry that the tip includes

  Measurement& operator[](std::size_t i) { return ring[(begins + i) % kEntries]; }
  const Measurement& operator[](std::size_t i) const { return ring[(begins + i) % kEntries]; }
};

template <class Belief>
struct Memory {
  std::array<Belief, kMemos> ring{};
  Belief tip{};  // after entry `folded`

  // Belief after entry k * kMemoStride.
  Belief& every(const Entries& e, std::size_t k) {
    return ring[(e.begins / kMemoStride + k) % kMemos];
  }
};

// Order in time; measurements of the same instant are ordered by kind, unit and value, so that the
// order of arrival has no effect.
inline bool before(const Measurement& a, const Measurement& b) {
  if (a.at != b.at) return a.at < b.at;
  if (a.kind != b.kind) return a.kind < b.kind;
  if (a.unit != b.unit) return a.unit < b.unit;
  return a.a < b.a;
}

template <class Belief>
void begin(Entries& entries, Memory<Belief>& memory, const Belief& belief, Instant at) {
  entries.begins = 0;
  entries.size = 1;
  entries.folded = 0;
  entries[0] = {.at = at};
  memory.every(entries, 0) = memory.tip = belief;
}

// Index of the first kImu at or after entry i; e.size if there is none.
inline std::size_t imu_from(const Entries& e, std::size_t i) {
  while (i < e.size && e[i].kind != Kind::kImu) ++i;
  return i;
}

// Index of the last kImu before entry i, or 0.
inline std::size_t imu_before(const Entries& e, std::size_t i) {
  while (--i > 0 && e[i].kind != Kind::kImu) continue;
  return i;
}

// Advances the tip to entry `last`, which is not before it. Returns the innovation of that entry.
template <class Model>
Innovation fold_to(Entries& e, Memory<typename Model::Belief>& memory,
                   const typename Model::Params& params, std::size_t last) {
  Innovation innovation;
  std::size_t next_imu = 0;
  while (e.folded < last) {
    const std::size_t i = ++e.folded;
    if (next_imu < i) next_imu = imu_from(e, i);
    const Measurement* ahead = next_imu < e.size ? &e[next_imu] : nullptr;
    innovation = Model::fold(memory.tip, params, e[i], ahead);
    if (i % kMemoStride == 0) memory.every(e, i / kMemoStride) = memory.tip;
  }
  return innovation;
}

// Takes the tip back to the newest snapshot before entry `first`.
template <class Belief>
void rewind(Entries& e, Memory<Belief>& memory, std::size_t first) {
  if (e.folded < first) return;
  const std::size_t k = (first - 1) / kMemoStride;
  memory.tip = memory.every(e, k);
  e.folded = k * kMemoStride;
}

// Advances the tip to the newest entry.
template <class Model>
void settle(Entries& e, Memory<typename Model::Belief>& memory,
            const typename Model::Params& params) {
  (void)fold_to<Model>(e, memory, params, e.size - 1);
}

// Drops whole strides that are older than the window, or the oldest one of a full list. An entry
// that is not folded yet is folded first.
template <class Model>
void forget(Entries& e, Memory<typename Model::Belief>& memory,
            const typename Model::Params& params, Duration window) {
  const Instant oldest = e[e.size - 1].at - window;
  std::size_t strides = 0;
  while ((strides + 1) * kMemoStride < e.size && e[(strides + 1) * kMemoStride].at <= oldest)
    ++strides;
  if (strides == 0 && e.size == kEntries) strides = 1;
  if (strides == 0) return;
  const std::size_t count = strides * kMemoStride;
  if (e.folded < count) (void)fold_to<Model>(e, memory, params, count);
  e.begins = (e.begins + count) % kEntries;
  e.size -= count;
  e.folded -= count;
}

// Kinds whose innovation is not reported.
inline bool is_quiet(Kind kind) {
  return kind == Kind::kImu || kind == Kind::kRoad || kind == Kind::kSlip || kind == Kind::kWiden;
}

template <class Model>
std::optional<Innovation> insert_into(Entries& e, Memory<typename Model::Belief>& memory,
                                      const typename Model::Params& params, Duration window,
                                      const Measurement& m) {
  CHECK(e.size > 0);
  if (m.at < e[0].at) return std::nullopt;
  forget<Model>(e, memory, params, window);
  if (m.at < e[0].at) return std::nullopt;
  std::size_t place = e.size;
  while (place > 1 && before(m, e[place - 1])) --place;
  const bool imu = m.kind == Kind::kImu;
  rewind(e, memory, imu ? imu_before(e, place) + 1 : place);
  for (std::size_t i = e.size; i > place; --i) e[i] = e[i - 1];
  e[place] = m;
  ++e.size;
  if (is_quiet(m.kind)) return Innovation{.accepted = true, .nis = kUnset, .size = 0};
  return fold_to<Model>(e, memory, params, place);
}

}  // namespace pitwall::localization
