// Where the device gets its context from.
#include <gtest/gtest.h>

#include <memory>
#include <stdexcept>

#include "sim/methods/rows.h"
#include "sim/model/hash.h"
#include "support/counted_device.h"
#include "support/run_lab.h"

namespace hooke {
namespace {

std::shared_ptr<GpuDevice> device_of(ContextKind kind) {
  try {
    return std::make_shared<GpuDevice>(std::function<void(GlFunctions&)>(), std::initializer_list<ContextKind>{kind});
  } catch (const std::runtime_error&) {
    return nullptr;
  }
}

// The code of graphics cards, with Mesa's software device.
TEST(GpuContext, OfEglWithoutASurfaceComputesTheSameBitsAsOsMesa) {
  std::vector<std::uint64_t> hashes;
  for (const ContextKind kind : {ContextKind::OsMesa, ContextKind::SoftwareEgl}) {
    const std::shared_ptr<GpuDevice> device = device_of(kind);
    ASSERT_NE(device, nullptr) << "needs libegl-mesa0 and libosmesa6";
    EXPECT_NE(device->renderer().find(", OpenGL 4."), std::string::npos) << device->renderer();
    Lab lab(weak_sheet(velocity_verlet_explicit), KeepStart::No);
    lab.set_execution({.device = device});
    run(lab, 10);
    EXPECT_EQ(lab.device_refusal(), "");
    hashes.push_back(hash_state(lab.scene().state));
  }
  EXPECT_EQ(hashes[0], hashes[1]);
}

TEST(GpuContext, OfSoftwareIsNoCardWhateverMadeIt) {
  for (const ContextKind kind : {ContextKind::OsMesa, ContextKind::SoftwareEgl}) EXPECT_FALSE(ComputeContext({}, {kind}).is_card());
}

TEST(GpuContext, SeveralLiveSideBySide) {
  const std::shared_ptr<GpuDevice> first = device_of(ContextKind::SoftwareEgl), second = device_of(ContextKind::OsMesa);
  ASSERT_TRUE(first != nullptr && second != nullptr) << "needs libegl-mesa0 and libosmesa6";
  Lab one(weak_sheet(velocity_verlet_explicit), KeepStart::No), other(weak_sheet(velocity_verlet_explicit), KeepStart::No);
  one.set_execution({.device = first});
  other.set_execution({.device = second});
  for (int i = 0; i < 3; ++i) {
    run(one, 1);
    run(other, 1);
  }
  EXPECT_EQ(hash_state(one.scene().state), hash_state(other.scene().state));
  EXPECT_EQ(one.device_refusal() + other.device_refusal(), "");
}

}  // namespace
}  // namespace hooke
