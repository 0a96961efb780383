#include "terrain/slide_body.hh"

#include <gdal_alg.h>
#include <ogrsf_frmts.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <numbers>

#include "base/error.hh"
#include "terrain/raster_source.hh"

namespace lgiw::detail {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double degree = std::numbers::pi / 180;

using Geometry = std::unique_ptr<OGRGeometry>;

/// Everything that makes a slide, gathered while reading, for messages and notes.
struct Reader {
  const Case& c;
  const HeightField& ground;
  const OGRSpatialReference& crs;
  Provenance& provenance;
  std::vector<std::string>& notes;

  std::vector<double> raster(const std::string& file, const char* key, double void_value) const {
    RasterSource source(c.resolve(file), at_key(c, text("slide.%s", key)) + text("slide.%s '%s'", key, file.c_str()),
                        provenance);
    if (source.place(crs)) notes.push_back(source.what() + " names no CRS: taken to be in the case's");
    const Extent& e = source.extent();
    LGIW_VALIDATE(
        e[2] > ground.x0 && e[0] < ground.x_max() && e[3] > ground.y0 && e[1] < ground.y_max(),
        source.what() + ": lies outside the domain",
        "it covers " + describe(e) + "; the domain " + describe({ground.x0, ground.y0, ground.x_max(), ground.y_max()}),
        "check its CRS and terrain.window");
    return source.sample(RasterGrid(ground), 0, false, nullptr, void_value);
  }

  std::vector<Geometry> polygons() const {
    std::vector<Geometry> result;
    if (!c.slide.polygon.empty()) {
      auto ring = std::make_unique<OGRLinearRing>();
      for (const auto& [x, y] : c.slide.polygon) ring->addPoint(x, y);
      ring->closeRings();
      auto polygon = std::make_unique<OGRPolygon>();
      polygon->addRingDirectly(ring.release());
      LGIW_VALIDATE(c.slide.polygon.size() >= 3, at_key(c, "slide.polygon") + "slide.polygon has no area",
                    text("it has %zu points", c.slide.polygon.size()), "name at least three corners of the slide");
      LGIW_VALIDATE(polygon->IsValid(), at_key(c, "slide.polygon") + "slide.polygon crosses itself",
                    QuietGdal::message(), "name its corners in order around the slide");
      result.push_back(std::move(polygon));
    } else if (!c.slide.polygon_file.empty()) {
      read_polygon_file(result);
    }
    return result;
  }

  void read_polygon_file(std::vector<Geometry>& result) const {
    const std::string what = at_key(c, "slide.polygon_file") + "slide.polygon_file '" + c.slide.polygon_file + "'",
                      path = c.resolve(c.slide.polygon_file);
    GDALDatasetUniquePtr data(
        GDALDataset::Open(path.c_str(), GDAL_OF_VECTOR | GDAL_OF_READONLY | GDAL_OF_VERBOSE_ERROR));
    LGIW_VALIDATE(data, what + ": cannot be read as vectors", QuietGdal::message(),
                  "name a file that ogrinfo understands");
    provenance.add_input(path);
    for (OGRLayer* layer : data->GetLayers()) {
      OGRSpatialReference own = layer->GetSpatialRef() ? *layer->GetSpatialRef() : crs;
      if (!layer->GetSpatialRef()) notes.push_back(what + " names no CRS: taken to be in the case's");
      own.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
      std::unique_ptr<OGRCoordinateTransformation> forward(OGRCreateCoordinateTransformation(&own, &crs));
      for (const auto& feature : *layer) {
        Geometry geometry(feature->StealGeometry());
        if (!geometry || geometry->IsEmpty() || geometry->getDimension() != 2) continue;
        geometry->flattenTo2D();
        LGIW_VALIDATE(forward && geometry->transform(forward.get()) == OGRERR_NONE,
                      what + ": cannot be brought into the case's CRS", QuietGdal::message(),
                      "check its CRS and terrain.crs");
        LGIW_VALIDATE(geometry->IsValid(), what + ": holds a polygon that crosses itself", QuietGdal::message(),
                      "repair it, e.g. with ogr2ogr -makevalid");
        result.push_back(std::move(geometry));
      }
    }
    LGIW_VALIDATE(!result.empty(), what + ": holds no polygon", "the slide's outline is needed",
                  "draw the outline as a polygon");
  }

