#include "engines/grain/kernels.hpp"

#include <cstdlib>
#include <stdexcept>
#include <string>
#include <string_view>

namespace grain {

// One per instruction set: kernel_table.cpp.
template <class Real>
Kernels<Real> baseline();
template <class Real>
Kernels<Real> avx2();
template <class Real>
Kernels<Real> avx512();

namespace {

bool runs(std::string_view set) {
  __builtin_cpu_init();
  if (set == "avx2") return __builtin_cpu_supports("avx2");
  if (set == "avx512")
    return __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512vl") &&
           __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512bw");
  return set == "baseline";
}

std::string wanted() {
  const char* named = std::getenv("GRAIN_INSTRUCTIONS");
  if (named == nullptr || *named == '\0') return instructionSets().back();
  for (const char* set : instructionSets())
    if (std::string_view(set) == named) return named;
  std::string known;
  for (const char* set : instructionSets()) known += std::string(known.empty() ? "" : ", ") + set;
  throw std::invalid_argument("GRAIN_INSTRUCTIONS = \"" + std::string(named) +
                              "\" is no instruction set of this processor; there are " + known);
}

}  // namespace

const std::vector<const char*>& instructionSets() {
  static const std::vector<const char*> sets = [] {
    std::vector<const char*> found;
    for (const char* set : {"baseline", "avx2", "avx512"})
      if (runs(set)) found.push_back(set);
    return found;
  }();
  return sets;
}

template <class Real>
Kernels<Real> kernels() {
  const std::string set = wanted();
  return set == "avx512" ? avx512<Real>() : set == "avx2" ? avx2<Real>() : baseline<Real>();
}

template Kernels<double> kernels();
template Kernels<float> kernels();

}  // namespace grain
