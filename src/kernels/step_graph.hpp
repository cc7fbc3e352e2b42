#pragma once
/// Many steps that a GPU is asked for at once: a graph of their kernels, recorded once and then run again and again until what
/// the kernels were given changes. On a processor there are none, and kernels are launched one by one.
#include <Kokkos_Graph.hpp>
#include <cstdint>
#include <optional>

#include "kernels/lane.hpp"
#include "kernels/light_launch.hpp"

namespace clathra {

/// Where the kernels of a step go: to the device at once, or behind the last kernel of a graph.
class StepLaunches {
 public:
  using Node = Kokkos::Experimental::GraphNodeRef<ExecutionSpace>;

  StepLaunches() = default;
  /// @param last  of a graph that is being recorded, or nullptr
  explicit StepLaunches(ExecutionSpace const& space, Node* last = nullptr) : space_(space), last_(last) {}

  /// A light kernel for 0 .. n.
  template <class Kernel>
  void parallel_for(char const* label, int n, Kernel const& kernel) const {
    static_assert(sizeof(Kernel) <= most_bytes_of_a_light_kernel);
    if constexpr (for_gpu) {
      if (last_ != nullptr) {
        *last_ = last_->then_parallel_for(label, light_launch(space_, n), kernel);
        return;
      }
    }
    Kokkos::parallel_for(label, light_launch(space_, n), kernel);
  }
  /// Likewise. @param result  on the device
  template <class Kernel, class Result>
  void parallel_reduce(char const* label, int n, Kernel const& kernel, Result const& result) const {
    static_assert(sizeof(Kernel) <= most_bytes_of_a_light_kernel);
    if constexpr (for_gpu) {
      if (last_ != nullptr) {
        *last_ = last_->then_parallel_reduce(label, light_launch(space_, n), kernel, result);
        return;
      }
    }
    Kokkos::parallel_reduce(label, light_launch(space_, n), kernel, result);
  }

 private:
  ExecutionSpace space_;
  Node* last_ = nullptr;
};

/// The graph of a simulation. Its kernels have an instance of the execution space of their own, whose memory for reductions no
/// other kernel makes Kokkos move: a graph would go on using what has been given back. It grows by the same kernels only, which
/// is why a graph is recorded after they have run one by one.
class StepGraph {
 public:
  static constexpr int steps = 16;         ///< of a graph
  static constexpr int steps_before = 64;  ///< one by one, before a graph is recorded

  /// To be called whenever a kernel of a step would be given something else than in the step before: what is recorded is no
  /// longer true.
  void drop() {
    graph_.reset();
    done_ = 0;
  }
  /// The same where the time step [s] has changed.
  void follow(Real time_step) {
    if (time_step != time_step_) drop();
    time_step_ = time_step;
  }

  /// Enqueues as many steps as there are, by graphs as far as these pay.
  /// @param step  step(StepLaunches, n) enqueues the n-th of them. All give their kernels the same, but for the first one behind
  /// a drop, which no graph does.
  template <class Step>
  void enqueue(int count, Step const& step) {
    int n = 0;
    while (n < count) {
      if (for_gpu && done_ >= steps_before && count - n >= steps) {
        run(step);
        n += steps;
      } else {
        step(StepLaunches(space_), n++);
        ++done_;
      }
    }
  }
  /// For kernels behind the steps that were asked for, the same ones each time: the first of them may make Kokkos move the memory
  /// of this instance.
  StepLaunches behind() {
    if (!has_been_followed_) drop();
    has_been_followed_ = true;
    return StepLaunches(space_);
  }
  std::int64_t runs() const { return runs_; }  ///< of graphs

 private:
  using Graph = Kokkos::Experimental::Graph<ExecutionSpace>;

  static ExecutionSpace own_space() {
#if KOKKOS_VERSION >= 40000
    if constexpr (for_gpu) return Kokkos::Experimental::partition_space(ExecutionSpace(), 1)[0];
#endif
    return ExecutionSpace();
  }

  template <class Step>
  void run(Step const& step) {
    if (!graph_) {
      graph_ = Kokkos::Experimental::create_graph(space_, [&](auto const& root) {
        StepLaunches::Node last = root;
        for (int n = 0; n < steps; ++n) step(StepLaunches(space_, &last), 1);
      });
    }
    // Tools that watch kernels are not told of those of a graph.
    std::uint64_t kernel = 0;
    Kokkos::Tools::beginParallelFor("step_graph", 0, &kernel);
    graph_->submit();
    Kokkos::Tools::endParallelFor(kernel);
    ++runs_;
  }

  ExecutionSpace space_ = own_space();
  std::optional<Graph> graph_;
  Real time_step_ = 0;
  std::int64_t done_ = 0;  ///< steps one by one since it was dropped
  std::int64_t runs_ = 0;
  bool has_been_followed_ = false;
};

}  // namespace clathra
