// hooke-headless capture, run as a separate process.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <sstream>
#include <tuple>
#include <vector>

#include "formats/scene_file.h"
#include "lab/lab.h"
#include "support/headless.h"
#include "support/picture.h"
#include "support/process.h"
#include "support/scratch_folder.h"

namespace hooke {
namespace {

// Runs in this folder without a display. Arguments are separated by spaces; '' is an empty one.
Outcome capture(const std::string& arguments, const std::filesystem::path& folder) {
  std::vector<std::string> words{"/usr/bin/env", "-C", folder.string(), "-u", "DISPLAY", HOOKE_HEADLESS, "capture"};
  std::istringstream text(arguments);
  for (std::string word; text >> word;) words.push_back(word == "''" ? "" : word);
  return run_process(words);
}

std::vector<std::string> files_in(const std::filesystem::path& folder) {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) names.push_back(entry.path().filename().string());
  std::sort(names.begin(), names.end());
  return names;
}

TEST(Capture, DrawsOnePictureOfTheGivenSizeAndPrintsNothing) {
  const ScratchFolder scratch;
  const Outcome outcome = capture("two_masses --out a.png --size 200x120", scratch.folder);
  EXPECT_EQ(outcome.code, 0);
  EXPECT_EQ(outcome.out, "");
  EXPECT_EQ(outcome.err, "");
  const Image image = read_png(scratch.folder / "a.png");
  EXPECT_EQ(image.width, 200);
  EXPECT_EQ(image.height, 120);
}

TEST(Capture, DrawsAFolderOfNumberedPicturesFromStartToEnd) {
  const ScratchFolder scratch;
  const Outcome outcome = capture("two_masses --out pictures --seconds 0.1 --fps 30 --size 160x90", scratch.folder);
  EXPECT_EQ(outcome.code, 0);
  EXPECT_EQ(files_in(scratch.folder / "pictures"),
            (std::vector<std::string>{"frame_00000.png", "frame_00001.png", "frame_00002.png", "frame_00003.png"}));
}

TEST(Capture, DrawsThePanelsOnRequest) {
  const ScratchFolder scratch;
  EXPECT_EQ(capture("cloth --ui --out a.png --size 1280x720", scratch.folder).code, 0);
  EXPECT_EQ(capture("cloth --out b.png --size 1280x720", scratch.folder).code, 0);
  const Image with = read_png(scratch.folder / "a.png"), without = read_png(scratch.folder / "b.png");
  const auto color_at = [](const Image& image, int x, int y) {
    const std::uint8_t* pixel = &image.pixels[3u * static_cast<std::size_t>(y * image.width + x)];
    return std::tuple(pixel[0], pixel[1], pixel[2]);
  };
  // the backgrounds of the left and right panels with text on them, which gives pixels of high contrast
  EXPECT_EQ(color_at(with, 4, 600), std::tuple(0x1a, 0x1d, 0x22));
  EXPECT_NE(color_at(without, 4, 600), std::tuple(0x1a, 0x1d, 0x22));
  int bright = 0;
  for (int y = 60; y < 200; ++y)
    for (int x = 960; x < 1240; ++x) bright += std::get<0>(color_at(with, x, y)) > 0xa0;
  EXPECT_GT(bright, 200);
}

// In the scene and in a text beside it, in a color that nothing else has.
TEST(Capture, HighlightsWhatStartsCrossedWithThePanels) {
  const ScratchFolder scratch;
  const auto count = [&](const std::string& contact, const std::string& options) {
    write_file(scratch.folder / "crossed.json", R"({"hooke": 1, "dimensions": 2, "gravity": [0, 0, 0], "points": [{"position": [-1, 0]},
      {"position": [1, 0]}, {"position": [0.1, -1]}, {"position": [0, 1]}], "springs": [{"points": [0, 1], "stiffness": 100},
      {"points": [2, 3], "stiffness": 100}], "contact": )" +
                                                    contact + "}");
    EXPECT_EQ(capture("crossed.json --out a.png --size 1280x720 --seconds 0.1 " + options, scratch.folder).code, 0);
    const Image image = read_png(scratch.folder / "a.png");
    int in_scene = 0, in_text = 0;
    for (int y = 50; y < 650; ++y)
      for (int x = 80; x < 1260; ++x) {
        const std::uint8_t* pixel = &image.pixels[3u * static_cast<std::size_t>(y * image.width + x)];
        if (x < 940)
          in_scene += pixel[1] > 150 && pixel[0] < pixel[1] - 70 && pixel[2] > 110;
        else
          in_text += pixel[1] > 220 && pixel[0] < 100;
      }
    return std::pair(in_scene, in_text);
  };
  const auto [plain_scene, plain_text] = count("{}", "--ui");
  const auto [crossed_scene, crossed_text] = count(R"({"springs": true})", "--ui");
  EXPECT_GT(crossed_scene, plain_scene + 500);
  EXPECT_EQ(plain_text, 0);
  EXPECT_GT(crossed_text, 50);
  EXPECT_EQ(count(R"({"springs": true})", ""), count("{}", ""));
}

