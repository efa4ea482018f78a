// A base that records: what a killed one left is made whole and known again, then everything is
// kept, with the very texts that consoles get where there are any.
//   in     the folder, what the segments say of the run; the wall, nullptr: no consoles
//   out    the recorder; lines for a person, by `say`; fields of the base that tell how it records
//   law    what the judge is told beside states is recorded, too: judge_again() gives the same list
//   errors Problem where the folder cannot be made or written
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "basestation/outlets/wall/wall.hpp"
#include "protocol/recorder/recorder.hpp"

namespace pitwall::outlets::wall {

// Of the base that runs. The file of limits and alarms goes in as its hash.
recording::Metadata run_metadata(int car, const std::string& name,
                                 const std::string& judgement_file);

// The recorder outlives the wall.
Result<std::unique_ptr<recorder::Recorder>, Problem> start_recording(
    const std::string& folder, recording::Metadata run, Wall* wall,
    const std::function<void(const std::string&)>& say);

}  // namespace pitwall::outlets::wall
