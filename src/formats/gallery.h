// The gallery of shipped scenes: a card for each, with a description and a thumbnail.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "base/json_field.h"
#include "formats/scene_file.h"

namespace hooke {

// [px], of one; a file has two, the one for a light background below.
inline constexpr int thumbnail_width = 288, thumbnail_height = 180;

// The field "gallery" of a scene file, which lists the scene.
struct GalleryEntry {
  std::string group;               // heading in the menu
  int order = 0;                   // position among all scenes; the scenes of a group are consecutive
  double thumbnail_seconds = 0.0;  // [s] of simulated time at which the thumbnail is taken
};

// Throws InputError.
GalleryEntry read_gallery_entry(const JsonField& field);

struct GalleryCard {
  const ShippedScene* scene;
  std::string description;  // of the scene file
};

// In the order of shipped_scenes().
const std::vector<GalleryCard>& gallery_cards();

// The file of a scene's thumbnail.
std::filesystem::path thumbnail_file(const ShippedScene& scene);

// All thumbnails in one picture, `thumbnail_columns` in a row, in the order of shipped_scenes(); gray where one is missing.
inline constexpr int thumbnail_columns = 6;
Picture read_thumbnails();

}  // namespace hooke
