// What a scene's `texture` names: one that ships, or a PNG that lies in the scene's folder; and where on it each point lies.
#pragma once

#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <string_view>

#include "scene/scene.h"

namespace hooke {

struct ShippedTexture {
  std::string_view id;     // in files
  std::string_view title;  // in the menu
  double width;            // [m] of cloth that its image is wide
};
std::span<const ShippedTexture> shipped_textures();

// What a text must be to name a texture, if it does not; empty: it does. Nothing is opened.
std::string texture_limit(std::string_view texture);

// The picture of one that ships, or of a PNG within `folder`: a way that leaves it, through a link too, is refused. Throws
// Refused or FileError; `name` stands for the texture in messages.
std::shared_ptr<const Picture> read_texture(const std::string& texture, const std::filesystem::path& folder, const std::string& name);

// Makes the print agree with the view's texture: its width, and places on the cloth for the points of faces that have
// none, as they are seen now in the plane that the faces lie in on the whole. Nothing without a texture.
void set_print_layout(Scene& scene);

}  // namespace hooke
