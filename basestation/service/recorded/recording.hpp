// Recording of one car by the base. At the start, recordings that a killed base left are repaired
// and read back into the service.
//   in     the folder of the recordings, the metadata of the run; the car's service
//   out    the recorder, which keeps everything, with the very messages that consoles get; lines
//          for the log, by `log`; fields of the base that show the state of the recording
//   invariants
//          the inputs of the alarm evaluator that are not vehicle state are recorded too, so that
//          check_alarms() computes the same alarm list from the recording
//   errors Problem if the folder cannot be created or written
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "basestation/service/car_service.hpp"
#include "protocol/recorder/recorder.hpp"

namespace pitwall::service {

// Metadata of the running base. The file of limits and alarms is included as its hash.
recording::Metadata run_metadata(int car, const std::string& name,
                                 const std::string& judgement_file);

// The recorder outlives the service.
Result<std::unique_ptr<recorder::Recorder>, Problem> start_recording(
    const std::string& folder, recording::Metadata run, CarService& car,
    const std::function<void(const std::string&)>& log);

}  // namespace pitwall::service
