#pragma once

#include <cstddef>
#include <cstdint>
#include <new>
#include <vector>

namespace grain {

/// Whether coordinates count from an origin near the disk: in single precision, where an overlap of
/// 1e-7 m would be lost in a position of 0.1 m.
template <class Real>
inline constexpr bool hasLocalCoordinates = sizeof(Real) < sizeof(double);

/// Starts arrays on a cache line, so that no vector load straddles two.
template <class T>
struct CacheLineAllocator {
  using value_type = T;
  static constexpr std::align_val_t line{64};

  CacheLineAllocator() = default;
  template <class U>
  CacheLineAllocator(const CacheLineAllocator<U>&) {}

  T* allocate(std::size_t n) { return static_cast<T*>(::operator new(n * sizeof(T), line)); }
  void deallocate(T* p, std::size_t) { ::operator delete(p, line); }
  bool operator==(const CacheLineAllocator&) const = default;
};

template <class T>
using Array = std::vector<T, CacheLineAllocator<T>>;

// Functions that the kernels need of <cmath> and <algorithm>, inlined without exception: a kernel
// is compiled for several instruction sets, and the linker would keep one arbitrary copy of a
// function that was not inlined.
#define GRAIN_INLINE [[gnu::always_inline]] inline
#define GRAIN_INLINE_LAMBDA __attribute__((always_inline))

GRAIN_INLINE double squareRoot(double v) {
  return __builtin_sqrt(v);
}
GRAIN_INLINE float squareRoot(float v) {
  return __builtin_sqrtf(v);
}
/// v^(1/3) of v >= 0, within 3e-16 of itself, by additions, products and quotients alone: the same
/// bits everywhere. Newton's method from 2^(log₂(v)/3), linear between powers of two.
GRAIN_INLINE double cubeRoot(double v) {
  std::uint64_t bits;
  __builtin_memcpy(&bits, &v, sizeof bits);
  bits = bits / 3 + 0x2a9f7893782da1ceu;
  double root;
  __builtin_memcpy(&root, &bits, sizeof root);
  for (int k = 0; k < 4; ++k) root = (2.0 * root + v / (root * root)) / 3.0;
  return v > 0.0 ? root : 0.0;
}
GRAIN_INLINE float cubeRoot(float v) {
  return static_cast<float>(cubeRoot(static_cast<double>(v)));
}
GRAIN_INLINE double magnitude(double v) {
  return __builtin_fabs(v);
}
GRAIN_INLINE float magnitude(float v) {
  return __builtin_fabsf(v);
}
template <class Real>
GRAIN_INLINE Real larger(Real a, Real b) {
  return a < b ? b : a;
}
template <class Real>
GRAIN_INLINE Real smaller(Real a, Real b) {
  return b < a ? b : a;
}
/// |v| with the sign of `like`, whose zeros have one, too.
GRAIN_INLINE double withSignOf(double v, double like) {
  return __builtin_copysign(v, like);
}
GRAIN_INLINE float withSignOf(float v, float like) {
  return __builtin_copysignf(v, like);
}
/// v with the sign of `like`; 0 where `like` is 0.
template <class Real>
GRAIN_INLINE Real signedLike(Real v, Real like) {
  return like > Real(0) ? v : like < Real(0) ? -v : Real(0);
}

/// A vector of the plane. The two components move through memory and arithmetic together.
template <class Real>
struct Vec {
  Real x, y;
};

template <class Real>
struct Both {
  typedef Real Lanes __attribute__((vector_size(2 * sizeof(Real))));
  Lanes lanes;

  GRAIN_INLINE explicit Both(const Vec<Real>& v) { __builtin_memcpy(&lanes, &v, sizeof lanes); }
  GRAIN_INLINE void store(Vec<Real>& v) const { __builtin_memcpy(&v, &lanes, sizeof lanes); }
};

template <class Real>
GRAIN_INLINE Vec<Real> operator-(const Vec<Real>& a, const Vec<Real>& b) {
  Both<Real> difference(a);
  difference.lanes -= Both<Real>(b).lanes;
  Vec<Real> v;
  difference.store(v);
  return v;
}
template <class Real>
GRAIN_INLINE void operator+=(Vec<Real>& a, const Vec<Real>& b) {
  Both<Real> sum(a);
  sum.lanes += Both<Real>(b).lanes;
  sum.store(a);
}
template <class Real>
GRAIN_INLINE void operator-=(Vec<Real>& a, const Vec<Real>& b) {
  Both<Real> difference(a);
  difference.lanes -= Both<Real>(b).lanes;
  difference.store(a);
}

}  // namespace grain
