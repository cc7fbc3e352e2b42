#pragma once
/// Memory that one neighbour search hands back and the next one takes again: a device gives and takes memory slowly, and waits
/// for its kernels before it does.
#include <algorithm>
#include <tuple>
#include <vector>

#include "kernels/real_field.hpp"

namespace clathra {

/// Fields that nobody else holds are free. Kernels run one after the other, so a field may be taken again while those that were
/// given it before are still to come.
class Scratch {
 public:
  /// A field of `size` numbers, whatever stands in them.
  template <class T>
  Field<T> take(char const* label, std::size_t size) {
    if (size == 0) return Field<T>();
    auto& pieces = std::get<Pieces<T>>(pieces_);
    std::size_t const wanted = rounded(size);
    Piece<T>* best = nullptr;
    for (Piece<T>& piece : pieces) {
      std::size_t const room = piece.field.extent(0);
      bool const fits = room >= wanted && room <= wanted + wanted / 4 && piece.field.use_count() == 1;
      if (fits && (best == nullptr || room < best->field.extent(0))) best = &piece;
    }
    if (best == nullptr) best = &pieces.emplace_back(Piece<T>{uninitialised<T>(label, wanted), 0});
    best->idle = 0;
    return Kokkos::subview(best->field, std::pair<std::size_t, std::size_t>(0, size));
  }
  RealField take_reals(char const* label, std::size_t size, NumberFormat const& format) {
    return RealField(take<RealField::Word>(label, RealField::words(format, size)), format);
  }

  /// Ends a search. What the next one would not take either is given up, since sizes have changed: it takes what this one has
  /// taken, or what this one has set free.
  void tidy() {
    for_each_kind([](auto& pieces) {
      for (auto& piece : pieces) ++piece.idle;
      pieces.erase(std::remove_if(pieces.begin(), pieces.end(), [](auto const& piece) { return piece.idle > 2; }), pieces.end());
    });
  }

  /// Bytes that nobody else holds.
  std::size_t bytes() const {
    std::size_t total = 0;
    for_each_kind([&]<class T>(std::vector<Piece<T>> const& pieces) {
      for (Piece<T> const& piece : pieces) total += piece.field.use_count() == 1 ? piece.field.span() * sizeof(T) : 0;
    });
    return total;
  }

 private:
  template <class T>
  struct Piece {
    Field<T> field;
    int idle;  ///< searches that have ended since it was taken
  };
  template <class T>
  using Pieces = std::vector<Piece<T>>;

  /// Up to a thirty-second more, so that a size may grow a little.
  static std::size_t rounded(std::size_t size) {
    std::size_t step = 64;
    while (step * 64 <= size) step *= 2;
    return (size + step - 1) / step * step;
  }
  template <class Visit>
  void for_each_kind(Visit const& visit) {
    std::apply([&](auto&... pieces) { (visit(pieces), ...); }, pieces_);
  }
  template <class Visit>
  void for_each_kind(Visit const& visit) const {
    std::apply([&](auto const&... pieces) { (visit(pieces), ...); }, pieces_);
  }

  std::tuple<Pieces<std::uint8_t>, Pieces<int>, Pieces<std::uint32_t>, Pieces<std::int64_t>, Pieces<float>, Pieces<double>>
      pieces_;
};

/// A field of the same kind, whatever stands in it.
template <class T>
Field<T> take_like(Scratch& scratch, Field<T> const&, char const* label, std::size_t size) {
  return scratch.take<T>(label, size);
}
inline RealField take_like(Scratch& scratch, RealField const& field, char const* label, std::size_t size) {
  return scratch.take_reals(label, size, field.format());
}

}  // namespace clathra
