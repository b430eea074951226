// Compiled once for each vector unit by Highway. Vectors run along columns: every element is a sum over the columns before it, in their
// order, of products that are rounded before they are added, however long the vectors are.
#include "sim/methods/implicit/cholesky_kernel.h"

#include <algorithm>
#include <cmath>
#include <type_traits>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "sim/methods/implicit/cholesky_kernel.cpp"
#include <hwy/foreach_target.h>

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace hooke::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// Columns of a tile that is summed in registers; its rows are at most four vectors where there are 32 registers, two where there are 16.
constexpr std::size_t cholesky_columns = 6;
#if HWY_TARGET <= HWY_AVX3 || HWY_ARCH_ARM
constexpr int max_tile_vectors = 4;
#else
constexpr int max_tile_vectors = 2;
#endif

using CholeskyTag = hn::CappedTag<double, column_alignment>;
using CholeskyVector = hn::Vec<CholeskyTag>;

// sum[v][j] = rows i of A times row j of B
template <int Vectors, int Columns>
HWY_INLINE void sum_tile(ColumnBlock a, ColumnBlock b, std::size_t depth, CholeskyVector (&sum)[Vectors][Columns]) {
  const CholeskyTag d;
  const std::size_t lanes = hn::Lanes(d);
  for (int v = 0; v < Vectors; ++v)
    for (int j = 0; j < Columns; ++j) sum[v][j] = hn::Zero(d);
  const double *left = a.start, *right = b.start;
  for (std::size_t p = 0; p < depth; ++p, left += a.stride, right += b.stride) {
    CholeskyVector x[Vectors];
    for (int v = 0; v < Vectors; ++v) x[v] = hn::LoadU(d, left + v * lanes);
    for (int j = 0; j < Columns; ++j) {
      const CholeskyVector y = hn::Set(d, right[j]);
      for (int v = 0; v < Vectors; ++v) sum[v][j] = hn::Add(sum[v][j], hn::Mul(x[v], y));
    }
  }
}

template <int Vectors, int Columns>
HWY_INLINE void multiply_tile(ColumnBlock a, ColumnBlock b, std::size_t depth, ColumnBlock c) {
  const CholeskyTag d;
  CholeskyVector sum[Vectors][Columns];
  sum_tile(a, b, depth, sum);
  for (int j = 0; j < Columns; ++j)
    for (int v = 0; v < Vectors; ++v) hn::StoreU(sum[v][j], d, c.start + j * c.stride + v * hn::Lanes(d));
}

// A tile of `columns` < cholesky_columns + 1 columns.
template <int Vectors, int Columns = cholesky_columns>
HWY_INLINE void multiply_columns(ColumnBlock a, ColumnBlock b, std::size_t depth, ColumnBlock c, std::size_t columns) {
  if (columns == Columns) return multiply_tile<Vectors, Columns>(a, b, depth, c);
  if constexpr (Columns > 1) multiply_columns<Vectors, Columns - 1>(a, b, depth, c, columns);
}

// Rows from `row` on, in tiles of `Vectors` vectors and then of fewer.
template <int Vectors>
HWY_INLINE void multiply_rows(ColumnBlock a, ColumnBlock b, std::size_t depth, ColumnBlock c, std::size_t rows, std::size_t columns,
                              std::size_t row) {
  const std::size_t height = Vectors * hn::Lanes(CholeskyTag());
  for (; row < rows && (Vectors == 1 || row + height <= rows); row += height)
    for (std::size_t j = 0; j < std::min(columns, row + height); j += cholesky_columns)
      multiply_columns<Vectors>({a.start + row, a.stride}, {b.start + j, b.stride}, depth, {c.start + row + j * c.stride, c.stride},
                                std::min(cholesky_columns, columns - j));
  if constexpr (Vectors > 1) multiply_rows<Vectors / 2>(a, b, depth, c, rows, columns, row);
}

void multiply_transposed(ColumnBlock a, ColumnBlock b, std::size_t depth, ColumnBlock c, std::size_t rows, std::size_t columns) {
  multiply_rows<max_tile_vectors>(a, b, depth, c, rows, columns, 0);
}