// The mean of each tile of `side` pixels, channel by channel.
std::vector<double> means(const Image& image, int side) {
  const int across = image.width / side;
  const auto start_of = [](int pixel) { return 3 * static_cast<std::size_t>(pixel); };
  std::vector<double> sums(start_of(across * (image.height / side)));
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x)
      for (int c = 0; c < 3; ++c)
        sums[start_of(y / side * across + x / side) + static_cast<std::size_t>(c)] +=
            image.pixels[start_of(y * image.width + x) + static_cast<std::size_t>(c)];
  for (double& sum : sums) sum /= side * side;
  return sums;
}

// At twice the scale, everything has the same position and size; only the rasterization of letters differs.
class CaptureOfSize : public testing::TestWithParam<std::pair<int, int>> {};
INSTANTIATE_TEST_SUITE_P(Daily, CaptureOfSize, testing::Values(std::pair(960, 600)));
INSTANTIATE_TEST_SUITE_P(Nightly, CaptureOfSize, testing::Values(std::pair(1280, 720), std::pair(1920, 1080)));

TEST_P(CaptureOfSize, ShowsTheSameAtTwiceTheScale) {
  const auto [width, height] = GetParam();
  const ScratchFolder scratch;
  const auto tiles_at = [&, width = width, height = height](int scale) {
    const std::string words = "cloth --ui --seconds 0.5 --out a.png --scale " + std::to_string(scale) + " --size " +
                              std::to_string(scale * width) + "x" + std::to_string(scale * height);
    EXPECT_EQ(capture(words, scratch.folder).code, 0);
    return means(read_png(scratch.folder / "a.png"), scale * 20);
  };
  const std::vector<double> plain = tiles_at(1), fine = tiles_at(2);
  ASSERT_EQ(fine.size(), plain.size());
  double max = 0.0;
  for (std::size_t i = 0; i < plain.size(); ++i) max = std::max(max, std::abs(plain[i] - fine[i]));
  EXPECT_LT(max, 16.0) << "of 255";
}

TEST(Capture, WritesTheRequestedNumberOfPictures) {
  const ScratchFolder scratch;
  EXPECT_EQ(capture("two_masses --out pictures --frames 2 --size 32x32", scratch.folder).code, 0);
  EXPECT_EQ(files_in(scratch.folder / "pictures").size(), 2u);
}

TEST(Capture, ASingleFileIsTheLastOfAFolder) {
  const ScratchFolder scratch;
  EXPECT_EQ(capture("two_masses --out pictures --seconds 0.5 --fps 4 --size 320x180", scratch.folder).code, 0);
  EXPECT_EQ(capture("two_masses --out last.png --seconds 0.5 --size 320x180", scratch.folder).code, 0);
  const Image last = read_png(scratch.folder / "last.png");
  EXPECT_EQ(last.pixels, read_png(scratch.folder / "pictures/frame_00002.png").pixels);
  EXPECT_GT(difference(last, read_png(scratch.folder / "pictures/frame_00000.png")), 0.001);
}

TEST(Capture, DrawsTheSamePictureAsTheView) {
  const ScratchFolder scratch;
  EXPECT_EQ(capture("cloth --out a.png --seconds 0.2 --size 320x180 --quiet", scratch.folder).code, 0);
  Lab lab(load_scene(find_scene("cloth")).scene);
  const Camera camera = make_camera(lab.scene().view, lab.scene().system, lab.scene().state, 320.0 / 180.0);
  for (int frame = 0; frame < 12; ++frame) lab.step();
  lab.publish();

  const Offscreen offscreen;
  View view;
  const ViewOptions options = options_for(lab.scene().view, lab.scene().cloth_texture);
  view.draw(*lab.status()->snapshot, {}, camera, options, 320, 180, nullptr);
  EXPECT_EQ(read_png(scratch.folder / "a.png").pixels, view.read().pixels);
}

TEST(Capture, UsesTheGivenCamera) {
  const ScratchFolder scratch;
  EXPECT_EQ(capture("cloth --out a.png --size 160x90", scratch.folder).code, 0);
  EXPECT_EQ(capture("cloth --out b.png --size 160x90 --camera 5,1,0,0,0,0", scratch.folder).code, 0);
  EXPECT_GT(difference(read_png(scratch.folder / "a.png"), read_png(scratch.folder / "b.png")), 0.01);
}

TEST(Capture, KeepsTheLastValidPictureOfADivergedRun) {
  const ScratchFolder scratch;
  const Outcome outcome = capture("unstable --out a.png --seconds 60 --size 160x90 --quiet", scratch.folder);
  EXPECT_EQ(outcome.code, 4);
  EXPECT_NE(outcome.err.find("spring"), std::string::npos) << outcome.err;
  EXPECT_EQ(read_png(scratch.folder / "a.png").width, 160);
}

