#include "sim/methods/implicit/supernodal_factor.h"

#include <algorithm>

#include "sim/forces/field_kernel.h"

namespace hooke {
namespace {

// Of columns with this many rows. A multiple of 64 would place the rows of a tile in the same lines of the first cache.
std::size_t column_stride(std::size_t rows) {
  const std::size_t stride = (rows + column_alignment - 1) / column_alignment * column_alignment;
  return stride % 64 == 0 ? stride + column_alignment : stride;
}

// x[j] -= column j times x, of the rows after the columns; four columns at a time, because each sum waits for its last addition.
void subtract_products(const double* column, std::size_t stride, std::size_t rows, std::size_t columns, double* x) {
  std::size_t j = 0;
  for (; j + 4 <= columns; j += 4, column += 4 * stride)
    for (std::size_t i = columns; i < rows; ++i)
      for (std::size_t k = 0; k < 4; ++k) x[j + k] -= column[k * stride + i] * x[i];
  for (; j < columns; ++j, column += stride)
    for (std::size_t i = columns; i < rows; ++i) x[j] -= column[i] * x[i];
}

}  // namespace

SupernodalFactor::SupernodalFactor(int dimensions, const Couplings& before) : dimensions_(dimensions) {
  const std::size_t points = before.size();
  std::size_t entries = 0, product = 0, part = 0;
  for (Supernode& node : find_supernodes(before)) {
    const std::size_t columns = dimensions_ * node.columns, below = dimensions_ * node.rows.size();
    const std::size_t stride = column_stride(columns + below);
    product = std::max(product, column_stride(below) * std::min<std::size_t>(below, dimensions_ * max_supernode_columns));
    part = std::max(part, columns + below);
    panels_.push_back({std::move(node), entries, stride});
    entries += stride * columns;
    if (entries > max_factor_entries) throw MatrixTooLarge();
  }
  values_.resize(entries + column_alignment);
  product_.resize(product);
  part_.resize(part);
  panel_of_.resize(points);
  for (std::size_t s = 0; s < panels_.size(); ++s)
    std::fill_n(panel_of_.begin() + panels_[s].node.first, panels_[s].node.columns, static_cast<Index>(s));
  first_source_.resize(panels_.size());
  place_.resize(points);
}

void SupernodalFactor::set_zero() { std::fill(values_.begin(), values_.end(), 0.0); }

ColumnBlock SupernodalFactor::block(Index row, Index column) {
  const Panel& panel = panels_[panel_of_[column]];
  const Supernode& node = panel.node;
  const std::size_t place = row < node.first + node.columns
                                ? row - node.first
                                : node.columns + (std::lower_bound(node.rows.begin(), node.rows.end(), row) - node.rows.begin());
  return {values_.data() + panel.start + dimensions_ * ((column - node.first) * panel.stride + place), panel.stride};
}

// Puts a panel into the list of the one with its next row.
void SupernodalFactor::pass_on(Index source) {
  Panel& panel = panels_[source];
  if (panel.next_row == static_cast<Index>(panel.node.rows.size())) return;
  Index& first = first_source_[panel_of_[panel.node.rows[panel.next_row]]];
  panel.next_source = first;
  first = source;
}

// Subtracts the product of the source's rows from the target's columns on and its rows in these columns.
void SupernodalFactor::update(Panel& target, Panel& source) {
  const std::vector<Index>& points = source.node.rows;
  const Index begin = source.next_row, end_of_columns = target.node.first + target.node.columns;
  const Index end = static_cast<Index>(std::lower_bound(points.begin() + begin, points.end(), end_of_columns) - points.begin());
  source.next_row = end;

  const std::size_t rows = dimensions_ * (points.size() - begin), columns = dimensions_ * (end - begin);
  const ColumnBlock from{values_.data() + source.start + dimensions_ * (source.node.columns + begin), source.stride};
  const ColumnBlock product{product_.data(), column_stride(rows)}, to = block_of(target);
  multiply_transposed(from, from, dimensions_ * source.node.columns, product, rows, columns);

  const std::size_t count = points.size() - begin;
  for (std::size_t first = 0; first < count;) {
    // rows in sequence in both
    const std::size_t place = place_[points[begin + first]];
    std::size_t last = first + 1;
    while (last < count && place_[points[begin + last]] == static_cast<Index>(place + last - first)) ++last;
    const std::size_t row = dimensions_ * first, end_row = dimensions_ * last;
    for (std::size_t j = 0; j < std::min(columns, end_row); ++j) {
      const std::size_t start = std::max(row, j);
      const std::size_t column = dimensions_ * place_[points[begin + j / dimensions_]] + j % dimensions_;
      double* result = to.start + column * to.stride + dimensions_ * place + (start - row);
      const double* term = product.start + j * product.stride + start;
      for (std::size_t i = start; i < end_row; ++i) *result++ -= *term++;
    }
    first = last;
  }
}

bool SupernodalFactor::factorize() {
  std::fill(first_source_.begin(), first_source_.end(), no_index);
  for (Panel& panel : panels_) panel.next_row = 0;
  for (Index s = 0; s < static_cast<Index>(panels_.size()); ++s) {
    Panel& panel = panels_[s];
    const Supernode& node = panel.node;
    Index place = 0;
    for (Index k = node.first; k < node.first + node.columns; ++k) place_[k] = place++;
    for (const Index k : node.rows) place_[k] = place++;

    for (Index source = first_source_[s]; source != no_index;) {
      const Index next = panels_[source].next_source;
      update(panel, panels_[source]);
      pass_on(source);
      source = next;
    }
    if (!factorize_block(block_of(panel), dimensions_ * place, dimensions_ * node.columns)) return false;
    pass_on(s);
  }
  return true;
}

void SupernodalFactor::solve(std::span<double> x) {
  double* part = part_.data();
  for (const Panel& panel : panels_) {
    const std::size_t columns = dimensions_ * panel.node.columns, rows = columns + dimensions_ * panel.node.rows.size();
    double* own = x.data() + dimensions_ * panel.node.first;
    std::copy_n(own, columns, part);
    std::fill(part + columns, part + rows, 0.0);
    const double* column = values_.data() + panel.start;
    for (std::size_t j = 0; j < columns; ++j, column += panel.stride) {
      part[j] /= column[j];
      add_scaled(part + j + 1, -part[j], column + j + 1, rows - j - 1);
    }
    std::copy_n(part, columns, own);
    const double* sum = part + columns;
    for (const Index k : panel.node.rows)
      for (std::size_t c = 0; c < dimensions_; ++c) x[dimensions_ * k + c] += *sum++;
  }

  for (auto panel = panels_.rbegin(); panel != panels_.rend(); ++panel) {
    const std::size_t columns = dimensions_ * panel->node.columns, rows = columns + dimensions_ * panel->node.rows.size();
    double* own = x.data() + dimensions_ * panel->node.first;
    double* known = part + columns;
    for (const Index k : panel->node.rows)
      for (std::size_t c = 0; c < dimensions_; ++c) *known++ = x[dimensions_ * k + c];
    std::copy_n(own, columns, part);
    subtract_products(values_.data() + panel->start, panel->stride, rows, columns, part);
    for (std::size_t j = columns; j-- > 0;) {
      const double* column = values_.data() + panel->start + j * panel->stride;
      for (std::size_t i = j + 1; i < columns; ++i) part[j] -= column[i] * part[i];
      part[j] /= column[j];
    }
    std::copy_n(part, columns, own);
  }
}

}  // namespace hooke
