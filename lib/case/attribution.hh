// Whose data a case is made of.
#pragma once

#include <string>

namespace lgiw {

/// Who is to be named wherever anything made from the terrain is published: terrain.sources[].attribution of a case's
/// text, each once and in their order, with "; " between them; "" where the case names nobody.
std::string terrain_attribution(const std::string& case_text);

}  // namespace lgiw
