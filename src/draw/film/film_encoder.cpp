#include "draw/film/film_encoder.h"

namespace hooke {

StartFilm* find_film_format(const std::filesystem::path& file) {
  const std::filesystem::path extension = file.extension();
  if (extension == ".mp4") return start_mp4;
  if (extension == ".webp") return start_webp;
  return extension == ".gif" ? start_gif : nullptr;
}

}  // namespace hooke
