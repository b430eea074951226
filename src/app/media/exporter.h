// Exports of the scene: immediately, or for formats over time in a thread that runs a copy of the scene.
#pragma once

#include <filesystem>
#include <string>

#include "app/document/document.h"
#include "app/media/captures.h"
#include "app/work/background_task.h"
#include "app/work/file_task.h"
#include "formats/file_kind.h"

namespace hooke {

class Exporter {
 public:
  Exporter(ToolContext& context, Panels& panels, FileTask& task, Captures& captures, const Document& document)
      : context_(context), panels_(panels), task_(task), captures_(captures), document_(document) {}

  // Opens the export dialog.
  void show();
  // Exports what panels.export_state describes.
  void start();
  void stop() { run_.stop(); }
  // Once per frame.
  void poll() { run_.follow(); }
  bool is_running() const { return run_.is_running(); }
  ExportWork progress() const;

 private:
  void export_frames(const FileKind& kind);
  void export_state();
  void export_plots();
  void finish(const std::string& error, bool stopped);

  ToolContext& context_;
  Panels& panels_;
  FileTask& task_;
  Captures& captures_;
  const Document& document_;
  std::filesystem::path file_;
  BackgroundTask run_;  // last: the destructor waits for it before anything that it uses is destroyed
};

}  // namespace hooke
