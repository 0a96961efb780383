// A case file, and behind each byte 1 an override as --set takes it.
#include <cstdio>
#include <cstdlib>
#include <vector>

#include "case/case.hh"
#include "fuzzing.hh"

int LLVMFuzzerTestOneInput(const uint8_t* data, std::size_t size) {
  using namespace lgiw;
  std::vector<std::string> parts(1);
  for (std::size_t k = 0; k < size; ++k) {
    if (data[k] == 1)
      parts.emplace_back();
    else
      parts.back() += char(data[k]);
  }
  const std::vector<std::string> overrides(parts.begin() + 1, parts.end());
  Case c;
  if (!fuzz::accepted([&] { c = parse_case(parts[0], "case.yaml", overrides); })) return 0;
  case_warnings(c);
  // What is stored beside the results is a case as well, and the same one.
  try {
    const Case again = parse_case(c.text, "stored");
    if (again.name != c.name || again.dp != c.dp || again.gauges.size() != c.gauges.size()) std::abort();
  } catch (const InputError& e) {
    std::fprintf(stderr, "the stored case is refused: %s\n", e.what());
    std::abort();
  }
  // Names become names of files.
  for (const Gauge& gauge : c.gauges)
    if (gauge.name.find('/') != std::string::npos || gauge.name[0] == '.') std::abort();
  for (const Section& section : c.sections)
    if (section.name.find('/') != std::string::npos || section.name[0] == '.') std::abort();
  if (c.name.find('/') != std::string::npos || c.name[0] == '.') std::abort();
  return 0;
}
