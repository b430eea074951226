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

// y[i] = change(d, y[i], x[i]), in vectors of tag d and one by one at the end
template <class Change>
HWY_INLINE void for_all(double* HWY_RESTRICT y, const double* HWY_RESTRICT x, std::size_t size, Change change) {
  const hn::ScalableTag<double> wide;
  const hn::CappedTag<double, 1> single;
  const std::size_t lanes = hn::Lanes(wide);
  std::size_t i = 0;
  for (; i + lanes <= size; i += lanes) hn::StoreU(change(wide, hn::LoadU(wide, y + i), hn::LoadU(wide, x + i)), wide, y + i);
  for (; i < size; ++i) hn::StoreU(change(single, hn::LoadU(single, y + i), hn::LoadU(single, x + i)), single, y + i);
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

void set_sum(double* y, const double* start, std::span<const ScaledField> terms, std::size_t size) {
  for_elements(size, [&](auto d, std::size_t i) HWY_ATTR {
    auto sum = start != nullptr ? hn::LoadU(d, start + i) : hn::Zero(d);
    for (const ScaledField& term : terms) sum = hn::Add(sum, hn::Mul(hn::Set(d, term.scale), hn::LoadU(d, term.x + i)));
    hn::StoreU(sum, d, y + i);
  });
}

// x = (x0 + x1) / 2 + h/8 (v0 - v1),  v = 3/2 (x1 - x0) / h - (v0 + v1) / 4
void set_cubic_middle(const CubicEnds& ends, double h, double* x, double* v, std::size_t size) {
  const double rate = 1.5 / h;
  for_elements(size, [&](auto d, std::size_t i) HWY_ATTR {
    const auto x0 = hn::LoadU(d, ends.start_x + i), x1 = hn::LoadU(d, ends.end_x + i);
    const auto v0 = hn::LoadU(d, ends.start_v + i), v1 = hn::LoadU(d, ends.end_v + i);
    const auto half = hn::Set(d, 0.5), quarter = hn::Set(d, 0.25);
    hn::StoreU(hn::Add(hn::Mul(half, hn::Add(x0, x1)), hn::Mul(hn::Set(d, 0.125 * h), hn::Sub(v0, v1))), d, x + i);
    hn::StoreU(hn::Sub(hn::Mul(hn::Set(d, rate), hn::Sub(x1, x0)), hn::Mul(quarter, hn::Add(v0, v1))), d, v + i);
  });
}

void add_slope(const SlopeFields& fields, const double* inverse_mass, double weight, double step, std::size_t size) {
  for_elements(size, [&](auto d, std::size_t i) HWY_ATTR {
    const auto v = hn::LoadU(d, fields.v + i), a = hn::Mul(hn::LoadU(d, fields.a + i), hn::LoadU(d, inverse_mass + i));
    const auto w = hn::Set(d, weight), h = hn::Set(d, step);
    hn::StoreU(a, d, fields.a + i);
    hn::StoreU(hn::Add(hn::LoadU(d, fields.sum_v + i), hn::Mul(w, v)), d, fields.sum_v + i);
    hn::StoreU(hn::Add(hn::LoadU(d, fields.sum_a + i), hn::Mul(w, a)), d, fields.sum_a + i);
    hn::StoreU(hn::Add(hn::LoadU(d, fields.start_x + i), hn::Mul(h, v)), d, fields.next_x + i);
    hn::StoreU(hn::Add(hn::LoadU(d, fields.start_v + i), hn::Mul(h, a)), d, fields.next_v + i);
  });
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
HWY_EXPORT(set_cubic_middle);
HWY_EXPORT(add_slope);

void add_scaled(double* y, double s, const double* x, std::size_t size) { HWY_DYNAMIC_DISPATCH(add_scaled)(y, s, x, size); }
void scale_and_add_scaled(double* y, double r, double s, const double* x, std::size_t size) {
  HWY_DYNAMIC_DISPATCH(scale_and_add_scaled)(y, r, s, x, size);
}
void multiply_each(double* y, const double* x, std::size_t size) { HWY_DYNAMIC_DISPATCH(multiply_each)(y, x, size); }
void set_scaled(double* y, double s, const double* x, std::size_t size) { HWY_DYNAMIC_DISPATCH(set_scaled)(y, s, x, size); }

void set_sum(double* y, const double* start, std::span<const ScaledField> terms, std::size_t size) {
  HWY_DYNAMIC_DISPATCH(set_sum)(y, start, terms, size);
}
void set_cubic_middle(const CubicEnds& ends, double h, double* x, double* v, std::size_t size) {
  HWY_DYNAMIC_DISPATCH(set_cubic_middle)(ends, h, x, v, size);
}
void add_slope(const SlopeFields& fields, const double* inverse_mass, double weight, double step, std::size_t size) {
  HWY_DYNAMIC_DISPATCH(add_slope)(fields, inverse_mass, weight, step, size);
}

}  // namespace hooke
#endif
