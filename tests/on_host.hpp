#pragma once
/// What a simulation keeps in the memory of its kernels, copied to where a test can read it. It does not follow later steps.
#include <vector>

#include "domain/simulation/simulation.hpp"

namespace clathra {

template <class T>
class HostField {
 public:
  explicit HostField(Field<T> const& field) {
    auto const copy = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), field);
    values_.assign(copy.data(), copy.data() + copy.extent(0));
  }
  explicit HostField(RealField const& field) : values_(on_host(field, field.extent(0))) {}
  template <class Index>
  T operator()(Index i) const {
    return values_.at(static_cast<std::size_t>(i));
  }

 private:
  std::vector<T> values_;
};

struct HostDiscs {
  int owned;
  HostField<int> id;
  HostField<double> x, y, radius, reference_x, reference_y, verlet_skin;
  explicit HostDiscs(ParticleSoA const& p)
      : owned(p.owned),
        id(p.id),
        x(p.x),
        y(p.y),
        radius(p.radius),
        reference_x(p.reference_x),
        reference_y(p.reference_y),
        verlet_skin(p.verlet_skin) {}
};

struct HostRows {
  ContactFeatures features;
  HostField<int> slice_start, neighbour;
  HostField<RowLength> length;
  HostField<double> shear, formation_overlap, width;
  explicit HostRows(ContactRows const& rows)
      : features(rows.features),
        slice_start(rows.slice_start),
        neighbour(rows.neighbour),
        length(rows.length),
        shear(rows.shear),
        formation_overlap(rows.formation_overlap),
        width(rows.width) {}
  std::size_t entry(int disc, int k) const { return entry_in(slice_start, features.format, disc, k); }
};

}  // namespace clathra
