// A base that records: what a killed one left is made whole and known again, then everything is
// kept, with the very messages that consoles get.
//   in     the folder, what the segments say of the run; the car's service
//   out    the recorder; lines for a person, by `say`; fields of the base that tell how it records
//   invariants
//          inputs of the evaluator beside states are recorded, too: check_alarms() gives the same
//          list
//   errors Problem where the folder cannot be made or written
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "basestation/service/car_service.hpp"
#include "protocol/recorder/recorder.hpp"

namespace pitwall::service {

// Of the base that runs. The file of limits and alarms goes in as its hash.
recording::Metadata run_metadata(int car, const std::string& name,
                                 const std::string& judgement_file);

// The recorder outlives the service.
Result<std::unique_ptr<recorder::Recorder>, Problem> start_recording(
    const std::string& folder, recording::Metadata run, CarService& car,
    const std::function<void(const std::string&)>& say);

}  // namespace pitwall::service
