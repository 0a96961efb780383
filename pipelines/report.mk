# One report a run, out/<case>/report.html: a page that needs no other file; and styles for the layers in QGIS.
# Included by the Makefile. What the scene lacks is left out of the report.

report := $(here)/report

# --- Lines and tables that the figures of the report draw ---------------------------------------------------------------
$(work)/%.json: $(work)/%.geojson
	@jq -f $(report)/$*.jq $< > $@

# Read from the styled package, so that nothing reads it while its styles are written.
$(work)/shores.geojson: $(work)/wave.styled
	@ogr2ogr -f GeoJSON /vsistdout/ $(out)/wave.gpkg shore_runup > $@

$(work)/shores.json: $(report)/shores.jq
$(work)/shores.txt: $(work)/shores.json
	@jq -r '.[:8][] | "\(.x) \(.y) \(.shore) \(.runup_m)"' $< > $@

$(work)/shore-runup.txt: $(work)/shores.geojson
	@jq -r '.features | group_by(.properties.shore)[] | (sort_by(.properties.distance_m)[].properties | "\(.shore) \(.distance_m) \(.runup_m // "NaN")"), ""' $< > $@

$(work)/shoreline-at-rest.txt: $(work)/wave.styled $(report)/lines.jq
	@ogr2ogr -f GeoJSON /vsistdout/ $(out)/wave.gpkg shoreline | jq -r --arg shortest 0 -f $(report)/lines.jq > $@

$(work)/inundation.txt: $(work)/wave.styled $(report)/lines.jq
	@ogr2ogr -f GeoJSON /vsistdout/ $(out)/wave.gpkg -dialect sqlite -sql 'SELECT ST_Union(geom) FROM inundation' \
	  | jq -r --arg shortest 0 -f $(report)/lines.jq > $@

# GDAL complains where a raster has no value and so no range.
range = gdalinfo -json -mm $(1) 2> /dev/null
# So many cells of a raster, in m.
cell = $$(gdalinfo -json $(1) | jq '.geoTransform[1] * $(2)')
# Medians of 5 x 5 cells, where no arrival counts as late, smooth the times; isochrones shorter than 12 cells say nothing.
$(work)/arrival-median.tif: $(out)/arrival.tif | $(work)
	@gdalwarp -q -overwrite -srcnodata nan -dstnodata 1e9 $< $(work)/arrival-late.tif
	@gdalwarp -q -overwrite -r med -tr $(call cell,$<,5) $(call cell,$<,5) -srcnodata None -dstnodata None $(work)/arrival-late.tif $@

$(work)/isochrones.geojson: $(work)/arrival-median.tif $(work)/wave.styled
	@gdalwarp -q -overwrite -ot Float32 -r bilinear -tr $(call cell,$(out)/arrival.tif,1) $(call cell,$(out)/arrival.tif,1) -srcnodata 1e9 -dstnodata nan \
	  $< $(work)/arrival-smooth.tif
	@rm -f $(work)/contours.gpkg
	@latest=$$($(call range,$(work)/arrival-smooth.tif) | jq '.bands[0].computedMax // 1'); \
	gdal_contour -q -f GPKG -a value -i $$(jq -n "$$latest / 8 | . as \$$s | pow(10; log10 | floor) as \$$p | [1, 2, 5, 10] | map(select(. * \$$p >= \$$s))[0] * \$$p") \
	  $(work)/arrival-smooth.tif $(work)/contours.gpkg -nln contour
	@ogr2ogr -f GeoJSON -clipsrc $(out)/wave.gpkg -clipsrclayer inundation /vsistdout/ $(work)/contours.gpkg contour > $@

$(work)/isochrones.txt: $(work)/isochrones.geojson $(report)/lines.jq
	@jq -r --arg shortest $(call cell,$(out)/arrival.tif,12) -f $(report)/lines.jq $< > $@

# One label an isochrone, in the middle of its longest line.
$(work)/isochrone-labels.txt: $(work)/isochrones.txt
	@awk 'NF {x[n] = $$1; y[n++] = $$2; v = $$3} !NF && n {if (n > most[v]) {most[v] = n; at[v] = x[int(n / 2)] " " y[int(n / 2)]} n = 0} \
	  END {for (v in at) print at[v], v}' $< | sort > $@

# Rows of x, y, hazard class, zone (1 lake at rest, 2 inundated land) and highest surface.
$(work)/zone.tif: $(out)/hazard.tif $(work)/wave.styled
	@gdal_translate -q -ot Byte -a_nodata none -scale 0 1 0 0 $< $@
	@gdal_rasterize -q -a class -l inundation $(out)/wave.gpkg $@
$(work)/zone.xyz: $(work)/zone.tif
	@gdal_translate -q -of XYZ $< /vsistdout/ | $(rows) > $@
$(work)/zones.xyz: $(work)/hazard.xyz $(work)/zone.xyz $(work)/max_elevation.xyz
	@paste -d ' ' $^ | awk '{print $$1, $$2, $$3, $$6, $$9}' > $@
