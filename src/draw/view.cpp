#include "draw/view.h"

#include <algorithm>
#include <glm/geometric.hpp>

#include "draw/gl/gui_renderer.h"
#include "draw/gl/render_target.h"
#include "draw/gl/shader.h"
#include "draw/parts/cloth_surface.h"
#include "draw/parts/environment.h"
#include "draw/parts/network_renderer.h"
#include "draw/parts/point_impostors.h"
#include "draw/parts/shadows.h"
#include "draw/parts/strokes.h"

namespace hooke {
namespace {

void clear(const Color& background, float opacity) {
  glDepthMask(GL_TRUE);
  // readers expect colors multiplied by the opacity
  glClearColor(opacity * background.red / 255.0f, opacity * background.green / 255.0f, opacity * background.blue / 255.0f, opacity);
  glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
}

void set_scissor(const PixelBox& box) { glScissor(box.left, box.bottom, box.right - box.left, box.top - box.bottom); }

// In a 2-D scene everything lies in one plane: later objects are drawn on top.
void set_state(bool is_spatial) {
  is_spatial ? glEnable(GL_DEPTH_TEST) : glDisable(GL_DEPTH_TEST);
  glDepthFunc(GL_LEQUAL);
  glDisable(GL_CULL_FACE);
  glEnable(GL_BLEND);
  glBlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
}

// Other runs of the network: its springs and points in one color each.
void add_ghost_networks(const DrawContext& context, Strokes& strokes, PointImpostors& impostors) {
  const auto scale = static_cast<float>(context.options.scale);
  const System& system = *context.snapshot.system;
  const bool is_dense = system.springs().size() > 500;
  // more rings than this would hide the run
  constexpr std::size_t max_ghost_points = 24;
  for (auto ghost = context.marks.ghost_networks.rbegin(); ghost != context.marks.ghost_networks.rend(); ++ghost) {
    const std::vector<Vec3>& places = *ghost->positions;
    if (places.size() != system.points().size()) continue;
    for (const Spring& spring : system.springs()) {
      if (!system.is_on(spring) || spring.family == SpringFamily::Shear || spring.family == SpringFamily::Bend) continue;
      strokes.add(context.projection, places[system.index_of(spring.first)], places[system.index_of(spring.second)],
                  rgba(ghost->color, is_dense ? 0.45 : 0.85), (is_dense ? 1.0f : 1.75f) * scale);
    }
    if (places.size() > max_ghost_points) continue;
    for (const Vec3& place : places) {
      const glm::dvec4 clip = context.projection.clip(place);
      const PointImpostor point{
          .radius = 2.5f * scale, .body = rgba(ghost->color, 0.5), .ring = 4.5f * scale, .ring_color = rgba(ghost->color)};
      impostors.add(context.projection, clip, context.projection.project(clip), point);
    }
  }
}

void add_arrows(const DrawContext& context, Strokes& strokes) {
  const auto scale = static_cast<float>(context.options.scale);
  for (const Arrows& arrows : context.marks.arrows) {
    const Color color = arrows.kind == Arrows::Kind::Velocity ? context.palette.velocity : context.palette.force;
    for (const auto& [from, to] : arrows.lines) strokes.add_arrow(context.projection, from, to, rgba(color), 2.0f * scale, 9.0f * scale);
  }
}

void add_ghosts(const DrawContext& context, Strokes& strokes, PointImpostors& impostors) {
  const auto scale = static_cast<float>(context.options.scale);
  const Rgba color = rgba(context.palette.hover, 0.55);
  if (const auto& line = context.marks.ghost_spring)
    strokes.add_dashed(context.projection, line->first, line->second, color, 1.75f * scale, 6.0f * scale, 4.0f * scale);
  if (const auto& place = context.marks.ghost_point) {
    const glm::dvec4 clip = context.projection.clip(*place);
    const PointImpostor ghost{.radius = 3.0f * scale, .body = color, .ring = 7.0f * scale, .ring_color = color};
    impostors.add(context.projection, clip, context.projection.project(clip), ghost);
  }

  add_ghost_networks(context, strokes, impostors);

  // Many overlapping lines must stay faint, and more so where they are only pixels apart: their pattern would not be that of the part.
  const auto& lines = context.marks.ghost_lines;
  const Vec3 from = lines.empty() ? Vec3(0.0) : lines[0].first, to = lines.empty() ? Vec3(0.0) : lines[0].second;
  const double length = context.projection.scale(context.projection.clip(from)) * glm::distance(from, to) / scale;  // [px of the screen]
  const double faint = lines.size() > 500 ? 0.28 * std::clamp(length / 12.0, 0.2, 1.0) : 0.5;
  for (const auto& [a, b] : lines) strokes.add(context.projection, a, b, rgba(context.palette.hover, faint), 1.25f * scale);
  for (const Vec3& place : context.marks.ghost_nails) {
    const glm::dvec4 clip = context.projection.clip(place);
    PointImpostor nail{.radius = 3.5f * scale, .body = rgba(context.palette.nailed, 0.8)};
    nail.square = true;
    impostors.add(context.projection, clip, context.projection.project(clip), nail);
  }
}

}  // namespace

struct View::Parts {
  RenderTarget target;
  Shader stroke_shader{"stroke"}, impostor_shader{"bead"}, surface_shader{"surface"}, cloth_shader{"cloth"}, ball_shader{"ball"},
      ground_shader{"ground"}, shadow_shader{"shadow"};
  Environment environment;
  Shadows shadows;
  NetworkRenderer network_renderer;
  ClothSurface cloth;
  Strokes springs, marked_springs, ghost_springs;
  PointImpostors points, marked_points, ghost_points;
  GuiRenderer gui;

