# How fast the solver is: fixed scenes, run with nothing else beside them. Included by the Makefile.
#
#   make -C pipelines bench                  the scenes in bench/, ROUNDS times in turn: out/bench/bench.json and a table
#   make -C pipelines bench OTHER=FOLDER     the same in turn with the tools built there, and the ratio: above 1 is faster
#
# Compare ratios of one call, not figures of different days: machines differ and are shared. SCENES="water-3d soil-3d" takes
# some of them; SPACING=0.5 makes them all finer, 8 times the particles in 3-D and 4 times in 2-D. BENCH_FLAGS go to lgiw-run.

ROUNDS ?= 3
SPACING ?= 1
SCENES ?= $(notdir $(patsubst %/case.yaml,%,$(wildcard $(here)/bench/*/case.yaml)))
bench_out := $(here)/out/bench
bench_flags = -o $(bench_out)/run.h5 -O -q --backend cpu $(BENCH_FLAGS)

.PHONY: bench
bench: $(tools)
	@mkdir -p $(bench_out)
	@for scene in $(SCENES); do \
	  case=$(here)/bench/$$scene/case.yaml; \
	  spacing=$$(awk -v f=$(SPACING) '/^particle_spacing/ {print $$2 * f}' $$case); \
	  $(dem2particles) $$case -o $(bench_out)/$$scene.h5 -O -q --set particle_spacing=$$spacing; \
	  for round in $$(seq $(ROUNDS)); do \
	    $(lgiw_run) $(bench_out)/$$scene.h5 $(bench_flags) --summary $(bench_out)/$$scene.this.$$round.json; \
	    $(if $(OTHER),$(abspath $(OTHER))/lgiw-run $(bench_out)/$$scene.h5 $(bench_flags) --summary $(bench_out)/$$scene.other.$$round.json;) \
	  done; \
	done
	@rm -f $(bench_out)/run.h5
	@jq -n -f $(here)/bench/collect.jq \
	  $(foreach scene,$(SCENES),$(foreach who,this $(if $(OTHER),other),$(foreach round,$(shell seq $(ROUNDS)),$(bench_out)/$(scene).$(who).$(round).json))) \
	  > $(bench_out)/bench.json
	@jq -r -f $(here)/bench/table.jq $(bench_out)/bench.json | tee $(bench_out)/bench.txt
