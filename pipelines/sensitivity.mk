# How much uncertain inputs move the answer, next to the numerical error. Included by the Makefile.
#
#   make -C pipelines CASE=mycase sensitivity
#
# Runs the case again with the friction angle of the soil (and of a Coulomb bed) FRICTION_STEP degrees lower and higher,
# with the still water level LEVEL_STEP metres lower and higher, and at DP_FACTORS times the particle spacing, each in
# out/mycase/sensitivity/<variant>/. Then sensitivity.csv, .txt and .json there tell how far each moves the maximum wave
# height at the gauges, the run-up, the slide volume and the immersed volume, and which dominates. The numerical error
# is the spread between two spacings; with DP_FACTORS="1.5 2.25" it is the GCI where the results converge.

FRICTION_STEP ?= 2
# auto: 1 m, or 2 % of the greatest depth where that is less (flumes).
LEVEL_STEP ?= auto
DP_FACTORS ?= 1.5

sensitivity := $(out)/sensitivity
sensitivity_json := $(sensitivity)/sensitivity.json
sensitivity_plan := $(sensitivity)/plan.json

# The line of the case's summary, as shell; it is out of date when the case has been run again since.
uncertainty_line = if [ -e $(sensitivity_json) ] && ! [ $(out)/run.h5 -nt $(sensitivity_json) ]; then jq -r .line $(sensitivity_json); \
  else echo "not studied$$(if [ -e $(sensitivity_json) ]; then echo " since the last run"; fi); type make -C pipelines $(if $(CASE_DIR),CASE_DIR=$(CASE_DIR),CASE=$(CASE))$(if $(filter 1,$(words $(DP))), DP=$(strip $(DP))) sensitivity"; fi

.PHONY: sensitivity sensitivity-results
# What can be varied is known once the case itself has been run: hence the second make.
sensitivity: $(out)/summary.json $(sensitivity_plan)
	@$(again) sensitivity-results
	@$(again) $(out)/summary.txt $(out)/report.html
	@cat $(sensitivity)/sensitivity.txt

# Written only when it changes, so that another step reruns the variants and the same one does not.
$(sensitivity_plan): $(out)/gauges.json $(here)/sensitivity-plan.jq sensitivity-steps
	@mkdir -p $(@D)
	@jq --arg friction_step '$(FRICTION_STEP)' --arg level_step '$(LEVEL_STEP)' --arg dp_factors '$(DP_FACTORS)' \
	  -f $(here)/sensitivity-plan.jq $(out)/gauges.json > $@.new
	@if cmp -s $@.new $@; then rm $@.new; else mv $@.new $@; fi
.PHONY: sensitivity-steps

variants := $(if $(filter sensitivity-results,$(MAKECMDGOALS)),$(shell jq -r '.variants | keys[]' $(sensitivity_plan)))
variant_summaries := $(foreach variant,$(variants),$(sensitivity)/$(variant)/summary.json)

ifneq ($(variants),)
sensitivity-results: $(sensitivity)/sensitivity.txt $(sensitivity)/sensitivity.csv

$(sensitivity)/%/overrides: $(sensitivity_plan)
	@mkdir -p $(@D)
	@jq -r '.variants["$*"] | map("--set " + .) | join(" ")' $< > $@.new
	@if cmp -s $@.new $@; then rm $@.new; else mv $@.new $@; fi

$(sensitivity)/%/particles.h5: $(sensitivity)/%/overrides $(case) $(sort $(wildcard $(case_dir)/terrain/*) $(computed_terrain)) $(user_maps) $(dem2particles)
	$(dem2particles) $(case) $(set_flags) $$(cat $<) -o $@ -O -q --dependencies $(@D)/particles.d
-include $(wildcard $(sensitivity)/*/particles.d)

$(sensitivity)/%/run.h5 $(sensitivity)/%/run.json: $(sensitivity)/%/particles.h5 $(lgiw_run)
	$(lgiw_run) $< -o $(@D)/run.h5 -O --progress --summary $(@D)/run.json $(if $(BACKEND),--backend $(BACKEND)) $(RUN_FLAGS)

$(sensitivity)/%/gauges.json: $(sensitivity)/%/run.h5 $(gauges_tool)
	@$(gauges_tool) $< -q --json > $@

$(sensitivity)/%/slide.json: $(sensitivity)/%/run.h5 $(deposit_volume)
	@$(deposit_volume) $< -q --json > $@

$(sensitivity)/%/summary.json: $(here)/merge.jq $(sensitivity)/%/run.json $(sensitivity)/%/gauges.json $(if $(slide),$(sensitivity)/%/slide.json)
	@jq -s -f $^ > $@

$(sensitivity)/convergence.json: $(out)/run.h5 $(patsubst %,$(sensitivity)/%/run.h5,$(filter dp%,$(variants))) $(convergence_tool)
	$(convergence_tool) $(filter %.h5,$^) --json > $@

$(sensitivity_json): $(here)/sensitivity.jq $(sensitivity_plan) $(out)/summary.json $(sensitivity)/convergence.json $(variant_summaries)
	@jq -s --arg variants '$(variants)' -f $^ > $@

$(sensitivity)/sensitivity.txt: $(here)/sensitivity-text.jq $(sensitivity_json)
	@jq -r -f $^ > $@

$(sensitivity)/sensitivity.csv: $(sensitivity_json)
	@jq -r '.variants as $$v | (["quantity", "unit", "value"] + ($$v | map("change_" + .)) + ["friction", "level", "numerical_error", "numerical_basis", "dominates"]), (.rows[] | . as $$row | [.quantity, .unit, .value] + ($$v | map($$row.changes[.])) + [.friction, .level, .numerical, .basis, .dominates]) | @csv' $< > $@
endif
