#pragma once
/// What became of the claims of a paper, as a page of text and as JSON.
#include <map>
#include <string>
#include <vector>

#include "domain/measurement/claims.hpp"

namespace clathra {

struct Scorecard {
  std::string title;
  std::map<std::string, std::string> facts;  ///< "particles": "20000", ...: what was run
  std::vector<Claim> claims;
};

/// Markdown: a line for each claim, then a table of its numbers with their 95 % intervals and bounds.
std::string scorecard_markdown(Scorecard const& card);
/// The same for programs: claims with verdict and parts; numbers are null where there are none.
std::string scorecard_json(Scorecard const& card);
/// "3 pass, 1 partial, 2 fail, 11 undetermined"
std::string tally(std::vector<Claim> const& claims);
/// "Stated in section 5.1, Fig. 11.", "Ours, after section 5.1."; empty where nothing is known of it
std::string source_text(Claim const& claim);
/// "0.31 ± 0.05", "0.31" of one seed, a dash without numbers
std::string mean_text(ClaimPart const& part);
/// ">= 0", "<= 0.85", "1.5 to 2.5"
std::string bounds_text(ClaimPart const& part);

}  // namespace clathra
