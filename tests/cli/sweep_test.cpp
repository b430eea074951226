// hooke-headless sweep, run as a separate process.
#include <gtest/gtest.h>
#include <signal.h>

#include <algorithm>
#include <chrono>
#include <thread>

#include "support/contents.h"
#include "support/headless.h"
#include "support/scratch_folder.h"

namespace hooke {
namespace {

namespace fs = std::filesystem;

// A command with more arguments.
std::vector<std::string> with(std::vector<std::string> words, const std::vector<std::string>& more) {
  words.insert(words.end(), more.begin(), more.end());
  return words;
}

// 12 runs, some of which diverge.
const std::vector<std::string> rope_sweep{
    "sweep",     "rope", "--vary", "stiffness=100:1e4:log:4", "--vary", "substeps=4,8,64", "--measure", "max_strain,max:fastest,error",
    "--seconds", "0.1"};

Outcome sweep_rope(const std::vector<std::string>& more) { return headless(with(rope_sweep, more)); }

TEST(Sweep, MeasuresWhatARunMeasures) {
  const ScratchFolder scratch;
  const std::string out = scratch.folder / "out", csv = scratch.folder / "run.csv";
  ASSERT_EQ(sweep_rope({"--out", out}).code, 0);
  const std::vector<std::string> lines = lines_of(contents(fs::path(out) / "sweep.csv"));
  ASSERT_EQ(lines.size(), 13u);
  EXPECT_EQ(lines[0], "stiffness [N/m],substeps,max_strain [1],max:fastest [m/s],error [m],status,note");

  ASSERT_EQ(headless({"run", "rope", "--set", "stiffness=100", "--substeps", "64", "--seconds", "0.1", "--sample", "0.016", "--csv", csv,
                      "--quantities", "largest_strain,error,fastest", "-q"})
                .code,
            0);
  const std::vector<std::string> samples = lines_of(contents(csv));
  ASSERT_EQ(samples.size(), 8u);
  std::string strain, error, fastest;
  double max = 0.0;
  for (auto line = samples.begin() + 1; line != samples.end(); ++line) {
    std::istringstream row(*line);
    std::getline(row, strain, ',');
    std::getline(row, error, ',');
    std::getline(row, fastest, ',');
    max = std::max(max, std::stod(fastest));
  }
  EXPECT_TRUE(lines[3].starts_with("100,64," + strain + ",")) << lines[3] << " " << strain;
  EXPECT_NE(lines[3].find("," + error + ",ok,"), std::string::npos) << lines[3] << " " << error;
  EXPECT_EQ(std::stod(lines[3].substr(("100,64," + strain + ",").size())), max);

  // a stiff rope with few substeps diverges: no figures, but the reason
  EXPECT_TRUE(lines[10].starts_with("10000,4,,,,diverged,")) << lines[10];
  EXPECT_NE(lines[10].find("The simulation blew up"), std::string::npos);
  for (const char* file : {"sweep.json", "sweep.svg", "sweep.png"}) EXPECT_GT(fs::file_size(fs::path(out) / file), 1000u) << file;
}

TEST(Sweep, ChartsHaveAtMostEightLinesElseCells) {
  const ScratchFolder scratch;
  const auto charted = [&](const std::string& name, const std::vector<std::string>& axes) {
    const fs::path out = scratch.folder / name;
    std::vector<std::string> words{"sweep", "rope", "--measure", "lowest", "--seconds", "0", "-q", "--out", out};
    for (const std::string& axis : axes) words.insert(words.end(), {"--vary", axis});
    const Outcome outcome = headless(words);
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    return outcome.err + contents(out / "sweep.svg");
  };
  const std::string eight = charted("eight", {"substeps=1:9:lin:9", "gravity=1:8:lin:8"});
  EXPECT_NE(eight.find("gravity 8"), std::string::npos) << "the key of a line";
  const std::string nine = charted("nine", {"substeps=1:9:lin:9", "gravity=1:9:lin:9"});
  EXPECT_EQ(nine.find("gravity 8"), std::string::npos);
  EXPECT_NE(nine.find("gravity [m/s^2]"), std::string::npos) << "the label of an axis";
  const std::string three = charted("three", {"substeps=1:9:lin:9", "gravity=1:5:lin:5", "damping=0,1"});
  EXPECT_EQ(three, "no chart: too many combinations; vary at most two parameters, or fewer values\n");
}

// All figures are those of the start; some of the sweeps are of a single value.
TEST(Sweep, ChartsOfConstantsAreDrawnWithoutWarnings) {
  const ScratchFolder scratch;
  for (const std::vector<std::string>& axes : {std::vector<std::string>{"--vary", "substeps=1:3:lin:3"},
                                               {"--vary", "substeps=2"},
                                               {"--vary", "damping=0"},
                                               {"--vary", "damped_springs=off"},
                                               {"--vary", "substeps=1:9:lin:9", "--vary", "gravity=1:9:lin:9"}}) {
    const fs::path out = scratch.folder / ("out_" + axes[1] + std::to_string(axes.size()));
    const Outcome outcome =
        headless(with({"sweep", "rope", "--measure", "lowest,fastest,max_strain", "--seconds", "0", "-q", "--out", out}, axes));
    EXPECT_EQ(outcome.code, 0);
    EXPECT_EQ(outcome.err, "") << axes[1];
    EXPECT_GT(fs::file_size(out / "sweep.svg"), 1000u);
  }
}

// gnuplot does not notice failed writes.
TEST(Sweep, ThatCannotWriteItsChartsFails) {
  const ScratchFolder scratch;
  const Outcome outcome = headless_with_short_files(
      8, {"sweep", "rope", "--vary", "substeps=1:9:lin:9", "--measure", "lowest", "--seconds", "0", "-q", "--out", scratch.folder});
  EXPECT_EQ(outcome.code, 5);
  EXPECT_NE(outcome.err.find((scratch.folder / "sweep.svg").string() + ": cannot be written: File too large\n"), std::string::npos);
  EXPECT_TRUE(fs::exists(scratch.folder / "sweep.csv"));
  EXPECT_FALSE(fs::exists(scratch.folder / "sweep.svg"));
}

TEST(Sweep, CreatesTheFolderThatALinkLeadsTo) {
  const ScratchFolder scratch;
  fs::create_directory_symlink("new", scratch.folder / "link");
  const Outcome outcome = headless(
      {"sweep", "rope", "--vary", "substeps=1,2", "--measure", "lowest", "--seconds", "0", "-q", "--out", scratch.folder / "link/deep/"});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_TRUE(fs::exists(scratch.folder / "new/deep/sweep.csv"));
  EXPECT_TRUE(fs::is_symlink(scratch.folder / "link"));

  fs::create_directory_symlink("circle", scratch.folder / "circle");
  const Outcome circular = headless(
      {"sweep", "rope", "--vary", "substeps=1,2", "--measure", "lowest", "--seconds", "0", "-q", "--out", scratch.folder / "circle"});
  EXPECT_EQ(circular.code, 5);
  EXPECT_EQ(circular.err,
            "hooke-headless: " + (scratch.folder / "circle").string() + ": cannot be created: Too many levels of symbolic links\n");
}

TEST(Sweep, AnyDivisionIntoPartsGivesTheSameTable) {
  const ScratchFolder scratch;
  const auto in = [&](const std::string& name) { return (scratch.folder / name).string(); };
  ASSERT_EQ(sweep_rope({"--out", in("whole"), "-q"}).code, 0);
  const std::string expected = contents(fs::path(in("whole")) / "sweep.csv"), json = contents(fs::path(in("whole")) / "sweep.json");
  std::vector<std::string> merge{"sweep", "--out", in("merged"), "-q", "--merge"};
  for (const char* part : {"3", "2", "1"}) {
    ASSERT_EQ(sweep_rope({"--out", in(part), "--shard", std::string(part) + "/3", "-q"}).code, 0);
    merge.push_back(in(part));
  }
  ASSERT_EQ(headless(merge).code, 0);
  EXPECT_EQ(contents(fs::path(in("merged")) / "sweep.csv"), expected);
  EXPECT_EQ(contents(fs::path(in("merged")) / "sweep.json"), json);
  EXPECT_TRUE(fs::exists(fs::path(in("merged")) / "sweep.png"));
}

TEST(Sweep, ResumedAfterAKillGivesTheSameTable) {
  const ScratchFolder scratch;
  const fs::path whole = scratch.folder / "whole", killed = scratch.folder / "killed";
  ASSERT_EQ(sweep_rope({"--out", whole, "-q"}).code, 0);
  const std::string journal = contents(whole / "sweep.jsonl");

  // what a kill within the fifth line would leave
  std::size_t end = 0;
  for (int line = 0; line < 4; ++line) end = journal.find('\n', end) + 1;
  fs::create_directories(killed);
  write_file(killed / "sweep.jsonl", journal.substr(0, end + 9));
  ASSERT_EQ(sweep_rope({"--out", killed, "-q"}).code, 0);
  EXPECT_EQ(contents(killed / "sweep.csv"), contents(whole / "sweep.csv"));
  EXPECT_EQ(contents(killed / "sweep.json"), contents(whole / "sweep.json"));
  EXPECT_EQ(contents(killed / "sweep.jsonl"), journal);

  // finished runs are not repeated: a changed figure stays
  std::string changed = journal.substr(0, end);
  const std::size_t figure = changed.rfind('[') + 1;
  changed.replace(figure, changed.find(',', figure) - figure, "1234");
  write_file(killed / "sweep.jsonl", changed);
  ASSERT_EQ(sweep_rope({"--out", killed, "-q"}).code, 0);
  EXPECT_NE(contents(killed / "sweep.csv").find(",1234,"), std::string::npos);
}

// Starts a sweep that takes minutes, and waits for two finished runs.
pid_t start_long_sweep(const fs::path& out) {
  const pid_t child = start_process(
      {HOOKE_HEADLESS, "sweep", "rope", "--vary", "substeps=64:900:lin:500", "--measure", "cpu", "--seconds", "5", "-q", "--out", out},
      STDERR_FILENO, STDERR_FILENO);
  for (int i = 0; i < 30'000 && std::ranges::count(contents(out / "sweep.jsonl"), '\n') < 3; ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  return child;
}

TEST(Sweep, AnInterruptedSweepKeepsItsRows) {
  const ScratchFolder scratch;
  const fs::path out = scratch.folder / "out";
  const pid_t child = start_long_sweep(out);
  kill(child, SIGINT);
  EXPECT_EQ(wait_for(child), 130);
  EXPECT_EQ(lines_of(contents(out / "sweep.csv")).size(), lines_of(contents(out / "sweep.jsonl")).size());
}

TEST(Sweep, AKilledSweepKeepsItsRows) {
  const ScratchFolder scratch;
  const fs::path out = scratch.folder / "out", merged = scratch.folder / "merged";
  const pid_t child = start_long_sweep(out);
  kill(child, SIGKILL);
  EXPECT_EQ(wait_for(child), -1);
  EXPECT_FALSE(fs::exists(out / "sweep.csv"));
  EXPECT_EQ(headless({"sweep", "--merge", out, "--out", merged, "-q"}).code, 1);
  EXPECT_GE(lines_of(contents(merged / "sweep.csv")).size(), 3u);
}

TEST(Sweep, AnIncompleteMergeNamesWhatIsMissing) {
  const ScratchFolder scratch;
  const auto in = [&](const std::string& name) { return (scratch.folder / name).string(); };
  ASSERT_EQ(sweep_rope({"--out", in("second"), "--shard", "2/2", "-q"}).code, 0);
  const Outcome outcome = headless({"sweep", "--merge", in("second"), "--out", in("merged")});
  EXPECT_EQ(outcome.code, 1);
  EXPECT_NE(outcome.err.find("incomplete: 6 of 12 runs are missing, the first is row 0\n"), std::string::npos) << outcome.err;

  // the same command without --shard computes the rest
  ASSERT_EQ(sweep_rope({"--out", in("merged"), "-q"}).code, 0);
  ASSERT_EQ(sweep_rope({"--out", in("whole"), "-q"}).code, 0);
  EXPECT_EQ(contents(fs::path(in("merged")) / "sweep.csv"), contents(fs::path(in("whole")) / "sweep.csv"));
}

struct RefusedSweep {
  std::vector<std::string> words;
  int code;
  std::string message;
};

TEST(Sweep, InvalidInputIsOneLine) {
  const ScratchFolder scratch;
  const std::string out = scratch.folder / "out", other = scratch.folder / "other";
  const std::vector<std::string> valid{"--measure", "cpu", "--seconds", "0", "--out", out};
  const auto vary = [&](const std::string& text, const std::vector<std::string>& more = {}) {
    return with(with({"sweep", "rope", "--vary", text}, valid), more);
  };
  ASSERT_EQ(sweep_rope({"--out", other, "-q", "--shard", "1/4"}).code, 0);
  const std::string other_scene = scratch.folder / "other_scene";
  ASSERT_EQ(sweep_rope({"--out", other_scene, "-q", "--shard", "2/4", "--set", "damping=0.5"}).code, 0);
  fs::create_directories(scratch.folder / "broken");
  write_file(scratch.folder / "broken" / "sweep.jsonl", contents(fs::path(other) / "sweep.jsonl") + "{\"row\": 12}\n");
  fs::create_directories(scratch.folder / "foreign");
  write_file(scratch.folder / "foreign" / "sweep.jsonl", "{\"hooke_sweep\": 2}\n");
  for (const RefusedSweep& refused : {
           RefusedSweep{{"sweep", "rope"}, 2, "--out is required"},
           {{"sweep", "rope", "--out", out}, 2, "--vary is required"},
           {{"sweep", "--vary", "substeps=2"}, 2, "--out is required"},
           {vary("substeps"), 2, "--vary substeps: must be NAME=VALUES"},
           {vary("color=3"), 2, "--vary color=3: no such parameter: must be one of dimensions, substeps"},
           {vary("stifness=3"), 2, "; did you mean stiffness?"},
           {vary("substeps=0"), 2, "0: must be whole, and must be from 1 to 1000000"},
           {vary("substeps=2.5"), 2, "2.5: must be whole"},
           {vary("substeps=2,2"), 2, "2: is repeated"},
           {vary("substeps="), 2, "--vary substeps=: a value is missing"},
           {vary("stiffness=1:nan:log:3"), 2, "nan: not a number: must be from 0 to 1000000000000 [N/m]"},
           {vary("stiffness=1:2:log"), 2, "a range must be MIN:MAX:log:COUNT or MIN:MAX:lin:COUNT"},
           {vary("stiffness=1:2:cubic:3"), 2, "a range must be MIN:MAX:log:COUNT or MIN:MAX:lin:COUNT"},
           {vary("stiffness=1:2:log:1"), 2, "1: the number of values must be from 2 to 1000000"},
           {vary("stiffness=1:2:log:99999999999999999999"), 2, "the number of values must be from 2"},
           {vary("damping=0:2:log:3"), 2, "the ends of a logarithmic range must be more than 0"},
           {vary("damping=2:2:lin:3"), 2, "the ends of a range must differ"},
           {vary("damped_springs=on:off:lin:2"), 2, "must be on or off, separated by commas"},
           {vary("sheet_stiffness=1,2"), 2, "--vary sheet_stiffness: the scene has nothing that it sets"},
           {vary("damping=0:1:lin:1000000", {"--vary", "substeps=1,2"}), 2, "more than 1000000 combinations"},
           {vary("substeps=1,2", {"--vary", "substeps=3"}), 2, "substeps=3: varied twice"},
           {vary("damping=0:2:lin:0"), 2, "0: the number of values must be from 2 to 1000000"},
           {vary("damping=0:inf:lin:3"), 2, "inf: not a number: must be "},
           {{"sweep", "rope", "--vary", "substeps=1,2", "--measure", "cpu", "--seconds", "inf", "--out", out},
            2,
            "--seconds: inf: not a finite number: must be"},
           {{"sweep", "rope", "--vary", "substeps=1,2", "--measure", "cpu", "--seconds", "1e300", "--out", out}, 2, "at most 1e15 frames"},
           {vary("substeps=1,2", {"--shard", "1"}), 2, "--shard 1: must be I/N"},
           {vary("substeps=1,2", {"--shard", "3/2"}), 2, "3/2: must be I/N with I from 1 to N"},
           {vary("substeps=1,2", {"--shard", "0/2"}), 2, "0/2: must be I/N with I from 1 to N"},
           {vary("substeps=1,2", {"--merge", other}), 2, "excludes --merge"},
           {{"sweep", "rope", "--vary", "substeps=1", "--measure", "cpu,speediness", "--seconds", "0", "--out", out},
            2,
            "--measure speediness: must be one of cpu, time"},
           {{"sweep", "rope", "--vary", "substeps=1", "--measure", "max:cpu", "--seconds", "0", "--out", out},
            2,
            "--measure max:cpu: must be"},
           {{"sweep", "rope", "--vary", "substeps=1", "--measure", "cpu,cpu", "--seconds", "0", "--out", out},
            2,
            "--measure cpu: is repeated"},
           {{"sweep", "rope", "--vary", "substeps=1", "--measure", "cpu", "--seconds", "0", "--out", other}, 3, "contains another sweep"},
           {{"sweep", "--merge", scratch.folder / "broken", "--out", out},
            3,
            "sweep.jsonl: line 5: row: 12: must be a whole number from 0 to 11"},
           {{"sweep", "--merge", other, "--out", out, "--set", "damping=0"}, 2, "--set"},
           {{"sweep", "--merge", other, other_scene, "--out", out}, 3, "contains another sweep than"},
           {{"sweep", "--merge", scratch.folder / "foreign", "--out", out}, 3, "sweep.jsonl: line 1: hooke_sweep: 2: must be 1"},
           {{"sweep", "--merge", scratch.folder / "none", "--out", out}, 5, "sweep.jsonl"},
           {{"sweep", "rope", "--vary", "substeps=1", "--measure", "cpu", "--seconds", "0", "--out", "/proc/none"}, 5, "cannot be created"},
       }) {
    const Outcome outcome = headless(refused.words);
    EXPECT_EQ(outcome.code, refused.code) << outcome.err;
    EXPECT_EQ(std::ranges::count(outcome.err, '\n'), 1) << outcome.err;
    EXPECT_NE(outcome.err.find(refused.message), std::string::npos) << outcome.err << "\nexpected: " << refused.message;
    EXPECT_EQ(outcome.out, "");
  }
}

#ifdef GNU_PARALLEL
TEST(Sweep, RunsUnderGnuParallel) {
  const ScratchFolder scratch;
  const std::string parts = scratch.folder / "part", merged = scratch.folder / "merged", whole = scratch.folder / "whole";
  const Outcome outcome = run_process(with(with({GNU_PARALLEL, "--will-cite", "-j", "2", HOOKE_HEADLESS}, rope_sweep),
                                           {"--shard", "{}/4", "--out", parts + "{}", "-q", ":::", "1", "2", "3", "4"}));
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  ASSERT_EQ(headless({"sweep", "--out", merged, "-q", "--merge", parts + "1", parts + "2", parts + "3", parts + "4"}).code, 0);
  ASSERT_EQ(sweep_rope({"--out", whole, "-q"}).code, 0);
  EXPECT_EQ(contents(fs::path(merged) / "sweep.csv"), contents(fs::path(whole) / "sweep.csv"));
}
#endif

}  // namespace
}  // namespace hooke
