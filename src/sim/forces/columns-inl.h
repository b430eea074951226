// Rows of numbers in vectors, for kernels that Highway compiles once for each vector unit: loads and stores up to the right edge, and what
// one vector hands on to the next. Included once for each of them.
#include <type_traits>

#if defined(HOOKE_SIM_FORCES_COLUMNS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef HOOKE_SIM_FORCES_COLUMNS_INL_H
#undef HOOKE_SIM_FORCES_COLUMNS_INL_H
#else
#define HOOKE_SIM_FORCES_COLUMNS_INL_H
#endif

#include <hwy/highway.h>

#include "sim/plan/grid.h"

HWY_BEFORE_NAMESPACE();
namespace hooke::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// All lanes up by one, with the highest lane of `previous` below them.
template <class D, class V = hn::Vec<D>>
HWY_INLINE V shift_up([[maybe_unused]] D d, [[maybe_unused]] V current, V previous) {
#if HWY_TARGET == HWY_SCALAR
  return previous;
#else
  using T = hn::TFromD<D>;
  constexpr std::size_t bytes = hn::MaxLanes(D()) * sizeof(T);
  if constexpr (hn::MaxLanes(D()) == 1) {
    return previous;
  } else if constexpr (bytes <= 16) {
    return hn::CombineShiftRightLanes<hn::MaxLanes(D()) - 1>(d, current, previous);
  } else if constexpr (bytes == 32) {
    return hn::CombineShiftRightLanes<16 / sizeof(T) - 1>(d, current, hn::ConcatLowerUpper(d, current, previous));
  } else {
    static_assert(bytes == 64 && HWY_TARGET <= HWY_AVX3, "no other unit has vectors of more than 32 bytes");
#if HWY_TARGET <= HWY_AVX3
    if constexpr (sizeof(T) == 8)
      return V{_mm512_castsi512_pd(_mm512_alignr_epi64(_mm512_castpd_si512(current.raw), _mm512_castpd_si512(previous.raw), 7))};
    else
      return V{_mm512_castsi512_ps(_mm512_alignr_epi32(_mm512_castps_si512(current.raw), _mm512_castps_si512(previous.raw), 15))};
#endif
  }
#endif
}

// As many columns as the vector has lanes, with a further column after them.
template <class Tag>
struct WholeVector {
  using D = Tag;
  using T = hn::TFromD<Tag>;
  using V = hn::Vec<D>;
  D d;
  HWY_INLINE V load(const T* p) const { return hn::LoadU(d, p); }
  HWY_INLINE V load_next(const T* p) const { return hn::LoadU(d, p + 1); }
  HWY_INLINE void store(V v, T* p) const { hn::StoreU(v, d, p); }
};

// The last columns of a row: nothing is read or written beyond them. Vectors of 16 bytes take them one by one, since Highway's
// masked operations touch all lanes there.
template <class Tag>
struct RightEdge {
  using D = Tag;
  using T = hn::TFromD<Tag>;
  using V = hn::Vec<D>;
  D d;
  hn::Mask<D> here, next;
  HWY_INLINE RightEdge(D tag, Index columns) : d(tag), here(hn::FirstN(tag, columns)), next(hn::FirstN(tag, columns - 1)) {}
  HWY_INLINE V load(const T* p) const { return hn::MaskedLoad(here, d, p); }
  HWY_INLINE V load_next(const T* p) const { return hn::MaskedLoad(next, d, p + 1); }
  HWY_INLINE void store(V v, T* p) const { hn::BlendedStore(v, here, d, p); }
};

template <class T>
struct OneColumn {
  using D = hn::CappedTag<T, 1>;
  using V = hn::Vec<D>;
  D d;
  bool has_next;
  HWY_INLINE V load(const T* p) const { return hn::LoadU(d, p); }
  HWY_INLINE V load_next(const T* p) const { return has_next ? hn::LoadU(d, p + 1) : hn::Zero(d); }
  HWY_INLINE void store(V v, T* p) const { hn::StoreU(v, d, p); }
};

// What cells have for the points of the next column.
template <int Dimensions, class V>
struct Carry {
  V same_row[Dimensions], below[Dimensions];
};

// For the columns of a row in vectors: use(columns, first column).
template <class T, class Use>
HWY_INLINE void for_columns(Index count, const Use& use) {
  const hn::ScalableTag<T> d;
  const Index lanes = static_cast<Index>(hn::Lanes(d));
  const WholeVector<decltype(d)> whole{d};
  Index j = 0;
  for (; j + lanes < count; j += lanes) use(whole, j);
  if constexpr (hn::MaxLanes(d) * sizeof(T) >= 32) {
    use(RightEdge(d, count - j), j);
  } else {
    for (; j < count; ++j) use(OneColumn<T>{{}, j + 1 < count}, j);
  }
}

// The state of a sweep along a row in vectors of either width.
template <int Dimensions, class T>
struct RowState {
  using Wide = hn::ScalableTag<T>;
  using Single = hn::CappedTag<T, 1>;
  Carry<Dimensions, hn::Vec<Wide>> wide;
  Carry<Dimensions, hn::Vec<Single>> single;
  bool is_wide = false;
  HWY_INLINE RowState() {
    for (int c = 0; c < Dimensions; ++c) {
      wide.same_row[c] = wide.below[c] = hn::Zero(Wide());
      single.same_row[c] = single.below[c] = hn::Zero(Single());
    }
  }
  template <class D>
  HWY_INLINE auto& carry(D) {
    if constexpr (hn::MaxLanes(D()) == hn::MaxLanes(Wide())) {
      is_wide = true;
      return wide;
    } else {
      if (is_wide)
        for (int c = 0; c < Dimensions; ++c) {
          single.same_row[c] = hn::Set(Single(), hn::ExtractLane(wide.same_row[c], hn::MaxLanes(Wide()) - 1));
          single.below[c] = hn::Set(Single(), hn::ExtractLane(wide.below[c], hn::MaxLanes(Wide()) - 1));
        }
      is_wide = false;
      return single;
    }
  }
};

}  // namespace hooke::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
