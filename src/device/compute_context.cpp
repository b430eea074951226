#include "device/compute_context.h"

#include <dlfcn.h>

#include <array>
#include <future>
#include <memory>
#include <stdexcept>
#include <string_view>
#include <vector>

namespace hooke {
namespace {

using Handle = ComputeContext::Handle;

// A shared library; its functions are null if it is not installed.
class Library {
 public:
  explicit Library(const char* file) : library_(dlopen(file, RTLD_NOW | RTLD_LOCAL)) {}
  template <class Function>
  Function* function(const char* name) const {
    return library_ == nullptr ? nullptr : reinterpret_cast<Function*>(dlsym(library_, name));
  }

 private:
  void* library_;
};

// The contexts of EGL devices, without a surface: of graphics cards, or of software. (EGL_EXT_device_enumeration, EGL_EXT_device_query,
// EGL_EXT_platform_device)
std::vector<Handle> egl_contexts(bool of_software) {
  constexpr int extensions = 0x3055, platform_device = 0x313F, opengl_api = 0x30A2;
  constexpr std::array<int, 5> config_wanted{0x3040, 0x0008, 0x3033, -1, 0x3038};  // renderable: OpenGL; any surface; end
  // where that exists, one that says when it was lost; 4.3; core profile; end
  constexpr std::array<int, 9> wanted{0x31BD, 0x31BF, 0x3098, 4, 0x30FB, 3, 0x30FD, 1, 0x3038};
  const Library egl("libEGL.so.1");
  const auto find = egl.function<void*(const char*)>("eglGetProcAddress");
  const auto initialize = egl.function<int(void*, int*, int*)>("eglInitialize");
  const auto bind = egl.function<int(int)>("eglBindAPI");
  const auto choose = egl.function<int(void*, const int*, void**, int, int*)>("eglChooseConfig");
  const auto create = egl.function<void*(void*, void*, void*, const int*)>("eglCreateContext");
  const auto destroy = egl.function<int(void*, void*)>("eglDestroyContext");
  const auto make_current = egl.function<int(void*, void*, void*, void*)>("eglMakeCurrent");
  if (!find || !initialize || !bind || !choose || !create || !destroy || !make_current) return {};
  const auto query = reinterpret_cast<int (*)(int, void**, int*)>(find("eglQueryDevicesEXT"));
  const auto text_of = reinterpret_cast<const char* (*)(void*, int)>(find("eglQueryDeviceStringEXT"));
  const auto get_display = reinterpret_cast<void* (*)(int, void*, const int*)>(find("eglGetPlatformDisplayEXT"));
  std::array<void*, 16> devices{};
  int count = 0;
  if (!query || !text_of || !get_display || !query(static_cast<int>(devices.size()), devices.data(), &count)) return {};

  std::vector<Handle> contexts;
  for (int d = 0; d < count; ++d) {
    const char* text = text_of(devices[d], extensions);
    const bool is_software = text != nullptr && std::string_view(text).find("EGL_MESA_device_software") != std::string_view::npos;
    if (is_software != of_software) continue;
    void *const display = get_display(platform_device, devices[d], nullptr), *config = nullptr;
    int configs = 0;
    if (display == nullptr || !initialize(display, nullptr, nullptr) || !bind(opengl_api)) continue;
    if (!choose(display, config_wanted.data(), &config, 1, &configs) || configs == 0) continue;
    void* context = create(display, config, nullptr, wanted.data());
    if (context == nullptr) context = create(display, config, nullptr, wanted.data() + 2);
    if (context == nullptr) continue;
    // the chosen interface, of which no context is released, is that of the thread
    contexts.push_back(
        {.make_current = [=](bool on) { return bind(opengl_api) && make_current(display, nullptr, nullptr, on ? context : nullptr) != 0; },
         .find = find,
         .destroy = [=] { destroy(display, context); }});
  }
  return contexts;
}

// The context of the software renderer, which needs a picture, of one pixel.
std::vector<Handle> osmesa_contexts() {
  constexpr std::array<int, 9> wanted{0x22, 0x1908, 0x33, 0x34, 0x36, 4, 0x37, 3, 0};  // RGBA; core profile; 4.3; end
  constexpr unsigned bytes = 0x1401;
  const Library mesa("libOSMesa.so.8");
  const auto create = mesa.function<void*(const int*, void*)>("OSMesaCreateContextAttribs");
  const auto make_current = mesa.function<unsigned char(void*, void*, unsigned, int, int)>("OSMesaMakeCurrent");
  const auto find = mesa.function<void*(const char*)>("OSMesaGetProcAddress");
  const auto destroy = mesa.function<void(void*)>("OSMesaDestroyContext");
  if (!create || !make_current || !find || !destroy) return {};
  void* const context = create(wanted.data(), nullptr);
  if (context == nullptr) return {};
  const auto pixel = std::make_shared<std::array<unsigned char, 4>>();
  return {
      {.make_current =
           [=](bool on) { return (on ? make_current(context, pixel->data(), bytes, 1, 1) : make_current(nullptr, nullptr, 0, 0, 0)) != 0; },
       .find = find,
       .destroy = [=] { destroy(context); }}};
}

}  // namespace

ComputeContext::ComputeContext(const std::function<void(GlFunctions&)>& change, std::initializer_list<ContextKind> kinds) {
  for (const ContextKind kind : kinds) {
    if (!renderer_.empty()) break;
    for (const Handle& handle : kind == ContextKind::OsMesa ? osmesa_contexts() : egl_contexts(kind == ContextKind::SoftwareEgl))
      if (!renderer_.empty() || !take(handle)) handle.destroy();
  }
  // also of a driver for a card that it does not know
  is_card_ = renderer_.find("llvmpipe") == std::string::npos && renderer_.find("softpipe") == std::string::npos;
  if (change) change(gl_);
  if (renderer_.empty())
    throw std::runtime_error("no OpenGL 4.3, neither of a graphics card (libEGL.so.1) nor of the software renderer (libOSMesa.so.8)");
}

ComputeContext::~ComputeContext() {
  if (handle_.destroy) handle_.destroy();
}

bool ComputeContext::take(const Handle& handle) {
  const auto load = [&] {
    if (!handle.make_current(true)) return false;
    const auto text = [&](GLenum name) { return std::string(reinterpret_cast<const char*>(gl_.GetString(name))); };
    if (gl_.load(handle.find)) renderer_ = text(GL_RENDERER) + ", OpenGL " + text(GL_VERSION);
    handle.make_current(false);
    return !renderer_.empty();
  };
  if (!std::async(std::launch::async, load).get()) return false;
  handle_ = handle;
  return true;
}

void ComputeContext::run(const std::function<void(const GlFunctions& gl)>& work) {
  const auto run = [&] {
    if (!handle_.make_current(true)) throw std::runtime_error(lost_context);
    const std::shared_ptr<void> leave(nullptr, [&](void*) { handle_.make_current(false); });
    work(gl_);
  };
  std::async(std::launch::async, run).get();
}

}  // namespace hooke
