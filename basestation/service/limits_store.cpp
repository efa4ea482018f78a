// SPDX-License-Identifier: Apache-2.0
#include "basestation/service/limits_store.hpp"

#include <filesystem>
#include <system_error>
#include <utility>

#include "basestation/service/messages/settings_text.hpp"
#include "protocol/transport/file.hpp"

namespace pitwall::service {

LimitsStore::LimitsStore(std::string path) : path_(std::move(path)) {
  std::error_code unknown;  // whether it is there: then reading it tells why not
  if (!std::filesystem::exists(path_, unknown) && !unknown) {
    remark_ = path_ + ": not there; limits and alarms as they came, changes go into it";
    return;
  }
  auto read = settings::read_judgement_file(path_);
  if (read) {
    judgement_ = *std::move(read);
    return;
  }
  unreadable_ = read.error();
  remark_ = unreadable_text(*unreadable_);
}

Result<bool, Problem> LimitsStore::save(const command::SettingsEditor::Wanted& wanted) {
  if (unreadable_) {
    if (auto kept = keep_broken(); !kept) return kept;
  }
  auto written = transport::write_file(
      path_, settings::judgement_text(wanted.derive, wanted.limits, wanted.alarms, wanted.revision,
                                      wanted.up_kbit_s));
  if (written) unreadable_.reset();
  return written;
}

Result<bool, Problem> LimitsStore::keep_broken() {
  namespace files = std::filesystem;
  if (kept_) return true;
  std::error_code error;
  std::string beside = path_ + ".broken";
  for (int next = 2; files::exists(beside, error); ++next) {
    beside = path_ + ".broken." + std::to_string(next);
  }
  kept_ = files::copy_file(path_, beside, error);
  if (!kept_) return Unexpected{Problem{beside, "the broken file is not kept: " + error.message()}};
  return true;
}

}  // namespace pitwall::service
