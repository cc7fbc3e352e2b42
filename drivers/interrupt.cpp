#include "interrupt.hpp"

#include <signal.h>

namespace clathra {
namespace {

volatile sig_atomic_t signal_came = 0;
extern "C" void remember_signal(int) { signal_came = 1; }

}  // namespace

void watch_for_interrupt() {
  struct sigaction action = {};
  action.sa_handler = remember_signal;
  action.sa_flags = static_cast<int>(SA_RESETHAND | SA_RESTART);
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
  sigaction(SIGUSR1, &action, nullptr);  // what batch systems send before the end, and what mpirun passes on in peace
}

bool interrupted() { return signal_came != 0; }

}  // namespace clathra
