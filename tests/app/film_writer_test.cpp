// Films of the window, with a fake ffmpeg.
#include "app/media/film_writer.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cstdlib>
#include <fstream>

#include "base/errors.h"
#include "formats/png_picture.h"
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

TEST(FilmWriter, WritesAnimatedPicturesWithoutFfmpeg) {
  const ScratchFolder scratch;
  const fs::path file = scratch.folder / "film.png";
  {
    FilmWriter writer(file, 64, 36, 30.0);
    Picture picture = gray(64, 36);
    EXPECT_TRUE(writer.add(picture, 3));
    picture.pixels[300] = 7;
    EXPECT_TRUE(writer.add(picture, 1));
    writer.end();
    while (!writer.result()) std::this_thread::sleep_for(std::chrono::milliseconds(5));
    EXPECT_EQ(*writer.result(), "");
  }
  const std::string bytes = contents(file);
  const auto begin = bytes.find("acTL");
  ASSERT_NE(begin, std::string::npos);
  EXPECT_EQ(bytes[begin + 7], 2) << "pictures";
  // the sequence is 0 fcTL, 1 fcTL, 2 fdAT; the first is shown for 0.1 s
  const auto first = bytes.find("fcTL"), second = bytes.find("fcTL", first + 4), data = bytes.find("fdAT");
  ASSERT_NE(data, std::string::npos);
  EXPECT_EQ(bytes[first + 7], 0);
  EXPECT_EQ(bytes[second + 7], 1);
  EXPECT_EQ(bytes[data + 7], 2);
  EXPECT_EQ(bytes[first + 25], 100);
  EXPECT_EQ(decode_png(bytes, "film.png").width, 64) << "a program that knows no animation shows the first picture";
}

}  // namespace
}  // namespace hooke
