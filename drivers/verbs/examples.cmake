# Turns the scenes of a folder into the source of examples(): cmake -DEXAMPLES=<folder> -DOUTPUT=<file> -P examples.cmake
file(GLOB_RECURSE scenes RELATIVE ${EXAMPLES} ${EXAMPLES}/*.toml)
list(FILTER scenes EXCLUDE REGEX "^studies/") # no scenes
list(SORT scenes)
set(source "// Made by drivers/verbs/examples.cmake.\n#include \"verbs/examples.hpp\"\n\nnamespace clathra {\n\nstd::span<Example const> examples() {\n  static constexpr Example all[] = {\n")
foreach(scene ${scenes})
  string(REGEX REPLACE "\\.toml$" "" name ${scene})
  file(READ ${EXAMPLES}/${scene} text)
  string(APPEND source "      {\"${name}\", R\"scene(${text})scene\"},\n")
endforeach()
string(APPEND source "  };\n  return all;\n}\n\n}  // namespace clathra\n")
file(WRITE ${OUTPUT} "${source}")
