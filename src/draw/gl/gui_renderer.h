// Draws the panels: the triangle lists of ImGui.
#pragma once

#include "draw/gl/gl.h"
#include "draw/gl/shader.h"
#include "scene/view_settings.h"

struct ImDrawData;

namespace hooke {

class GuiRenderer {
 public:
  GuiRenderer();
  // Uploads the fonts of the current ImGui context. Call again when they change.
  void upload_fonts();
  // Uploads a picture for ImGui::Image and returns its texture id. Replaces the previous picture.
  void* upload_picture(const Picture& picture);
  // Draws to the bound framebuffer. Leaves blending on, scissor and depth test off.
  void draw(const ImDrawData& data);

 private:
  Shader shader_{"gui"};
  GlName array_{GlKind::VertexArray}, vertices_{GlKind::Buffer}, indices_{GlKind::Buffer}, font_{GlKind::Texture},
      picture_{GlKind::Texture};
};

}  // namespace hooke
