#include "draw/film/film_encoder.h"

namespace hooke {

std::string xmp_packet(const std::string& description) {
  return "<x:xmpmeta xmlns:x='adobe:ns:meta/'><rdf:RDF xmlns:rdf='http://www.w3.org/1999/02/22-rdf-syntax-ns#'><rdf:Description "
         "rdf:about='' xmlns:dc='http://purl.org/dc/elements/1.1/'><dc:description><rdf:Alt><rdf:li xml:lang='x-default'>" +
         description + "</rdf:li></rdf:Alt></dc:description></rdf:Description></rdf:RDF></x:xmpmeta>";
}

StartFilm* find_film_format(const std::filesystem::path& file) {
  const std::filesystem::path extension = file.extension();
  if (extension == ".mp4") return start_mp4;
  if (extension == ".webp") return start_webp;
  return extension == ".gif" ? start_gif : nullptr;
}

}  // namespace hooke
