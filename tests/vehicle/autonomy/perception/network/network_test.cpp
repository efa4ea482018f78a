// SPDX-License-Identifier: Apache-2.0
#include "vehicle/autonomy/perception/network/network.hpp"

#include <gtest/gtest.h>

#include "tests/vehicle/autonomy/perception/network/onnx_text.hpp"

namespace pitwall::perception {
namespace {

constexpr PlanesShape kShape{2, 4, 6};

std::string refusal(const std::string& onnx, const PlanesShape& out = kShape) {
  const auto network = Network::load(onnx, "net.onnx", kShape, out);
  EXPECT_FALSE(network);
  return network ? std::string() : to_string(network.error());
}

TEST(Network, WhatIsNoNetworkIsRefusedWithItsName) {
  for (const std::string& bytes : {std::string(), std::string("no network"), std::string(99, '\0')})
    EXPECT_NE(refusal(bytes).find("net.onnx: error: expected an ONNX network"), std::string::npos)
        << refusal(bytes);
}

TEST(Network, OneOfAnotherShapeIsRefusedWithBothShapes) {
  const std::string why = refusal(onnx_text("Relu", {1, 2, 4, 6}), {2, 2, 3});
  EXPECT_NE(why.find("expected an output of 1 x 2 x 2 x 3, got 1 x 2 x 4 x 6"), std::string::npos)
      << why;
}

TEST(Network, RunsItsLayers) {
  auto network = Network::load(onnx_text("Relu", {1, 2, 4, 6}), "net.onnx", kShape, kShape);
  ASSERT_TRUE(network) << to_string(network.error());
  std::vector<float> planes(kShape.size());
  for (std::size_t i = 0; i < planes.size(); ++i) planes[i] = static_cast<float>(i) - 20.0F;
  const std::vector<float> out = network->run(planes);
  ASSERT_EQ(out.size(), planes.size());
  for (std::size_t i = 0; i < out.size(); ++i) EXPECT_EQ(out[i], std::max(0.0F, planes[i])) << i;
}

}  // namespace
}  // namespace pitwall::perception
