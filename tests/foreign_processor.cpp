/// A program that was compiled for a processor that nobody has; the check of drivers/processor ends it before main().
extern "C" char const clathra_built_for[];
char const clathra_built_for[] = "sse4.2 made-up ";

int main() { return 0; }
