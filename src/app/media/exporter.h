// Exports of the scene: immediately, or for formats over time in a thread that runs a copy of the scene.
#pragma once

#include <atomic>
#include <chrono>
#include <filesystem>
#include <future>
#include <memory>
#include <string>

#include "app/document/document.h"
#include "app/media/captures.h"
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
  void stop();
  // Once per frame.
  void poll();
  bool is_running() const { return run_.valid(); }
  ExportWork progress() const;

 private:
  struct Shared {
    std::atomic<double> fraction = 0.0;
    std::atomic<bool> stop = false;
  };
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
  std::chrono::steady_clock::time_point started_{};
  std::shared_ptr<Shared> shared_;
  std::future<std::string> run_;  // last: the destructor waits for it before anything that it uses is destroyed
};

}  // namespace hooke
