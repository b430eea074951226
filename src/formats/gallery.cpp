#include "formats/gallery.h"

#include <algorithm>

#include "base/printable.h"
#include "base/read_file.h"
#include "formats/png_picture.h"
#include "formats/scene_json/scene_fields.h"

namespace hooke {
namespace {

constexpr std::uint8_t placeholder_gray = 0x20;

void blit(const Picture& thumbnail, Picture& atlas, int left, int top) {
  if (thumbnail.width != thumbnail_width || thumbnail.height != 2 * thumbnail_height) return;
  for (int y = 0; y < thumbnail.height; ++y) {
    const auto from = thumbnail.pixels.begin() + std::ptrdiff_t{3} * y * thumbnail.width;
    std::copy_n(from, 3 * thumbnail.width, atlas.pixels.begin() + std::ptrdiff_t{3} * ((top + y) * atlas.width + left));
  }
}

}  // namespace

GalleryEntry read_gallery_entry(const JsonField& field) {
  GalleryEntry entry;
  for (const JsonField member : field.members()) {
    if (member.is("group"))
      entry.group = member.text();
    else if (member.is("order"))
      entry.order = static_cast<int>(member.integer(0, 1'000'000));
    else if (member.is("thumbnail_seconds"))
      entry.thumbnail_seconds = member.number({.min = 0.0, .max = 60.0});
  }
  required(field, "group", "must be a string");
  return entry;
}

const std::vector<GalleryCard>& gallery_cards() {
  static const std::vector<GalleryCard> cards = [] {
    std::vector<GalleryCard> result;
    for (const ShippedScene& scene : shipped_scenes()) result.push_back({&scene, scene.description});
    return result;
  }();
  return cards;
}

std::filesystem::path thumbnail_file(const ShippedScene& scene) { return assets_folder() / "thumbnails" / (scene.id + ".png"); }

Picture read_thumbnails() {
  const auto count = static_cast<int>(shipped_scenes().size()), rows = (count + thumbnail_columns - 1) / thumbnail_columns;
  Picture atlas{.width = thumbnail_columns * thumbnail_width, .height = 2 * rows * thumbnail_height};
  atlas.pixels.assign(std::size_t{3} * atlas.width * atlas.height, placeholder_gray);
  for (int i = 0; i < count; ++i) {
    const std::filesystem::path file = thumbnail_file(shipped_scenes()[static_cast<std::size_t>(i)]);
    try {
      blit(decode_png(read_file(file), printable(file.native())), atlas, i % thumbnail_columns * thumbnail_width,
           i / thumbnail_columns * 2 * thumbnail_height);
    } catch (const std::runtime_error&) {  // InputError or FileError: the card has no picture
    }
  }
  return atlas;
}

}  // namespace hooke
