/// Says so, instead of dying with SIGILL, where the program was compiled for another processor. Compiled for any processor, and
/// run before the constructors of all others.
#include <unistd.h>

#include <cstring>

extern "C" char const clathra_built_for[];  ///< "avx avx2 ", each followed by a blank

namespace {

constexpr int refused = 77;

/// Whether this processor has an extension. One that is not known here it does not have.
bool has(char const* name, std::size_t length) {
#define CLATHRA_EXTENSION(text) \
  if (length == sizeof(text) - 1 && std::memcmp(name, text, length) == 0) return __builtin_cpu_supports(text) != 0
  CLATHRA_EXTENSION("sse4.2");
  CLATHRA_EXTENSION("popcnt");
  CLATHRA_EXTENSION("avx");
  CLATHRA_EXTENSION("avx2");
  CLATHRA_EXTENSION("fma");
  CLATHRA_EXTENSION("bmi");
  CLATHRA_EXTENSION("bmi2");
  CLATHRA_EXTENSION("avx512f");
  CLATHRA_EXTENSION("avx512vl");
  CLATHRA_EXTENSION("avx512bw");
  CLATHRA_EXTENSION("avx512dq");
  CLATHRA_EXTENSION("avx512cd");
  CLATHRA_EXTENSION("avx512vbmi");
  CLATHRA_EXTENSION("avx512vnni");
  CLATHRA_EXTENSION("avx512vpopcntdq");
#undef CLATHRA_EXTENSION
  return false;
}

void say(char const* text, std::size_t length) { (void)!::write(STDERR_FILENO, text, length); }

__attribute__((constructor(101))) void check_processor() {
  __builtin_cpu_init();
  for (char const* name = clathra_built_for; *name != '\0';) {
    std::size_t const length = std::strcspn(name, " ");
    if (!has(name, length)) {
      constexpr char before[] = "clathra: this program was built for a processor with ",
                     after[] =
                         ", which this one lacks: build it on the kind of machine that runs it, or with -DCLATHRA_NATIVE=OFF\n";
      say(before, sizeof before - 1);
      say(name, length);
      say(after, sizeof after - 1);
      ::_exit(refused);
    }
    name += length + (name[length] == ' ' ? 1 : 0);
  }
}

}  // namespace
