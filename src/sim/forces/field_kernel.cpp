// Compiled once for each vector unit by Highway. Multiplication and addition stay two operations with two roundings, in
// vectors as in the scalar rest.
#include "sim/forces/field_kernel.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "sim/forces/field_kernel.cpp"
#include <hwy/foreach_target.h>

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace hooke::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// use(d, i) for the elements from i on, in vectors of tag d and one by one at the end
template <class Use>
HWY_INLINE void for_elements(std::size_t size, const Use& use) {
  const hn::ScalableTag<double> wide;
  const hn::CappedTag<double, 1> single;
  const std::size_t lanes = hn::Lanes(wide);
  std::size_t i = 0;
  for (; i + lanes <= size; i += lanes) use(wide, i);
  for (; i < size; ++i) use(single, i);
}

// y[i] = change(d, y[i], x[i])
template <class Change>
HWY_INLINE void for_all(double* HWY_RESTRICT y, const double* HWY_RESTRICT x, std::size_t size, const Change& change) {
  for_elements(size, [&](auto d, std::size_t i) HWY_ATTR { hn::StoreU(change(d, hn::LoadU(d, y + i), hn::LoadU(d, x + i)), d, y + i); });
}

void add_scaled(double* y, double s, const double* x, std::size_t size) {
  for_all(y, x, size, [s](auto d, auto old, auto term) HWY_ATTR { return hn::Add(old, hn::Mul(hn::Set(d, s), term)); });
}

void scale_and_add_scaled(double* y, double r, double s, const double* x, std::size_t size) {
  for_all(y, x, size,
          [r, s](auto d, auto old, auto term) HWY_ATTR { return hn::Add(hn::Mul(hn::Set(d, r), old), hn::Mul(hn::Set(d, s), term)); });
}

void multiply_each(double* y, const double* x, std::size_t size) {
  for_all(y, x, size, [](auto, auto old, auto factor) HWY_ATTR { return hn::Mul(old, factor); });
}

void set_scaled(double* y, double s, const double* x, std::size_t size) {
  for_all(y, x, size, [s](auto d, auto, auto term) HWY_ATTR { return hn::Mul(hn::Set(d, s), term); });
}

// Four vectors at once: scales and addresses of the terms are read once for them, and their sums do not wait for each other.
void set_sum(double* y, const double* start, std::span<const ScaledField> terms, std::size_t size) {
  const auto store = [&](auto d, auto sum, std::size_t i)
                         HWY_ATTR { hn::StoreU(start != nullptr ? hn::Add(hn::LoadU(d, start + i), sum) : sum, d, y + i); };
  const hn::ScalableTag<double> d;
  const std::size_t lanes = hn::Lanes(d), step = 4 * lanes;
  std::size_t i = 0;
  for (; i + step <= size; i += step) {
    auto sum0 = hn::Zero(d), sum1 = sum0, sum2 = sum0, sum3 = sum0;
    for (const ScaledField& term : terms) {
      const auto scale = hn::Set(d, term.scale);
      const double* const x = term.x + i;
      sum0 = hn::Add(sum0, hn::Mul(scale, hn::LoadU(d, x)));
      sum1 = hn::Add(sum1, hn::Mul(scale, hn::LoadU(d, x + lanes)));
      sum2 = hn::Add(sum2, hn::Mul(scale, hn::LoadU(d, x + 2 * lanes)));
      sum3 = hn::Add(sum3, hn::Mul(scale, hn::LoadU(d, x + 3 * lanes)));
    }
    store(d, sum0, i);
    store(d, sum1, i + lanes);
    store(d, sum2, i + 2 * lanes);
    store(d, sum3, i + 3 * lanes);
  }
  for_elements(size - i, [&](auto tag, std::size_t k) HWY_ATTR {
    auto sum = hn::Zero(tag);
    for (const ScaledField& term : terms) sum = hn::Add(sum, hn::Mul(hn::Set(tag, term.scale), hn::LoadU(tag, term.x + i + k)));
    store(tag, sum, i + k);
  });
}

void add_squares_of_sum(std::span<double, partial_sums> squares, std::span<const ScaledField> terms, std::size_t size) {
  const auto add = [&](auto d, std::size_t i, std::size_t partial) HWY_ATTR {
    auto sum = hn::Zero(d);
    for (const ScaledField& term : terms) sum = hn::Add(sum, hn::Mul(hn::Set(d, term.scale), hn::LoadU(d, term.x + i)));
    hn::StoreU(hn::Add(hn::LoadU(d, &squares[partial]), hn::Mul(sum, sum)), d, &squares[partial]);
  };
  const hn::CappedTag<double, partial_sums> wide;
  const hn::CappedTag<double, 1> single;
  const std::size_t lanes = hn::Lanes(wide);
  std::size_t i = 0;
  for (; i + partial_sums <= size; i += partial_sums)
    for (std::size_t partial = 0; partial < partial_sums; partial += lanes) add(wide, i + partial, partial);
  for (std::size_t partial = 0; i < size; ++i, ++partial) add(single, i, partial);
}

}  // namespace hooke::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace hooke {

HWY_EXPORT(add_scaled);
HWY_EXPORT(scale_and_add_scaled);
HWY_EXPORT(multiply_each);
HWY_EXPORT(set_scaled);
HWY_EXPORT(set_sum);
HWY_EXPORT(add_squares_of_sum);

void add_scaled(double* y, double s, const double* x, std::size_t size) { HWY_DYNAMIC_DISPATCH(add_scaled)(y, s, x, size); }
void scale_and_add_scaled(double* y, double r, double s, const double* x, std::size_t size) {
  HWY_DYNAMIC_DISPATCH(scale_and_add_scaled)(y, r, s, x, size);
}
void multiply_each(double* y, const double* x, std::size_t size) { HWY_DYNAMIC_DISPATCH(multiply_each)(y, x, size); }
void set_scaled(double* y, double s, const double* x, std::size_t size) { HWY_DYNAMIC_DISPATCH(set_scaled)(y, s, x, size); }

void set_sum(double* y, const double* start, std::span<const ScaledField> terms, std::size_t size) {
  HWY_DYNAMIC_DISPATCH(set_sum)(y, start, terms, size);
}
void add_squares_of_sum(std::span<double, partial_sums> squares, std::span<const ScaledField> terms, std::size_t size) {
  HWY_DYNAMIC_DISPATCH(add_squares_of_sum)(squares, terms, size);
}

}  // namespace hooke
#endif
