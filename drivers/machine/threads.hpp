#pragma once
/// How many threads Kokkos gets, and on which cores they stay.
#include <memory>
#include <string>

namespace clathra {

/// Threads that a run with this setting uses: the wanted number, else OMP_NUM_THREADS, else all cores of this process, shared
/// with the other ranks on this machine; never more than the cores, where they would only wait for each other.
int thread_count(int wanted);

/// What to tell the user where fewer threads are used than were asked for, else nothing.
std::string thread_warning(int wanted);

/// Settles the environment that OpenMP reads for `thread_count(wanted)` threads. OpenMP reads it when the program starts, so
/// where something had to be changed the program is started anew, once, with the same arguments. Threads are bound to cores only
/// if they take all cores: two runs that share a machine would else be bound to the same ones. A thread that waits gives its core
/// away soon, since another program may keep from running what it waits for.
void set_up_threads(int wanted);

/// Kokkos from here to the end of the scope, for the verbs that compute.
class KokkosSession {
 public:
  KokkosSession();
  ~KokkosSession();

 private:
  struct Guard;
  std::unique_ptr<Guard> guard_;
};

}  // namespace clathra