$(work)/zones.json: $(work)/zones.xyz $(report)/zones.awk
	@awk -v level=$$(jq .still_water_level_m $(out)/gauges.json) -v cell=$$(gdalinfo -json $(out)/hazard.tif | jq '.geoTransform[1] * -.geoTransform[5]') \
	  -f $(report)/zones.awk $< > $@

map_files := $(addprefix $(work)/,ground.xyz hillshade.xyz shoreline-at-rest.txt)
$(addprefix $(out)/,wave-map.png hazard-map.png deposit-map.png): $(here)/figures/ground.gp
$(out)/wave-map.png: $(map_files) $(addprefix $(work)/,max_elevation.xyz inundation.txt isochrones.txt isochrone-labels.txt shores.txt)
$(out)/hazard-map.png: $(map_files) $(addprefix $(work)/,zones.xyz inundation.txt)
$(out)/deposit-map.png: $(map_files) $(work)/thickness.xyz $(filter %/profiles.csv,$(slide_files))
$(out)/shores.png: $(work)/shore-runup.txt
$(out)/energy.png: $(out)/diagnostics.csv

# --- The page -------------------------------------------------------------------------------------------------------------
# HDF5 attributes by GDAL: the text of the case as it was run, the provenance of particles and run.
$(work)/run-attributes.json: $(out)/run.h5 | $(work)
	@gdalinfo -json $< | jq '.metadata[""] | {case_text: .lgiw_Case, vertical_datum: .lgiw_VerticalDatum, attribution: .lgiw_Attribution, crs: .lgiw_CRS, provenance: .lgiw_Provenance}' > $@
$(work)/particles-attributes.json: $(out)/particles.h5 | $(work)
	@gdalinfo -json $< | jq '.metadata[""] | {provenance: .lgiw_Provenance}' > $@
$(work)/plan.json: $(out)/particles.h5 $(lgiw_run) | $(work)
	@$(lgiw_run) $< --dry-run --json -q > $@

report_figures := $(addprefix $(out)/,$(if $(maps),wave-map.png hazard-map.png shores.png $(if $(slide),deposit-map.png)) \
  $(filter-out map.png,$(figures)) energy.png)
$(work)/pictures.json: $(report)/embed $(report_figures) | $(work)
	@$^ > $@

# What the case says of itself, where it says that it is invented. A map of the user's own is not the case's invention.
$(work)/invented.txt: $(report)/invented.awk $(case) $(wildcard $(case_dir)/README.md $(if $(strip $(TERRAIN)),,$(case_dir)/terrain/README.md)) | $(work)
	@awk $(if $(strip $(TERRAIN)),-v terrain=replaced) -f $^ > $@

report_data := $(out)/summary.json $(addprefix $(work)/,run-attributes.json particles-attributes.json plan.json pictures.json \
  $(if $(maps),shores.json zones.json))
optional_json = $(wildcard $(sensitivity_json))
$(out)/report.html: $(report)/report.jq $(report)/style.css $(here)/numbers.jq $(report_data) $(work)/invented.txt $(optional_json)
	@echo "report $@"
	@jq -n -r -L $(here) -f $< --rawfile style $(report)/style.css --rawfile invented $(work)/invented.txt \
	  --arg date "$$(date -u -r $(out)/run.h5 +%Y-%m-%d)" --arg uncertainty "$$($(uncertainty_line))" \
	  --arg threshold "$(if $(gauges),$$(awk -F, '!/^#/ {sub("arrival_", "", $$10); sub("m_s", "", $$10); print $$10; exit}' $(out)/peaks.csv))" \
	  $(foreach file,$(report_data) $(optional_json),--slurpfile $(subst -,_,$(basename $(notdir $(file)))) $(file)) > $@

.PHONY: report
report: $(out)/report.html

# --- Styles for QGIS --------------------------------------------------------------------------------------------------------
# A raster's style lies beside it as FILE.qml; those of wave.gpkg lie within, in layer_styles. QGIS takes both by itself.
rasters := $(filter %.tif,$(gauge_files) $(slide_files))
.PHONY: styles
styles: $(rasters:.tif=.qml) $(if $(maps),$(work)/wave.styled)

$(out)/%.qml: $(out)/%.tif $(here)/gis/raster.jq $(out)/gauges.json
	@$(call range,$<) | jq -r --arg name $* --arg level $$(jq '.still_water_level_m // 0' $(out)/gauges.json) -f $(here)/gis/raster.jq > $@

# The package keeps its date, so that nothing that was made from it is made again; a copy, so that it is whole at any time.
$(work)/wave.styled: $(out)/wave.gpkg $(here)/gis/vector.jq $(out)/gauges.json | $(work)
	@jq -n --arg runup $$(jq '.shore_runup_m // 1' $(out)/gauges.json) -f $(here)/gis/vector.jq > $(work)/styles.geojson
	@cp $< $(work)/wave.gpkg
	@OGR_CURRENT_DATE=2000-01-01T00:00:00.000Z ogr2ogr -update -overwrite -a_srs None $(work)/wave.gpkg $(work)/styles.geojson -nln layer_styles -nlt NONE -lco FID=id
	@touch -r $< $(work)/wave.gpkg && mv $(work)/wave.gpkg $< && touch $@
