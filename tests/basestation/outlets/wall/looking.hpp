// Eyes that see what a test shows them.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "basestation/outlets/wall/snapshots.hpp"

namespace pitwall::outlets::wall {

struct Looking : Eyes {
  picture::Picture picture;
  picture::Judgement judgement = picture::Judgement::kNone;
  telemetry::Snapshot state;

  void show(telemetry::FieldIndex field, double value, Instant at) {
    const telemetry::Group group = telemetry::kFields[field].group;
    state.values[field] = value;
    state.at(group) = at;
    telemetry::GroupSet groups;
    groups.add(group);
    picture.update(state, groups);
  }
  picture::FieldView view(picture::FieldId field, Instant now) const override {
    return picture::is_base(field) ? picture::FieldView{} : picture.view(field, now);
  }
  picture::Judgement judge(picture::FieldId, const picture::FieldView&) const override {
    return judgement;
  }
  std::vector<picture::TrendPoint> past(picture::FieldId, Instant from, Instant,
                                        std::size_t) const override {
    return {{.time_s = static_cast<double>(from.ns) * 1e-9, .value = 1.0F}};
  }
};

}  // namespace pitwall::outlets::wall
