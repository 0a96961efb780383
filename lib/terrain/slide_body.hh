// The slide: from the ground and a failure surface to the soil between. Internal to lib/terrain.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "base/provenance.hh"
#include "case/case.hh"
#include "files/height_field.hh"
#include "terrain/gdal_support.hh"

namespace lgiw::detail {

struct SlideBody {
  std::vector<double> bed;    // [ny,nx] min(ground, failure surface) in the slide, ground elsewhere
  std::vector<uint8_t> mask;  // [ny,nx]
  double volume = 0;          // m3: sum of thickness times cell area
};

/// The slide of `c` under `ground` (case coordinates). Throws InputError for rasters and polygons that cannot be read,
/// lie outside the domain or reach across its edge, for a failure surface above the ground, and for an empty slide.
SlideBody make_slide(const Case& c, const HeightField& ground, const OGRSpatialReference& crs, Provenance& provenance,
                     std::vector<std::string>& notes);

/// Failure surface by the sloping local base level: Jaboyedoff et al. 2004 (Toward preliminary hazard assessment using
/// DEM topographic analysis and simple mechanical modeling by means of the sloping local base level, in Landslides:
/// Evaluation and Stabilization, Balkema, 191-197), 2009 (Geomorphology 103, 5-16), 2019 (Earth Surf. Dynam. 7,
/// 439-458).
///
/// In the slide, a cell that lies higher than z_temp = mean of its 4 or 8 neighbours - C is lowered to z_temp, over and
/// over, until nothing moves; cells outside keep the ground. The surface so found is the highest one that is nowhere
/// above the ground and nowhere above z_temp; it is computed here by projected successive over-relaxation, which has
/// the same limit and needs the square root of the number of sweeps. The tolerance C (m per cell of this grid, > 0
/// deepens) sets the curvature: on a plane, a strip of length L gives the parabola of depth 2 C s (L - s) / dx2 with 4
/// neighbours (8 neighbours: 4/3 C s (L - s) / dx2), s along the slope. Limits, where > 0: max_depth, below the ground
/// (m); max_slope (degrees), the steepest angle at which the surface may be seen from the ground around the slide,
/// which keeps a deep slide's back scarp from being undercut.
///
/// `ground` [ny,nx] m, `inside` [ny,nx], none of them on the outermost ring. Returns the surface, equal to the ground
/// outside. Throws WorkError when it does not converge.
std::vector<double> sloping_local_base_level(const HeightField& ground, const std::vector<uint8_t>& inside,
                                             const SlideSurface::Slbl& parameters, double tolerance);

/// The tolerance for `tolerance: 0`. An elliptic slide of length L (along the mean slope) and width B on a plane has
/// its greatest depth e where C = e dx2 m (1/L2 + 1/B2), m = 2 with 4 neighbours, 3 with 8. e is max_depth where given,
/// or 0.1 L, a usual depth of translational to shallow rotational slides.
double automatic_tolerance(const HeightField& ground, const std::vector<uint8_t>& inside,
                           const SlideSurface::Slbl& parameters);

}  // namespace lgiw::detail
