#pragma once
// One core for everybody. While lavapipe's thread works on another core, ours falls asleep, and its first milliseconds
// awake are slow: up to half as long again for a pass that takes no longer than that.

#include <sched.h>

namespace bench {

/// Keeps the calling thread, and every thread that it starts meanwhile, on the core where it is.
class OneCore {
  public:
    OneCore() {
        known_ = sched_getaffinity(0, sizeof before_, &before_) == 0;
        int const here = sched_getcpu();
        if (!known_ || here < 0) return;
        cpu_set_t one;
        CPU_ZERO(&one);
        CPU_SET(static_cast<unsigned>(here), &one);
        sched_setaffinity(0, sizeof one, &one);
    }
    ~OneCore() {
        if (known_) sched_setaffinity(0, sizeof before_, &before_);
    }
    OneCore(OneCore const&) = delete;
    OneCore& operator=(OneCore const&) = delete;

  private:
    cpu_set_t before_{};
    bool known_ = false;
};

}  // namespace bench
