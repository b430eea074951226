#include "batch/capture_report.h"

#include <algorithm>
#include <cmath>

#include "base/bounds.h"
#include "base/number_text.h"
#include "batch/accuracy_json.h"
#include "batch/output_folder.h"
#include "batch/run_report.h"
#include "sim/methods/integrator.h"
#include "sim/model/hash.h"

namespace hooke {
namespace {

std::filesystem::path created(const std::filesystem::path& folder) {
  make_folder(folder);
  return folder;
}

// The time and every quantity of the accuracy.
std::vector<Quantity> report_quantities() {
  std::vector<Quantity> quantities;
  parse_quantities("time,kinetic,elastic,gravitational,total", 0, 0, quantities);
  for (const QuantityRow& row : quantity_rows())
    if (row.needs_accuracy) quantities.push_back({&row, 0});
  return quantities;
}

}  // namespace

CaptureReport::CaptureReport(const std::filesystem::path& folder, const Scene& scene)
    : csv_((created(folder) / "report.csv").string()), json_file_((folder / "report.json").string()) {
  std::string heading = csv_heading(report_quantities());
  heading.pop_back();
  csv_.write("file," + heading + ",half_error_substeps [1],half_error_cost [1],hash\n");
  json_.begin_object(JsonWriter::Layout::Lines);
  json_.text("scene", scene.name);
  json_.text("integrator", scene.settings.integrator->id);
  json_.integer("substeps", scene.settings.substeps);
  json_.number("frame_rate", scene.settings.frame_rate);
  json_.key("frames");
  json_.begin_list(JsonWriter::Layout::Lines);
}

void CaptureReport::add(const Lab& lab, const std::string& file) {
  const Scene& scene = lab.scene();
  const Accuracy accuracy = lab.accuracy();
  const std::string hash = to_hexadecimal(hash_state(scene.state));
  std::string row = csv_row(report_quantities(), scene.system, scene.state, &accuracy);
  row.pop_back();
  const std::string half =
      accuracy.half_error_substeps > 0 ? std::to_string(accuracy.half_error_substeps) + "," + format_exact(accuracy.half_error_cost) : ",";
  csv_.write(file + "," + row + "," + half + "," + hash + "\n");

  json_.begin_object(JsonWriter::Layout::Line);
  json_.text("file", file);
  json_.number("time", scene.state.time);
  json_.key("error");
  write_error(json_, accuracy);
  json_.key("energy_balance");
  write_energy_balance(json_, accuracy);
  json_.key("half_error");
  write_half_error(json_, accuracy);
  json_.text("hash", hash);
  json_.end();
  json_file_.write(json_.take());
}

void CaptureReport::finish(bool interrupted) {
  json_.end();
  json_.boolean("interrupted", interrupted);
  json_.end();
  json_file_.write(json_.take() + "\n");
  json_file_.close();
  csv_.close();
}

void ErrorLimit::check(const Lab& lab, const std::string& frame) {
  if (!message_.empty()) return;
  const Accuracy accuracy = lab.accuracy();
  const auto& error = accuracy.accumulated;
  if (error.value && *error.value <= limit_) return;
  message_ = frame + ", at " + number_text(lab.scene().state.time) + " s: " +
             (error.value ? "estimated error " + number_text(*error.value) + " m" : "error not known: " + std::string(error.reason)) +
             ", limit " + format_exact(limit_) + " m";
}

}  // namespace hooke
