// A context of OpenGL 4.3 without a window: of a graphics card, or else of the software renderer of Mesa. Their libraries are opened when
// they are needed, so that programs start without them.
#pragma once

#include <GL/glcorearb.h>

#include <functional>
#include <initializer_list>
#include <string>

namespace hooke {

// The functions that compute shaders need, of the library that made the context: pictures have a context of their own, with GLEW.
#define HOOKE_GL_FUNCTIONS(X)             \
  X(AttachShader, ATTACHSHADER)           \
  X(BindBuffer, BINDBUFFER)               \
  X(BindBufferBase, BINDBUFFERBASE)       \
  X(BufferData, BUFFERDATA)               \
  X(CompileShader, COMPILESHADER)         \
  X(CopyBufferSubData, COPYBUFFERSUBDATA) \
  X(CreateProgram, CREATEPROGRAM)         \
  X(CreateShader, CREATESHADER)           \
  X(DispatchCompute, DISPATCHCOMPUTE)     \
  X(GenBuffers, GENBUFFERS)               \
  X(GetBufferSubData, GETBUFFERSUBDATA)   \
  X(GetError, GETERROR)                   \
  X(GetInteger64v, GETINTEGER64V)         \
  X(GetProgramInfoLog, GETPROGRAMINFOLOG) \
  X(GetProgramiv, GETPROGRAMIV)           \
  X(GetString, GETSTRING)                 \
  X(LinkProgram, LINKPROGRAM)             \
  X(MemoryBarrier, MEMORYBARRIER)         \
  X(ShaderSource, SHADERSOURCE)           \
  X(Uniform1i, UNIFORM1I)                 \
  X(Uniform3i, UNIFORM3I)                 \
  X(UseProgram, USEPROGRAM)

struct GlFunctions {
#define HOOKE_MEMBER(name, type) PFNGL##type##PROC name = nullptr;
  HOOKE_GL_FUNCTIONS(HOOKE_MEMBER)

  // `find`: the address of a function by its name. False: one is missing.
  bool load(const std::function<void*(const char* name)>& find) {
    bool all = true;
#define HOOKE_LOAD(name, type) all = ((name) = reinterpret_cast<PFNGL##type##PROC>(find("gl" #name))) != nullptr && all;
    HOOKE_GL_FUNCTIONS(HOOKE_LOAD)
    return all;
  }
};

inline constexpr const char* lost_context = "the context of OpenGL was lost";

// Where the context comes from: a graphics card through EGL, without a surface, or the software renderer through OSMesa or EGL.
enum class ContextKind { Card, OsMesa, SoftwareEgl };
inline constexpr std::initializer_list<ContextKind> context_kinds{ContextKind::Card, ContextKind::OsMesa, ContextKind::SoftwareEgl};

class ComputeContext {
 public:
  // The first of these that this machine has. Calls `change` on the functions of OpenGL, for tests of failures. Throws std::runtime_error
  // with one line that says what is missing.
  explicit ComputeContext(const std::function<void(GlFunctions&)>& change = {}, std::initializer_list<ContextKind> kinds = context_kinds);
  ~ComputeContext();
  ComputeContext(const ComputeContext&) = delete;
  ComputeContext& operator=(const ComputeContext&) = delete;

  // Calls `work` on a thread of its own, with the context current: that of the calling thread, if it draws, stays as it is.
  void run(const std::function<void(const GlFunctions& gl)>& work);
  // "NVIDIA ..., OpenGL 4.6.0 ..."
  const std::string& renderer() const { return renderer_; }
  // Whether that is a graphics card.
  bool is_card() const { return is_card_; }

  // A context of EGL or OSMesa.
  struct Handle {
    std::function<bool(bool on)> make_current;  // for the calling thread; if not `on`, none
    std::function<void*(const char* function)> find;
    std::function<void()> destroy;
  };

 private:
  bool take(const Handle& handle);

  Handle handle_;
  GlFunctions gl_;
  std::string renderer_;
  bool is_card_ = true;
};

}  // namespace hooke
