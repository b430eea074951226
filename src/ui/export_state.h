// What is about to be exported, and how far that is.
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace hooke {

struct ExportKind {
  std::string_view extension;  // ".obj"
  std::string_view label;
  std::string_view description;
  bool over_time;   // what the scene does from here on, so many seconds
  bool quantities;  // in a table; over time they are to be named
  bool flat_only;
};
std::span<const ExportKind> export_kinds();

struct ExportState {
  bool is_shown = false, is_new = false;
  std::size_t kind = 0;
  std::string path;  // as typed; its ending follows the kind
  std::string quantities = "time, kinetic, elastic, gravitational, total";
  double seconds = 2.0;
  bool wants_export = false, wants_stop = false;
  double fraction = -1.0;        // that is done; below 0: nothing is going on
  double running_seconds = 0.0;  // [s] since it began
  bool is_running() const { return fraction >= 0.0; }
};

}  // namespace hooke
