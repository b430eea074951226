#include "app/loop.h"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "draw/view.h"
#include "ui/theme.h"

namespace hooke {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

// How long a frame waits for events when nothing moves [s], and for how long after the last one it does not.
constexpr double still_wait = 0.25, settle_time = 0.4;
// A hidden window looks this seldom for events [s].
constexpr double hidden_wait = 0.1;
// Weight of the newest value in the displayed timings.
constexpr double smoothing = 0.08;

void smooth(double& shown, double value) { shown = shown == 0.0 ? value : shown + smoothing * (value - shown); }

// Reloads style and fonts when the window comes to a screen of another scale.
class Scale {
 public:
  void follow(const Window& window, View& view) {
    const double scale = window.content_scale(), density = window.framebuffer_size().x / std::max(1.0, window.size().x);
    if (scale == scale_ && density == density_) return;
    scale_ = scale;
    density_ = density;
    load_theme(scale, density);
    view.upload_fonts();
  }
  double scale() const { return scale_; }
  double density() const { return density_; }

 private:
  double scale_ = 0.0, density_ = 0.0;
};

void draw(View& view, const App& app, const Window& window, const Scale& scale, const ImDrawData* panels) {
  ViewOptions options = app.view_options();
  options.scale = scale.scale() * scale.density();
  const Rect& scene = app.layout().scene;
  const auto pixels = [&](double length) { return static_cast<int>(std::lround(length * scale.density())); };
  options.place = {pixels(scene.x), pixels(scene.y), pixels(scene.width), pixels(scene.height)};
  const glm::ivec2 size = window.framebuffer_size();
  view.draw(*app.status().snapshot, app.marks(), app.camera(), options, size.x, size.y, panels);
  view.show();
}

}  // namespace

void run_loop(Window& window, App& app) {
  if (const std::string error = load_gl(); !error.empty()) throw WindowError(error);
  View view;
  Scale scale;
  Figures figures;
  double frame_seconds = 0.0;
  bool first = true;
  Clock::time_point last_frame = Clock::now(), last_event = last_frame;

  while (!app.is_finished()) {
    // sleep until the next picture is due, or longer when nothing moves
    const bool still = app.is_still() && seconds_since(last_event) > settle_time;
    const double period = window.is_hidden() ? hidden_wait : still ? still_wait : 0.9 * window.refresh_period();
    do window.wait(period - seconds_since(last_frame));
    while (!still && seconds_since(last_frame) < period);

    // the place of an event is in the window as it is now
    if (!window.is_hidden()) {
      scale.follow(window, view);
      app.resize(window.size(), scale.scale());
    }
    const auto events = window.take_events();
    if (!events.empty()) last_event = Clock::now();
    for (const Event& event : events) app.handle(event);
    const double elapsed = seconds_since(last_frame);
    last_frame = Clock::now();
    if (window.is_hidden()) continue;

    window.gui().begin_frame();
    app.build_frame(figures);
    const ImDrawData* panels = window.gui().end_frame();
    window.set_title(app.title());

    // picture
    const auto start = Clock::now();
    draw(view, app, window, scale, panels);
    const double drawn = seconds_since(start);
    window.swap();

    // the first frame, which compiles the shaders, and the rare ones of a still scene say nothing of the speed
    if (first || still) {
      first = false;
      continue;
    }
    smooth(figures.draw_ms, 1000.0 * drawn);
    smooth(frame_seconds, elapsed);
    figures.frames_per_second = 1.0 / frame_seconds;
  }
}

}  // namespace hooke
