// Draws the panels: ImGui's triangle lists, through GLEW like the rest of the picture.
#pragma once

#include "draw/gl/gl.h"
#include "draw/gl/shader.h"
#include "scene/view_settings.h"

struct ImDrawData;

namespace hooke {

class GuiRenderer {
 public:
  GuiRenderer();
  // Of the current ImGui context; again after its fonts change.
  void upload_fonts();
  // A picture for ImGui::Image and the like; the one before it is gone.
  void* upload_picture(const Picture& picture);
  // Onto the framebuffer that is bound; leaves blending on, scissor and depth test off.
  void draw(const ImDrawData& data);

 private:
  Shader shader_{"gui"};
  GlName array_{GlKind::VertexArray}, vertices_{GlKind::Buffer}, indices_{GlKind::Buffer}, font_{GlKind::Texture},
      picture_{GlKind::Texture};
};

}  // namespace hooke
