#include "draw/view.h"

#include "draw/beads.h"
#include "draw/cloth_surface.h"
#include "draw/gui_renderer.h"
#include "draw/net.h"
#include "draw/shader.h"
#include "draw/shadows.h"
#include "draw/stage.h"
#include "draw/strokes.h"
#include "draw/target.h"

namespace hooke {
namespace {

void clear(const Color& background) {
  glDisable(GL_SCISSOR_TEST);
  glDepthMask(GL_TRUE);
  glClearColor(background.red / 255.0f, background.green / 255.0f, background.blue / 255.0f, 1.0f);
  glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
}

// In a flat scene all lies in one plane: what is drawn later is on top.
void set_state(bool is_spatial) {
  is_spatial ? glEnable(GL_DEPTH_TEST) : glDisable(GL_DEPTH_TEST);
  glDepthFunc(GL_LEQUAL);
  glDisable(GL_CULL_FACE);
  glEnable(GL_BLEND);
  glBlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
}

void add_ghosts(const Subject& subject, Strokes& strokes, Beads& beads) {
  const auto scale = static_cast<float>(subject.options.scale);
  const Ink color = ink(subject.palette.hover, 0.55);
  if (const auto& line = subject.marks.ghost_spring)
    strokes.add_dashed(subject.projection, line->first, line->second, color, 1.75f * scale, 6.0f * scale, 4.0f * scale);
  if (const auto& place = subject.marks.ghost_point) {
    const glm::dvec4 clip = subject.projection.clip(*place);
    const Bead ghost{.radius = 3.0f * scale, .body = color, .ring = 7.0f * scale, .ring_ink = color};
    beads.add(subject.projection, clip, subject.projection.see(clip), ghost);
  }

  // many lines one over the other must stay faint
  const double faint = subject.marks.ghost_lines.size() > 500 ? 0.28 : 0.5;
  for (const auto& [from, to] : subject.marks.ghost_lines)
    strokes.add(subject.projection, from, to, ink(subject.palette.hover, faint), 1.25f * scale);
  for (const Vec3& place : subject.marks.ghost_nails) {
    const glm::dvec4 clip = subject.projection.clip(place);
    Bead nail{.radius = 3.5f * scale, .body = ink(subject.palette.nailed, 0.8)};
    nail.square = true;
    beads.add(subject.projection, clip, subject.projection.see(clip), nail);
  }
}

}  // namespace

struct View::Parts {
  Target target;
  Shader stroke_shader{"stroke"}, bead_shader{"bead"}, surface_shader{"surface"}, cloth_shader{"cloth"}, ball_shader{"ball"},
      ground_shader{"ground"}, shadow_shader{"shadow"};
  Stage stage;
  Shadows shadows;
  Net net;
  ClothSurface cloth;
  Strokes springs, marked_springs, ghost_springs;
  Beads points, marked_points, ghost_points;
  GuiRenderer gui;

