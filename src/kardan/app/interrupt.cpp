#include "kardan/app/interrupt.hpp"

#include <atomic>
#include <csignal>

namespace kardan::app {

namespace {

std::atomic<Solver*> running{nullptr};
static_assert(std::atomic<Solver*>::is_always_lock_free && std::atomic<bool>::is_always_lock_free);

extern "C" void stop_running_solver(int signal) {
  if (Solver* solver = running.load()) solver->request_stop();
  std::signal(signal, SIG_DFL);
}

}  // namespace

InterruptGuard::InterruptGuard(Solver& solver) {
  KARDAN_ASSERT(running.exchange(&solver) == nullptr);
  std::signal(SIGINT, stop_running_solver);
  std::signal(SIGTERM, stop_running_solver);
}

InterruptGuard::~InterruptGuard() {
  std::signal(SIGINT, SIG_DFL);
  std::signal(SIGTERM, SIG_DFL);
  running.store(nullptr);
}

}  // namespace kardan::app
