#include "formats/gallery.h"

#include <algorithm>

#include "base/json_field.h"
#include "base/json_text.h"
#include "base/printable.h"
#include "base/read_file.h"
#include "formats/png_picture.h"

namespace hooke {
namespace {

std::string description_in(const std::filesystem::path& file) {
  std::string description;
  const std::string name = printable(file.native());
  try {
    const std::string text = read_file(file);
    JsonParser parser;
    const auto read_member = [&](std::string_view key, std::string_view value) {
      if (key == "description") description = JsonField(name, key, parser.parse(value)).text();
    };
    walk_json(text, name,
              {.is_list = [](std::string_view) { return false; },
               .item = [](std::string_view, std::size_t, std::string_view) {},
               .member = read_member});
  } catch (const std::runtime_error&) {  // Refused or FileError: opening it says more
    description.clear();
  }
  return description;
}

constexpr std::uint8_t placeholder_gray = 0x20;

void blit(const Picture& thumbnail, Picture& atlas, int left, int top) {
  if (thumbnail.width != thumbnail_width || thumbnail.height != thumbnail_height) return;
  for (int y = 0; y < thumbnail.height; ++y) {
    const auto from = thumbnail.pixels.begin() + std::ptrdiff_t{3} * y * thumbnail.width;
    std::copy_n(from, 3 * thumbnail.width, atlas.pixels.begin() + std::ptrdiff_t{3} * ((top + y) * atlas.width + left));
  }
}

}  // namespace

const std::vector<GalleryCard>& gallery_cards() {
  static const std::vector<GalleryCard> cards = [] {
    std::vector<GalleryCard> result;
    for (const ShippedScene& scene : shipped_scenes()) result.push_back({&scene, description_in(scene.file)});
    return result;
  }();
  return cards;
}

std::filesystem::path thumbnail_file(const ShippedScene& scene) {
  return scene.file.parent_path().parent_path() / "thumbnails" / (scene.id + ".png");
}

Picture read_thumbnails() {
  const auto count = static_cast<int>(shipped_scenes().size()), rows = (count + thumbnail_columns - 1) / thumbnail_columns;
  Picture atlas{.width = thumbnail_columns * thumbnail_width, .height = rows * thumbnail_height};
  atlas.pixels.assign(std::size_t{3} * atlas.width * atlas.height, placeholder_gray);
  for (int i = 0; i < count; ++i) {
    const std::filesystem::path file = thumbnail_file(shipped_scenes()[static_cast<std::size_t>(i)]);
    try {
      blit(decode_png(read_file(file), printable(file.native())), atlas, i % thumbnail_columns * thumbnail_width,
           i / thumbnail_columns * thumbnail_height);
    } catch (const std::runtime_error&) {  // Refused or FileError: a card without a picture is still a card
    }
  }
  return atlas;
}

}  // namespace hooke