  /// Cells whose centre lies in a polygon; all cells when the slide has none.
  std::vector<uint8_t> inside(const std::vector<Geometry>& polygons) const {
    if (polygons.empty()) return std::vector<uint8_t>(ground.z.size(), 1);
    OGREnvelope all;
    std::vector<OGRGeometryH> handles;
    for (const Geometry& polygon : polygons) {
      OGREnvelope one;
      polygon->getEnvelope(&one);
      all.Merge(one);
      handles.push_back(OGRGeometry::ToHandle(polygon.get()));
    }
    const std::string extents = "it covers " + describe({all.MinX, all.MinY, all.MaxX, all.MaxY}) + "; the domain " +
                                describe({ground.x0, ground.y0, ground.x_max(), ground.y_max()});
    LGIW_VALIDATE(
        all.MaxX > ground.x0 && all.MinX < ground.x_max() && all.MaxY > ground.y0 && all.MinY < ground.y_max(),
        at_key(c, "slide") + "the slide's polygon lies outside the domain", extents,
        "move it or enlarge terrain.window");
    LGIW_VALIDATE(
        all.MinX > ground.x0 && all.MaxX < ground.x_max() && all.MinY > ground.y0 && all.MaxY < ground.y_max(),
        at_key(c, "slide") + "the slide's polygon reaches across the edge of the domain", extents,
        "cut it or enlarge terrain.window");
    const GDALDatasetUniquePtr mask = memory_raster(RasterGrid(ground), GDT_Byte, nullptr, "");
    int band = 1;
    std::vector<double> burn(handles.size(), 1);
    if (GDALRasterizeGeometries(GDALDataset::ToHandle(mask.get()), 1, &band, int(handles.size()), handles.data(),
                                nullptr, nullptr, burn.data(), nullptr, nullptr, nullptr) != CE_None)
      throw WorkError("cannot draw the slide's polygon", QuietGdal::message(), "simplify it");
    std::vector<uint8_t> result = read_north_up<uint8_t>(*mask, RasterGrid(ground), GDT_Byte);
    LGIW_VALIDATE(std::find(result.begin(), result.end(), 1) != result.end(),
                  at_key(c, "slide") + "the slide's polygon contains no terrain node",
                  text("the nodes are %g m apart", ground.dx), "enlarge it or use a finer terrain source");
    return result;
  }

  /// Elevation of the failure surface, NaN where it says nothing; `what` describes it for messages.
  std::vector<double> failure_surface(const std::vector<uint8_t>& inside_polygon, std::string& what) const {
    const SlideSurface& surface = c.slide.surface;
    std::vector<double> z(ground.z.size(), nan);
    if (!surface.before.empty()) {
      what = "slide.after";
      const std::vector<double> before = raster(surface.before, "before", nan),
                                after = raster(surface.after, "after", nan);
      // The ground may come from another survey: the change counts, not the level. Deposits (after > before) are no
      // slide.
      for (std::size_t k = 0; k < z.size(); ++k)
        if (before[k] > after[k]) z[k] = ground.z[k] - (before[k] - after[k]);
    } else if (!surface.thickness.empty()) {
      what = "slide.thickness";
      const std::vector<double> thickness = raster(surface.thickness, "thickness", 0);
      for (std::size_t k = 0; k < z.size(); ++k) {
        LGIW_VALIDATE(!(std::abs(thickness[k]) > 2000),
                      at_key(c, "slide.thickness") + text("slide.thickness has %g m", thickness[k]),
                      "no slide is thicker than 2000 m; this looks like no-data that is not declared",
                      text("declare it, e.g. with gdal_edit.py -a_nodata %g", thickness[k]));
        z[k] = ground.z[k] - std::abs(thickness[k]);
      }
    } else if (!surface.failure_surface.empty()) {
      what = "slide.failure_surface";
      z = raster(surface.failure_surface, "failure_surface", nan);
    } else if (surface.depth) {
      what = "slide.depth";
      for (std::size_t k = 0; k < z.size(); ++k) z[k] = ground.z[k] - *surface.depth;
    } else if (surface.plane) {
      what = "slide.plane";
      const SlideSurface::Plane& plane = *surface.plane;
      const double east = std::sin(plane.dip_direction * degree), north = std::cos(plane.dip_direction * degree);
      const double fall = std::tan(plane.dip * degree);
      for (std::size_t k = 0; k < z.size(); ++k) {
        const double x = ground.x0 + double(k % ground.nx) * ground.dx,
                     y = ground.y0 + double(k / ground.nx) * ground.dx;
        z[k] = plane.z - fall * ((x - plane.x) * east + (y - plane.y) * north);
      }
    } else if (surface.base_elevation) {
      what = "slide.base_elevation";
      std::fill(z.begin(), z.end(), *surface.base_elevation);
    } else if (surface.slbl) {
      what = "slide.slbl";
      const double tolerance = surface.slbl->tolerance != 0
                                   ? surface.slbl->tolerance
                                   : automatic_tolerance(ground, inside_polygon, *surface.slbl);
      if (surface.slbl->tolerance == 0)
        notes.push_back(text("slide.slbl.tolerance: automatic, %.4g m per cell of %g m", tolerance, ground.dx));
      z = sloping_local_base_level(ground, inside_polygon, *surface.slbl, tolerance);
    } else {
      throw InputError(at_key(c, "slide") + "the slide has no failure surface", "slide names none",
                       "give slide one of thickness, before and after, failure_surface, depth, plane, "
                       "base_elevation, slbl");
    }
    return z;
  }
};

}  // namespace

