// Places the labels of a chart so that they overlap neither each other nor the lines.
#pragma once

#include <string>
#include <vector>

namespace hooke {

// Pixels; y points upwards.
struct ChartPoint {
  double x = 0.0, y = 0.0;
};

struct ChartBox {
  double left = 0.0, bottom = 0.0, right = 0.0, top = 0.0;
};

// A label that belongs to an anchor, usually the end of a line.
struct ChartLabel {
  ChartPoint anchor;
  double width = 0.0, height = 0.0;
};

enum class Justify { Left, Right };

struct PlacedLabel {
  ChartPoint at;  // midpoint of the edge where the text starts (Left) or ends (Right)
  Justify justify = Justify::Left;
};

// Greedy, in the given order: each label takes the position near its anchor, within the frame, that overlaps least with `occupied`
// (points of the lines) and with the labels placed before.
std::vector<PlacedLabel> place_labels(const std::vector<ChartLabel>& labels, const std::vector<ChartPoint>& occupied,
                                      const ChartBox& frame);

}  // namespace hooke
