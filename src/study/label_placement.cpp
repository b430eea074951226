#include "study/label_placement.h"

#include <algorithm>
#include <cmath>

namespace hooke {
namespace {

ChartBox box_of(const PlacedLabel& label, const ChartLabel& size) {
  const double left = label.justify == Justify::Left ? label.at.x : label.at.x - size.width;
  return {left, label.at.y - 0.5 * size.height, left + size.width, label.at.y + 0.5 * size.height};
}

double overlap(const ChartBox& a, const ChartBox& b) {
  const double width = std::min(a.right, b.right) - std::max(a.left, b.left);
  const double height = std::min(a.top, b.top) - std::max(a.bottom, b.bottom);
  return width > 0.0 && height > 0.0 ? width * height : 0.0;
}

ChartBox expanded(const ChartBox& box, double by) { return {box.left - by, box.bottom - by, box.right + by, box.top + by}; }

bool holds(const ChartBox& box, const ChartPoint& point) {
  return point.x > box.left && point.x < box.right && point.y > box.bottom && point.y < box.top;
}

// positions around the anchor, nearest first
std::vector<PlacedLabel> candidate_places(const ChartLabel& label) {
  std::vector<PlacedLabel> places;
  for (int ring = 0; ring < 6; ++ring)
    for (const Justify justify : {Justify::Left, Justify::Right})
      for (const double up : {0.0, 1.0, -1.0})
        for (const double further : {0.0, 25.0, 50.0}) {
          if (up == 0.0 && (ring > 0 || further > 0.0)) continue;
          const double aside = (justify == Justify::Left ? 1.0 : -1.0) * (further + (up == 0.0 ? 10.0 : 4.0));
          places.push_back({{label.anchor.x + aside, label.anchor.y + up * (ring + 0.9) * label.height}, justify});
        }
  return places;
}

}  // namespace

std::vector<PlacedLabel> place_labels(const std::vector<ChartLabel>& labels, const std::vector<ChartPoint>& occupied,
                                      const ChartBox& frame) {
  std::vector<PlacedLabel> placed;
  std::vector<ChartBox> occupied_boxes;
  for (const ChartLabel& label : labels) {
    PlacedLabel best;
    double min = INFINITY;
    for (const PlacedLabel& place : candidate_places(label)) {
      const ChartBox box = box_of(place, label);
      const double area = label.width * label.height;
      double cost = 20.0 * (area - overlap(box, frame)) / area;
      for (const ChartBox& other : occupied_boxes) cost += 100.0 * overlap(box, other) / area;
      for (const ChartPoint& point : occupied) cost += holds(expanded(box, 2.0), point) ? 0.3 : 0.0;
      // next to the end of another line the label would be mistaken for the name of that line
      for (const ChartLabel& other : labels) cost += &other != &label && holds(expanded(box, 10.0), other.anchor) ? 3.0 : 0.0;
      cost += 0.01 * std::hypot(place.at.x - label.anchor.x, place.at.y - label.anchor.y);
      if (cost < min) {
        min = cost;
        best = place;
      }
    }
    placed.push_back(best);
    occupied_boxes.push_back(box_of(best, label));
  }
  return placed;
}

}  // namespace hooke
