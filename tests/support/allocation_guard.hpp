// Allocation counter under the names that tests use.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "protocol/transport/allocation_count.hpp"

namespace pitwall::testing {

using transport::allocation_count;
using transport::allocations_of;
using transport::kAllocationsCounted;

}  // namespace pitwall::testing
