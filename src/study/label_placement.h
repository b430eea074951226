// Finds places for the labels of a chart where they cover neither each other nor the lines.
#pragma once

#include <string>
#include <vector>

namespace hooke {

// Pixels; y grows upwards.
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
  ChartPoint at;  // the middle of the edge that the text starts from (Left) or ends at (Right)
  Justify justify = Justify::Left;
};

// Greedy, in the order given: each takes the place near its anchor that covers least of `inked` (points of the lines) and
// of the labels before it, within the frame.
std::vector<PlacedLabel> place_labels(const std::vector<ChartLabel>& labels, const std::vector<ChartPoint>& occupied,
                                      const ChartBox& frame);

}  // namespace hooke
