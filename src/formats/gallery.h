// The gallery of the scenes that ship: a card each, with what to try in words and a picture that Hooke took of it.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "formats/scene_file.h"

namespace hooke {

inline constexpr int thumbnail_width = 288, thumbnail_height = 180;  // [px]

struct GalleryCard {
  const ShippedScene* scene;
  std::string description;  // of the scene file; empty where it cannot be read
};

// In the order of shipped_scenes(). Read once; nothing but the descriptions is taken in.
const std::vector<GalleryCard>& gallery_cards();

// Where the thumbnail of a scene lies.
std::filesystem::path thumbnail_file(const ShippedScene& scene);

// All thumbnails in one picture, `thumbnail_columns` a row, in the order of shipped_scenes(); plain where one is missing.
inline constexpr int thumbnail_columns = 6;
Picture read_thumbnails();

}  // namespace hooke
