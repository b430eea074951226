#include "draw/view.h"

#include "draw/beads.h"
#include "draw/gui_renderer.h"
#include "draw/net.h"
#include "draw/shader.h"
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

void set_blending() {
  glEnable(GL_BLEND);
  glBlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
}

}  // namespace

struct View::Parts {
  Target target;
  Shader stroke_shader{"stroke"}, bead_shader{"bead"};
  Net net;
  Strokes springs, marked_springs;
  Beads points, marked_points;
  GuiRenderer gui;

  void draw_scene(const Subject& subject, int width, int height);
};

void View::Parts::draw_scene(const Subject& subject, int width, int height) {
  net.see(subject);
  for (Strokes* strokes : {&springs, &marked_springs}) strokes->clear();
  for (Beads* beads : {&points, &marked_points}) beads->clear();
  if (subject.options.springs) net.add_springs(subject, springs);
  if (subject.options.points) net.add_points(subject, points);
  net.add_marks(subject, marked_springs, marked_points);

  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_LEQUAL);
  glDisable(GL_CULL_FACE);
  set_blending();

  glDepthMask(GL_FALSE);
  marked_springs.draw(stroke_shader, width, height);
  glDepthMask(GL_TRUE);
  springs.draw(stroke_shader, width, height);
  points.draw(bead_shader, width, height);
  marked_points.draw(bead_shader, width, height);
  glDisable(GL_DEPTH_TEST);
}

View::View() : parts_(std::make_unique<Parts>()) {}
View::~View() = default;

void View::draw(const Snapshot& snapshot, const Marks& marks, const Camera& camera, const ViewOptions& options, int width, int height,
                const ImDrawData* panels) {
  const PicturePlace place = options.place.width > 0 ? options.place : PicturePlace{0, 0, width, height};
  const Projection projection(camera, place.width, place.height);
  const Palette palette = palette_for(options.background);
  parts_->target.begin(width, height, options.samples);
  clear(options.background);
  glViewport(place.x, height - place.y - place.height, place.width, place.height);
  parts_->draw_scene({snapshot, marks, options, projection, camera, palette}, place.width, place.height);
  parts_->target.resolve();
  if (panels) parts_->gui.draw(*panels);
}

void View::upload_fonts() { parts_->gui.upload_fonts(); }
void View::show() const {
  parts_->target.show();
  glFinish();
}
Image View::read() const { return parts_->target.read(); }

}  // namespace hooke
