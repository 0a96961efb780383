# Where the solver is stable, and how it announces that it is not. Included by the Makefile.
#
#   make -C pipelines stability              all points of stability/matrix.jq: out/stability.csv, a table and a figure
#   make -C pipelines stability AXES='CFL' VARIANTS=2-D   axes and variants whose names fit the regular expressions
#
# Every point is a small scene that departs from a sound one along one axis: twice in 2-D, at two particle spacings, once in 3-D.
# STABILITY_JOBS runs at once, of one thread each; TIME_LIMIT seconds a run. Points that are there already are kept until the matrix or the
# tools change.

STABILITY_JOBS ?= $(shell nproc)
TIME_LIMIT ?= 240
AXES ?= .
VARIANTS ?= .
# Where the results go.
stability_out ?= $(here)/out
stability := $(stability_out)/stability

.PHONY: stability
stability: $(stability_out)/stability.txt $(stability_out)/stability.png
	@cat $<

# A point whose case changes is another point.
$(stability)/matrix.json: $(here)/stability/matrix.jq $(here)/stability/judge.jq $(here)/stability/run-point $(dem2particles) $(lgiw_run)
	@rm -rf $(stability)
	@mkdir -p $(stability)
	@jq -n -f $< > $@

# Always looked at: AXES may ask for other points than the last call did.
.PHONY: stability-points
stability-points: $(stability)/matrix.json
	@for id in $$(jq -r --arg axes '$(AXES)' --arg variants '$(VARIANTS)' \
	    'map(select((.axis | test($$axes)) and (.variant | test($$variants)))) | sort_by(.variant == "2-D fine", .variant == "3-D")[] | .id' $<); do \
	  [ -e $(stability)/$$id/row.json ] || echo $$id; done \
	| DEM2PARTICLES=$(dem2particles) LGIW_RUN=$(lgiw_run) TIME_LIMIT=$(TIME_LIMIT) \
	  xargs -r -P $(STABILITY_JOBS) -I ID $(here)/stability/run-point ID $< $(stability)

$(stability_out)/stability.json: stability-points
	@jq -s 'sort_by(.id)' $(stability)/*/row.json > $@

$(stability_out)/stability.csv: $(stability_out)/stability.json
	@jq -r '["axis", "value", "scene", "variant", "dimension", "resolution_m", "pass", "criterion", "dt_s", "dt_limited_by", "largest_stable_cfl", "particles", "wall_time_s", "announced"], (.[] | [.axis, .value, .scene, .variant, .dimension, .particle_spacing_m, .pass, .criterion, .dt_s, .dt_limited_by, .largest_stable_cfl, .particles, .wall_time_s, .announced]) | @csv' $< > $@

$(stability_out)/stability.txt: $(here)/stability/table.jq $(stability_out)/stability.json $(stability_out)/stability.csv $(here)/numbers.jq
	@jq -r -L $(here) -f $(wordlist 1,2,$^) | column -t -s "$$(printf '\t')" > $@

$(stability_out)/stability.png: $(here)/figures/stability.gp $(stability_out)/stability.json
	@echo "figure $(@F)"; gnuplot -e "data='< jq -r -f $(here)/stability/marks.jq $(stability_out)/stability.json'; set output '$@'" $<
