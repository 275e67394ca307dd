#include "adapters/worker/launcher.hpp"

#include <unistd.h>

#include <mutex>
#include <semaphore>
#include <thread>

namespace crossgrain {
namespace {

class Launcher {
 public:
  Launcher() {
    std::thread([this] { serve(); }).detach();
  }

  pid_t launch(const std::function<pid_t()>& work) {
    const std::scoped_lock one(mutex_);
    work_ = &work;
    asked_.release();
    done_.acquire();
    return launched_;
  }

  const pid_t process = ::getpid();

 private:
  [[noreturn]] void serve() {
    for (;;) {
      asked_.acquire();
      launched_ = (*work_)();
      done_.release();
    }
  }

  std::mutex mutex_;  ///< one who asks at a time
  std::binary_semaphore asked_{0}, done_{0};
  const std::function<pid_t()>* work_ = nullptr;
  pid_t launched_ = -1;
};

}  // namespace

pid_t inTheLastingThread(const std::function<pid_t()>& work) {
  static std::mutex mutex;
  // Never deleted: its thread waits until the process is gone. A fork of this process without exec,
  // as tests make, has no such thread and gets one of its own.
  static Launcher* known = nullptr;
  const std::scoped_lock lock(mutex);
  if (!known || known->process != ::getpid()) known = new Launcher;
  return known->launch(work);
}

}  // namespace crossgrain
