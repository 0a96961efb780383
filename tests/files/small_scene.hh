// A particles file of five particles.
#pragma once

#include <cmath>
#include <string>

#include "files/particle_file.hh"

namespace lgiw {

/// 2 of water, 1 of soil, 2 of wall in a box 10 m long, 5 m wide, 4 m high.
inline ParticleHeader small_header() {
  ParticleHeader header;
  header.dp = 0.5;
  header.origin = {400000.25, 3800000.5, 700};
  header.crs_wkt = "PROJCRS[\"WGS 84 / UTM zone 11N\"]";
  header.vertical_datum = "EGM96";
  header.attribution = "Office, CC BY 4.0";
  header.still_water_level = 2.25;
  header.low = {0, 0, 0};
  header.high = {10, 5, 4};
  header.sides = {Side::wall, Side::absorbing, Side::open, Side::wall};
  header.absorbing_width = 1.5;
  header.bed = {3, 2, -1, -0.5, 6, {0.1, 0.2, NAN, 0.4, 0.5, 0.6}};
  header.ground = {3, 2, -1, -0.5, 6, {1, 2, NAN, 4, 5, 6}};
  header.case_text = "name: Gro\xC3\x9F\n";
  header.provenance = "{}";
  header.counts = {2, 1, 2, 17};
  return header;
}

inline ParticleBlock small_water() {
  return {Phase::water, {0, 0, 0, 10, 5, 4}, {0.125f, 0.25f}, {1000, 1001}, {9810, 0}, {}, {}, {}};
}
inline ParticleBlock small_soil() {
  return {Phase::soil, {1, 2, 3}, {0.5f}, {2000}, {5}, {-1, -2, -3, 0.5f, 0.25f, 0}, {}, {}};
}
inline ParticleBlock small_wall() {
  return {Phase::wall, {1, 1, -0.5, -0.5, 2, 1}, {0.125f, 0.125f}, {1000, 1000}, {0, 1}, {}, {0, 0, 1, 0.6f, 0, 0.8f},
          {0, 1}};
}

inline void write_small_particles(const std::string& path) {
  ParticleWriter writer(path, small_header());
  writer.append(small_water());
  writer.append(small_soil());
  writer.append(small_wall());
  writer.finish();
}

}  // namespace lgiw
