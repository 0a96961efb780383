// Which cells a reservoir covers. Internal to lib/terrain.
#pragma once

#include <cstdint>
#include <vector>

#include "case/case.hh"
#include "files/height_field.hh"

namespace lgiw::detail {

struct Reservoir {
  std::vector<uint8_t> wet;  // [ny,nx]
  double area = 0;           // m2
  double volume = 0;         // m3: sum of (level - z) over the wet cells times their area
  double max_depth = 0;      // m
};

/// Fills `ground` (case coordinates; cells around the nodes) from `water.seed` up to
/// `water.level`: the cells below the
/// level that are 4-connected to the seed's cell. The edge of the grid acts as a wall. Throws InputError for a seed
/// outside or on dry land, a level below or above all terrain, and a reservoir that reaches a side that is open.
Reservoir fill_reservoir(const HeightField& ground, const Case& c);

/// Nodes with `allowed` != 0 that are connected to a node with `seeds` != 0 (itself allowed or not) over `neighbours`
/// (4 or 8) others.
std::vector<uint8_t> connected_to(const std::vector<uint8_t>& seeds, const std::vector<uint8_t>& allowed,
                                  std::size_t nx, std::size_t ny, int neighbours);

}  // namespace lgiw::detail