  void gather(const DrawContext& context) {
    environment.clear();
    shadows.clear();
    cloth.clear();
    for (Strokes* strokes : {&springs, &marked_springs, &ghost_springs}) strokes->clear();
    for (PointImpostors* impostors : {&points, &marked_points, &ghost_points}) impostors->clear();

    network_renderer.project(context);
    shadows.add(context, network_renderer);
    environment.add(context, shadows);
    if (context.options.surface) cloth.add(context, network_renderer);
    // A cloth without visible springs still shows its supports and objects attached to it.
    if (context.options.springs || !cloth.is_empty())
      network_renderer.add_springs(context, context.options.springs ? NetworkRenderer::Subset::All : NetworkRenderer::Subset::OutsideCloth,
                                   springs);
    if (context.options.points || !cloth.is_empty())
      network_renderer.add_points(context, context.options.points ? NetworkRenderer::Subset::All : NetworkRenderer::Subset::OutsideCloth,
                                  points);
    network_renderer.add_marks(context, marked_springs, marked_points);
    add_arrows(context, ghost_springs);
    add_ghosts(context, ghost_springs, ghost_points);
  }

  void draw_scene(const DrawContext& context, const Viewport& place, int width, int height) {
    gather(context);
    target.begin(width, height);
    glDisable(GL_SCISSOR_TEST);
    clear(context.options.background, context.options.transparent ? 0.0f : 1.0f);
    glViewport(place.x, height - place.y - place.height, place.width, place.height);
    set_state(context.snapshot.system->dimensions == 3);
    glEnable(GL_SCISSOR_TEST);

    // Only the edges of polygons need multisampling, which costs several times as much: the pixels around them are drawn multisampled, with
    // everything there, and all others directly. Lines, points and panels are antialiased in their shaders.
    const PixelBox whole{place.x, height - place.y - place.height, place.x + place.width, height - place.y};
    PixelBox multisampled = context.options.samples > 0 ? polygons(context, whole) : PixelBox{};
    if (!multisampled.is_empty() && !target.begin_multisampled(context.options.samples)) multisampled = {};
    if (!multisampled.is_empty()) {
      set_scissor(multisampled);
      clear(context.options.background, context.options.transparent ? 0.0f : 1.0f);
      draw_environment(context, true);
      target.resolve(multisampled);
    }
    for (const PixelBox& part : around(multisampled, whole)) {
      if (part.is_empty()) continue;
      set_scissor(part);
      draw_environment(context, multisampled.is_empty());
    }
    glDisable(GL_SCISSOR_TEST);
    draw_network(context);
    draw_over(context);
  }

