// The report of `capture`: the accuracy of every picture, as report.csv and report.json in a folder.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "base/json_writer.h"
#include "batch/output_file.h"
#include "lab/lab.h"

namespace hooke {

class CaptureReport {
 public:
  // Creates the folder if there is none. Throws FileError.
  CaptureReport(const std::filesystem::path& folder, const Scene& scene);
  // The present frame of the laboratory, drawn to `file`.
  void add(const Lab& lab, const std::string& file);
  void finish(bool interrupted);

 private:
  OutputFile csv_, json_file_;
  JsonWriter json_;
};

// Notes the first frame, by its name, whose accumulated error exceeds a limit [m], or is so large that the motion cannot be predicted.
class ErrorLimit {
 public:
  explicit ErrorLimit(double limit) : limit_(limit) {}
  void check(const Lab& lab, const std::string& frame);
  // "frame_00012.png, at 0.2 s: estimated error 0.002 m, limit 0.001 m"; empty: it was not exceeded.
  const std::string& message() const { return message_; }

 private:
  double limit_;
  std::string message_;
};

}  // namespace hooke
