#include "lab/frames_file.h"

#include <cmath>

#include "lab/atomic_write.h"
#include "lab/file_limits.h"
#include "lab/lab.h"
#include "lab/point_cache.h"
#include "lab/printable.h"
#include "sim/errors.h"

namespace hooke {
namespace {

// Takes the frames; `finish` makes the file whole.
class Sink {
 public:
  virtual ~Sink() = default;
  virtual void add(const System& system, const State& state) = 0;
  virtual void finish() = 0;
};

class TableSink : public Sink {
 public:
  explicit TableSink(const FramesFile& wanted) : wanted_(wanted), text_(csv_heading(wanted.quantities)) {}
  void add(const System& system, const State& state) override {
    text_ += csv_row(wanted_.quantities, system, state);
    if (text_.size() > most_file_bytes)
      throw Refused(printable(wanted_.file.native()) + ": more than 256 MiB: fewer quantities or seconds");
  }
  void finish() override { write_atomically(wanted_.file, text_); }

 private:
  const FramesFile& wanted_;
  std::string text_;
};

// Grows beside its place, so that a run that is given up leaves the old file as it was.
class CacheSink : public Sink {
 public:
  CacheSink(const FramesFile& wanted, Index points)
      : file_(wanted.file), part_(wanted.file.native() + ".part"), writer_(std::make_unique<PointCacheWriter>(part_, points)) {}
  ~CacheSink() override {
    std::error_code ignored;
    writer_.reset();
    std::filesystem::remove(part_, ignored);
  }
  void add(const System&, const State& state) override { writer_->add(state.position); }
  void finish() override {
    writer_->close();
    std::error_code error;
    std::filesystem::rename(part_, file_, error);
    if (error) throw FileError(printable(file_.native()) + ": " + error.message());
  }

 private:
  std::filesystem::path file_, part_;
  std::unique_ptr<PointCacheWriter> writer_;
};

}  // namespace

void write_frames(Scene scene, const FramesFile& wanted, const GoesOn& goes_on) {
  const bool is_table = wanted.file.extension() == ".csv";
  std::unique_ptr<Sink> sink;
  if (is_table)
    sink = std::make_unique<TableSink>(wanted);
  else
    sink = std::make_unique<CacheSink>(wanted, scene.system.point_count());

  constexpr double round_off = 1e-9;
  const double exact = wanted.seconds * scene.settings.frame_rate;
  const long frames = std::max(0l, static_cast<long>(std::ceil(std::min(exact, 1e9) * (1.0 - round_off) - round_off)));
  Lab lab(std::move(scene), KeepStart::No);
  std::string stopped;
  sink->add(lab.scene().system, lab.scene().state);
  for (long frame = 0; frame < frames && stopped.empty(); ++frame) {
    if (!goes_on(static_cast<double>(frame) / static_cast<double>(frames))) return;
    if (lab.step()) {
      sink->add(lab.scene().system, lab.scene().state);
    } else {
      lab.publish();
      stopped = lab.status()->message;
    }
  }
  sink->finish();
  if (!stopped.empty()) throw Refused(stopped);
}

}  // namespace hooke
