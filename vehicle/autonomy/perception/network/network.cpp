// SPDX-License-Identifier: Apache-2.0
#include "vehicle/autonomy/perception/network/network.hpp"

#include <algorithm>
#include <array>
#include <opencv2/core.hpp>
#include <opencv2/dnn.hpp>
#include <utility>

#include "protocol/vocabulary/check.hpp"
#include "protocol/vocabulary/text.hpp"

namespace pitwall::perception {
namespace {

using Axes = std::array<int, 4>;

Axes axes_of(const PlanesShape& shape) {
  return {1, static_cast<int>(shape.planes), static_cast<int>(shape.rows),
          static_cast<int>(shape.columns)};
}

std::string axes_text(const int* sizes, int axes) {
  std::string text;
  for (int axis = 0; axis < axes; ++axis)
    text += formatted(axis == 0 ? "%d" : " x %d", sizes[axis]);
  return text;
}

std::string shape_text(const PlanesShape& shape) {
  const Axes axes = axes_of(shape);
  return axes_text(axes.data(), static_cast<int>(axes.size()));
}

bool has_shape(const cv::Mat& blob, const PlanesShape& shape) {
  const Axes expected = axes_of(shape);
  return blob.type() == CV_32F && blob.dims == static_cast<int>(expected.size()) &&
         std::equal(expected.begin(), expected.end(), blob.size.p);
}

}  // namespace

struct Network::Net {
  cv::dnn::Net net;
  PlanesShape in;

  cv::Mat run(std::vector<float>& planes) {
    const Axes shape = axes_of(in);
    net.setInput(cv::Mat(static_cast<int>(shape.size()), shape.data(), CV_32F, planes.data()));
    return net.forward();
  }
};

Network::Network(std::unique_ptr<Net> net) : net_(std::move(net)) {}
Network::~Network() = default;
Network::Network(Network&&) noexcept = default;
Network& Network::operator=(Network&&) noexcept = default;

Result<Network, Problem> Network::load(std::string_view onnx, const std::string& name,
                                       const PlanesShape& in, const PlanesShape& out) {
  auto net = std::make_unique<Net>(Net{.net = {}, .in = in});
  try {
    net->net = cv::dnn::readNetFromONNX(onnx.data(), onnx.size());
    net->net.setPreferableBackend(cv::dnn::DNN_BACKEND_OPENCV);
    std::vector<float> nothing(in.size(), 0.0F);
    const cv::Mat blob = net->run(nothing);
    if (!has_shape(blob, out))
      return refuse(name, "expected an output of " + shape_text(out) + ", got " +
                              axes_text(blob.size.p, blob.dims));
  } catch (const cv::Exception& error) {
    return refuse(name,
                  "expected an ONNX network with an input of " + shape_text(in) + ": " + error.err);
  }
  return Network{std::move(net)};
}

std::vector<float> Network::run(std::vector<float>& planes) {
  CHECK(planes.size() == net_->in.size());
  const cv::Mat out = net_->run(planes);
  const auto* const first = out.ptr<float>();
  return {first, first + out.total()};
}

}  // namespace pitwall::perception
