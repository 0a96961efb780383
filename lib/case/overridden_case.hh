// Reading a case with values whose places are known: of --set, or of a sweep's file.
#pragma once

#include "case/case.hh"
#include "case/yaml_document.hh"

namespace lgiw {

/// parse_case() with overrides that tell where they stand.
Case parse_overridden_case(const std::string& text, const std::string& name_for_messages,
                           const std::vector<Override>& overrides);

/// The text at `path`, "-" for stdin. Throws InputError where there is none; `what` is what was wanted.
std::string read_case_text(const std::string& path, const std::string& what);

}  // namespace lgiw
