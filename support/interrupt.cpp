#include "support/interrupt.hpp"

#include <csignal>

namespace crossgrain::inline support {
namespace {

volatile std::sig_atomic_t flag = 0;

void onSignal(int signal) {
  flag = 1;
  std::signal(signal, SIG_DFL);
}

}  // namespace

void catchInterrupts() {
  std::signal(SIGINT, onSignal);
  std::signal(SIGTERM, onSignal);
}

bool interrupted() {
  return flag != 0;
}

void throwIfInterrupted() {
  if (interrupted()) throw Interrupted();
}

}  // namespace crossgrain::inline support
