// A device that fails: the scene goes on on the processor from the last good frame.
#include <gtest/gtest.h>

#include "device/gpu_device.h"
#include "sim/methods/rows.h"
#include "sim/model/hash.h"
#include "support/run_lab.h"

namespace hooke {
namespace {

// The functions of the driver, and whether they fail now.
GlFunctions driver;
bool fails = false;

struct Fault {
  bool is_at_start;  // where shaders are compiled and large buffers filled
  const char* line;  // what the user reads
  void (*inject)(GlFunctions& gl);
};

const Fault faults[] = {
    {true, "the driver refuses the shader move.comp: ",
     [](GlFunctions& gl) {
       gl.ShaderSource = [](GLuint shader, GLsizei count, const GLchar* const* text, const GLint* lengths) {
         const GLchar* broken = "#version 430\nvoid main() { broken }\n";
         fails ? driver.ShaderSource(shader, 1, &broken, nullptr) : driver.ShaderSource(shader, count, text, lengths);
       };
     }},
    {false, "out of memory",
     [](GlFunctions& gl) {
       gl.BufferData = [](GLenum target, GLsizeiptr bytes, const void* data, GLenum use) {
         fails ? driver.BufferData(target, GLsizeiptr{1} << 60, nullptr, use) : driver.BufferData(target, bytes, data, use);
       };
     }},
    {true, "its buffers contain at most 1000 bytes",
     [](GlFunctions& gl) {
       gl.GetInteger64v = [](GLenum name, GLint64* value) { driver.GetInteger64v(name, value), *value = fails ? 1000 : *value; };
     }},
    {false, "the context of OpenGL was lost",
     [](GlFunctions& gl) { gl.GetError = []() -> GLenum { return fails ? GL_CONTEXT_LOST : driver.GetError(); }; }},
    // without a word
    {false, "the context of OpenGL was lost",
     [](GlFunctions& gl) {
       gl.GetBufferSubData = [](GLenum target, GLintptr begin, GLsizeiptr bytes, void* data) {
         if (!fails) driver.GetBufferSubData(target, begin, bytes, data);
       };
     }},
};

// It tears, falls on a plane and has dashpots.
Scene falling_sheet() {
  Scene scene = weak_sheet(velocity_verlet_explicit);
  scene.system.colliders.push_back({.shape = Plane{.point = {0, -0.9, 0}, .normal = {0, 1, 0}}});
  return scene;
}

TEST(GpuFailure, TheProcessorGoesOnFromTheLastGoodFrame) {
  for (const Fault& fault : faults)
    for (const int good : {0, 5}) {
      if (good > 0 && fault.is_at_start) continue;
      fails = false;
      const auto device = std::make_shared<GpuDevice>([&](GlFunctions& gl) {
        driver = gl;
        fault.inject(gl);
      });
      Lab lab(falling_sheet(), KeepStart::No);
      lab.set_execution({.device = device});
      run(lab, good);
      EXPECT_EQ(lab.device_refusal(), "") << fault.line;
      Lab expected(lab.scene(), KeepStart::No);

      fails = true;
      run(lab, 30);
      run(expected, 30);
      EXPECT_EQ(hash_state(lab.scene().state), hash_state(expected.scene().state)) << fault.line;
      const std::string refusal = lab.device_refusal();
      EXPECT_EQ(refusal.rfind("the GPU stopped: " + std::string(fault.line), 0), 0u) << refusal;
      EXPECT_EQ(refusal.find('\n'), std::string::npos) << refusal;
      EXPECT_EQ(lab.plan().execution.device, nullptr);
    }
}

TEST(GpuFailure, AnotherDeviceTakesOver) {
  fails = true;
  const auto failing = std::make_shared<GpuDevice>([&](GlFunctions& gl) {
    driver = gl;
    faults[1].inject(gl);
  });
  Lab lab(falling_sheet());
  lab.submit(SetDevice{failing});
  run(lab, 2);
  lab.publish();
  EXPECT_EQ(lab.status()->run.device_refusal, "the GPU stopped: out of memory");
  lab.submit(SetDevice{std::make_shared<GpuDevice>()});
  run(lab, 2);
  lab.publish();
  EXPECT_TRUE(lab.status()->run.on_device);
  EXPECT_EQ(lab.status()->run.device_refusal, "");
  lab.submit(SetDevice{});
  run(lab, 2);
  lab.publish();
  EXPECT_FALSE(lab.status()->run.on_device);
}

}  // namespace
}  // namespace hooke
