#include "draw/shadows.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <variant>

#include "draw/ground.h"
#include "draw/shader.h"

namespace hooke {
namespace {

constexpr int tile_size = 128;        // [texels]
constexpr int tiles_across = 4;       // of the picture of all maps: as many receivers have shadows, those that come first
constexpr int map_texels = 126;       // a side: no map touches its neighbour
constexpr int ball_texels = 62;       // a side
constexpr double wanted_reach = 2.5;  // in distances of the camera from its target

Receiver plane_receiver(const Subject& subject, const Plane& plane) {
  Receiver receiver{.above = plane.normal};
  span(plane.normal, receiver.across, receiver.along);
  const Vec3& target = subject.camera.target;
  receiver.origin = target - glm::dot(target - plane.point, plane.normal) * plane.normal;
  const auto reach = static_cast<float>(wanted_reach * subject.camera.distance);
  receiver.least = glm::vec2(-reach);
  receiver.most = glm::vec2(reach);
  return receiver;
}

Receiver ball_receiver(const Subject& subject, const Sphere& sphere) {
  Receiver receiver{.origin = sphere.center, .above = subject.camera.pole, .radius = static_cast<float>(sphere.radius)};
  span(receiver.above, receiver.across, receiver.along);
  receiver.least = glm::vec2(-receiver.radius);
  receiver.most = glm::vec2(receiver.radius);
  return receiver;
}

// The side of a box that looks up most.
Receiver top_receiver(const Subject& subject, const Box& box) {
  const Vec3 pole = subject.camera.pole;
  int axis = 0;
  for (const int other : {1, 2})
    if (std::abs(pole[other]) > std::abs(pole[axis])) axis = other;
  Receiver receiver{.above = Vec3(0.0)};
  receiver.above[axis] = pole[axis] < 0.0 ? -1.0 : 1.0;
  span(receiver.above, receiver.across, receiver.along);
  const Vec3 half = 0.5 * (box.most - box.least);
  receiver.origin = box.least + half + half[axis] * receiver.above;
  receiver.most = {glm::dot(half, glm::abs(receiver.across)), glm::dot(half, glm::abs(receiver.along))};
  receiver.least = -receiver.most;
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

void Shadows::add(const Subject& subject, const Net& net) {
  const System& system = *subject.snapshot.system;
  if (!subject.options.shadows || !subject.options.colliders || system.dimensions == 2) return;
  for (std::size_t c = 0; c < system.colliders.size() && !is_full(); ++c) {
    if (!system.colliders[c].solid) continue;
    const Collider collider = moved_at(system.colliders[c], subject.snapshot.state.time);
    Receiver receiver;
    if (const auto* sphere = std::get_if<Sphere>(&collider.shape)) receiver = ball_receiver(subject, *sphere);
    if (const auto* box = std::get_if<Box>(&collider.shape)) receiver = top_receiver(subject, *box);
    if (const auto* plane = std::get_if<Plane>(&collider.shape)) {
      if (!is_before(subject.camera, *plane)) continue;
      receiver = plane_receiver(subject, *plane);
    }
    receiver.collider = static_cast<Index>(c);
    if (receiver.radius > 0.0f)
      shade(subject, net, receiver);
    else
      add_flat(subject, net, receiver, std::holds_alternative<Plane>(collider.shape) ? look_from(subject.camera).reach : 0.0);
  }
}

bool Shadows::is_full() const { return tiles_.size() == tiles_across * tiles_across; }

// Null where there is no shade.
const Shadows::Tile* Shadows::shade(const Subject& subject, const Net& net, const Receiver& receiver) {
  Tile tile{.collider = receiver.collider};
  if (!casters_.shade(subject, net, receiver, receiver.radius > 0.0f ? ball_texels : map_texels, map_, tile.least, tile.most))
    return nullptr;
  tile.shares = map_.finish();
  if (std::ranges::all_of(tile.shares, [](std::uint8_t share) { return share == 0; })) return nullptr;
  const auto number = static_cast<int>(tiles_.size());
  tile.x = number % tiles_across * tile_size;
  tile.y = number / tiles_across * tile_size;
  tile.width = map_.width();
  tile.height = map_.height();
  return &tiles_.emplace_back(std::move(tile));
}

// A quad over as much of the map as lies on the receiver, half a texel inside, where the map still is nothing.
void Shadows::add_flat(const Subject& subject, const Net& net, const Receiver& receiver, double reach) {
  const Tile* tile = shade(subject, net, receiver);
  if (!tile) return;
  const glm::vec2 texel = (tile->most - tile->least) / glm::vec2(tile->width, tile->height);
  const glm::vec2 low = glm::max(tile->least + 0.5f * texel, receiver.least), high = glm::min(tile->most - 0.5f * texel, receiver.most);
  constexpr auto whole = static_cast<float>(tiles_across * tile_size);
  for (const float v : {low.y, high.y})
    for (const float u : {low.x, high.x}) {
      const glm::vec4 clip(subject.projection.clip(receiver.origin + double(u) * receiver.across + double(v) * receiver.along));
      const glm::vec2 at = (glm::vec2(tile->x, tile->y) + (glm::vec2(u, v) - tile->least) / texel) / whole;
      const float far = reach > 0.0 ? 1.0f / static_cast<float>(reach) : 0.0f;
      vertices_.push_back({{clip.x, clip.y, clip.z, clip.w}, {at.x, at.y}, {far * u, far * v}});
    }
}

BallShade Shadows::on_ball(Index collider) const {
  const auto tile = std::ranges::find(tiles_, collider, &Tile::collider);
  if (tile == tiles_.end()) return {};
  constexpr auto whole = static_cast<float>(tiles_across * tile_size);
  const glm::vec2 per_metre = 1.0f / (tile->most - tile->least), size = glm::vec2(tile->width, tile->height);
  return {{tile->least.x, tile->least.y},
          {per_metre.x, per_metre.y},
          {static_cast<float>(tile->x) / whole, static_cast<float>(tile->y) / whole},
          {size.x / whole, size.y / whole}};
}

void Shadows::upload() {
  if (uploaded_) return;
  uploaded_ = true;
  glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
  for (const Tile& tile : tiles_)
    glTexSubImage2D(GL_TEXTURE_2D, 0, tile.x, tile.y, tile.width, tile.height, GL_RED, GL_UNSIGNED_BYTE, tile.shares.data());
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

void Shadows::draw(const Shader& shader, Ink ink) {
  if (vertices_.empty()) return;
  bind();
  shader.use();
  glUniform4f(shader.uniform("ink"), ink.red / 255.0f, ink.green / 255.0f, ink.blue / 255.0f, ink.opacity / 255.0f);
  glUniform1i(shader.uniform("maps"), 0);
  stream_.draw_quads(vertices_.data(), vertices_.size());
}

}  // namespace hooke
