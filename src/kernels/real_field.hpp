#pragma once
/// Fields of reals whose storage is chosen when the program runs: one kernel reads a state of either precision, and only those
/// that are worth it are compiled for each.
#include <string>
#include <utility>
#include <vector>

#include "kernels/bond_kind.hpp"
#include "kernels/lane.hpp"

namespace clathra {

enum class Storage : std::int8_t { as_double, as_float, as_int };

/// How a number is kept.
struct NumberFormat {
  Storage storage = Storage::as_double;
  bool operator==(NumberFormat const&) const = default;
  KOKKOS_INLINE_FUNCTION int bytes() const { return storage == Storage::as_double ? 8 : 4; }
};

/// A field of reals, read and written in double precision whatever it is kept in.
class RealField {
 public:
  RealField() = default;
  /// @param zero  whether it is filled with zeros
  RealField(std::string const& label, std::size_t size, NumberFormat format = {}, bool zero = true)
      : words_(zero ? Field<Word>(label, words(format, size))
                    : Field<Word>(Kokkos::view_alloc(label, Kokkos::WithoutInitializing), words(format, size))),
        format_(format) {}
  using Word = std::uint32_t;
  /// Numbers that stand in these words.
  RealField(Field<Word> words, NumberFormat format) : words_(std::move(words)), format_(format) {}
  /// How many words `size` numbers take.
  KOKKOS_INLINE_FUNCTION static std::size_t words(NumberFormat const& format, std::size_t size) {
    return static_cast<std::size_t>(format.bytes()) / sizeof(Word) * size;
  }

  /// One column of a table of single precision numbers, which it shares.
  /// @param table  [rows][columns]
  static RealField column(Field<Word> const& table, int columns, int which) {
    RealField field;
    field.words_ = table;
    field.format_ = {Storage::as_float};
    field.stride_ = columns;
    field.offset_ = which;
    return field;
  }
  KOKKOS_INLINE_FUNCTION bool is_column() const { return stride_ > 1; }

  KOKKOS_INLINE_FUNCTION double operator()(std::size_t i) const {
    switch (format_.storage) {
      case Storage::as_double:
        return data<double>()[i];
      case Storage::as_float:
        return from_single(data<float>()[place(i)]);
      default:
        return data<std::int32_t>()[i];
    }
  }
  KOKKOS_INLINE_FUNCTION double operator()(int i) const { return (*this)(static_cast<std::size_t>(i)); }
  /// The same of a field in single precision.
  KOKKOS_FORCEINLINE_FUNCTION double of_single(int i) const {
    return from_single(data<float>()[place(static_cast<std::size_t>(i))]);
  }
  /// A number beyond single precision is kept as infinite, no_bond as its own mark.
  KOKKOS_INLINE_FUNCTION void set(std::size_t i, double value) const {
    switch (format_.storage) {
      case Storage::as_double:
        data<double>()[i] = value;
        break;
      case Storage::as_float:
        data<float>()[place(i)] = to_single(value);
        break;
      default:
        data<std::int32_t>()[i] = static_cast<std::int32_t>(value);
    }
  }
  KOKKOS_INLINE_FUNCTION void set(int i, double value) const { set(static_cast<std::size_t>(i), value); }
  KOKKOS_INLINE_FUNCTION void add(int i, double value) const {
    if (format_.storage == Storage::as_double)
      data<double>()[i] += value;
    else
      set(i, (*this)(i) + value);
  }

  KOKKOS_INLINE_FUNCTION NumberFormat const& format() const { return format_; }
  KOKKOS_INLINE_FUNCTION std::size_t extent(int) const {
    return words_.extent(0) / words(format_, static_cast<std::size_t>(stride_));
  }
  std::size_t bytes() const { return is_column() ? 0 : words_.span() * sizeof(Word); }  ///< of its own
  std::string label() const { return words_.label(); }

  /// The numbers as they are kept; T is what the format says. Not of a column.
  template <class T>
  KOKKOS_FORCEINLINE_FUNCTION T* data() const {
    return reinterpret_cast<T*>(words_.data());
  }
  /// The same as a field that does not own them.
  template <class T>
  Field<T> as() const {
    return Field<T>(data<T>(), extent(0));
  }

  // Only the mark itself becomes the other mark: what is beyond single precision becomes infinite, which is found as a fault.
  KOKKOS_INLINE_FUNCTION static double from_single(float value) { return value == no_bond_single ? no_bond : value; }
  KOKKOS_INLINE_FUNCTION static float to_single(double value) {
    return value == no_bond ? no_bond_single : static_cast<float>(value);
  }

