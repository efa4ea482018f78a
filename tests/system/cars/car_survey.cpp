// SPDX-License-Identifier: Apache-2.0
#include "tests/system/cars/car_survey.hpp"

#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <fstream>
#include <iterator>

#include "protocol/vocabulary/check.hpp"

namespace pitwall::testing {
namespace {

constexpr std::size_t kWorst = 10;

// Memory that forked processes write and the caller reads.
class SharedResults {
 public:
  struct Row {
    double asked_mps;
    CarStopResults stops;
  };
  explicit SharedResults(std::size_t count) : bytes_(count * sizeof(Row)) {
    void* const at = ::mmap(nullptr, std::max<std::size_t>(bytes_, 1), PROT_READ | PROT_WRITE,
                            MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    CHECK(at != MAP_FAILED);
    rows_ = static_cast<Row*>(at);
  }
  ~SharedResults() { ::munmap(rows_, std::max<std::size_t>(bytes_, 1)); }
  SharedResults(const SharedResults&) = delete;
  SharedResults& operator=(const SharedResults&) = delete;
  Row& operator[](std::size_t i) { return rows_[i]; }

 private:
  std::size_t bytes_;
  Row* rows_ = nullptr;
};

plant::PlantFile read_file(const std::string& name) {
  const std::string file = std::string(PITWALL_SOURCE_DIR) + "/hil/config/plants/" + name + ".yaml";
  std::ifstream in(file);
  const std::string text{std::istreambuf_iterator<char>(in), {}};
  const auto read = plant::read_plant(text, file);
  CHECK(read);
  return *read;
}

// How far a stop is from failing: the smaller the worse.
double margin_of(const CarStopFigures& f) {
  if (!fault_of(f).empty() && !(f.use > kUseMost)) return -1.0;
  return std::min(kUseMost - f.use, 0.1 * f.wall_gap_m);
}

}  // namespace

std::vector<plant::FamilyCar> family_of(std::uint64_t seed, std::size_t count) {
  const std::array files{read_file("av21"), read_file("av21_putnam"), read_file("av21_compliant")};
  return plant::car_family(files, seed, count);
}

std::vector<SurveyedStop> survey(std::span<const plant::FamilyCar> cars,
                                 std::span<const StopPlace> places, unsigned processes) {
  const std::size_t count = cars.size() * places.size();
  SharedResults shared{count};
  std::vector<pid_t> workers;
  for (unsigned worker = 0; worker < processes; ++worker) {
    std::fflush(nullptr);
    const pid_t child = ::fork();
    CHECK(child >= 0);
    if (child > 0) {
      workers.push_back(child);
      continue;
    }
    for (std::size_t i = worker; i < count; i += processes) {
      const plant::Params& plant = cars[i / places.size()].params;
      const StopPlace& place = places[i % places.size()];
      shared[i].asked_mps = speed_of(plant, place.track);
      run_car_stops({plant, place, shared[i].asked_mps}, shared[i].stops);
    }
    ::_exit(0);
  }
  for (const pid_t worker : workers) {
    int status = 0;
    CHECK(::waitpid(worker, &status, 0) == worker);
    CHECK(status == 0);
  }
  std::vector<SurveyedStop> out;
  for (std::size_t i = 0; i < count; ++i)
    for (const CarStop kind : kCarStops)
      out.push_back({i / places.size(), places[i % places.size()], kind, shared[i].asked_mps,
                     shared[i].stops[static_cast<std::size_t>(kind)]});
  return out;
}

std::string row_of(const plant::FamilyCar& car, const SurveyedStop& stop) {
  const CarStopFigures& f = stop.figures;
  const std::string fault = fault_of(f);
  std::array<char, 320> text{};
  std::snprintf(text.data(), text.size(),
                "%-12s %-4s %-8s %-10s %4.1f m/s (use %.2f): %4.1f s %3.0f m, beside %5.2f m, "
                "use %.2f, tyre %.2f, slip %4.1f deg, wall %5.2f m, refused %u%s%s",
                car.name.c_str(), stop.place.track.c_str(), stop.place.turn ? "turn" : "straight",
                text_of(stop.kind), f.from_mps, f.use_before, f.lasted_s, f.distance_m,
                f.cross_track_m, f.use, f.tyre_use, f.slip_deg, f.wall_gap_m, f.refusals,
                fault.empty() ? "" : "  FAILS: ", fault.c_str());
  return text.data();
}

std::size_t print_survey(std::span<const plant::FamilyCar> cars,
                         std::span<const SurveyedStop> stops) {
  std::printf("%-10s %6s %6s %10s %10s %12s %10s\n", "stop", "runs", "failed", "use most",
              "slip most", "beside most", "wall least");
  for (const CarStop kind : kCarStops) {
    std::size_t runs = 0, failed = 0;
    CarStopFigures worst;
    for (const SurveyedStop& stop : stops) {
      if (stop.kind != kind) continue;
      const CarStopFigures& f = stop.figures;
      ++runs, failed += fault_of(f).empty() ? 0U : 1U;
      worst.use = std::max(worst.use, f.use);
      worst.slip_deg = std::max(worst.slip_deg, f.slip_deg);
      worst.cross_track_m = std::max(worst.cross_track_m, f.cross_track_m);
      worst.wall_gap_m = std::min(worst.wall_gap_m, f.wall_gap_m);
    }
    std::printf("%-10s %6zu %6zu %10.2f %6.1f deg %10.2f m %8.2f m\n", text_of(kind), runs, failed,
                worst.use, worst.slip_deg, worst.cross_track_m, worst.wall_gap_m);
  }
  std::vector<const SurveyedStop*> order;
  for (const SurveyedStop& stop : stops) order.push_back(&stop);
  std::ranges::stable_sort(order, {}, [](const SurveyedStop* s) { return margin_of(s->figures); });
  std::printf("the worst ten\n");
  for (std::size_t i = 0; i < std::min(kWorst, order.size()); ++i)
    std::printf("  %s\n", row_of(cars[order[i]->car], *order[i]).c_str());
  std::size_t failed = 0;
  for (const SurveyedStop& stop : stops) failed += fault_of(stop.figures).empty() ? 0U : 1U;
  return failed;
}

}  // namespace pitwall::testing
