// The table of file formats: what Hooke reads, writes and exports. From a row follow the files that the open dialog lists, the
// formats of `hooke convert`, the export dialog and the table in docs/reference/file-formats.md.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "base/table.h"
#include "formats/import_options.h"
#include "formats/scene_file.h"
#include "scene/quantity.h"

namespace hooke {

// A file that grows frame by frame. All members throw InputError or FileError.
class FrameSink {
 public:
  virtual ~FrameSink() = default;
  // `accuracy`: of the run; null where nothing measures it.
  virtual void add(const System& system, const State& state, const Accuracy* accuracy) = 0;
  // Moves the file to its final path. Without this call no file is left.
  virtual void finish() = 0;
};

// The data that an export needs.
enum class ExportSource {
  None,     // not offered as an export
  Scene,    // the current state: `format`
  Frames,   // each frame from now on: `open_frames`
  Plots,    // the plotted quantities, which the window has
  Picture,  // the current view, which the window draws
  Film,     // the window from now on
};

struct FileKind {
  std::string_view extension;  // ".json"
  std::string_view title;      // "Wavefront mesh"
  bool is_native = false;      // preserves everything; saving in another format is an export
  // From memory; `file` is its name in messages. Null: not readable.
  LoadedScene (*parse)(std::string_view text, const std::string& file, const ImportOptions& options) = nullptr;
  // Appends to `losses` what the format cannot represent, one sentence each. Throws InputError. Null: cannot be written from a scene.
  std::string (*format)(const Scene& scene, const std::string& file, std::vector<std::string>& losses) = nullptr;
  // A second file that the first one refers to, of the same name with this extension, written before it. Empty, null: there is none.
  std::string_view companion_extension = {};
  std::string (*format_companion)(const Scene& scene) = nullptr;
  // Null: cannot be written over time.
  std::unique_ptr<FrameSink> (*open_frames)(const std::filesystem::path& file, const System& system,
                                            const std::vector<Quantity>& quantities) = nullptr;

  ExportSource source = ExportSource::None;
  std::string_view label = {};        // in the export dialog
  std::string_view description = {};  // one sentence
  bool has_quantities = false;        // the dialog asks for quantities
  bool has_alpha = false;             // its pictures may have an alpha channel
  bool is_flat_only = false;          // only for 2-D scenes
  bool is_mesh = false;               // can be placed as a part, of any size
};

Table<FileKind> file_kinds();

// Those of the export dialog.
Table<FileKind> export_kinds();

// By the extension, ignoring case; null if it is not in the table.
const FileKind* find_file_kind(const std::filesystem::path& file);

// The kind of a file to read, by its extension without ".gz": that of "net.obj.gz" is .obj. Null if it is not in the table.
const FileKind* find_readable_kind(const std::filesystem::path& file);

// ".json, .obj or .xsp": the extensions that can be read, or to which a scene can be written.
std::string readable_extensions();
std::string writable_extensions();

// Whether the file has the native format.
bool is_scene_file(const std::filesystem::path& file);

}  // namespace hooke
