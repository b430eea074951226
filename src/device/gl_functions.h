// The functions of OpenGL 4.3 that compute shaders need, of the library that made the context. The picture uses GLEW and its own context.
#pragma once

#include <GL/glcorearb.h>

#include <functional>

namespace hooke {

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
#define HOOKE_LOAD(name, type) all = (name = reinterpret_cast<PFNGL##type##PROC>(find("gl" #name))) != nullptr && all;
    HOOKE_GL_FUNCTIONS(HOOKE_LOAD)
    return all;
  }
};

}  // namespace hooke
