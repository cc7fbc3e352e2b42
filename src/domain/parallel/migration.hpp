#pragma once
/// Discs that crossed a cut change their owner.
#include "domain/parallel/decomposition.hpp"
#include "domain/parallel/disc_packing.hpp"

namespace clathra {

/// Gives the discs that lie in other ranks' rectangles to these, with their rows and auxiliary fields, and takes those that came.
/// The discs that stay keep their order; those that came stand behind them.
/// @param old_row  [owned] the row of each disc in `old`; brought up to date
void migrate(Ranks const& ranks, Decomposition const& decomposition, ParticleSoA& particles, AuxiliaryFields const& auxiliary,
             OldRows& old, Field<int>& old_row, Scratch& scratch);

}  // namespace clathra
