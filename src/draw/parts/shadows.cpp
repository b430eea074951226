#include "draw/parts/shadows.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <variant>

#include "draw/gl/shader.h"
#include "draw/parts/ground.h"

namespace hooke {
namespace {

constexpr int tile_size = 128;        // [texels]
constexpr int tiles_across = 4;       // of the atlas, whose size limits the number of receivers: the first ones have shadows
constexpr int map_texels = 126;       // per side; leaves a gap between maps
constexpr int ball_texels = 62;       // per side
constexpr double wanted_reach = 2.5;  // in units of the camera distance

ShadowReceiver plane_receiver(const DrawContext& context, const Plane& plane) {
  ShadowReceiver receiver{.above = plane.normal};
  span(plane.normal, receiver.across, receiver.along);
  const Vec3& target = context.camera.target;
  receiver.origin = target - glm::dot(target - plane.point, plane.normal) * plane.normal;
  const auto reach = static_cast<float>(wanted_reach * context.camera.distance);
  receiver.min = glm::vec2(-reach);
  receiver.max = glm::vec2(reach);
  return receiver;
}

ShadowReceiver ball_receiver(const DrawContext& context, const Sphere& sphere) {
  ShadowReceiver receiver{.origin = sphere.center, .above = context.camera.pole, .radius = static_cast<float>(sphere.radius)};
  span(receiver.above, receiver.across, receiver.along);
  receiver.min = glm::vec2(-receiver.radius);
  receiver.max = glm::vec2(receiver.radius);
  return receiver;
}

// The side of a box that faces upwards most.
ShadowReceiver top_receiver(const DrawContext& context, const Box& box) {
  const Vec3 pole = context.camera.pole;
  int axis = 0;
  for (const int other : {1, 2})
    if (std::abs(pole[other]) > std::abs(pole[axis])) axis = other;
  ShadowReceiver receiver{.above = Vec3(0.0)};
  receiver.above[axis] = pole[axis] < 0.0 ? -1.0 : 1.0;
  span(receiver.above, receiver.across, receiver.along);
  const Vec3 half = 0.5 * (box.max - box.min);
  receiver.origin = box.min + half + half[axis] * receiver.above;
  receiver.max = {glm::dot(half, glm::abs(receiver.across)), glm::dot(half, glm::abs(receiver.along))};
  receiver.min = -receiver.max;
  return receiver;
}

}  // namespace

Shadows::Shadows()
    : stream_({{4, GL_FLOAT, GL_FALSE, offsetof(Vertex, clip)},
               {2, GL_FLOAT, GL_FALSE, offsetof(Vertex, place)},
               {2, GL_FLOAT, GL_FALSE, offsetof(Vertex, fade)}},
              sizeof(Vertex)) {}

void Shadows::clear() {
  tiles_.clear();
  vertices_.clear();
  uploaded_ = false;
}

void Shadows::add(const DrawContext& context, const NetworkRenderer& network_renderer) {
  const System& system = *context.snapshot.system;
  if (!context.options.shadows || !context.options.colliders || system.dimensions == 2) return;
  for (std::size_t c = 0; c < system.colliders.size() && !is_full(); ++c) {
    if (!system.colliders[c].solid) continue;
    const Collider collider = current_collider(system, context.snapshot.state, c);
    ShadowReceiver receiver;
    if (const auto* sphere = std::get_if<Sphere>(&collider.shape)) receiver = ball_receiver(context, *sphere);
    if (const auto* box = std::get_if<Box>(&collider.shape)) receiver = top_receiver(context, *box);
    if (const auto* plane = std::get_if<Plane>(&collider.shape)) {
      if (!is_before(context.camera, *plane)) continue;
      receiver = plane_receiver(context, *plane);
    }
    receiver.collider = static_cast<Index>(c);
    if (receiver.radius > 0.0f)
      shade(context, network_renderer, receiver);
    else
      add_flat(context, network_renderer, receiver,
               std::holds_alternative<Plane>(collider.shape) ? grid_style_for(context.camera).reach : 0.0);
  }
}

bool Shadows::is_full() const { return tiles_.size() == tiles_across * tiles_across; }

// Null if there is no shadow.
const Shadows::Tile* Shadows::shade(const DrawContext& context, const NetworkRenderer& network_renderer, const ShadowReceiver& receiver) {
  Tile tile{.collider = receiver.collider};
  if (!shadow_casters_.shade(context, network_renderer, receiver, receiver.radius > 0.0f ? ball_texels : map_texels, map_, tile.min,
                             tile.max))
    return nullptr;
  tile.occlusion = map_.finish();
  if (std::ranges::all_of(tile.occlusion, [](std::uint8_t value) { return value == 0; })) return nullptr;
  const auto number = static_cast<int>(tiles_.size());
  tile.x = number % tiles_across * tile_size;
  tile.y = number / tiles_across * tile_size;
  tile.width = map_.width();
  tile.height = map_.height();
  return &tiles_.emplace_back(std::move(tile));
}

// A quad over the part of the map on the receiver, inset by half a texel, where the map is still zero.
void Shadows::add_flat(const DrawContext& context, const NetworkRenderer& network_renderer, const ShadowReceiver& receiver, double reach) {
  const Tile* tile = shade(context, network_renderer, receiver);
  if (!tile) return;
  const glm::vec2 texel = (tile->max - tile->min) / glm::vec2(tile->width, tile->height);
  const glm::vec2 low = glm::max(tile->min + 0.5f * texel, receiver.min), high = glm::min(tile->max - 0.5f * texel, receiver.max);
  constexpr auto whole = static_cast<float>(tiles_across * tile_size);
  for (const float v : {low.y, high.y})
    for (const float u : {low.x, high.x}) {
      const glm::vec4 clip(context.projection.clip(receiver.origin + double(u) * receiver.across + double(v) * receiver.along));
      const glm::vec2 at = (glm::vec2(tile->x, tile->y) + (glm::vec2(u, v) - tile->min) / texel) / whole;
      const float far = reach > 0.0 ? 1.0f / static_cast<float>(reach) : 0.0f;
      vertices_.push_back({{clip.x, clip.y, clip.z, clip.w}, {at.x, at.y}, {far * u, far * v}});
    }
}

BallShadow Shadows::on_ball(Index collider) const {
  const auto tile = std::ranges::find(tiles_, collider, &Tile::collider);
  if (tile == tiles_.end()) return {};
  constexpr auto whole = static_cast<float>(tiles_across * tile_size);
  const glm::vec2 per_meter = 1.0f / (tile->max - tile->min), size = glm::vec2(tile->width, tile->height);
  return {{tile->min.x, tile->min.y},
          {per_meter.x, per_meter.y},
          {static_cast<float>(tile->x) / whole, static_cast<float>(tile->y) / whole},
          {size.x / whole, size.y / whole}};
}

void Shadows::upload() {
  if (uploaded_) return;
  uploaded_ = true;
  glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
  for (const Tile& tile : tiles_)
    glTexSubImage2D(GL_TEXTURE_2D, 0, tile.x, tile.y, tile.width, tile.height, GL_RED, GL_UNSIGNED_BYTE, tile.occlusion.data());
}

void Shadows::bind() {
  if (tiles_.empty()) return;
  if (texture_ == 0) {
    texture_ = GlName(GlKind::Texture);
    glBindTexture(GL_TEXTURE_2D, texture_);
    constexpr int whole = tiles_across * tile_size;
    glTexImage2D(GL_TEXTURE_2D, 0, GL_R8, whole, whole, 0, GL_RED, GL_UNSIGNED_BYTE, nullptr);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  }
  glBindTexture(GL_TEXTURE_2D, texture_);
  upload();
}

void Shadows::draw(const Shader& shader, Rgba rgba) {
  if (vertices_.empty()) return;
  bind();
  shader.use();
  glUniform4f(shader.uniform("ink"), rgba.red / 255.0f, rgba.green / 255.0f, rgba.blue / 255.0f, rgba.opacity / 255.0f);
  glUniform1i(shader.uniform("maps"), 0);
  stream_.draw_quads(vertices_.data(), vertices_.size());
}

}  // namespace hooke
