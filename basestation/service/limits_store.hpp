// File of limits and alarms during the life of a base: read once, written after each change.
//   in     its path; changes by operators, from the settings editor
//   out    the settings at the start; a line for the log if they are not from the file
//   invariants
//          a file that cannot be read does not stop the base: the built-in limits and alarms hold,
//          and the file stays as it is until an operator changes a setting. Then the broken file is
//          kept as FILE.broken (or FILE.broken.2 and so on), and the new one takes its place. A
//          missing file is created with the first change
//   errors save(): Problem with the path; the file is then unchanged
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include "basestation/command/settings_editor.hpp"
#include "basestation/settings/judgement_file.hpp"
#include "protocol/vocabulary/result.hpp"

namespace pitwall::service {

class LimitsStore {
 public:
  explicit LimitsStore(std::string path);

  const settings::Judgement& judgement() const { return judgement_; }
  const std::string& remark() const { return remark_; }  // empty: the settings are from the file
  // The error of a file that cannot be read, until it is replaced.
  const std::optional<Problem>& unreadable() const { return unreadable_; }
  Result<bool, Problem> save(const command::SettingsEditor::Wanted& wanted);

 private:
  Result<bool, Problem> keep_broken();

  std::string path_;
  settings::Judgement judgement_;
  std::string remark_;
  std::optional<Problem> unreadable_;
  bool kept_ = false;  // the broken file has been copied
};

}  // namespace pitwall::service
