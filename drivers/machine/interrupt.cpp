#include "machine/interrupt.hpp"

#include <signal.h>
#include <unistd.h>

#include <initializer_list>

namespace clathra {
namespace {

volatile sig_atomic_t signal_came = 0;
volatile sig_atomic_t interrupts = 0;

/// Ctrl-C a second time ends the program at once; a batch system may send its signals as often as it likes (`timeout` of GNU
/// sends SIGTERM twice).
extern "C" void remember_signal(int signal) {
  signal_came = 1;
  if (signal != SIGINT) return;
  if (interrupts > 0) ::_exit(128 + SIGINT);
  interrupts = 1;
}

}  // namespace

void watch_for_interrupt() {
  struct sigaction action = {};
  action.sa_handler = remember_signal;
  action.sa_flags = SA_RESTART;
  for (int const signal : {SIGINT, SIGTERM, SIGUSR1}) sigaction(signal, &action, nullptr);
  struct sigaction before = {};  // a terminal that goes away sends SIGHUP, which `nohup` tells us to ignore
  if (sigaction(SIGHUP, nullptr, &before) == 0 && before.sa_handler != SIG_IGN) sigaction(SIGHUP, &action, nullptr);
}

bool interrupted() { return signal_came != 0; }

}  // namespace clathra
