# The same case at several particle spacings, and how far the results agree. Included by the Makefile.
#
#   make -C pipelines mycase DP="20 15 10"
#
# Each run has all its results in out/mycase/dp<spacing>/. In out/mycase/ lie convergence.csv and .json (observed order, GCI or
# spread of wave heights, run-up and volumes), spacings.txt (what each run cost and gave, beside reference.csv of the case folder,
# where there is one), maps of the differences from the finest run, and figures of all runs together.

.PHONY: spacings spacings-results

ifdef several_spacings
spacings_in_order := $(shell printf '%s\n' $(DP) | sort -gr)

# Runs one behind the other: each takes all cores. What they hold is known once they are there: hence the other makes.
spacings: tools
	@for dp in $(spacings_in_order); do $(again) DP=$$dp case; done
	@$(again) DP='$(DP)' spacings-results
	@cat $(out)/spacings.txt
	@printf '\nFiles in %s:\n' $(out)
	@ls -C -w 100 $(out)

folders := $(foreach dp,$(spacings_in_order),$(out)/dp$(dp))
reference := $(wildcard $(case_dir)/reference.csv)
spacing_figures := $(if $(gauges),gauges heights) $(if $(slide),slide $(if $(sections),final-sections))
spacings-results: $(out)/spacings.txt $(patsubst %,$(out)/by-spacing-%.png,$(spacing_figures)) $(if $(maps),$(out)/differences.png)

$(out)/convergence.json $(out)/convergence.csv &: $(addsuffix /run.h5,$(folders)) $(convergence_tool)
	$(convergence_tool) $(filter %.h5,$^) -O -q -o $(out)/convergence.csv --summary $(out)/convergence.json \
	  $(if $(maps),--difference-maps $(out)/differences)

$(out)/spacings.json: $(addsuffix /summary.json,$(folders))
	@jq -s '.' $^ > $@

$(out)/spacings.txt: $(here)/spacings.jq $(out)/spacings.json $(out)/convergence.json $(reference) $(here)/numbers.jq
	@jq -n -r -L $(here) --slurpfile runs $(out)/spacings.json --slurpfile convergence $(out)/convergence.json \
	  --rawfile reference $(or $(reference),/dev/null) -f $< | column -t -s "$$(printf '\t')" > $@

# Scripts see the spacings as words, finest last, and reference.csv ("" where there is none).
$(out)/by-spacing-%.png: $(here)/figures/by-spacing-%.gp $(here)/figures/common.gp $(out)/spacings.json $(reference)
	@echo "figure $(@F)"; gnuplot -e "case='$(CASE)'; out='$(out)'; spacings='$(spacings_in_order)'; reference='$(reference)'" \
	  -e "set loadpath '$(here)/figures'; set output '$@'" $<

$(out)/differences.png: $(here)/figures/differences.gp $(here)/figures/common.gp $(out)/convergence.json | $(work)
	@for map in $(out)/differences/*.tif; do gdal_translate -q -of XYZ $$map /vsistdout/ | $(rows) > $(work)/$$(basename $$map .tif).xyz; done
	@echo "figure $(@F)"; gnuplot -e "case='$(CASE)'; work='$(work)'; maps='$$(ls $(out)/differences | sed -n 's/\.tif$$//p' | xargs)'" \
	  -e "set loadpath '$(here)/figures'; set output '$@'" $<
endif
