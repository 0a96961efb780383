# One case with several values of its keys: independent runs, one table, maps of the worst of all. Included by the Makefile.
#
#   make -C pipelines mycase sweep -j4          runs what pipelines/mycase/sweep.yaml says (docs/sweep.md), four runs at a time
#   make -C pipelines mycase sweep-list         its runs by number and name, and the commands that run them under Slurm
#   make -C pipelines mycase sweep-gather       table, maps and figures of the runs that are there
#   make -C pipelines mycase MEMBER=2           everything (figures, report) of one of its runs, by number or name
#
# Each run lies in out/mycase/sweep/<name>/. In out/mycase/sweep/ lie sweep.txt and .csv (a line a run), envelope_height.tif,
# envelope_hazard.tif, envelope_arrival.tif, share_above_1m.tif and share_above_3m.tif, styles for QGIS, and figures.
# SWEEP=other.yaml is another sweep of the case, with results in out/mycase/other/. Each run gets as many threads as there are
# cores for it: cores / runs at a time. A run that fails is marked, keeps its log, and is tried again next time.

sweep_file := $(case_dir)/$(or $(SWEEP),sweep.yaml)
sweep_work := $(sweep)/.work
sweep_words = $(if $(CASE_DIR),CASE_DIR=$(CASE_DIR),CASE=$(CASE)) \
  $(if $(OUT),OUT=$(abspath $(OUT))) $(foreach word,DP SWEEP,$(if $($(word)),$(word)=$($(word)))) \
  $(foreach word,TERRAIN SITE,$(if $($(word)),$(word)=$(call user_map,$(word))))
# For the shell: writes what it is given to a file, unless that holds it already.
keep := keep() { cat > "$$1.new"; if cmp -s "$$1.new" "$$1"; then rm "$$1.new"; else mv "$$1.new" "$$1"; fi; };

.PHONY: sweep sweep-list sweep-plan sweep-runs sweep-gather sweep-member sweep-results
# What is to be run is known once the sweep has been read, what is to be gathered once it has been run: hence the other makes.
sweep: tools
	+@$(again) BIN='$(bin)' sweep-plan
	+@$(again) BIN='$(bin)' sweep-runs
	+@$(again) BIN='$(bin)' sweep-gather

# Every run's case as it is, from whose contents make sees what an edit touches.
sweep-plan: $(dem2particles) $(computed_terrain)
	@mkdir -p $(sweep)
	@$(dem2particles) $(case) $(set_flags) --sweep $(sweep_file) --json > $(sweep)/runs.json.new
	@mv $(sweep)/runs.json.new $(sweep)/runs.json
	@$(keep) jq -r '.runs[].name' $(sweep)/runs.json | { k=0; while read -r name; do mkdir -p "$(sweep)/$$name"; \
	  jq -j --argjson k $$k '.runs[$$k].case_text' $(sweep)/runs.json | keep "$(sweep)/$$name/case.yaml"; \
	  jq -r --argjson k $$k '.runs[$$k].overrides[] | "--set", .' $(sweep)/runs.json | keep "$(sweep)/$$name/overrides"; k=$$((k + 1)); done; }

sweep-list: tools
	+@$(again) BIN='$(bin)' sweep-plan
	@mkdir -p $(here)/out  # where the jobs' logs go
	@jq -r '.runs | to_entries[] | "\(.key + 1)\t\(.value.name)"' $(sweep)/runs.json
	@n=$$(jq '.runs | length' $(sweep)/runs.json); words='$(strip $(sweep_words))'; printf '\n%s\n%s\n%s\n' 'Under Slurm, with the folders that all nodes see:' \
	  "  job=\$$(sbatch --parsable --chdir=$(here) --array=1-$$n $(here)/sweep.sbatch $$words)" \
	  "  sbatch --chdir=$(here) --dependency=afterany:\$$job $(here)/sweep.sbatch $$words"

# Names, where the goal wants them.
sweep_names := $(if $(filter sweep-runs sweep-gather sweep-results,$(MAKECMDGOALS)),$(shell jq -r '.runs[].name' $(sweep)/runs.json 2>/dev/null))
sweep_jobs := $(addprefix sweep-run-,$(sweep_names))
.PHONY: $(sweep_jobs)
sweep-runs: $(sweep_jobs)

# Under make -jN so many runs at a time share the cores; in a Slurm job they are the job's. A failure is told at the end.
$(sweep_jobs): sweep-run-%:
	+@jobs=$$(sed -n 's/ -- .*//; s/.*-j *\([0-9]*\).*/\1/p' <<< " $$MAKEFLAGS "); case "$$MAKEFLAGS " in *-j*) jobs=$${jobs:-$(words $(sweep_names))} ;; *) jobs=1 ;; esac; \
	[ $$jobs -le $(words $(sweep_names)) ] || jobs=$(words $(sweep_names)); threads=$$(($$(nproc) / jobs)); [ $$threads -ge 1 ] || threads=1; \
	$(MAKE) --no-print-directory -f $(here)/Makefile CASE=$(CASE) BIN='$(bin)' MEMBER='$*' RUN_FLAGS="$(if $(findstring --threads,$(RUN_FLAGS)),,--threads $$threads )$(RUN_FLAGS)" sweep-member \
	  || echo "sweep: $* failed: $$(cat '$(sweep)/$*/failed')"

