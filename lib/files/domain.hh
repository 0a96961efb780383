// What lies in the domain of a scene, which is known once its terrain is.
#pragma once

#include <string>
#include <vector>

#include "case/case.hh"
#include "files/particle_file.hh"

namespace lgiw {

/// Whether (x, y) of the case's CRS lies in the run's domain; in 2-D only x counts.
bool inside_domain(const ParticleHeader& header, double x, double y);
/// The domain in the case's CRS, for messages: "x from 0 to 100 and y from 0 to 50".
std::string domain_text(const ParticleHeader& header);
/// Throws InputError when a gauge or a point of a section lies outside the run's domain.
void check_inside(const ParticleHeader& header, const std::vector<Gauge>& gauges, const std::vector<Section>& sections);

}  // namespace lgiw
