#include "edit/arrange.h"

#include <algorithm>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/mat4x4.hpp>
#include <span>

#include "sim/model/bounding_box.h"

namespace hooke {
namespace {

Move unmoved(const Snapshot& now, const std::vector<PointId>& points) {
  Move move;
  for (const PointId id : points)
    if (const Index i = now.system->index_of(id); i != no_index) move.items.push_back({id, now.state.position[i], now.state.velocity[i]});
  return move;
}

}  // namespace

glm::dmat3 rotation(const Vec3& axis, double angle) { return glm::dmat3(glm::rotate(glm::dmat4(1.0), angle, axis)); }

glm::dmat3 reflection(int axis) {
  glm::dmat3 turn(1.0);
  turn[axis][axis] = -1.0;
  return turn;
}

Vec3 center_of(const Snapshot& now, const std::vector<PointId>& points) {
  std::vector<Vec3> positions;
  for (const Move::Item& item : unmoved(now, points).items) positions.push_back(item.position);
  return bounding_box(positions).center();
}

std::vector<Command> moved(const Snapshot& start, const std::vector<PointId>& points, const Affine& affine) {
  Move move = unmoved(start, points);
  for (Move::Item& item : move.items) {
    item.position = affine.about + affine.turn * (item.position - affine.about) * affine.scale + affine.shift;
    item.velocity = affine.turn * item.velocity;
  }
  std::vector<Command> commands = {std::move(move)};
  if (affine.scale == 1.0) return commands;
  const System& system = *start.system;
  SetSpringProperty set{SpringProperty::RestLength, {}};
  for (const SpringId id : select_with_springs_between(system, points).springs)
    set.values.emplace_back(id, affine.scale * system.springs()[system.index_of(id)].rest_length);
  commands.emplace_back(std::move(set));
  return commands;
}

Command aligned(const Snapshot& now, const std::vector<PointId>& points, int axis) {
  Move move = unmoved(now, points);
  double sum = 0.0;
  for (const Move::Item& item : move.items) sum += item.position[axis];
  for (Move::Item& item : move.items) item.position[axis] = sum / static_cast<double>(move.items.size());
  return move;
}

Command distributed(const Snapshot& now, const std::vector<PointId>& points, int axis) {
  Move move = unmoved(now, points);
  std::ranges::stable_sort(move.items, {}, [&](const Move::Item& item) { return item.position[axis]; });
  const double first = move.items.front().position[axis], last = move.items.back().position[axis];
  const auto steps = static_cast<double>(std::max<std::size_t>(1, move.items.size() - 1));
  for (std::size_t i = 0; i < move.items.size(); ++i) move.items[i].position[axis] = std::lerp(first, last, static_cast<double>(i) / steps);
  return move;
}

std::vector<Command> weld(const Snapshot& snapshot, const SheetWeights* sheet, const std::vector<PointId>& points, const IdSource& ids) {
  const System& system = *snapshot.system;
  if (points.size() < 2) return {};
  const PointId kept = points.front();
  const auto end_of = [&](PointId id) { return std::ranges::find(points, id) == points.end() ? id : kept; };
  Insert insert;
  for (const Spring& spring : system.springs()) {
    Spring changed = spring;
    changed.first = end_of(spring.first), changed.second = end_of(spring.second);
    if (changed == spring || changed.first == changed.second) continue;
    changed.id = ids.spring();
    insert.springs.push_back({.spring = changed, .sheet_weight = sheet_weight_of(sheet, spring.id)});
  }
  for (const Face& face : system.faces) {
    Face changed = face;
    for (PointId& corner : changed.points) corner = end_of(corner);
    const auto& [a, b, c] = changed.points;
    if (changed.points != face.points && a != b && b != c && c != a) insert.faces.push_back({.face = changed});
  }
  double mass = 0.0;
  Vec3 center(0.0), momentum(0.0);
  Point welded;
  for (const PointId id : points) {
    const Index i = system.index_of(id);
    const Point& point = system.points()[i];
    mass += point.mass;
    center += point.mass * snapshot.state.position[i];
    if (!point.nailed) momentum += point.mass * snapshot.state.velocity[i];
    welded.nailed = welded.nailed || point.nailed;
    welded.fixed_axes |= point.fixed_axes;
    welded.load += point.load;
  }
  std::vector<Command> commands;
  if (welded.nailed) commands.emplace_back(SetNailed{{{kept, true}}});
  if (welded.fixed_axes != 0) commands.emplace_back(SetFixedAxes{{{kept, welded.fixed_axes}}});
  if (welded.load != Vec3(0.0)) commands.emplace_back(SetLoad{{{kept, welded.load}}});
  commands.emplace_back(Move{{{kept, center / mass, welded.nailed ? Vec3(0.0) : momentum / mass}}});
  commands.emplace_back(SetPointProperty{PointProperty::Mass, {{kept, mass}}});
  // springs between the welded points go with the removed ones
  commands.emplace_back(std::move(insert));
  commands.emplace_back(Remove{{points.begin() + 1, points.end()}, {}});
  return commands;
}

std::vector<Command> split(const Snapshot& now, const SheetWeights* sheet, const std::vector<PointId>& points, const IdSource& ids) {
  const System& system = *now.system;
  std::vector<Spring> springs(system.springs().begin(), system.springs().end());
  std::vector<bool> is_changed(springs.size());
  SetPointProperty masses{PointProperty::Mass, {}};
  SetLoad loads;
  Insert insert;
  for (const PointId point : points) {
    const Index i = system.index_of(point);
    const auto is_corner = [&](const Face& face) { return std::ranges::find(face.points, point) != face.points.end(); };
    std::vector<std::size_t> meeting;
    for (std::size_t s = 0; s < springs.size(); ++s)
      if (springs[s].first == point || springs[s].second == point) meeting.push_back(s);
    if (i == no_index || meeting.size() < 2 || std::any_of(system.faces.begin(), system.faces.end(), is_corner)) continue;
    Point end = system.points()[i];
    end.mass /= static_cast<double>(meeting.size());
    end.load /= static_cast<double>(meeting.size());
    masses.values.emplace_back(point, end.mass);
    loads.values.emplace_back(point, end.load);
    for (const std::size_t s : std::span(meeting).subspan(1)) {
      end.id = ids.point();
      insert.points.push_back({.point = end, .position = now.state.position[i], .velocity = now.state.velocity[i]});
      (springs[s].first == point ? springs[s].first : springs[s].second) = end.id;
      is_changed[s] = true;
    }
  }
  if (insert.points.empty()) return {};
  Remove remove;
  for (std::size_t s = 0; s < springs.size(); ++s) {
    if (!is_changed[s]) continue;
    const double sheet_weight = sheet_weight_of(sheet, springs[s].id);
    remove.springs.push_back(springs[s].id);
    springs[s].id = ids.spring();
    insert.springs.push_back({.spring = springs[s], .sheet_weight = sheet_weight});
  }
  return {std::move(masses), std::move(loads), std::move(remove), std::move(insert)};
}

}  // namespace hooke
