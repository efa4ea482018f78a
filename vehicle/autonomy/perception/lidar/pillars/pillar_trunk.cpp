// SPDX-License-Identifier: Apache-2.0
#include "vehicle/autonomy/perception/lidar/pillars/pillar_trunk.hpp"

#include <array>
#include <opencv2/core.hpp>
#include <opencv2/dnn.hpp>
#include <utility>

#include "protocol/vocabulary/check.hpp"
#include "protocol/vocabulary/text.hpp"

namespace pitwall::perception {
namespace {

std::string shape_text(const cv::Mat& blob) {
  std::string text;
  for (int axis = 0; axis < blob.dims; ++axis)
    text += formatted(axis == 0 ? "%d" : " x %d", blob.size[axis]);
  return text;
}

bool is_output(const cv::Mat& blob, std::size_t rows) {
  const std::array<std::size_t, 4> expected{1, kPillarOutputs, rows / PillarTrunk::kStride,
                                            PillarTrunk::kOutColumns};
  if (blob.dims != static_cast<int>(expected.size()) || blob.type() != CV_32F) return false;
  for (std::size_t axis = 0; axis < expected.size(); ++axis)
    if (blob.size[static_cast<int>(axis)] != static_cast<int>(expected[axis])) return false;
  return true;
}

}  // namespace

struct PillarTrunk::Net {
  cv::dnn::Net net;
  std::size_t rows;

  cv::Mat run(std::vector<float>& planes) {
    const std::array<int, 4> shape{1, static_cast<int>(kPillarFeatures), static_cast<int>(rows),
                                   static_cast<int>(PillarGrid::kColumns)};
    net.setInput(cv::Mat(static_cast<int>(shape.size()), shape.data(), CV_32F, planes.data()));
    return net.forward();
  }
};

PillarTrunk::PillarTrunk(std::unique_ptr<Net> net) : net_(std::move(net)) {}
PillarTrunk::~PillarTrunk() = default;
PillarTrunk::PillarTrunk(PillarTrunk&&) noexcept = default;
PillarTrunk& PillarTrunk::operator=(PillarTrunk&&) noexcept = default;

Result<PillarTrunk, Problem> PillarTrunk::load(std::string_view onnx, const std::string& name,
                                               std::size_t rows) {
  auto net = std::make_unique<Net>(Net{.net = {}, .rows = rows});
  try {
    net->net = cv::dnn::readNetFromONNX(onnx.data(), onnx.size());
    net->net.setPreferableBackend(cv::dnn::DNN_BACKEND_OPENCV);
    std::vector<float> nothing(kPillarFeatures * rows * PillarGrid::kColumns, 0.0F);
    const cv::Mat out = net->run(nothing);
    if (!is_output(out, rows))
      return refuse(name,
                    formatted("expected an output of 1 x %zu x %zu x %zu, got %s", kPillarOutputs,
                              rows / kStride, kOutColumns, shape_text(out).c_str()));
  } catch (const cv::Exception& error) {
    return refuse(name, formatted("expected an ONNX network with an input of 1 x %zu x %zu x "
                                  "%zu: %s",
                                  kPillarFeatures, rows, PillarGrid::kColumns, error.err.c_str()));
  }
  return PillarTrunk{std::move(net)};
}

std::vector<float> PillarTrunk::run(std::vector<float>& planes) {
  CHECK(planes.size() == kPillarFeatures * net_->rows * PillarGrid::kColumns);
  const cv::Mat out = net_->run(planes);
  const auto* const first = out.ptr<float>();
  return {first, first + out.total()};
}

}  // namespace pitwall::perception
