#pragma once
/// Launches of a program's kernels, and the wall time of kernels and named regions by their labels, from the hooks of Kokkos
/// Tools.
#include <Kokkos_Core.hpp>
#include <cstdint>
#include <map>
#include <string>

namespace clathra {

/// Listens while it lives. One at a time; kernels and regions do not nest.
class Phases {
 public:
  Phases() {
    seconds().clear();
    launched() = 0;
    using namespace Kokkos::Tools::Experimental;
    set_begin_parallel_for_callback(begin_kernel);
    set_begin_parallel_reduce_callback(begin_kernel);
    set_begin_parallel_scan_callback(begin_kernel);
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
  static std::int64_t launches() { return launched(); }  ///< of kernels, fills of new fields among them

 private:
  static void begin_kernel(char const* label, std::uint32_t, std::uint64_t*) {
    ++launched();
    begin(label);
  }
  static void begin(char const* label) {
    current() = label;
    clock().reset();
  }
  static void end(std::uint64_t) { seconds()[current()] += clock().seconds(); }
  static void begin_region(char const* label) { begin(label); }
  static void end_region() { end(0); }
  static std::int64_t& launched() {
    static std::int64_t number = 0;
    return number;
  }
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
