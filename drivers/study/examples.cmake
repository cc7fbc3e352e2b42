# Turns the scenes and studies of a folder and a paper into the source of examples() and built_in_paper():
# cmake -DEXAMPLES=<folder> -DPAPER=<file> -DOUTPUT=<file> -P examples.cmake
file(GLOB_RECURSE scenes RELATIVE ${EXAMPLES} ${EXAMPLES}/*.toml)
list(FILTER scenes EXCLUDE REGEX "^papers/")
list(SORT scenes)
set(source "// Made by drivers/study/examples.cmake.\n#include \"study/examples.hpp\"\n\nnamespace clathra {\n\nstd::span<Example const> examples() {\n  static constexpr Example all[] = {\n")
foreach(scene ${scenes})
  string(REGEX REPLACE "\\.toml$" "" name ${scene})
  file(READ ${EXAMPLES}/${scene} text)
  string(APPEND source "      {\"${name}\", R\"scene(${text})scene\"},\n")
endforeach()
string(APPEND source "  };\n  return all;\n}\n\nstd::string_view built_in_paper() {\n  return ")
file(READ ${PAPER} text)
# A compiler need not take a literal of more than 64 KiB, and this one has half of that at most.
string(APPEND source "R\"paper(${text})paper\";\n}\n\n}  // namespace clathra\n")
file(WRITE ${OUTPUT} "${source}")
