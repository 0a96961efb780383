# How fast the solver is: fixed scenes, run with nothing else beside them. Included by the Makefile.
#
#   make -C pipelines bench                  the scenes in bench/, ROUNDS times in turn: out/bench/bench.json and a table
#   make -C pipelines bench OTHER=FOLDER     the same in turn with the tools built there, and the ratio: above 1 is faster
#   make -C pipelines bench-scaling          cost per particle-step against size, efficiency against threads, the fastest of ROUNDS
#                                            in turn: scaling.json
#   make -C pipelines bench-bars             the two runs of Huang et al. 2023 against their bars of wall time: bars.json
#   make -C pipelines bench-kernels          pair laws, soil, copies and sort one by one (Google Benchmark): kernels.json
#   make -C pipelines bench-warps            what the threads of a CUDA warp wait for, counted without a device
#
# Compare ratios of one call, not figures of different days: machines differ and are shared. SCENES="water-3d soil-3d" takes
# some of them; SPACING=0.5 makes them all finer, 8 times the particles in 3-D and 4 times in 2-D. BENCH_FLAGS go to lgiw-run.
# ./bench-gpu does the same on a machine with a CUDA device.

ROUNDS ?= 3
SPACING ?= 1
SCENES ?= $(notdir $(patsubst %/case.yaml,%,$(wildcard $(here)/bench/*/case.yaml)))
bench_out := $(here)/out/bench
bench_flags = -o $(bench_out)/run.h5 -O -q --backend cpu $(BENCH_FLAGS)
bench_jq := jq -L $(here)/bench

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
	@$(bench_jq) -n -f $(here)/bench/collect.jq \
	  $(foreach scene,$(SCENES),$(foreach who,this $(if $(OTHER),other),$(foreach round,$(shell seq $(ROUNDS)),$(bench_out)/$(scene).$(who).$(round).json))) \
	  > $(bench_out)/bench.json
	@$(bench_jq) -r -f $(here)/bench/table.jq $(bench_out)/bench.json | tee $(bench_out)/bench.txt

# --- Scaling ---------------------------------------------------------------------------------------------------------
# Particles, walls included; up to 2.5e7. Sizes that memory does not allow are left out, and said to be.
SIZES ?= 1e5 3e5 1e6 3e6
THREADS ?= $(shell n=$$(nproc); k=1; while [ $$k -lt $$n ]; do echo $$k; k=$$((2 * k)); done; echo $$n)
SCALING_SCENES ?= water-3d coupled-3d
SCALING_SECONDS ?= 20
scaling := $(bench_out)/scaling
# BENCH_FLAGS=--threads=1 asks for the sizes alone.
scaling_threads := $(if $(findstring --threads,$(BENCH_FLAGS)),,$(THREADS))
timed_run = LGIW_RUN=$(lgiw_run) $(here)/bench/timed-run

.PHONY: bench-scaling
bench-scaling: $(tools)
	@rm -rf $(scaling); mkdir -p $(scaling)
	@for scene in $(SCALING_SCENES); do \
	  sizes=; \
	  for size in $(SIZES); do \
	    $(here)/bench/sized-particles $(dem2particles) $(here)/bench/$$scene/case.yaml $$size $(scaling)/$$size.h5 && sizes="$$sizes $$size"; \
	  done; \
	  $(dem2particles) $(here)/bench/$$scene/case.yaml -o $(scaling)/particles.h5 -O -q; \
	  for round in $$(seq $(ROUNDS)); do \
	    for size in $$sizes; do \
	      $(timed_run) $(scaling)/$$size.h5 $(SCALING_SECONDS) $(scaling)/$$scene.sizes.$$size.$$round.json --backend cpu $(BENCH_FLAGS); \
	    done; \
	    for threads in $(scaling_threads); do \
	      $(timed_run) $(scaling)/particles.h5 $(SCALING_SECONDS) $(scaling)/$$scene.threads.$$threads.$$round.json --backend cpu --threads $$threads $(BENCH_FLAGS); \
	    done; \
	  done; \
	  rm -f $(scaling)/*.h5; \
	done
	@$(bench_jq) -n -f $(here)/bench/scaling.jq $(scaling)/*.json > $(bench_out)/scaling.json
	@$(bench_jq) -r -f $(here)/bench/scaling-table.jq $(bench_out)/scaling.json | tee $(bench_out)/scaling.txt

# --- The paper's own runs --------------------------------------------------------------------------------------------
# Computed up to this share of their end time, a frame or more, and extrapolated; whole with WHOLE=1. BARS: which of bars.json.
PART ?= $(if $(WHOLE),1,0.1)
BARS ?= viroulet huangtian
bars := $(bench_out)/bars
bar = $(shell jq -r '.$(1).$(2)' $(here)/bench/bars.json)

$(bars)/huangtian.h5: $(here)/huangtian/terrain/gorge.asc
$(bars)/%.h5: $(here)/$$(call bar,$$*,case) $(here)/bench/bars.json $(dem2particles)
	@mkdir -p $(@D)
	$(dem2particles) $< --set $(call bar,$*,set) -o $@ -O -q --json > $(bars)/$*.seeded

.PHONY: bench-bars
bench-bars: $(BARS:%=$(bars)/%.h5) $(lgiw_run)
	@for bar in $(BARS); do \
	  end=$$(jq .run.end_time $(bars)/$$bar.seeded); \
	  $(lgiw_run) $(bars)/$$bar.h5 -o $(bars)/$$bar-run.h5 -O --progress --summary $(bars)/$$bar.json \
	    --set output.end_time=$$(jq -n "$$end * $(PART)") $(BENCH_FLAGS); \
	  $(bench_jq) --arg name $$bar --argjson end_time $$end --argjson bar "$$(jq ".$$bar" $(here)/bench/bars.json)" \
	    -f $(here)/bench/bars.jq $(bars)/$$bar.json > $(bars)/$$bar.record; \
	done
	@jq -s . $(BARS:%=$(bars)/%.record) > $(bench_out)/bars.json
	@$(bench_jq) -r -f $(here)/bench/bars-table.jq $(bench_out)/bars.json | tee $(bench_out)/bars.txt

# --- Kernels ---------------------------------------------------------------------------------------------------------
# KERNELS=--benchmark_filter=sort runs some of them, and takes other options of Google Benchmark.
.PHONY: bench-packages bench-kernels
bench-packages:
	@$(here)/install-deps --bench

bench-kernels: $(if $(BIN),,bench-packages)
	@mkdir -p $(bench_out)
ifndef BIN
	@cd $(root) && cmake --preset release >/dev/null && cmake --build $(build) --target lgiw-kernels
endif
	@$(bin)/lgiw-kernels --benchmark_out=$(bench_out)/kernels.json --benchmark_out_format=json $(KERNELS)

# --- Warps -----------------------------------------------------------------------------------------------------------
.PHONY: bench-warps
bench-warps: $(if $(BIN),,packages)
ifndef BIN
	@cd $(root) && cmake --preset release >/dev/null && cmake --build $(build) --target lgiw-warps
endif
	@$(bin)/lgiw-warps
