#pragma once
/// Wall time of a program's kernels and named regions by their labels, from the hooks of Kokkos Tools.
#include <Kokkos_Core.hpp>
#include <map>
#include <string>

namespace clathra {

/// Listens while it lives. One at a time; kernels and regions do not nest.
class Phases {
 public:
  Phases() {
    seconds().clear();
    using namespace Kokkos::Tools::Experimental;
    set_begin_parallel_for_callback(begin);
    set_begin_parallel_reduce_callback(begin);
    set_begin_parallel_scan_callback(begin);
    set_end_parallel_for_callback(end);
    set_end_parallel_reduce_callback(end);
    set_end_parallel_scan_callback(end);
    set_push_region_callback(begin_region);
    set_pop_region_callback(end_region);
  }
  ~Phases() {
    using namespace Kokkos::Tools::Experimental;
    set_begin_parallel_for_callback(nullptr);
    set_begin_parallel_reduce_callback(nullptr);
    set_begin_parallel_scan_callback(nullptr);
    set_end_parallel_for_callback(nullptr);
    set_end_parallel_reduce_callback(nullptr);
    set_end_parallel_scan_callback(nullptr);
    set_push_region_callback(nullptr);
    set_pop_region_callback(nullptr);
  }
  Phases(Phases const&) = delete;
  Phases& operator=(Phases const&) = delete;

  /// [s] by label.
  static std::map<std::string, double>& seconds() {
    static std::map<std::string, double> by_label;
    return by_label;
  }

 private:
  static void begin(char const* label, std::uint32_t, std::uint64_t*) {
    current() = label;
    clock().reset();
  }
  static void end(std::uint64_t) { seconds()[current()] += clock().seconds(); }
  static void begin_region(char const* label) { begin(label, 0, nullptr); }
  static void end_region() { end(0); }
  static std::string& current() {
    static std::string label;
    return label;
  }
  static Kokkos::Timer& clock() {
    static Kokkos::Timer timer;
    return timer;
  }
};

}  // namespace clathra
