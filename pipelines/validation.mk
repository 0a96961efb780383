# How wrong the solver is, benchmark by benchmark, and what accuracy costs. Included by the Makefile.
#
#   make -C pipelines validate         all benchmarks; then one line a quantity, measured against its bar
#   make -C pipelines validate-tank    one of them (a folder in validation/); the table keeps the rows of the others
#   make -C pipelines validate-clean   removes all their results; validate-clean-tank those of one
#   make -C pipelines error-vs-time    the study of schemes: error against run time, as table and figure
#
# LEVELS says which of the runs in validation/*/runs.txt are made: full (the default), quick (seconds; what the tests do),
# fine (hours), or several: LEVELS="full fine". A rebuilt tool reruns nothing, an edit of a case or of its runs does.

LEVELS ?= full
validation := $(here)/validation
validation_out := $(here)/out/validation
validation_cases := $(notdir $(patsubst %/runs.txt,%,$(wildcard $(validation)/*/runs.txt)))
lgiw_validation := $(build)/bin/lgiw-validation
$(lgiw_validation): compile
	@:

# The runs of the levels asked for, as CASE/RUN; a line of runs.txt is: run, its levels, arguments of dem2particles.
validation_runs := $(shell cd $(validation) && awk -v levels="$(LEVELS)" '\
  BEGIN {n = split(levels, wanted, /[ ,]+/)} \
  /^[^#]/ && NF >= 2 {for (k = 1; k <= n; ++k) if ("," $$2 "," ~ "," wanted[k] ",") {print substr(FILENAME, 1, length(FILENAME) - 9) "/" $$1; break}}' \
  */runs.txt)
case_has = $(shell grep -q '^$(2) *:' $(validation)/$(1)/case.yaml && echo $(2))
find_tables = run.json $(if $(call case_has,$(1),gauges),gauges.csv) $(if $(call case_has,$(1),slide),slide.csv)
$(foreach case,$(validation_cases),$(eval case_tables_$(case) := $(call find_tables,$(case))))
case_results = $(foreach run,$(filter $(1)/%,$(validation_runs)),$(addprefix $(validation_out)/$(run)/,$(case_tables_$(1))))

.PHONY: validate validate-runs $(addprefix validate-,$(validation_cases)) validate-clean $(addprefix validate-clean-,$(validation_cases)) FORCE
validate: $(addprefix $(validation_out)/,$(addsuffix /rows.csv,$(validation_cases)))
$(foreach case,$(validation_cases),$(eval validate-$(case): $(validation_out)/$(case)/rows.csv))
validate $(addprefix validate-,$(validation_cases)): | $(lgiw_validation)
	@$(lgiw_validation) merge $(validation_out) -o $(here)/out/validation.csv -O

# The runs alone, without judging them.
validate-runs: $(foreach case,$(validation_cases),$(call case_results,$(case)))

validate-clean:
	rm -rf $(validation_out) $(here)/out/validation.csv
$(addprefix validate-clean-,$(validation_cases)): validate-clean-%:
	rm -rf $(validation_out)/$*

.SECONDEXPANSION:
.PRECIOUS: $(validation_out)/%/overrides $(validation_out)/%/particles.h5 $(validation_out)/%/run.json
# Written only when they change, so that an edit of one run's line reruns that run.
$(validation_out)/%/overrides: FORCE
	@mkdir -p $(@D)
	@awk '$$1 == "$(notdir $*)" {$$1 = $$2 = ""; print}' $(validation)/$(*D)/runs.txt > $@.new
	@if cmp -s $@.new $@; then rm $@.new; else mv $@.new $@; fi

$(validation_out)/%/particles.h5: $(validation)/$$(*D)/case.yaml $(validation_out)/%/overrides | $(dem2particles)
	$(dem2particles) $< $$(cat $(@D)/overrides) -o $@ -O -q

# One run at a time, even under make -j: they are timed.
$(validation_out)/%/run.json $(validation_out)/%/run.h5: $(validation_out)/%/particles.h5 | $(lgiw_run)
	flock $(validation_out)/.lock $(lgiw_run) $< -o $(@D)/run.h5 -O -q --summary $(@D)/run.json

$(validation_out)/%/gauges.csv: $(validation_out)/%/run.h5 | $(gauges_tool)
	$(gauges_tool) $< -o $@ -O -q --long

$(validation_out)/%/slide.csv: $(validation_out)/%/run.h5 | $(deposit_volume)
	$(deposit_volume) $< -o $@ -O -q

$(validation_out)/%/rows.csv: $(validation)/%/checks.yaml $(validation)/%/runs.txt $$(call case_results,$$*) | $(lgiw_validation)
	$(lgiw_validation) check $(validation)/$* $(validation_out)/$* -o $@ -O
