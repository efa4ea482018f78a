// The file of limits and alarms over the life of a base: read once, written after each change.
//   in     its path; what people changed, by the settings editor
//   out    the settings to begin with; a line for a person where they are not the file's
//   invariants
//          a file that cannot be read stops no base: limits and alarms hold as they came, and the
//          file stays as it is until somebody changes a setting. Then the broken one is kept as
//          FILE.broken (FILE.broken.2 and so on where that is there), and the new one takes its
//          place. A file that is not there is made with the first change
//   errors save(): Problem with the path; the file is then as it was
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
  const std::string& remark() const { return remark_; }  // empty: the settings are the file's
  // The file is there and is none; until it was replaced.
  const std::optional<Problem>& unreadable() const { return unreadable_; }
  Result<bool, Problem> save(const command::SettingsEditor::Wanted& wanted);

 private:
  Result<bool, Problem> keep_broken();

  std::string path_;
  settings::Judgement judgement_;
  std::string remark_;
  std::optional<Problem> unreadable_;
  bool kept_ = false;  // the broken one
};

}  // namespace pitwall::service