 private:
  KOKKOS_INLINE_FUNCTION std::size_t place(std::size_t i) const {
    return i * static_cast<std::size_t>(stride_) + static_cast<std::size_t>(offset_);
  }

  Field<Word> words_;
  NumberFormat format_;
  int stride_ = 1, offset_ = 0;
};

// The same for fields of one type, for those who only carry them.
template <class T>
KOKKOS_INLINE_FUNCTION void set(Field<T> const& field, std::size_t i, double value) {
  field(i) = static_cast<T>(value);
}
KOKKOS_INLINE_FUNCTION void set(RealField const& field, std::size_t i, double value) { field.set(i, value); }
template <class T>
std::size_t field_bytes(Field<T> const& field) {
  return field.span() * sizeof(T);
}
inline std::size_t field_bytes(RealField const& field) { return field.bytes(); }

/// A field of the same format. @param zero  whether it is filled with zeros
template <class T>
Field<T> like(Field<T> const&, std::string const& label, std::size_t size, bool zero = true) {
  return zero ? Field<T>(label, size) : uninitialised<T>(label.c_str(), size);
}
inline RealField like(RealField const& field, std::string const& label, std::size_t size, bool zero = true) {
  return RealField(label, size, field.format(), zero);
}

/// Calls visit with the field as what it is kept in: Field<double>, Field<float> or Field<std::int32_t>.
template <class Visit>
void visit_as_kept(RealField const& field, Visit&& visit) {
  switch (field.format().storage) {
    case Storage::as_double:
      return visit(field.as<double>());
    case Storage::as_float:
      return visit(field.as<float>());
    default:
      return visit(field.as<std::int32_t>());
  }
}

/// Makes room for `size` numbers and keeps those that there were, as far as there is room.
template <class T>
void resize(Field<T>& field, std::size_t size) {
  Kokkos::resize(field, size);
}
/// Copies the first `count` numbers.
template <class T>
void copy_first(Field<T> const& from, Field<T> const& to, std::size_t count) {
  std::pair<std::size_t, std::size_t> const range(0, count);
  Kokkos::deep_copy(Kokkos::subview(to, range), Kokkos::subview(from, range));
}
inline void copy_first(RealField const& from, RealField const& to, std::size_t count) {
  visit_as_kept(from, [&]<class T>(Field<T> const& numbers) { copy_first(numbers, to.as<T>(), count); });
}

inline void resize(RealField& field, std::size_t size) {
  RealField const other = like(field, field.label(), size);
  copy_first(field, other, field.extent(0) < size ? field.extent(0) : size);
  field = other;
}

struct FillRealField {
  RealField field;
  double value;
  KOKKOS_FUNCTION void operator()(int i) const { field.set(i, value); }
};
inline void fill(RealField const& field, double value) {
  Kokkos::parallel_for("fill_real_field", Kokkos::RangePolicy<ExecutionSpace>(0, static_cast<int>(field.extent(0))),
                       FillRealField{field, value});
}

/// The first numbers of a field on the host.
std::vector<double> on_host(RealField const& field, std::size_t size);
/// Sets the first numbers of a field.
void set_from_host(RealField const& field, std::vector<double> const& values);

// Lanes of a field in double precision, whatever it is kept in.
KOKKOS_FORCEINLINE_FUNCTION Lanes load(RealField const& field, std::size_t i) {
  if (field.format().storage == Storage::as_double) return load(field.data<double>() + i);
  if (field.format().storage == Storage::as_float && !field.is_column()) {
    Lanes const value = load_float(field.data<float>() + i);
    return select(value == Lanes(no_bond_single), Lanes(no_bond), value);
  }
  Lanes value(0);
  for (int l = 0; l < lane_count; ++l) set_lane(value, l, field(i + static_cast<std::size_t>(l)));
  return value;
}
KOKKOS_FORCEINLINE_FUNCTION Lanes gather(RealField const& field, int const* index) {
  if (field.format().storage == Storage::as_double) return gather(field.data<double>(), index);
  Lanes value(0);
  if (field.format().storage == Storage::as_float) {
    for (int l = 0; l < lane_count; ++l) set_lane(value, l, field.of_single(index[l]));
    return value;
  }
  for (int l = 0; l < lane_count; ++l) set_lane(value, l, field(index[l]));
  return value;
}

}  // namespace clathra
