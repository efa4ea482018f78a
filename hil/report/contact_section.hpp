// Section of a report about the contact with another car: who, when, where, how fast, who caused it
// and by which rule (hil/traffic/contact_cause.hpp), and both cars in the second before.
//   in     RunData with a contact; the picture needs the truth of both cars
//   out    HTML; the picture is drawn along the heading of this car at the contact, in one scale
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "hil/report/run_data.hpp"

namespace pitwall::report {

std::string contact_section(const RunData& run);

}  // namespace pitwall::report