SlideBody make_slide(const Case& c, const HeightField& ground, const OGRSpatialReference& crs, Provenance& provenance,
                     std::vector<std::string>& notes) {
  const Reader reader{c, ground, crs, provenance, notes};
  const std::vector<Geometry> polygons = reader.polygons();
  const SlideSurface& surface = c.slide.surface;
  const bool outlined = !surface.before.empty() || !surface.thickness.empty() || !surface.failure_surface.empty();
  LGIW_VALIDATE(!polygons.empty() || outlined, at_key(c, "slide") + "the slide has no outline",
                "only rasters of the slide tell where it ends", "give slide.polygon or slide.polygon_file");
  const std::vector<uint8_t> inside = reader.inside(polygons);
  std::string what;
  const std::vector<double> failure = reader.failure_surface(inside, what);

  SlideBody body;
  body.bed = ground.z;
  body.mask.assign(ground.z.size(), 0);
  const double cell = ground.dx * ground.dx,  // Rigid bodies are not made of whole particles.
      thinnest = c.slide.min_thickness > 0 ? c.slide.min_thickness : (c.slide.motion ? 0.05 : 0.5) * c.dp;
  double thickest = -HUGE_VAL, thin_volume = 0;
  int64_t thin_cells = 0;
  for (std::size_t k = 0; k < ground.z.size(); ++k) {
    if (!inside[k] || std::isnan(failure[k])) continue;
    const double thickness = ground.z[k] - failure[k];
    thickest = std::max(thickest, thickness);
    if (thickness <= 0) continue;
    if (thickness < thinnest) {
      ++thin_cells, thin_volume += thickness * cell;
      continue;
    }
    body.bed[k] = failure[k];
    body.mask[k] = 1;
    body.volume += thickness * cell;
  }
  LGIW_VALIDATE(thickest > -HUGE_VAL, at_key(c, what) + what + " says nothing inside the slide's polygon",
                "the raster has only no-data there", "check its extent and CRS, or move the polygon");
  LGIW_VALIDATE(thickest > 0,
                at_key(c, "slide") + "the slide is empty: the failure surface lies above the ground everywhere",
                text("%s comes no nearer than %g m below the ground", what.c_str(), thickest),
                "lower the failure surface or move the polygon");
  LGIW_VALIDATE(body.volume > 0, at_key(c, "slide") + "the slide is empty: it is too thin to be filled with particles",
                text("at most %g m, and slide.min_thickness is %g m", thickest, thinnest),
                "choose a smaller particle_spacing or slide.min_thickness");
  if (thin_cells > 0)
    notes.push_back(text("slide: %lld cells thinner than %g m left out (%g m3)", static_cast<long long>(thin_cells),
                         thinnest, thin_volume));
  for (std::size_t k = 0; k < body.mask.size(); ++k) {
    const std::size_t i = k % ground.nx, j = k / ground.nx;
    const bool edge = i == 0 || j == 0 || i + 1 == ground.nx || j + 1 == ground.ny;
    LGIW_VALIDATE(!edge || !body.mask[k], at_key(c, "slide") + "the slide reaches the edge of the domain",
                  text("at %.8g, %.8g, where it would be cut off", ground.x0 + double(i) * ground.dx,
                       ground.y0 + double(j) * ground.dx),
                  "enlarge terrain.window or cut the slide with slide.polygon");
  }
  return body;
}

}  // namespace lgiw::detail
