// Export of the registry as JSON: groups in wire order with their fields, and the commands.
//   units  as in the registry; ages in ms; hashes as 16 hexadecimal digits
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace pitwall::telemetry {

std::string catalogue_json();

}  // namespace pitwall::telemetry
