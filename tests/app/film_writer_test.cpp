// Films of the window, with a fake ffmpeg.
#include "app/media/film_writer.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cstdlib>
#include <fstream>

#include "base/errors.h"
#include "support/contents.h"
#include "support/scratch_folder.h"

namespace hooke {
namespace {

namespace fs = std::filesystem;

// A fake ffmpeg that reads nothing until a file `go` exists.
struct LateFfmpeg {
  ScratchFolder scratch;
  std::string path = std::getenv("PATH");
  LateFfmpeg() {
    const fs::path program = scratch.folder / "ffmpeg";
    std::ofstream(program) << "#!/bin/sh\nwhile [ ! -e '" << (scratch.folder / "go").string() << "' ]; do sleep 0.02; done\n"
                           << "for last; do :; done\nexec cat >\"${last#file:}\"\n";
    fs::permissions(program, fs::perms::owner_all);
    ::setenv("PATH", (scratch.folder.string() + ":" + path).c_str(), 1);
  }
  ~LateFfmpeg() { ::setenv("PATH", path.c_str(), 1); }
  fs::path film() const { return scratch.folder / "a.mp4"; }
};

Picture gray(int width, int height) {
  return {.width = width, .height = height, .pixels = std::vector<std::uint8_t>(static_cast<std::size_t>(3 * width * height), 100)};
}

TEST(FilmWriter, AcceptsPicturesWithoutWaitingUntilTheQueueIsFull) {
  const LateFfmpeg ffmpeg;
  FilmWriter writer(ffmpeg.film(), 1280, 720, 30.0);
  std::uintmax_t taken = 0;
  while (writer.add(gray(1280, 720), 1)) ++taken;
  EXPECT_GT(taken, 10u);
  EXPECT_LT(taken, 50u);
  EXPECT_FALSE(writer.result());

  std::ofstream(ffmpeg.scratch.folder / "go") << "go";
  writer.end();
  while (!writer.result()) std::this_thread::sleep_for(std::chrono::milliseconds(5));
  EXPECT_EQ(*writer.result(), "");
  EXPECT_EQ(fs::file_size(ffmpeg.film()), taken * 3 * 1280 * 720);
}

TEST(FilmWriter, RepeatsAPictureForEveryFrameItCovers) {
  const LateFfmpeg ffmpeg;
  std::ofstream(ffmpeg.scratch.folder / "go") << "go";
  {
    FilmWriter writer(ffmpeg.film(), 64, 36, 30.0);
    EXPECT_TRUE(writer.add(gray(64, 36), 3));
    EXPECT_TRUE(writer.add(gray(64, 36), 1));
    writer.end();
  }  // the destructor waits
  EXPECT_EQ(fs::file_size(ffmpeg.film()), 4u * 3 * 64 * 36);
}

TEST(FilmWriter, RemovesAnUnfinishedFilmEvenIfFfmpegReadsNothing) {
  const LateFfmpeg ffmpeg;
  {
    FilmWriter writer(ffmpeg.film(), 1280, 720, 30.0);
    EXPECT_TRUE(writer.add(gray(1280, 720), 1));
  }
  EXPECT_FALSE(fs::exists(ffmpeg.film()));
  EXPECT_EQ(std::distance(fs::directory_iterator(ffmpeg.scratch.folder), {}), 1) << "only the fake ffmpeg";
}

// A film of two pictures without ffmpeg, the first for 3 frames of 1/30 s.
std::string film_of_two(const char* name, int channels = 3) {
  const ScratchFolder scratch;
  const fs::path file = scratch.folder / name;
  FilmWriter writer(file, 64, 36, 30.0);
  Picture picture = gray(64, 36);
  picture.channels = channels;
  picture.pixels.resize(static_cast<std::size_t>(channels) * 64u * 36u, 100);
  EXPECT_TRUE(writer.add(picture, 3));
  picture.pixels[300] = 7;
  EXPECT_TRUE(writer.add(picture, 1));
  writer.end();
  while (!writer.result()) std::this_thread::sleep_for(std::chrono::milliseconds(5));
  EXPECT_EQ(*writer.result(), "");
  return contents(file);
}

int count_of(std::string_view part, std::string_view text) {
  int count = 0;
  for (std::size_t at = text.find(part); at != text.npos; at = text.find(part, at + 1)) ++count;
  return count;
}

TEST(FilmWriter, WritesAnimatedWebp) {
  const std::string bytes = film_of_two("film.webp");
  EXPECT_EQ(bytes.substr(8, 8), "WEBPVP8X");
  EXPECT_EQ(count_of("ANMF", bytes), 2);
  EXPECT_EQ(bytes[bytes.find("ANMF") + 20], 100) << "ms";
}

TEST(FilmWriter, WritesWebpWithTheOpacityOfItsPictures) {
  constexpr int has_opacity = 0x10;  // in the flags of the chunk VP8X
  EXPECT_EQ(film_of_two("film.webp")[20] & has_opacity, 0);
  EXPECT_EQ(film_of_two("film.webp", 4)[20] & has_opacity, has_opacity);
}

TEST(FilmWriter, WritesAnimatedGifs) {
  const std::string bytes = film_of_two("film.gif");
  EXPECT_EQ(bytes.substr(0, 6), "GIF89a");
  EXPECT_EQ(bytes.back(), ';');
  EXPECT_EQ(count_of("NETSCAPE2.0", bytes), 1) << "it is repeated";
  const std::string control = "\x21\xf9\x04";
  EXPECT_EQ(count_of(control, bytes), 2);
  EXPECT_EQ(bytes[bytes.find(control) + 4], 10) << "hundredths of a second";
}

// 60 pictures per second would be shown with 10 per second: the format has hundredths of a second, and programs do not show 1.
TEST(FilmWriter, WritesGifsOfNotMoreThan50PicturesPerSecond) {
  const ScratchFolder scratch;
  const fs::path file = scratch.folder / "film.gif";
  {
    FilmWriter writer(file, 64, 36, 60.0);
    for (int i = 0; i < 60; ++i) EXPECT_TRUE(writer.add(gray(64, 36), 1));
    writer.end();
  }
  const std::string bytes = contents(file), control("\x21\xf9\x04", 3);
  int hundredths = 0;
  for (std::size_t at = bytes.find(control); at != bytes.npos; at = bytes.find(control, at + 1)) {
    EXPECT_GE(bytes[at + 4], 2);
    hundredths += bytes[at + 4];
  }
  EXPECT_EQ(hundredths, 100);
}

}  // namespace
}  // namespace hooke
