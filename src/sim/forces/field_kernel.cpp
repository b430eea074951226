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

}  // namespace hooke::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace hooke {

HWY_EXPORT(add_scaled);
HWY_EXPORT(scale_and_add_scaled);
HWY_EXPORT(multiply_each);
HWY_EXPORT(set_scaled);

void add_scaled(double* y, double s, const double* x, std::size_t size) { HWY_DYNAMIC_DISPATCH(add_scaled)(y, s, x, size); }
void scale_and_add_scaled(double* y, double r, double s, const double* x, std::size_t size) {
  HWY_DYNAMIC_DISPATCH(scale_and_add_scaled)(y, r, s, x, size);
}
void multiply_each(double* y, const double* x, std::size_t size) { HWY_DYNAMIC_DISPATCH(multiply_each)(y, x, size); }
void set_scaled(double* y, double s, const double* x, std::size_t size) { HWY_DYNAMIC_DISPATCH(set_scaled)(y, s, x, size); }

}  // namespace hooke
#endif