  void gather(const Subject& subject);
  void draw_scene(const Subject& subject, const PicturePlace& place, int width, int height);
  void draw_stage(const Subject& subject);
  void draw_net(const Subject& subject);
  void draw_over(const Subject& subject);
};

void View::Parts::gather(const Subject& subject) {
  stage.clear();
  shadows.clear();
  cloth.clear();
  for (Strokes* strokes : {&springs, &marked_springs, &ghost_springs}) strokes->clear();
  for (Beads* beads : {&points, &marked_points, &ghost_points}) beads->clear();

  net.see(subject);
  shadows.add(subject, net);
  stage.add(subject, shadows);
  if (subject.options.surface) cloth.add(subject, net);
  // a bare cloth still shows what it hangs by, and what hangs on it
  if (subject.options.springs || !cloth.is_empty())
    net.add_springs(subject, subject.options.springs ? Net::Which::All : Net::Which::BesideCloth, springs);
  if (subject.options.points || !cloth.is_empty())
    net.add_points(subject, subject.options.points ? Net::Which::All : Net::Which::BesideCloth, points);
  net.add_marks(subject, marked_springs, marked_points);
  add_ghosts(subject, ghost_springs, ghost_points);
}

void View::Parts::draw_scene(const Subject& subject, const PicturePlace& place, int width, int height) {
  gather(subject);

  // only polygons have edges that need several samples a pixel
  const bool has_polygons = !cloth.is_empty() || !stage.solids.is_empty();
  target.begin(width, height, has_polygons ? subject.options.samples : 0);
  clear(subject.options.background);
  glViewport(place.x, height - place.y - place.height, place.width, place.height);
  set_state(subject.snapshot.system->dimensions == 3);
  draw_stage(subject);
  target.resolve();
  draw_net(subject);
  draw_over(subject);
}

// What stands behind the network and can hide it.
void View::Parts::draw_stage(const Subject& subject) {
  glDepthMask(GL_FALSE);
  stage.backdrop.draw(ground_shader);
  glDepthMask(GL_TRUE);
  stage.floors.draw(ground_shader);
  shadows.bind();
  stage.balls.draw(ball_shader, subject.projection, subject.camera.pole, subject.palette.shadow);

  // surfaces give way a little to the lines that lie on them
  glEnable(GL_POLYGON_OFFSET_FILL);
  glPolygonOffset(1.0f, 2.0f);
  stage.solids.draw(surface_shader);

  // and shadows lie on them
  glDepthMask(GL_FALSE);
  glPolygonOffset(-1.0f, -2.0f);
  shadows.draw(shadow_shader, subject.palette.shadow);
  glDepthMask(GL_TRUE);
  glPolygonOffset(1.0f, 2.0f);
  cloth.draw(cloth_shader);
  glDisable(GL_POLYGON_OFFSET_FILL);
}

void View::Parts::draw_net(const Subject& subject) {
  const int width = subject.projection.width(), height = subject.projection.height();
  glDepthMask(GL_FALSE);
  stage.outlines.draw(stroke_shader, width, height);
  marked_springs.draw(stroke_shader, width, height);

  // where lines hide one another, half-covered pixels would hide what is behind them, and a dense net would shimmer
  glDepthMask(net.is_dense(subject.options) ? GL_FALSE : GL_TRUE);
  springs.draw(stroke_shader, width, height);
  glDepthMask(GL_TRUE);
  points.draw(bead_shader, width, height, subject.options.scale);
}

// What can be seen through, and what the person is doing.
void View::Parts::draw_over(const Subject& subject) {
  const int width = subject.projection.width(), height = subject.projection.height();
  glDepthMask(GL_FALSE);
  glEnable(GL_CULL_FACE);
  stage.faint_solids.draw(surface_shader);
  glDisable(GL_CULL_FACE);
  stage.faint_balls.draw(ball_shader, subject.projection, subject.camera.pole, subject.palette.shadow);
  stage.veils.draw(ground_shader);

  // rings and ghosts are seen through everything
  glDisable(GL_DEPTH_TEST);
  marked_points.draw(bead_shader, width, height, subject.options.scale);
  ghost_springs.draw(stroke_shader, width, height);
  ghost_points.draw(bead_shader, width, height, subject.options.scale);
  glDepthMask(GL_TRUE);
}

ViewOptions options_for(const ViewSettings& settings, const Print& print) {
  ViewOptions options;
  options.points = settings.points;
  options.springs = settings.springs;
  options.surface = settings.surface;
  options.strain_colors = settings.strain_colors;
  options.shadows = settings.shadows;
  options.print = print;
  if (settings.background) options.background = *settings.background;
  return options;
}

View::View() : parts_(std::make_unique<Parts>()) {}
View::~View() = default;

void View::draw(const Snapshot& snapshot, const Marks& marks, const Camera& camera, const ViewOptions& options, int width, int height,
                const ImDrawData* panels) {
  const PicturePlace place = options.place.width > 0 ? options.place : PicturePlace{0, 0, width, height};
  const Projection projection(camera, place.width, place.height);
  const Palette palette = palette_for(options.background);
  parts_->draw_scene({snapshot, marks, options, projection, camera, palette}, place, width, height);
  if (panels) parts_->gui.draw(*panels);
}

void View::upload_fonts() { parts_->gui.upload_fonts(); }
void* View::upload_picture(const Picture& picture) { return parts_->gui.upload_picture(picture); }
void View::show() const {
  parts_->target.show();
  glFinish();
}
Image View::read() const { return parts_->target.read(); }

}  // namespace hooke
