// The lake's shore: the lake at rest, its shoreline, and the run-up along it. 3-D runs only.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "files/run_file.hh"

namespace lgiw {

/// Per node of the map: 1 in the lake at rest (wet at the first time, or below still water level and connected with
/// that).
std::vector<uint8_t> lake_at_rest(const RunHeader& header, const std::vector<float>& first_water);

/// The still-water shoreline as polylines (local x, y): where the ground meets the still water level.
std::vector<std::vector<std::array<double, 2>>> shorelines(const RunHeader& header, const std::vector<uint8_t>& lake);

struct ShorePoint {
  double x = 0, y = 0;         // local
  double distance = 0;         // m along its line
  double runup_elevation = 0;  // local z; NaN where no water was measured near it
  double runup = 0;            // m above still water level
};

/// Maximum run-up at every point of the shorelines. The limit of inundation is made of the nodes that were wet with a
/// neighbour that never was; each counts for the point of the shore nearest to it with the highest surface there,
/// carried level to the dry neighbour unless that lies more than dp below it (then: with its own ground), and at least
/// still level. Neighbours that stay dry since they are full of soil, their ground more than dp below still level, are
/// no land. Shore points without such a node take the value of the node nearest to them, so that the line is
/// continuous. max_elevation [ny,nx]: highest water surface, local z, NaN where never wet.
std::vector<std::vector<ShorePoint>> shore_runup(const RunHeader& header,
                                                 const std::vector<std::vector<std::array<double, 2>>>& lines,
                                                 const std::vector<float>& max_elevation);

/// Hazard by the largest wave height above still water level in the lake, by the largest flow depth on land: 0 none,
/// 1 below 1 m, 2 from 1 m to 3 m, 3 above 3 m.
std::vector<uint8_t> hazard_classes(const RunHeader& header, const std::vector<uint8_t>& lake,
                                    const std::vector<float>& max_elevation, const std::vector<float>& max_depth);

}  // namespace lgiw
