// Dense blocks of a Cholesky factor, in columns, for the widest vector unit of the machine at hand; the same bits on every machine.
#pragma once

#include <cstddef>

namespace hooke {

// Rows of a column are padded to a multiple of this.
inline constexpr std::size_t column_alignment = 8;

// Rows and columns of a matrix from `start`, whose columns are `stride` apart: a multiple of column_alignment.
struct ColumnBlock {
  double* start = nullptr;
  std::size_t stride = 0;
};

// C = A B^T, for row >= column of C only; what is above remains, or becomes anything. `rows` of A, `columns` rows of B, `depth` columns of
// both. Reads up to column_alignment - 1 elements beyond each column of A, and sets as many beyond each of C.
void multiply_transposed(ColumnBlock a, ColumnBlock b, std::size_t depth, ColumnBlock c, std::size_t rows, std::size_t columns);

// The columns of L for a block that starts with a diagonal one, of rows >= columns: L L^T = block, with L below. What is above the diagonal
// becomes anything. False if a pivot is not positive.
bool factorize_block(ColumnBlock block, std::size_t rows, std::size_t columns);

}  // namespace hooke
