#pragma once

#include <span>
#include <vector>

#include "runs/conformance/exam.hpp"

/// The checks that every engine has to pass, as data: a property each, which holds for any engine.
namespace crossgrain::conformance {

struct Check {
  const char* name;    ///< "HeadOnCollision"
  const char* what;    ///< the property, in words
  void (*run)(Exam&);  ///< finds faults, or throws Skipped
};

namespace capabilities {
std::span<const Check> checks();
}
namespace lifecycle {
std::span<const Check> checks();
}
namespace free_motion {
std::span<const Check> checks();
}
namespace collision {
std::span<const Check> checks();
}
namespace laws {
std::span<const Check> checks();
}
namespace symmetry {
std::span<const Check> checks();
}
namespace walls {
std::span<const Check> checks();
}
namespace contacts {
std::span<const Check> checks();
}
namespace reach {
std::span<const Check> checks();
}
namespace refusal {
std::span<const Check> checks();
}
namespace mirror {
std::span<const Check> checks();
}

/// All of them, in the order in which they are run.
/// @param isMirror  whether the engine is a mirror, which has to follow its peer as well
std::vector<Check> checksOf(bool isMirror);

}  // namespace crossgrain::conformance