# One run, which leaves `failed` with a line that says why where it does not come to its end. Under make -n it touches nothing.
sweep-member:
	+@case "$${MAKEFLAGS%% *}" in (--*) ;; (*n*) exit 0 ;; esac; \
	mkdir -p $(work); echo 'it was stopped' > $(out)/failed; echo "sweep: $(member)$(if $(RUN_FLAGS), ($(strip $(RUN_FLAGS))))"; \
	if $(again) sweep-results > $(out)/log 2>&1; then rm $(out)/failed; else \
	  { grep -E '^($(subst $(empty) $(empty),|,$(notdir $(tools)))): ' $(out)/log || grep -v '^make' $(out)/log || echo 'see its log'; } | tail -n 1 > $(out)/failed; exit 1; fi

ifdef MEMBER
sweep-results: $(out)/summary.json $(gauge_files) $(slide_files)
else
# --- What the runs gave ----------------------------------------------------------------------------------------------
sweep_done := $(foreach name,$(sweep_names),$(if $(wildcard $(sweep)/$(name)/summary.json),$(if $(wildcard $(sweep)/$(name)/failed),,$(sweep)/$(name))))
sweep_maps := $(if $(and $(maps),$(sweep_done)),$(addprefix $(sweep)/,envelope_height.tif envelope_hazard.tif envelope_arrival.tif share_above_1m.tif share_above_3m.tif))

# Fails at its end where a run has.
sweep-gather:
	+@$(again) sweep-results
	@cat $(sweep)/sweep.txt; jq -e '[.runs[] | select(.error)] | length == 0' $(sweep)/sweep.json > /dev/null

sweep-results: $(sweep)/sweep.txt $(sweep)/sweep.csv $(sweep_maps) $(sweep_maps:.tif=.qml) $(if $(sweep_done),$(sweep)/sweep.png) $(if $(sweep_maps),$(sweep)/sweep-map.png)

$(sweep_work):
	@mkdir -p $@

# Written only when it changes: what was made from it stays.
.PHONY: sweep-state
sweep-state:
$(sweep)/sweep.json: $(here)/sweep/collect.jq sweep-state | $(sweep_work)
	@$(keep) jq -r '.runs[].name' $(sweep)/runs.json | while read -r name; do folder="$(sweep)/$$name"; \
	  if [ -e "$$folder/failed" ]; then jq -n --rawfile error "$$folder/failed" '{error: $$error}'; \
	  elif [ -e "$$folder/summary.json" ]; then jq '{summary: .}' "$$folder/summary.json"; else echo '{"error": "not run yet"}'; fi; done \
	  | jq -s --arg case '$(CASE)' --slurpfile plan $(sweep)/runs.json -f $< | keep $@

$(sweep)/sweep.csv: $(here)/sweep/csv.jq $(sweep)/sweep.json
	@jq -r -f $^ > $@

$(sweep)/sweep.txt: $(here)/sweep/text.jq $(sweep)/sweep.json $(here)/numbers.jq $(here)/sweep/values.jq
	@jq -r -L $(here) -f $(wordlist 1,2,$^) > $@

$(sweep_maps) &: $(here)/sweep/envelope $(sweep)/sweep.json $(foreach folder,$(sweep_done),$(addprefix $(folder)/,max_elevation.tif hazard.tif arrival.tif)) | $(sweep_work)
	@echo "maps over $(words $(sweep_done)) runs"; $(here)/sweep/envelope $(sweep) $(sweep_work) $(sweep_done)

$(sweep)/%.qml: $(sweep)/%.tif $(here)/gis/raster.jq
	@$(call range,$<) | jq -r --arg name $* --arg level 0 -f $(here)/gis/raster.jq > $@

$(sweep_work)/%.xyz: $(sweep)/%.tif | $(sweep_work)
	$(as_rows)
# The ground of any run that has one.
$(sweep_work)/ground.xyz: $(firstword $(sweep_done))/ground.tif | $(sweep_work)
	$(as_rows)
$(sweep_work)/hillshade.xyz: $(firstword $(sweep_done))/ground.tif | $(sweep_work)
	$(as_hillshade)

sweep_draw = @echo "figure $(@F)"; gnuplot -e "case='$(CASE)'; out='$(firstword $(sweep_done))'; work='$(sweep_work)'; set loadpath '$(here)/figures'; set output '$@'" $<
$(sweep_work)/points.csv: $(here)/sweep/points.jq $(sweep)/sweep.json $(here)/sweep/values.jq
	@jq -r -L $(here) -f $(wordlist 1,2,$^) > $@
$(sweep)/sweep.png: $(here)/figures/sweep.gp $(here)/figures/common.gp $(sweep_work)/points.csv
	$(sweep_draw)
$(sweep)/sweep-map.png: $(here)/figures/sweep-map.gp $(here)/figures/common.gp $(here)/figures/ground.gp \
    $(addprefix $(sweep_work)/,ground.xyz hillshade.xyz $(addsuffix .xyz,$(basename $(notdir $(sweep_maps)))))
	$(sweep_draw)
endif