// Arguments, exit code, and the rest of the line on stderr after "hooke-headless: ".
TEST(Capture, RefusesInOneLine) {
  const ScratchFolder scratch;
  const std::string size = " must be WIDTHxHEIGHT, each from 1 to 8192\n";
  const std::string camera = " must be six numbers, of the eye and a different target [m]\n";
  const std::string out = " must end in .png, .mp4, .webp or .gif, or be a folder (a new one with a dot in its name must end in /)\n";
  const std::vector<std::tuple<std::string, int, std::string>> refusals{
      {"two_masses --out a.png --size 0x9", 2, "--size 0x9:" + size},
      {"two_masses --out a.png --size 640", 2, "--size 640:" + size},
      {"two_masses --out a.png --size 640x480x2", 2, "--size 640x480x2:" + size},
      {"two_masses --out a.png --size 8193x9", 2, "--size 8193x9:" + size},
      {"two_masses --out a.png --ui --size 64x40", 2, "--size 64x40: must be at least 320x180 with panels of this scale\n"},
      {"two_masses --out a.png --camera 1,2,3", 2, "--camera 1,2,3:" + camera},
      {"two_masses --out a.png --camera 1,2,3,1,2,3", 2, "--camera 1,2,3,1,2,3:" + camera},
      {"two_masses --out a.png --camera nan,2,3,1,2,3", 2, "--camera nan,2,3,1,2,3:" + camera},
      {"two_masses --out a.jpg", 2, "--out a.jpg:" + out},
      {"two_masses --out ''", 2, "--out :" + out},
      {"two_masses --out a.png --fps 61", 2, "--fps 61: must be at most the frame rate of the scene, 60\n"},
      {"two_masses --out a.png --seconds 1e300", 2, "--seconds 1e+300: must be at most 1e15 frames\n"},
      {"two_masses --out /nowhere/at/all.png", 5, "/nowhere/at/all.png: cannot be written: No such file or directory\n"},
      {"two_masses --out /dev/null/pictures", 5, "/dev/null/pictures: cannot be created: Not a directory\n"},
  };
  for (const auto& [arguments, code, line] : refusals) {
    const Outcome outcome = capture(arguments, scratch.folder);
    EXPECT_EQ(outcome.code, code) << arguments;
    EXPECT_EQ(outcome.err, "hooke-headless: " + line);
    EXPECT_EQ(outcome.out, "");
  }
  EXPECT_TRUE(files_in(scratch.folder).empty());
}

TEST(Capture, RefusesUnknownOrConflictingOptions) {
  const ScratchFolder scratch;
  for (const char* arguments : {"two_masses", "--out a.png", "two_masses --out a.png --uii", "two_masses --out a.png --frames 0",
                                "two_masses --out a.png --frames 2 --seconds 1", "two_masses --out a.png --fps 0"})
    EXPECT_EQ(capture(arguments, scratch.folder).code, 2) << arguments;
  EXPECT_EQ(capture("no_such_scene --out a.png", scratch.folder).code, 5);
}

// Also of the report, and of numbered pictures.
TEST(Capture, CreatesTheFolderThatALinkLeadsTo) {
  const ScratchFolder scratch;
  std::filesystem::create_directory_symlink("new", scratch.folder / "pictures");
  std::filesystem::create_directory_symlink("other", scratch.folder / "report");
  const Outcome outcome = capture("two_masses --out pictures --report report --frames 1 --size 32x32", scratch.folder);
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(files_in(scratch.folder / "new"), (std::vector<std::string>{"frame_00000.png"}));
  EXPECT_EQ(files_in(scratch.folder / "other"), (std::vector<std::string>{"report.csv", "report.json"}));
}

TEST(Capture, KeepsTheOldPictureWhereTheNewOneCannotBeWritten) {
  const ScratchFolder scratch;
  ASSERT_EQ(capture("two_masses --out a.png --size 32x32", scratch.folder).code, 0);
  const Image before = read_png(scratch.folder / "a.png");
  const Outcome outcome =
      headless_with_short_files(1, {"capture", "cloth", "--out", scratch.folder / "a.png", "--size", "640x360", "--quiet"});
  EXPECT_EQ(outcome.code, 5);
  EXPECT_EQ(outcome.err, "hooke-headless: " + (scratch.folder / "a.png").string() + ": cannot be written: File too large\n");
  EXPECT_EQ(read_png(scratch.folder / "a.png").pixels, before.pixels);
  EXPECT_EQ(files_in(scratch.folder), (std::vector<std::string>{"a.png"}));
}

// Pictures are written in a thread of their own: in order, up to the first that fails.
TEST(Capture, EndsWithThePictureOfAFolderThatCannotBeWritten) {
  const ScratchFolder scratch;
  std::filesystem::create_directories(scratch.folder / "pictures" / "frame_00003.png" / "occupied");
  const Outcome outcome = capture("two_masses --out pictures --frames 40 --size 32x32", scratch.folder);
  EXPECT_EQ(outcome.code, 5);
  EXPECT_NE(outcome.err.find("frame_00003.png: "), std::string::npos) << outcome.err;
  EXPECT_EQ(files_in(scratch.folder / "pictures"),
            (std::vector<std::string>{"frame_00000.png", "frame_00001.png", "frame_00002.png", "frame_00003.png"}));
}

}  // namespace
}  // namespace hooke
