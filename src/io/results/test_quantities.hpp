#pragma once
/// The quantities that claims are about, from the members of a study: what there is, in which units, and their numbers.
#include <filesystem>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "domain/measurement/claims.hpp"
#include "io/results/run_results.hpp"
#include "io/results/study_results.hpp"

namespace clathra {

/// What a quantity is taken from: the history of a test, its snapshots, or the envelope of a material.
enum class QuantityOf { history, snapshots, material };

struct Quantity {
  std::string_view name, unit;  ///< unit: that of its numbers, "Pa", "degrees", "d50" or none
  QuantityOf of;
  bool at_strain;  ///< there is one at each axial strain
};
std::span<Quantity const> quantities();

/// What a number is multiplied by to be shown in a unit; nothing where the quantity has no such unit.
std::optional<double> factor_to(std::string_view unit, Quantity const& quantity);
/// "Pa, kPa, MPa"
std::string units_of(Quantity const& quantity);

/// "q_share_at_6.71": under this name numbers are kept. @param strain  ignored where the quantity is not one of a strain
std::string number_name(Quantity const& quantity, double strain);

/// Numbers of tests by group or material, name and seed.
class TestQuantities {
 public:
  void add(std::string const& group, std::uint64_t seed, std::map<std::string, double> const& numbers);
  SeedNumbers const& of(std::string const& group, std::string const& name) const;  ///< empty where there are none

 private:
  std::map<std::string, std::map<std::string, SeedNumbers>> numbers_;
};

/// What a history says. @param strains  axial ones, at which something is looked at
std::map<std::string, double> numbers_of_history(HistoryTable const& history, std::vector<double> const& strains);

/// Whether a snapshot taken at one strain is the one wanted.
bool is_near(double strain, double wanted);

/// Numbers of the finished members: of their histories, of the snapshots where they have some, and of the envelopes of each seed.
/// @param folders  of the members' runs  @throws FileProblem
TestQuantities quantities_of_members(Study const& study, std::vector<MemberResult> const& members,
                                     std::vector<std::filesystem::path> const& folders, std::vector<double> const& strains);

}  // namespace clathra
