#include "study/frame_export.h"

#include <algorithm>
#include <cmath>

#include "base/errors.h"
#include "base/printable.h"
#include "formats/file_kind.h"
#include "lab/lab.h"

namespace hooke {
void write_frames(Scene scene, const FrameExport& request, const Progress& progress) {
  const FileKind* kind = find_file_kind(request.file);
  if (kind == nullptr || kind->open_frames == nullptr)
    throw InputError(printable(request.file.native()) + ": file format: cannot be written over time");
  const std::unique_ptr<FrameSink> sink = kind->open_frames(request.file, scene.system, request.quantities);

  constexpr double round_off = 1e-9;
  const double exact_frames = request.seconds * scene.settings.frame_rate;
  const long frames = std::max(0l, static_cast<long>(std::ceil(std::min(exact_frames, 1e9) * (1.0 - round_off) - round_off)));
  Lab lab(std::move(scene), KeepStart::No);
  std::string stop_reason;
  const bool has_accuracy = std::ranges::any_of(request.quantities, [](const Quantity& each) { return each.row->needs_accuracy; });
  lab.submit(SetAccuracy{has_accuracy ? AccuracyMode::Full : AccuracyMode::Off});
  lab.apply_pending();
  const auto add = [&] {
    const Accuracy accuracy = lab.accuracy();
    sink->add(lab.scene().system, lab.scene().state, &accuracy);
  };
  add();
  for (long frame = 0; frame < frames && stop_reason.empty(); ++frame) {
    if (!progress(static_cast<double>(frame) / static_cast<double>(frames))) return;
    if (lab.step()) {
      add();
    } else {
      lab.publish();
      stop_reason = lab.status()->diagnosis.message;
    }
  }
  sink->finish();
  if (!stop_reason.empty()) throw InputError(stop_reason);
}

}  // namespace hooke
