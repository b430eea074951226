// Animated GIF by giflib.
#include <gif_lib.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "base/atomic_write.h"
#include "base/errors.h"
#include "base/printable.h"
#include "draw/film/film_encoder.h"

namespace hooke {
namespace {

constexpr int unchanged = 255;  // the color of the pixels of the previous picture that stay

// Added to a channel, of which GifQuantizeBuffer keeps five bits: without it, gradients have bands. After Bayer (1973).
constexpr int dither[4][4] = {{0, 4, 1, 5}, {6, 2, 7, 3}, {1, 5, 0, 4}, {7, 3, 6, 2}};

int append(GifFileType* gif, const GifByteType* bytes, int count) {
  static_cast<std::string*>(gif->UserData)->append(reinterpret_cast<const char*>(bytes), static_cast<std::size_t>(count));
  return count;
}

class GifEncoder : public FilmEncoder {
 public:
  GifEncoder(const std::filesystem::path& file, int width, int height, double frame_rate)
      : file_(file),
        out_(file),
        frame_rate_(frame_rate),
        gif_(EGifOpen(&bytes_, append, nullptr)),
        colors_(GifMakeMapObject(256, nullptr)) {
    if (gif_ == nullptr || colors_ == nullptr) throw FileError(printable(file_.native()) + ": out of memory");
    EGifSetGifVersion(gif_, true);
    check(EGifPutScreenDesc(gif_, width, height, 8, 0, nullptr));
    check(EGifPutExtensionLeader(gif_, APPLICATION_EXT_FUNC_CODE));
    check(EGifPutExtensionBlock(gif_, 11, "NETSCAPE2.0"));
    check(EGifPutExtensionBlock(gif_, 3, "\1\0\0"));  // repeated for ever
    check(EGifPutExtensionTrailer(gif_));
  }
  ~GifEncoder() override {
    GifFreeMapObject(colors_);
    EGifCloseFile(gif_, nullptr);
  }

  void add(const Picture& picture, long frames) override {
    frames_ += frames;
    // [1/100 s]: programs show shorter pictures for 0.1 s, so the next one covers the time of such a picture
    const long delay = std::lround(100.0 * static_cast<double>(frames_) / frame_rate_) - shown_;
    if (delay < 2) return;
    shown_ += delay;
    std::vector<GifByteType> pixels = indices(picture);
    const GraphicsControlBlock control{DISPOSE_DO_NOT, false, static_cast<int>(std::min(delay, 65535L)), unchanged};
    GifByteType block[4];
    check(EGifPutExtension(gif_, GRAPHICS_EXT_FUNC_CODE, static_cast<int>(EGifGCBToExtension(&control, block)), block));
    check(EGifPutImageDesc(gif_, 0, 0, picture.width, picture.height, false, colors_));
    for (int y = 0; y < picture.height; ++y)
      check(EGifPutLine(gif_, &pixels[static_cast<std::size_t>(y) * static_cast<std::size_t>(picture.width)], picture.width));
    out_.write(bytes_);
    bytes_.clear();
    before_ = picture;
  }

  void close(const std::string& comment) override {
    if (!comment.empty()) check(EGifPutComment(gif_, comment.c_str()));
    out_.write(bytes_ + ";");
    out_.commit();
  }

 private:
  // The pixels as numbers of colors_, chosen for those that differ from the previous picture.
  std::vector<GifByteType> indices(const Picture& now) {
    const std::size_t count = now.pixels.size() / 3;
    std::vector<GifByteType> all(count, unchanged), red, green, blue;
    std::vector<std::size_t> changed;
    for (std::size_t i = 0; i < count; ++i) {
      if (!before_.pixels.empty() && std::equal(&now.pixels[3 * i], &now.pixels[3 * i] + 3, &before_.pixels[3 * i])) continue;
      changed.push_back(i);
      const std::size_t width = static_cast<std::size_t>(now.width);
      const int noise = dither[i / width % 4][i % width % 4];
      for (const auto& [plane, channel] : {std::pair(&red, 0), std::pair(&green, 1), std::pair(&blue, 2)})
        plane->push_back(static_cast<GifByteType>(std::min(now.pixels[3 * i + channel] + noise, 255)));
    }
    if (changed.empty()) return all;
    std::vector<GifByteType> chosen(changed.size());
    int colors = unchanged;
    check(GifQuantizeBuffer(static_cast<unsigned>(changed.size()), 1, &colors, red.data(), green.data(), blue.data(), chosen.data(),
                            colors_->Colors));
    for (std::size_t i = 0; i < changed.size(); ++i) all[changed[i]] = chosen[i];
    return all;
  }

  void check(int result) const {
    if (result != GIF_OK) throw FileError(printable(file_.native()) + ": the picture could not be encoded");
  }

  std::filesystem::path file_;
  AtomicFile out_;
  double frame_rate_;
  long frames_ = 0, shown_ = 0;  // added; [1/100 s] until the end of the last picture written
  std::string bytes_;            // to be written
  GifFileType* gif_;
  ColorMapObject* colors_;
  Picture before_;
};

}  // namespace

std::unique_ptr<FilmEncoder> start_gif(const std::filesystem::path& file, int width, int height, double frame_rate) {
  return std::make_unique<GifEncoder>(file, width, height, frame_rate);
}

}  // namespace hooke
