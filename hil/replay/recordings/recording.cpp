// SPDX-License-Identifier: Apache-2.0
#include "hil/replay/recordings/recording.hpp"

namespace pitwall::traffic {

std::string_view to_string(SourceKind kind) {
  switch (kind) {
    case SourceKind::kCan:
      return "CAN";
    case SourceKind::kReceiver:
      return "receiver";
    case SourceKind::kRos:
      return "ROS 2";
    case SourceKind::kOther:
      return "other";
  }
  return "?";
}

std::string to_string(const Remark& remark) {
  std::string text = remark.place + ": " + remark.what;
  if (remark.times > 1) text += " (" + std::to_string(remark.times) + " times, first here)";
  return text;
}

}  // namespace pitwall::traffic
