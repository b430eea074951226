// Animated WebP by libwebp.
#include <webp/encode.h>
#include <webp/mux.h>

#include <cmath>

#include "base/atomic_write.h"
#include "base/errors.h"
#include "base/printable.h"
#include "draw/film/film_encoder.h"

namespace hooke {
namespace {

// Where that fails, the film stays as it is.
void add_description(WebPData& film, const std::string& description) {
  const std::string packet = xmp_packet(description);
  const WebPData chunk{reinterpret_cast<const std::uint8_t*>(packet.data()), packet.size()};
  const std::unique_ptr<WebPMux, decltype(&WebPMuxDelete)> mux(WebPMuxCreate(&film, 1), WebPMuxDelete);
  WebPData described;
  if (!mux || WebPMuxSetChunk(mux.get(), "XMP ", &chunk, 0) != WEBP_MUX_OK || WebPMuxAssemble(mux.get(), &described) != WEBP_MUX_OK) return;
  WebPDataClear(&film);
  film = described;
}

class WebpEncoder : public FilmEncoder {
 public:
  WebpEncoder(const std::filesystem::path& file, int width, int height, double frame_rate)
      : file_(file), out_(file), frame_rate_(frame_rate), encoder_(WebPAnimEncoderNew(width, height, nullptr), WebPAnimEncoderDelete) {
    WebPConfigInit(&config_);
    config_.quality = 85.0f;  // edges of thin springs stay clean
    config_.method = 2;       // the default takes twice as long for files 5 % smaller
    if (!encoder_) throw FileError(printable(file_.native()) + ": must have at most 16383 x 16383 pixels");
  }

  void add(const Picture& picture, long frames) override {
    WebPPicture pixels;
    WebPPictureInit(&pixels);
    pixels.use_argb = 1;
    pixels.width = picture.width;
    pixels.height = picture.height;
    const auto import_pixels = picture.channels == 4 ? WebPPictureImportRGBA : WebPPictureImportRGB;
    const bool is_added = import_pixels(&pixels, picture.pixels.data(), picture.channels * picture.width) != 0 &&
                          WebPAnimEncoderAdd(encoder_.get(), &pixels, now(), &config_) != 0;
    WebPPictureFree(&pixels);
    if (!is_added) fail();
    frames_ += frames;
  }

  void close(const std::string& comment) override {
    WebPData film;
    WebPDataInit(&film);
    if (WebPAnimEncoderAdd(encoder_.get(), nullptr, now(), nullptr) == 0 || WebPAnimEncoderAssemble(encoder_.get(), &film) == 0) fail();
    if (!comment.empty()) add_description(film, comment);
    const std::string bytes(reinterpret_cast<const char*>(film.bytes), film.size);
    WebPDataClear(&film);
    out_.write(bytes);
    out_.commit();
  }

 private:
  int now() const { return static_cast<int>(std::lround(1000.0 * static_cast<double>(frames_) / frame_rate_)); }  // [ms]
  [[noreturn]] void fail() const { throw FileError(printable(file_.native()) + ": " + printable(WebPAnimEncoderGetError(encoder_.get()))); }

  std::filesystem::path file_;
  AtomicFile out_;
  double frame_rate_;
  long frames_ = 0;
  WebPConfig config_;
  std::unique_ptr<WebPAnimEncoder, decltype(&WebPAnimEncoderDelete)> encoder_;
};

}  // namespace

std::unique_ptr<FilmEncoder> start_webp(const std::filesystem::path& file, int width, int height, double frame_rate) {
  return std::make_unique<WebpEncoder>(file, width, height, frame_rate);
}

}  // namespace hooke
