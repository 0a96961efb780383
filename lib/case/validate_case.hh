// Combinations of keys that make no case.
#pragma once

#include "case/case.hh"

namespace lgiw {

/// Throws InputError with the place of the key at fault. Every key by itself is sound already.
void validate_case(const Case& c);

/// The first point at which `polygon` (open: the last point is joined to the first) touches or crosses itself, doubles
/// back or repeats a point, as its edge's number; -1 for a simple polygon.
int self_intersection(const std::vector<Point2>& polygon);

}  // namespace lgiw