// The Cholesky factor of a diagonal tile, and the reciprocals of its diagonal; it is not stored.
template <int Columns>
struct DiagonalTile {
  double below[Columns][Columns];
  double reciprocal[Columns];

  HWY_INLINE bool factorize(ColumnBlock block) {
    for (int j = 0; j < Columns; ++j) {
      for (int i = j; i < Columns; ++i) {
        double value = block.start[j * block.stride + i];
        for (int p = 0; p < j; ++p) value -= below[i][p] * below[j][p];
        below[i][j] = i == j ? value : value * reciprocal[j];
        if (i != j) continue;
        if (!(value > 0.0)) return false;
        reciprocal[j] = 1.0 / std::sqrt(value);
      }
    }
    return true;
  }
};

// Factorizes `Columns` columns from `column` on; those before are.
template <int Columns>
HWY_INLINE bool factorize_columns(ColumnBlock block, std::size_t rows, std::size_t column) {
  const CholeskyTag d;
  const std::size_t lanes = hn::Lanes(d);
  const ColumnBlock target{block.start + column * block.stride, block.stride};
  const ColumnBlock row_of_columns{block.start + column, block.stride};

  // subtract what the columns before contribute
  const std::size_t first = column / column_alignment * column_alignment;
  std::size_t row = first;
  const auto subtract = [&](auto count) HWY_ATTR {
    constexpr int Vectors = decltype(count)::value;
    CholeskyVector sum[Vectors][Columns];
    sum_tile({block.start + row, block.stride}, row_of_columns, column, sum);
    for (int j = 0; j < Columns; ++j)
      for (int v = 0; v < Vectors; ++v) {
        double* at = target.start + j * target.stride + row + v * lanes;
        hn::StoreU(hn::Sub(hn::LoadU(d, at), sum[v][j]), d, at);
      }
    row += Vectors * lanes;
  };
  if (column > 0) {
    while (row + max_tile_vectors * lanes <= rows) subtract(std::integral_constant<int, max_tile_vectors>());
    while (row < rows) subtract(std::integral_constant<int, 1>());
  }

  DiagonalTile<Columns> tile;
  if (!tile.factorize({target.start + column, target.stride})) return false;
  for (row = first; row < rows; row += lanes) {
    CholeskyVector x[Columns];
    for (int j = 0; j < Columns; ++j) {
      double* at = target.start + j * target.stride + row;
      x[j] = hn::LoadU(d, at);
      for (int p = 0; p < j; ++p) x[j] = hn::Sub(x[j], hn::Mul(x[p], hn::Set(d, tile.below[j][p])));
      x[j] = hn::Mul(x[j], hn::Set(d, tile.reciprocal[j]));
      hn::StoreU(x[j], d, at);
    }
  }
  return true;
}

template <int Columns = cholesky_columns>
HWY_INLINE bool factorize_tile(ColumnBlock block, std::size_t rows, std::size_t column, std::size_t columns) {
  if (columns == Columns) return factorize_columns<Columns>(block, rows, column);
  if constexpr (Columns > 1) return factorize_tile<Columns - 1>(block, rows, column, columns);
  return true;
}

bool factorize_block(ColumnBlock block, std::size_t rows, std::size_t columns) {
  for (std::size_t j = 0; j < columns; j += cholesky_columns)
    if (!factorize_tile(block, rows, j, std::min(cholesky_columns, columns - j))) return false;
  return true;
}

}  // namespace hooke::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace hooke {

HWY_EXPORT(multiply_transposed);
HWY_EXPORT(factorize_block);

void multiply_transposed(ColumnBlock a, ColumnBlock b, std::size_t depth, ColumnBlock c, std::size_t rows, std::size_t columns) {
  HWY_DYNAMIC_DISPATCH(multiply_transposed)(a, b, depth, c, rows, columns);
}
bool factorize_block(ColumnBlock block, std::size_t rows, std::size_t columns) {
  return HWY_DYNAMIC_DISPATCH(factorize_block)(block, rows, columns);
}

}  // namespace hooke
#endif
