#include "app/window/loop.h"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "base/errors.h"
#include "draw/view.h"
#include "formats/gallery.h"
#include "ui/theme.h"

namespace hooke {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

// How long a frame waits for events while nothing moves, and how long after the last event it does not wait [s].
constexpr double idle_wait = 0.25, settle_time = 0.4;
// The interval at which a hidden window polls events [s].
constexpr double hidden_wait = 0.1;
// Weight of the newest value in the displayed timings.
constexpr double smoothing = 0.08;

void smooth(double& shown, double value) { shown = shown == 0.0 ? value : shown + smoothing * (value - shown); }

// Decides when the next frame is due, and measures the frame rate.
class LoopPacer {
 public:
  // Sleeps until the next picture is due, or longer if nothing moves.
  void wait(Window& window, bool app_is_idle) {
    is_idle_ = app_is_idle && seconds_since(last_event_) > settle_time;
    const double period = window.is_hidden() ? hidden_wait : is_idle_ ? idle_wait : 0.9 * window.refresh_period();
    do window.wait(period - seconds_since(last_frame_));
    while (!is_idle_ && seconds_since(last_frame_) < period);
    elapsed_ = seconds_since(last_frame_);
    last_frame_ = Clock::now();
  }
  void record_event() { last_event_ = Clock::now(); }

  // The first frame compiles the shaders, and frames of a static scene are rare: neither counts.
  void record_drawn_frame(double seconds) {
    const bool counts = !first_ && !is_idle_;
    first_ = false;
    if (!counts) return;
    smooth(statistics_.draw_ms, 1000.0 * seconds);
    smooth(frame_seconds_, elapsed_);
    statistics_.frames_per_second = 1.0 / frame_seconds_;
  }
  const FrameStatistics& frame_statistics() const { return statistics_; }

 private:
  Clock::time_point last_frame_ = Clock::now(), last_event_ = Clock::now();
  double elapsed_ = 0.0, frame_seconds_ = 0.0;  // [s]
  bool is_idle_ = false, first_ = true;
  FrameStatistics statistics_;
};

// Reloads style and fonts when the scale of the screen or of the interface changes.
class Scale {
 public:
  void follow(const Window& window, double desired, View& view) {
    const glm::dvec2 size = window.size();
    const double scale = fitting_scale(desired * window.content_scale(), size.x, size.y),
                 density = window.framebuffer_size().x / std::max(1.0, window.size().x);
    if (scale == scale_ && density == density_ && !needs_fonts()) return;
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

Viewport place_of_scene(const App& app, const Scale& scale) {
  const Rect& scene = app.layout().scene;
  const auto pixels = [&](double length) { return static_cast<int>(std::lround(length * scale.density())); };
  return {pixels(scene.x), pixels(scene.y), pixels(scene.width), pixels(scene.height)};
}

// Draws the window.
void draw(View& view, const App& app, const Window& window, const Scale& scale, const ImDrawData* panels) {
  ViewOptions options = app.view_options();
  options.scale = scale.scale() * scale.density();
  options.place = place_of_scene(app, scale);
  const glm::ivec2 size = window.framebuffer_size();
  view.draw(*app.status().snapshot, app.marks(), app.camera(), options, size.x, size.y, panels);
}

// The window that was drawn last; or the scene without panels, at its size on screen or at another one.
Picture picture_of(View& view, const App& app, const Scale& scale, const PictureOptions& wish) {
  if (wish.panels) return view.read();
  ViewOptions options = app.view_options();
  const Viewport place = place_of_scene(app, scale);
  const int width = wish.width == 0 ? place.width : wish.width, height = wish.height == 0 ? place.height : wish.height;
  options.scale = scale.scale() * height / app.layout().scene.height;
  options.transparent = wish.transparent;
  if (options.transparent) options.grid = false;
  Marks marks;
  marks.arrows = app.marks().arrows;
  marks.ghost_networks = app.marks().ghost_networks;
  view.draw(*app.status().snapshot, marks, app.camera(), options, width, height, nullptr);
  return view.read(options.transparent);
}

}  // namespace

void run_loop(Window& window, App& app) {
  if (const std::string error = load_gl(); !error.empty()) throw WindowError(error);
  View view;
  Scale scale;
  LoopPacer pacer;

  while (!app.is_finished()) {
    pacer.wait(window, app.is_idle());

    // the layout must match the window before its events are handled
    if (!window.is_hidden()) {
      scale.follow(window, app.interface_scale(), view);
      app.resize(window.size(), scale.scale());
    }
    const auto events = window.take_events();
    if (!events.empty()) pacer.record_event();
    for (const Event& event : events) app.handle(event);
    if (window.is_hidden()) {
      app.poll_background_work();
      continue;
    }

    // a picture that was asked for in the frame before: without the dialog that did
    const auto wanted = app.captures().take_wanted_picture();

    // panels
    if (Gallery& gallery = app.panels().gallery; gallery.is_shown && gallery.thumbnails == nullptr)
      gallery.thumbnails = view.upload_picture(read_thumbnails());
    window.gui().begin_frame();
    app.build_frame(pacer.frame_statistics());
    const ImDrawData* panels = window.gui().end_frame();
    window.set_title(app.title());

    // picture
    const auto start = Clock::now();
    draw(view, app, window, scale, panels);
    view.show();
    const auto picture = [&](const PictureOptions& wish) { return picture_of(view, app, scale, wish); };
    if (wanted) app.captures().write_picture(*wanted, picture);
    app.captures().film_recorder().take(seconds_since({}), picture);
    pacer.record_drawn_frame(seconds_since(start));
    window.swap();
  }
}

}  // namespace hooke