  // The pixels around the polygons in this part of the picture.
  PixelBox polygons(const DrawContext& context, const PixelBox& place) const {
    PixelExtent extent;
    cloth.extend(extent, network_renderer);
    environment.solids.extend(extent, context.projection);
    return extent.within(place);
  }

  // Opaque objects, which can hide the network.
  void draw_environment(const DrawContext& context, bool has_polygons) {
    glDepthMask(GL_FALSE);
    environment.backdrop.draw(ground_shader);
    glDepthMask(GL_TRUE);
    environment.floors.draw(ground_shader);
    shadows.bind();
    environment.balls.draw(ball_shader, context.projection, context.camera.pole, context.palette.shadow);

    // Offset surfaces so that lines on them are visible.
    glEnable(GL_POLYGON_OFFSET_FILL);
    glPolygonOffset(1.0f, 2.0f);
    if (has_polygons) environment.solids.draw(surface_shader);

    // Shadows lie on the surfaces.
    glDepthMask(GL_FALSE);
    glPolygonOffset(-1.0f, -2.0f);
    shadows.draw(shadow_shader, context.palette.shadow);
    glDepthMask(GL_TRUE);
    // by their slope only if lines are on them: it puts triangles that are seen edge-on, at folds, behind what they cover
    glPolygonOffset(context.options.springs ? 1.0f : 0.0f, 2.0f);
    if (has_polygons) cloth.draw(cloth_shader);
    glDisable(GL_POLYGON_OFFSET_FILL);
  }

  void draw_network(const DrawContext& context) {
    const int width = context.projection.width(), height = context.projection.height();
    glDepthMask(GL_FALSE);
    environment.outlines.draw(stroke_shader, width, height);
    marked_springs.draw(stroke_shader, width, height);

    // If lines wrote depth, their half-covered pixels would hide what is behind them, and a dense net would shimmer.
    glDepthMask(network_renderer.is_dense(context.options) ? GL_FALSE : GL_TRUE);
    springs.draw(stroke_shader, width, height);
    glDepthMask(GL_TRUE);
    points.draw(impostor_shader, width, height, context.options.scale);
  }

  // Transparent floors and marks.
  void draw_over(const DrawContext& context) {
    const int width = context.projection.width(), height = context.projection.height();
    glDepthMask(GL_FALSE);
    environment.transparent_floors.draw(ground_shader);

    // Rings and previews are visible through everything.
    glDisable(GL_DEPTH_TEST);
    marked_points.draw(impostor_shader, width, height, context.options.scale);
    ghost_springs.draw(stroke_shader, width, height);
    ghost_points.draw(impostor_shader, width, height, context.options.scale);
    glDepthMask(GL_TRUE);
  }
};

ViewOptions options_for(const ViewSettings& settings, const ClothTexture& cloth_texture) {
  ViewOptions options;
  copy_visible_parts(settings, options);
  options.cloth_texture = cloth_texture;
  if (settings.background) options.background = *settings.background;
  return options;
}

View::View() : parts_(std::make_unique<Parts>()) {}
View::~View() = default;

void View::draw(const Snapshot& snapshot, const Marks& marks, const Camera& camera, const ViewOptions& options, int width, int height,
                const ImDrawData* panels) {
  const Viewport place = options.place.width > 0 ? options.place : Viewport{0, 0, width, height};
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
Image View::read(bool with_opacity) const { return parts_->target.read(with_opacity); }

}  // namespace hooke
