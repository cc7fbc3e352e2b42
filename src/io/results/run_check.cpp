#include "io/results/run_check.hpp"

#include <nlohmann/json.hpp>

#include "io/errors/problems.hpp"
#include "io/formats/digest.hpp"
#include "io/formats/text_file.hpp"
#include "io/results/output_folder.hpp"
#include "io/results/run_record.hpp"
#include "io/results/snapshot_file.hpp"

namespace clathra {

namespace fs = std::filesystem;

std::map<std::string, std::string> result_digests(fs::path const& run_folder) {
  std::map<std::string, std::string> digests;
  std::error_code error;
  for (std::string_view const name : result_files())
    if (name != "run.json" && name != "report.html" && fs::is_regular_file(run_folder / name, error))
      digests.emplace(name, file_digest(run_folder / name));
  for (fs::path const& file : snapshot_files(run_folder)) digests["snap/" + file.filename().string()] = file_digest(file);
  return digests;
}

std::vector<FileCheck> check_run(fs::path const& run_folder) {
  fs::path const record = run_folder / "run.json";
  std::map<std::string, std::string> expected;
  try {
    nlohmann::json const json = nlohmann::json::parse(read_text_file(record, largest_run_record));
    if (!json.contains("result_digests_xxh3_128")) {
      std::string const reason = json.at("exit").at("reason");
      throw FileProblem(ExitCode::bad_input, record,
                        "is not of a finished run (" + reason + "), there is nothing to compare with");
    }
    expected = json.at("result_digests_xxh3_128").get<std::map<std::string, std::string>>();
  } catch (nlohmann::json::exception const& problem) {
    throw FileProblem(ExitCode::bad_input, record, std::string("is not a record of a run: ") + problem.what());
  }
  std::vector<FileCheck> checks;
  for (auto const& [name, digest] : expected) {
    FileCheck check{name, ""};
    try {
      if (std::string const now = file_digest(run_folder / name); now != digest)
        check.problem = "has changed: " + now + " instead of " + digest;
    } catch (FileProblem const& problem) {
      check.problem = problem.what();
    }
    checks.push_back(check);
  }
  return checks;
}

}  // namespace clathra
