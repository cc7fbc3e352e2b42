/// `clathra schema`: the keys of a scene file.
#include <memory>

#include "io/scene/scene_reference.hpp"
#include "terminal/print.hpp"
#include "verbs/verbs.hpp"

namespace clathra {

void add_schema(CLI::App& program, Verb& chosen) {
  auto const json = std::make_shared<bool>(false);
  CLI::App* const verb = program.add_subcommand("schema", "Print the reference of all keys of a scene file");
  verb->add_flag("--json", *json, "as a JSON Schema, for editors, instead of Markdown");
  verb->footer("Example: clathra schema --json > clathra.schema.json");
  verb->callback([json, &chosen] { chosen = [json] { return print_result(*json ? schema_json() : schema_markdown()); }; });
}

}  // namespace clathra
