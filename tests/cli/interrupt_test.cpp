// Ctrl+C and SIGTERM keep what was computed.

#include <gtest/gtest.h>
#include <signal.h>

#include <chrono>
#include <fstream>
#include <functional>
#include <thread>

#include "base/number_text.h"
#include "support/contents.h"
#include "support/headless.h"
#include "support/scratch_folder.h"

namespace hooke {
namespace {

namespace fs = std::filesystem;

// The exit code of a command in a folder that gets a signal once `is_ready`. Its errors go to a file.
int code_after(int signal, const std::string& arguments, const fs::path& folder, const std::function<bool()>& is_ready,
               const fs::path& errors = "/dev/null") {
  std::vector<std::string> words{"/usr/bin/env", "-C", folder.string(), "PATH=bin:/usr/bin:/bin", HOOKE_HEADLESS};
  for (std::istringstream text(arguments); text;)
    if (std::string word; text >> word) words.push_back(word);
  const int null = open("/dev/null", O_WRONLY | O_CLOEXEC), stderr_file = open(errors.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, 0600);
  const pid_t child = start_process(words, null, stderr_file);
  for (int tries = 0; tries < 600 && !is_ready(); ++tries) std::this_thread::sleep_for(std::chrono::milliseconds(100));
  kill(child, signal);
  const int code = wait_for(child);
  close(null), close(stderr_file);
  return code;
}

long files_in(const fs::path& folder, const std::string& start) {
  long count = 0;
  if (!fs::exists(folder)) return 0;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder))
    count += entry.path().filename().string().starts_with(start) ? 1 : 0;
  return count;
}

