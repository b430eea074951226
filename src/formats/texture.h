// Textures of scenes: shipped ones, or a PNG in the folder of the scene, and the texture coordinates of points.
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
  double width;            // [m], of the image on the cloth
};
std::span<const ShippedTexture> shipped_textures();
bool is_shipped_texture(std::string_view id);

// Why a string is not a valid name of a texture; empty if it is valid. Opens no file.
std::string texture_limit(std::string_view texture);

// The picture of a shipped texture, or of a PNG within `folder`; refuses paths that leave it or pass through a link. Throws InputError or
// FileError; `name` is the texture in messages.
std::shared_ptr<const Picture> read_texture(const std::string& texture, const std::filesystem::path& folder, const std::string& name);

// Sets the width of the view's texture, and texture coordinates for the points of faces that have none: their
// current positions projected on the mean plane of the faces. Does nothing without a texture.
void set_print_layout(Scene& scene);

}  // namespace hooke
