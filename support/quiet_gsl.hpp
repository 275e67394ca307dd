#pragma once

#include <gsl/gsl_errno.h>

namespace crossgrain::inline support {

/// GSL aborts the program on an error by default; while one of these lives errors are
/// return values. The handler is the process's, not the thread's.
class QuietGsl {
 public:
  QuietGsl() : previous_(gsl_set_error_handler_off()) {}
  ~QuietGsl() { gsl_set_error_handler(previous_); }
  QuietGsl(const QuietGsl&) = delete;
  QuietGsl& operator=(const QuietGsl&) = delete;

 private:
  gsl_error_handler_t* previous_;
};

}  // namespace crossgrain::inline support
