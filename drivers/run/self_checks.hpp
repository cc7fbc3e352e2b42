#pragma once
/// The checks of `clathra selftest`. Each returns what it found, in a few words for the user.
#include <cstdint>
#include <stdexcept>
#include <string>

namespace clathra {

/// What a check found wrong.
struct CheckFailed : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Strength and stiffness of bonds at three saturations against numbers computed once apart from this code. @throws CheckFailed
std::string check_bond_law();

/// Two equal discs meet head on: largest overlap v sqrt(m_eff / k_n), contact time pi sqrt(m_eff / k_n), no speed lost. Kokkos
/// must have been started. @throws CheckFailed
std::string check_collision();

/// A specimen is written to a temporary folder and read again, bit for bit. @throws CheckFailed, FileProblem
std::string check_specimen_file();

/// Bonds 400 discs and shears them until bonds break. Kokkos must have been started.
/// @return the state hash; @throws CheckFailed where no bonds broke
std::uint64_t bonded_state_hash();

}  // namespace clathra
