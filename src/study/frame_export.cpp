#include "study/frame_export.h"

#include <cmath>

#include "base/atomic_write.h"
#include "base/errors.h"
#include "base/file_limits.h"
#include "base/printable.h"
#include "formats/point_cache.h"
#include "lab/lab.h"

namespace hooke {
namespace {

// Receives the frames; `finish` puts the file in its place.
class FrameSink {
 public:
  virtual ~FrameSink() = default;
  virtual void add(const System& system, const State& state) = 0;
  virtual void finish() = 0;
};

class TableSink : public FrameSink {
 public:
  explicit TableSink(const FrameExport& request) : request_(request), text_(csv_heading(request.quantities)) {}
  void add(const System& system, const State& state) override {
    text_ += csv_row(request_.quantities, system, state);
    if (text_.size() > max_file_bytes)
      throw InputError(printable(request_.file.native()) + ": more than 256 MiB: fewer quantities or seconds");
  }
  void finish() override { write_atomically(request_.file, text_); }

 private:
  const FrameExport& request_;
  std::string text_;
};

class CacheSink : public FrameSink {
 public:
  CacheSink(const FrameExport& request, Index points) : writer_(request.file, points) {}
  void add(const System&, const State& state) override { writer_.add(state.position); }
  void finish() override { writer_.close(); }

 private:
  PointCacheWriter writer_;
};

}  // namespace

void write_frames(Scene scene, const FrameExport& request, const Progress& progress) {
  const bool is_table = request.file.extension() == ".csv";
  std::unique_ptr<FrameSink> sink;
  if (is_table)
    sink = std::make_unique<TableSink>(request);
  else
    sink = std::make_unique<CacheSink>(request, scene.system.point_count());

  constexpr double round_off = 1e-9;
  const double exact_frames = request.seconds * scene.settings.frame_rate;
  const long frames = std::max(0l, static_cast<long>(std::ceil(std::min(exact_frames, 1e9) * (1.0 - round_off) - round_off)));
  Lab lab(std::move(scene), KeepStart::No);
  std::string stop_reason;
  sink->add(lab.scene().system, lab.scene().state);
  for (long frame = 0; frame < frames && stop_reason.empty(); ++frame) {
    if (!progress(static_cast<double>(frame) / static_cast<double>(frames))) return;
    if (lab.step()) {
      sink->add(lab.scene().system, lab.scene().state);
    } else {
      lab.publish();
      stop_reason = lab.status()->diagnosis.message;
    }
  }
  sink->finish();
  if (!stop_reason.empty()) throw InputError(stop_reason);
}

}  // namespace hooke
