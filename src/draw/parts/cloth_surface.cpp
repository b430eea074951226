#include "draw/parts/cloth_surface.h"

#include <cmath>
#include <cstddef>
#include <glm/geometric.hpp>
#include <string_view>

#include "draw/gl/shader.h"

namespace hooke {
namespace {

// A cloth without visible springs is drawn lighter.
constexpr double lightening = 0.55;
constexpr Color white{255, 255, 255};

bool shows_strain(const ViewOptions& options) { return options.strain_colors && !options.springs; }

}  // namespace

ClothSurface::ClothSurface()
    : stream_({{4, GL_FLOAT, GL_FALSE, offsetof(Vertex, clip)},
               {4, GL_SHORT, GL_TRUE, offsetof(Vertex, normal)},
               {2, GL_FLOAT, GL_FALSE, offsetof(Vertex, cloth_texture)},
               {4, GL_UNSIGNED_BYTE, GL_TRUE, offsetof(Vertex, rgba)}},
              sizeof(Vertex)) {}

void ClothSurface::add(const DrawContext& context, const NetworkRenderer& network_renderer) {
  if (context.snapshot.system->faces.empty()) return;
  find_normals(context.snapshot.state.position, network_renderer);
  if (indices_.empty()) return;
  request_ = shows_strain(context.options) ? nullptr : context.options.cloth_texture.picture;
  find_colors(context, network_renderer);
  add_vertices(context, network_renderer);
}

void ClothSurface::find_normals(const std::vector<Vec3>& position, const NetworkRenderer& network_renderer) {
  const std::vector<GLuint>& corners = network_renderer.corners();
  const std::vector<ProjectedPoint>& projected = network_renderer.projected();
  normals_.assign(position.size(), Vec3(0.0));
  indices_.reserve(corners.size());
  for (std::size_t f = 0; f < corners.size(); f += 3) {
    const GLuint a = corners[f], b = corners[f + 1], c = corners[f + 2];
    if ((projected[a].outside | projected[b].outside | projected[c].outside) & NotFinite) continue;
    indices_.insert(indices_.end(), {a, b, c});

    // The length of the cross product is twice the area of the face.
    const Vec3 normal = glm::cross(position[b] - position[a], position[c] - position[a]);
    normals_[a] += normal;
    normals_[b] += normal;
    normals_[c] += normal;
  }
}

// The color of the point, or of the mean strain of its springs.
void ClothSurface::find_colors(const DrawContext& context, const NetworkRenderer& network_renderer) {
  const std::vector<Point>& points = context.snapshot.system->points();
  colors_.resize(points.size());
  if (shows_strain(context.options)) {
    strain_sum_.assign(points.size(), 0.0f);
    strain_count_.assign(points.size(), 0.0f);
    for (std::size_t s = 0; s < network_renderer.ends().size(); ++s)
      for (const Index end : network_renderer.ends()[s]) {
        strain_sum_[end] += network_renderer.strain()[s];
        strain_count_[end] += 1.0f;
      }
    const double scale = View::strain_scale(context.snapshot);
    for (std::size_t i = 0; i < points.size(); ++i)
      colors_[i] = rgba(View::strain_color(strain_count_[i] > 0.0f ? strain_sum_[i] / strain_count_[i] / scale : 0.0));
    return;
  }

  const Palette& palette = context.palette;
  const Color plain = request_ ? white : context.options.springs ? palette.face : mix(palette.face, white, lightening);
  for (std::size_t i = 0; i < points.size(); ++i) colors_[i] = rgba(points[i].color.value_or(plain));
}

void ClothSurface::add_vertices(const DrawContext& context, const NetworkRenderer& network_renderer) {
  const std::vector<Point>& points = context.snapshot.system->points();
  const ClothTexture& cloth_texture = context.options.cloth_texture;
  const glm::dvec2 size =
      request_ ? cloth_texture.width * glm::dvec2(1.0, static_cast<double>(request_->height) / request_->width) : glm::dvec2(1.0);
  const auto small = [](double component) { return static_cast<std::int16_t>(std::lround(32767.0 * component)); };

  vertices_.clear();
  for (const GLuint i : network_renderer.drawn()) {
    const glm::dvec4& clip = network_renderer.clip()[i];
    const Vec3 view_normal = context.projection.view_direction(normals_[i]);
    const double length = glm::length(view_normal);
    const Vec3 unit = length > 0.0 && std::isfinite(length) ? view_normal / length : Vec3(0.0, 0.0, 1.0);
    glm::dvec2 place = request_ ? cloth_coordinates_of(cloth_texture, points[i].id) / size : glm::dvec2(0.0);
    if (!std::isfinite(place.x + place.y)) place = glm::dvec2(0.0);
    vertices_.push_back({{static_cast<float>(clip.x), static_cast<float>(clip.y), static_cast<float>(clip.z), static_cast<float>(clip.w)},
                         {small(unit.x), small(unit.y), small(unit.z), 0},
                         {static_cast<float>(place.x), static_cast<float>(place.y)},
                         colors_[i]});
  }
  numbered_.clear();
  for (const GLuint corner : indices_) numbered_.push_back(network_renderer.number_of(corner));
}

void ClothSurface::extend(PixelExtent& extent, const NetworkRenderer& network_renderer) const {
  for (const GLuint corner : indices_) extent.add(network_renderer.projected()[corner]);
}

// Uploads each texture once, with mipmaps for distant cloth, which are finer along a cloth that is seen edge-on.
void ClothSurface::upload_picture() {
  if (texture_ == 0) texture_ = GlName(GlKind::Texture);
  glBindTexture(GL_TEXTURE_2D, texture_);
  if (request_ == uploaded_) return;
  uploaded_ = request_;
  glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
  glTexImage2D(GL_TEXTURE_2D, 0, GL_RGB8, request_->width, request_->height, 0, GL_RGB, GL_UNSIGNED_BYTE, request_->pixels.data());
  glGenerateMipmap(GL_TEXTURE_2D);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  // Mesa's software renderer takes minutes for a triangle that is seen edge-on
  const std::string_view renderer = reinterpret_cast<const char*>(glGetString(GL_RENDERER));
  if (GLEW_EXT_texture_filter_anisotropic && renderer.find("llvmpipe") == renderer.npos)
    glTexParameterf(GL_TEXTURE_2D, GL_TEXTURE_MAX_ANISOTROPY_EXT, 8.0f);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_REPEAT);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_REPEAT);
}

void ClothSurface::draw(const Shader& shader) {
  if (is_empty()) return;
  shader.use();
  if (request_) upload_picture();
  glUniform1i(shader.uniform("picture"), 0);
  glUniform1i(shader.uniform("is_printed"), request_ ? 1 : 0);
  stream_.draw_indexed(vertices_.data(), vertices_.size(), numbered_);
  if (request_) glBindTexture(GL_TEXTURE_2D, 0);
}

}  // namespace hooke