// Until the program has written something to a temporary file, it may not have caught signals yet.
bool has_long_file(const fs::path& folder) {
  for (const fs::directory_entry& entry : fs::directory_iterator(folder))
    if (entry.is_regular_file() && entry.file_size() > 100'000) return true;
  return false;
}

TEST(Interrupt, ARunWritesTheSamplesSoFarAndMarksThem) {
  for (const auto& [signal, code] : {std::pair{SIGINT, 130}, std::pair{SIGTERM, 143}}) {
    const ScratchFolder scratch;
    const std::string command = "run cloth --seconds 1e5 --sample 0.001 --accuracy off --json a.json --csv a.csv -q";
    EXPECT_EQ(code_after(signal, command, scratch.folder, [&] { return has_long_file(scratch.folder); }), code);
    const rapidjson::Document json = parse_json(contents(scratch.folder / "a.json"));
    EXPECT_TRUE(json["interrupted"].GetBool());
    EXPECT_FALSE(json["diverged"].GetBool());
    const auto& samples = json["samples"];
    ASSERT_GT(samples.Size(), 1u);
    EXPECT_EQ(samples[samples.Size() - 1]["time"].GetDouble(), json["seconds"].GetDouble());
    EXPECT_EQ(lines_of(contents(scratch.folder / "a.csv")).size(), samples.Size() + 1u);
    EXPECT_EQ(files_in(scratch.folder, "."), 0) << "temporary files";
  }
}

TEST(Interrupt, ACaptureKeepsItsPicturesAndItsReport) {
  const ScratchFolder scratch;
  const std::string command = "capture two_masses --out frames --seconds 1e5 --size 64x36 --report report -q";
  const fs::path errors = scratch.folder / "errors";
  EXPECT_EQ(code_after(
                SIGTERM, command, scratch.folder, [&] { return files_in(scratch.folder / "frames", "frame_") > 3; }, errors),
            143);
  EXPECT_TRUE(contents(errors).starts_with("Interrupted: the pictures in frames end at t = ")) << contents(errors);
  const rapidjson::Document json = parse_json(contents(scratch.folder / "report" / "report.json"));
  EXPECT_TRUE(json["interrupted"].GetBool());
  EXPECT_EQ(files_in(scratch.folder / "frames", "frame_"), static_cast<long>(json["frames"].Size()));
  EXPECT_EQ(files_in(scratch.folder / "frames", "."), 0);
  EXPECT_EQ(files_in(scratch.folder / "report", "."), 0);
}

// A line that is no row would be one to most programs.
TEST(Interrupt, TheErrorsSayWhereATableEnds) {
  const ScratchFolder scratch, other;
  const auto has_begun = [&] { return has_long_file(scratch.folder); };
  const fs::path errors = other.folder / "errors";
  EXPECT_EQ(code_after(SIGTERM, "run cloth --seconds 1e5 --sample 0.001 --accuracy off --csv a.csv -q", scratch.folder, has_begun, errors),
            143);
  const std::vector<std::string> rows = lines_of(contents(scratch.folder / "a.csv"));
  const std::string time = rows.back().substr(0, rows.back().find(','));
  EXPECT_NE(contents(errors).find("Interrupted: the results in a.csv end at t = " + number_text(std::stod(time)) + " s."),
            std::string::npos);
}

TEST(Interrupt, ACommentInAFilmSaysWhereItEnds) {
  for (const char* name : {"a.gif", "a.webp", "a.mp4"}) {
    const ScratchFolder scratch, other;
    fs::create_directory(scratch.folder / "bin");
    std::ofstream(scratch.folder / "bin" / "ffmpeg") << "#!/bin/sh\nfor last; do :; done\nexec cat >\"${last#file:}\"\n";
    fs::permissions(scratch.folder / "bin" / "ffmpeg", fs::perms::owner_all);
    const fs::path errors = other.folder / "errors";
    const std::string command = std::string("capture cloth --seconds 1e5 --size 320x180 -q --out ") + name;
    const auto start_time = std::chrono::steady_clock::now();  // GIF and WebP are written at the end
    const auto has_pictures = [&] {
      return files_in(scratch.folder, ".a") > 0 || std::chrono::steady_clock::now() - start_time > std::chrono::seconds(2);
    };
    EXPECT_EQ(code_after(SIGINT, command, scratch.folder, has_pictures, errors), 130);
    const std::string error = contents(errors), film = contents(scratch.folder / name),
                      start = std::string("Interrupted: the pictures in ") + name + " end at ";
    ASSERT_TRUE(error.starts_with(start) && error.ends_with(".\n")) << error;
    EXPECT_NE(film.find("interrupted at " + error.substr(start.size(), error.size() - start.size() - 2)), std::string::npos) << name;
    EXPECT_EQ(files_in(scratch.folder, "."), 0);
  }
}

TEST(Interrupt, ASweepKeepsItsRowsAndMarksThem) {
  for (const auto& [signal, code] : {std::pair{SIGINT, 130}, std::pair{SIGTERM, 143}}) {
    const ScratchFolder scratch;
    const std::string command = "sweep rope --vary stiffness=100:1e4:log:500 --measure total --seconds 2 --out out -q";
    const fs::path journal = scratch.folder / "out" / "sweep.jsonl";
    EXPECT_EQ(code_after(signal, command, scratch.folder, [&] { return fs::exists(journal) && fs::file_size(journal) > 10'000; }), code);
    const rapidjson::Document json = parse_json(contents(scratch.folder / "out" / "sweep.json"));
    EXPECT_FALSE(json["complete"].GetBool());
    EXPECT_EQ(lines_of(contents(scratch.folder / "out" / "sweep.csv")).size(), json["rows"].Size() + 1u);
    EXPECT_EQ(files_in(scratch.folder / "out", "."), 0);
  }
}

TEST(Interrupt, ABenchmarkKeepsWhatWasMeasuredAndMarksIt) {
  const ScratchFolder scratch;
  const fs::path results = scratch.folder / "out" / "bench.json";
  EXPECT_EQ(code_after(SIGTERM, "bench two_masses --quick --out out -q", scratch.folder, [&] { return fs::exists(results); }), 143);
  const rapidjson::Document json = parse_json(contents(results));
  EXPECT_FALSE(json["parts"][0]["complete"].GetBool());
  EXPECT_GE(json["scenes"][0]["rows"].Size(), 1u);
  EXPECT_EQ(files_in(scratch.folder / "out", "."), 0);
}

TEST(Interrupt, ChecksKeepTheirResultsAndMarkThem) {
  for (const char* command : {"check --json checks.json", "check --hard --json checks.json -q"}) {
    const ScratchFolder scratch;
    const auto start = std::chrono::steady_clock::now();
    const int code = code_after(SIGINT, command, scratch.folder,
                                [&] { return std::chrono::steady_clock::now() - start > std::chrono::milliseconds(1500); });
    EXPECT_EQ(code, 130);
    EXPECT_TRUE(parse_json(contents(scratch.folder / "checks.json"))["interrupted"].GetBool()) << command;
  }
}

}  // namespace
}  // namespace hooke
