// A case as one comparable text.
#pragma once

#include <sstream>
#include <string>

#include "case/case.hh"

namespace lgiw {

/// Every field but text, path and places, in the order of case.hh.
inline std::string case_summary(const Case& c) {
  std::ostringstream out;
  out.precision(17);
  const auto field = [&out](const auto&... values) { (..., (out << values << ' ')), out << '\n'; };
  const auto points = [&](const std::vector<Point2>& list) {
    for (const Point2& p : list) field(p[0], p[1]);
    field("-");
  };
  field(c.name, c.dimension, c.dp, c.gravity[0], c.gravity[1], c.gravity[2]);
  const Terrain& t = c.terrain;
  field(t.crs, t.vertical_datum, t.fill_voids, t.spike_threshold, t.remove_spikes, t.width);
  for (const TerrainSource& s : t.sources) field(s.file, s.blend, s.vertical_shift, s.attribution);
  if (t.window) field((*t.window)[0], (*t.window)[1], (*t.window)[2], (*t.window)[3]);
  points(t.profile);
  field(int(t.west), int(t.east), int(t.south), int(t.north), t.absorbing_width, t.wall_top, t.reach_angle,
        t.runup_allowance);
  const Water& w = c.water;
  field(w.present, w.level, w.density, w.sound_speed, w.viscosity_alpha, w.no_slip, w.density_diffusion);
  if (w.seed) field((*w.seed)[0], (*w.seed)[1]);
  for (const auto& body : w.bodies) points(body);
  if (w.wave)
    field("wave", int(w.wave->kind), w.wave->height, w.wave->crest, w.wave->eastwards, w.wave->amplitude, w.wave->mode);
  const SlideSurface& s = c.slide.surface;
  field(c.slide.present, c.slide.polygon_file, c.slide.min_thickness, s.before, s.after, s.thickness,
        s.failure_surface);
  if (s.depth) field("depth", *s.depth);
  if (s.plane) field("plane", s.plane->x, s.plane->y, s.plane->z, s.plane->dip, s.plane->dip_direction);
  if (s.base_elevation) field("base", *s.base_elevation);
  if (s.slbl) field("slbl", s.slbl->tolerance, s.slbl->max_depth, s.slbl->max_slope, s.slbl->neighbours);
  points(c.slide.polygon);
  for (const auto& body : c.slide.bodies) points(body);
  field(c.slide.velocity[0], c.slide.velocity[1], c.slide.velocity[2]);
  if (const auto& motion = c.slide.motion) {
    field("motion", motion->file, motion->heading);
    if (motion->pivot) field((*motion->pivot)[0], (*motion->pivot)[1], (*motion->pivot)[2]);
  }
  for (const MovingBody& body : c.bodies) {
    field(body.name, body.motion), points(body.outline);
    if (body.pivot) field((*body.pivot)[0], (*body.pivot)[1]);
  }
  const Soil& soil = c.soil;
  field(soil.density, soil.friction_angle, soil.cohesion, soil.dilatancy_angle, soil.young_modulus, soil.poisson_ratio,
        soil.viscosity_alpha, soil.stress_diffusion, soil.artificial_stress, int(soil.cone), int(soil.pore_pressure),
        int(soil.bed), int(soil.sides), soil.bed_friction_angle, int(soil.initial_stress));
  field(soil.rate.present, soil.rate.friction_angle_fast, soil.rate.inertial_number, soil.rate.grain_diameter,
        soil.rate.grain_density);
  field(c.interface.repulsion, c.interface.velocity_factor);
  const Numerics& n = c.numerics;
  field(n.scheme, int(n.kernel), n.h_over_dp, int(n.integrator), n.cfl, n.return_mapping, n.wall_viscosity,
        n.corrected_strain_rate, n.shifting, int(n.precision), n.settle_time, int(n.backend), n.threads);
  const Output& o = c.output;
  field(o.end_time, o.frame_interval, o.surface_interval, o.map_spacing, o.arrival_threshold, o.checkpoint_interval);
  for (const Gauge& g : c.gauges) field(g.name, g.x, g.y, int(g.quantity), g.z);
  for (const Section& section : c.sections) field(section.name), points(section.points);
  field(c.deposit.adps_threshold);
  return out.str();
}

}  // namespace lgiw
