// Whose data a case is made of.
#pragma once

#include <string>

#include "case/case.hh"

namespace lgiw {

/// Who is to be named wherever anything made from the terrain is published: the attributions of its sources, each once
/// and in their order, with "; " between them; "" where the case names nobody.
std::string terrain_attribution(const Terrain& terrain);

}  // namespace lgiw
