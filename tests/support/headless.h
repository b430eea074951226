// hooke-headless as scripts use it, and what it writes.
#pragma once

#include <gtest/gtest.h>
#include <rapidjson/document.h>

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "support/process.h"

namespace hooke {

inline Outcome headless(std::vector<std::string> words) {
  words.insert(words.begin(), HOOKE_HEADLESS);
  return run_process(words);
}

// Arguments separated by spaces, in a folder, without a display.
inline Outcome run_headless(const std::string& arguments, const std::filesystem::path& folder = ".") {
  std::vector<std::string> words{"/usr/bin/env", "-C", folder.string(), "-u", "DISPLAY", HOOKE_HEADLESS};
  std::istringstream text(arguments);
  for (std::string word; text >> word;) words.push_back(word);
  return run_process(words);
}

// Where no file may be longer than `kibibytes`: the write that would make it longer fails, as on a full disk.
inline Outcome headless_with_short_files(int kibibytes, const std::vector<std::string>& words) {
  std::vector<std::string> shell{"/bin/bash", "-c", "trap '' XFSZ; ulimit -f " + std::to_string(kibibytes) + "; exec \"$0\" \"$@\"",
                                 HOOKE_HEADLESS};
  shell.insert(shell.end(), words.begin(), words.end());
  return run_process(shell);
}

// Returns the path as an argument.
inline std::string write_file(const std::filesystem::path& file, const std::string& text) {
  std::ofstream(file) << text;
  return file.string();
}

inline rapidjson::Document parse_json(const std::string& text) {
  rapidjson::Document document;
  document.Parse<rapidjson::kParseFullPrecisionFlag>(text.c_str());
  EXPECT_FALSE(document.HasParseError()) << text.substr(0, 500);
  return document;
}

inline std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

// One free point with a speed of 1 m/s, so that results can be computed by hand.
inline constexpr const char* free_point =
    R"({"hooke": 1, "gravity": [0, 0, 0], "points": [{"position": [0, 0, 0], "velocity": [1, 0, 0], "mass": 2}],
  "simulation": {"frame_rate": 10, "substeps": 1}})";

}  // namespace hooke
