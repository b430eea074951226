// The structure of a Cholesky factor: in which order points are eliminated, and which blocks of L are not zero. Columns with the same
// structure, or nearly so, form supernodes, whose part of L is a dense block
// (J. W. H. Liu, The role of elimination trees in sparse factorization, 1990; C. Ashcraft, R. Grimes, The influence of relaxed supernode
// partitions on the multifrontal method, 1989).
#pragma once

#include <span>
#include <utility>
#include <vector>

#include "base/types.h"

namespace hooke {

// Points in the order of their elimination: for each, the sorted ones before it that it is coupled to.
using Couplings = std::vector<std::vector<Index>>;

// For each point its place in an order that keeps L sparse: approximate minimum degree (P. R. Amestoy, T. A. Davis, I. S. Duff, 1996), and
// every supernode's points in sequence.
std::vector<Index> elimination_order(Index points, std::span<const std::pair<Index, Index>> couplings);

Couplings couplings_before(std::span<const Index> order, std::span<const std::pair<Index, Index>> couplings);

// [points]; longer sequences are divided, so that the blocks that are multiplied fit into the second cache.
inline constexpr Index max_supernode_columns = 64;

struct Supernode {
  Index first = 0, columns = 0;  // points
  std::vector<Index> rows;       // points after its own that it is coupled to in L, sorted
};
std::vector<Supernode> find_supernodes(const Couplings& before);

}  // namespace hooke
